# SPDX-License-Identifier: GPL-3.0-or-later
# The face of roomcut: `make help`. The rules of the pipeline are in stages/pipeline.mk, run inside the work folder by
# stages/pipeline.sh. Which packages are needed stands in .ci/debian-packages.txt.

.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory --no-builtin-rules
.SUFFIXES:

# From the command line; passed on through the environment as they were typed, so that names may hold spaces and any letters, "$" too:
# Make expands none of them, and hands none on to another make.
BUILD ?= build
given := SCAN WORK CONFIG BUILD JOBS UP UNIT LEVEL STATIONS TRUTH PORT QUIET ONLY BASE OUT ROOT PRESET SWITCHES A B
$(foreach name,$(given),$(eval override $(name) := $$(value $(name))))
export $(given)
# Shells call the width of a terminal COLUMNS, too: only that of the command line is meant.
TEXT_COLUMNS := $(if $(filter command,$(firstword $(origin COLUMNS))),$(value COLUMNS))
export TEXT_COLUMNS
unexport COLUMNS
MAKEOVERRIDES :=

stages := $(shell sed -n 's/^\([a-z][a-z_]*\) .*/\1/p' stages/pipeline.table)
sources = git ls-files -co --exclude-standard '*.h' '*.cpp'
generator = $$(command -v ninja > /dev/null && echo "-G Ninja")
# Tests run make themselves; it must not take itself for a part of this one.
quiet_make = env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL
pipeline = +@sh stages/pipeline.sh

.PHONY: help deps configured build programs pipeline_programs parameters test demo run status verify view edit-lines diff-lines drop-edit edit-planes drop-planes layers evaluate compare accuracy ablation accuracy-walls accuracy-weights bench fuzz robustness tidy format ready ready_tools \
        $(stages) $(stages:%=rerun-%) $(stages:%=clean-%) $(stages:%=plot-%)

help:
	@printf '%s\n' \
	'make demo                     set up, build, make a synthetic two-storey scan, reconstruct it (work/demo/)' \
	'make test                     set up, build, run every test' \
	'make build | programs | deps  build all into build/ | all but the tests | install what is missing: Debian packages, readers of E57, LAS, LAZ' \
	'' \
	'make run SCAN=office.ply      the whole pipeline into work/office/' \
	'make STAGE SCAN=…             up to and including one stage' \
	'make rerun-STAGE SCAN=…       that stage again, and of what follows only what it changes' \
	'make plot-STAGE | clean-STAGE the result of a stage as SVG and PNG | delete what a stage wrote' \
	'make status | verify SCAN=…   what would run, and why | compute all digests again' \
	'make view SCAN=…              the report in the browser, served on this machine only; lines edited there are saved' \
	'make edit-lines SCAN=…        copy the lines to work/office/edits/wall_lines.geojson, to be edited' \
	'make layers SCAN=…            for QGIS: where points are in each slice, beside the lines (edit-lines does so too)' \
	'make diff-lines | drop-edit   what the edit changes | move it aside' \
	'make edit-planes | drop-planes  the same of sloped floors and ceilings: edits/planes.geojson; move it aside' \
	'make compare A=… B=…          two work folders side by side: parameters, lines, rooms, models; a page and JSON' \
	'make report | evaluate TRUTH=truth.off | bench | tidy | format' \
	'make parameters               after a change of parameters: pipeline.yaml, its JSON Schema, the tables of the READMEs' \
	'make accuracy                 scores of scenes with known truth, in one table; ONLY="virtual uniform_house_*" some of' \
	'                              them, BASE=old.json what changed since, OUT=file the JSON (work/accuracy/accuracy.json)' \
	'                              PRESET=paper_2013: the method as published, beside the defaults' \
	'make ablation                 what each addition to the paper is worth: all of them off, one at a time; ONLY=, SWITCHES=' \
	'make accuracy-walls           errors of walls and heights beside their stated sigmas; ONLY="uniform_3mm …", OUT=file' \
	'make accuracy-weights         after make accuracy: weights of the data term learned with every building left out; ONLY=, OUT=file,' \
	'                              FOLDS="duplex …" which are left out (or none), GENERATIONS=80 of the search;' \
	'                              ROOT=folder of its work folders, here and in make accuracy, instead of work/accuracy/' \
	'' \
	'make fuzz                     every reader fed with damaged bytes, SECONDS=60 each (libFuzzer, clang); ONLY="slices edit …"' \
	'make robustness               N=330 damaged files of each kind for every program that reads them; ONLY=, SEED=; then every' \
	'                              write, allocation … of every stage fails once' \
	'' \
	'Stages: $(stages)' \
	'WORK=folder    instead of work/<name of the scan>      CONFIG=my.yaml  parameters instead of pipeline.yaml' \
	'UP=y UNIT=mm   how the scan is to be read              STATIONS=file   scanner positions, x y z on each line' \
	'COLUMNS=-,x,y,z  what each column of a text scan is    LEVEL=no        a leaning scan is not levelled' \
	'               (these six hold until said otherwise; CONFIG=none, STATIONS=none, COLUMNS=auto, LEVEL=yes take them back)' \
	'JOBS=n         threads of a stage; default: all        PORT=n          of make view; default: any free one' \
	'BUILD=folder   of the programs instead of build/       QUIET=1         errors only'

deps:
	@sh .ci/install-packages.sh
	@sh .ci/install-python.sh "$$BUILD"

configured: deps
	@[ -f "$$BUILD/CMakeCache.txt" ] || cmake -S . -B "$$BUILD" $(generator) $(CMAKE_ARGS)

build: configured
	@cmake --build "$$BUILD"

# Without the tests, which are more than a quarter of a build; and of the programs only those of pipeline.table, which make a model.
programs pipeline_programs: configured
	@cmake --build "$$BUILD" --target $@

# What is made from the parameters as the programs describe them (contract_pipeline_yaml compares).
parameters: programs
	@sh stages/pipeline_yaml.sh "$$BUILD" > pipeline.yaml.tmp && mv pipeline.yaml.tmp pipeline.yaml
	@python3 stages/pipeline_schema.py "$$BUILD" > schemas/pipeline.schema.tmp && mv schemas/pipeline.schema.tmp schemas/pipeline.schema.json
	@python3 stages/parameter_tables.py "$$BUILD"

test: build
	@$(quiet_make) ctest --test-dir "$$BUILD" --output-on-failure -j "$$(nproc)"

# What a command runs, built when it is not there yet. After a change of the sources: make build.
ready:
	@[ -x "$$BUILD/bin/report" ] && [ -x "$$BUILD/bin/artefact" ] || $(MAKE) pipeline_programs
ready_tools: ready
	@[ -x "$$BUILD/bin/view" ] && [ -x "$$BUILD/bin/compare" ] && [ -x "$$BUILD/bin/diff_lines" ] && [ -x "$$BUILD/bin/verify" ] || $(MAKE) programs
view compare diff-lines verify: ready_tools

demo: pipeline_programs
	@mkdir -p work/demo
	@"$$BUILD/bin/synthesize" --scene tests/data/scenes/paper_two_storeys.json --scan-out work/demo/scan.ply \
	  --truth-out work/demo/truth.off --truth-json work/demo/truth.json
	+@SCAN=work/demo/scan.ply WORK=work/demo sh stages/pipeline.sh run
	+@SCAN=work/demo/scan.ply WORK=work/demo TRUTH=work/demo/truth.off sh stages/pipeline.sh evaluate
	@printf '%s\n' '' 'The demo lies in work/demo/:' '  scan.ply                the scan, made from a scene in tests/data/scenes/' \
	  '  model.ply, model.obj    the model' '  summary.json            storeys, rooms, areas, volumes, checks' \
	  '  report.html             every stage in pictures' '  evaluate/scores.json    how far from the truth (truth.off)' \
	  'Your own scan: make run SCAN=office.ply'

run status verify view edit-lines diff-lines drop-edit edit-planes drop-planes layers evaluate compare: ready
	$(pipeline) $@

$(stages): ready
	$(pipeline) run $@
$(stages:%=rerun-%): ready
	$(pipeline) rerun $(@:rerun-%=%)
$(stages:%=clean-%): ready
	$(pipeline) clean $(@:clean-%=%)
$(stages:%=plot-%): ready
	$(pipeline) plot $(@:plot-%=%)

accuracy: build
	@$(quiet_make) python3 tests/accuracy/accuracy.py "$$BUILD"

ablation: build
	@$(quiet_make) python3 tests/accuracy/ablation.py "$$BUILD"

accuracy-walls: build
	@set -f; $(quiet_make) python3 tests/accuracy/walls.py --build "$$BUILD" $${OUT:+--json "$$OUT"} $${ONLY:+--only $$ONLY}

accuracy-weights: build
	@$(quiet_make) python3 tests/accuracy/leave_one_out.py "$$BUILD"

# BENCH: options of tests/bench/bench.py, e.g. "--sizes 1,4,10,40,100 --series grown".
bench: deps
	@sh .ci/install-packages.sh debian-packages-ci.txt
	@cmake -S . -B "$$BUILD" $(generator) -DROOMCUT_BENCH=ON $(CMAKE_ARGS) > /dev/null
	@cmake --build "$$BUILD"
	@python3 tests/bench/bench.py "$$BUILD" $(BENCH)

# A build of its own, of what the targets need (build-fuzz/); what it finds is kept in build-fuzz/findings/.
fuzz: build
	@sh .ci/install-packages.sh debian-packages-ci.txt
	@cmake --preset fuzz > /dev/null
	@cmake --build build-fuzz --target fuzz
	@$(quiet_make) /usr/bin/python3 tests/fuzz/fuzz.py . "$$BUILD" build-fuzz --seconds $(or $(SECONDS),60) $(if $(ONLY),--only $(ONLY))

robustness: build
	@sh .ci/install-packages.sh debian-packages-ci.txt
	@$(quiet_make) /usr/bin/python3 tests/robustness/mutate.py . "$$BUILD" --n $(or $(N),330) --seed $(or $(SEED),1) \
	  --keep work/robustness $(OUT:%=--json %) $(if $(ONLY),--only $(ONLY))
	@[ -n "$(ONLY)" ] || $(quiet_make) /usr/bin/python3 tests/robustness/faults.py . "$$BUILD" --kills 200

# Configured on its own, nothing is built: GCC's precompiled headers are not for clang.
tidy: deps
	@sh .ci/install-packages.sh debian-packages-ci.txt
	@cmake --preset tidy > /dev/null
	@$(sources) -- '*.cpp' | xargs -P "$$(nproc)" -n 4 clang-tidy -p build-tidy --quiet

format:
	@sh .ci/install-packages.sh debian-packages-ci.txt
	@$(sources) | xargs clang-format -i
