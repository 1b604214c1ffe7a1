# SPDX-License-Identifier: GPL-3.0-or-later
# The rules of the pipeline: what each stage reads and writes, and in which order they run. stages/pipeline.sh runs this file inside a
# work folder, so that all names here are relative and have no spaces, whatever the folder is called. From the environment: ROOMCUT_BIN,
# _SCAN, _UP, _UNIT, _COLUMNS, _LEVEL, _THREADS, _VERBOSITY, _PROGRESS, _AGAIN, _INGEST_HEAP, which only the shell expands, never Make; not SCAN itself, which
# Make would hand on as the user wrote it, relative to elsewhere.
#
# Which stages run is decided by content, never by a file's time (common/rerun/README.md):
#   params/<stage>.json  resolved parameters and the stage's revision
#   inputs/, edits/      what enters from outside; and the scan, which goes by the name "scan"
#   stamps/<name>        written when the stage has run: the digests of all that it read and of all that it wrote
# `artefact plan` compares them with what lies there now and names the stages that must run and, as "?name", those that run when one before
# them has left a mark, stamps/.<name>.changed, that its outputs came out different. No other has a recipe. Make sees to the order, and to -j.
# A stage that is killed or fails leaves no stamp and runs again. The programs themselves are not looked at: a
# rebuild repeats hours of work only when a stage's revision changed.

MAKEFLAGS += --no-builtin-rules --no-print-directory
.SUFFIXES:
.PHONY: run table

names :=

# $(call stage,name,program,outputs,inputs,options)
define stage
names += $(1)
row_$(1) := $(1) $(2) : $(3) : params/$(2).json $(4)
position_$(1) := $$(words $$(names))
$(foreach output,$(3),maker_$(output) := $(1)
)
makers_$(1) := $$(sort $$(foreach input,$(4),$$(maker_$$(input))))
.PHONY: $(1)
$(1): $$(makers_$(1))
	$$(if $$(call is_due,$(1)),$$(call run_stage,$(1),$(2),$(4),$(5)),@:)
endef

# Asked when all before it are done; $(file) sees marks that are new.
is_due = $(or $(filter $(1),$(plan)),$(and $(filter ?$(1),$(plan)),$(strip $(foreach maker,$(makers_$(1)),$(file < stamps/.$(maker).changed)))))

# With ROOMCUT_PROGRESS every stage is announced: "@stage 7 15 raycast".
run_stage = @$(environment_$(1))"$$ROOMCUT_BIN/$(2)" --work . --params params/$(2).json --log logs/$(1).json --stamp stamps/$(1) \
	--reads "params/$(2).json $(3)" $(if $(filter ?$(1),$(plan)),--if-changed) \
	$(if $(ROOMCUT_PROGRESS),--announce "@stage $(position_$(1)) $(words $(names)) $(1)") \
	$${ROOMCUT_THREADS:+--threads "$$ROOMCUT_THREADS"} $${ROOMCUT_VERBOSITY:+"$$ROOMCUT_VERBOSITY"} $(4)

# How memory is taken (pipeline.sh); ingest has its own way.
environment_ingest := GLIBC_TUNABLES="$$ROOMCUT_INGEST_HEAP" # the space belongs to it

lines_30 := 30_detect_lines/wall_lines.geojson
lines_40 := 40_accept_lines/wall_lines.geojson
lines_80 := 80_refine_lines/wall_lines.geojson
cloud    := 10_ingest/cloud.h5
slices   := 20_slice/slices.h5
cells    := 50_partition/cells.h5
weights  := 55_weigh_faces/weights.h5
terms    := 60_raycast/data_terms.h5
labels   := 70_graphcut/labels.h5
final    := 90_final/cells.h5 90_final/weights.h5 90_final/data_terms.h5 90_final/labels.h5
openings := 95_find_openings/openings.geojson

$(eval $(call stage,ingest,ingest,$(cloud),scan inputs/scan.options inputs/stations.txt,\
  --scan "$$$$ROOMCUT_SCAN" --up "$$$$ROOMCUT_UP" --unit "$$$$ROOMCUT_UNIT" $$$${ROOMCUT_COLUMNS:+--columns="$$$$ROOMCUT_COLUMNS"} --level "$$$$ROOMCUT_LEVEL" \
  $$$$(test ! -s inputs/stations.txt || echo --stations inputs/stations.txt)))
$(eval $(call stage,slice,slice,$(slices),$(cloud)))
$(eval $(call stage,detect_lines,detect_lines,$(lines_30) 30_detect_lines/hough.h5,$(slices)))
$(eval $(call stage,accept_lines,accept_lines,$(lines_40),$(lines_30) edits/wall_lines.geojson))
$(eval $(call stage,partition,partition,$(cells),$(lines_40) $(slices)))
$(eval $(call stage,weigh_faces,weigh_faces,$(weights),$(cells) $(cloud)))
$(eval $(call stage,raycast,raycast,$(terms),$(cells) $(weights)))
$(eval $(call stage,graphcut,graphcut,$(labels),$(cells) $(weights) $(terms)))
$(eval $(call stage,refine_lines,refine_lines,$(lines_80),$(lines_40) $(cells) $(weights) $(labels) $(cloud)))

# The second pass: the same programs and parameters on the refined lines.
$(eval $(call stage,final_partition,partition,90_final/cells.h5,$(lines_80) $(slices),\
  --lines $(lines_80) --cells-out 90_final/cells.h5))
$(eval $(call stage,final_weigh_faces,weigh_faces,90_final/weights.h5,90_final/cells.h5 $(cloud),\
  --cells 90_final/cells.h5 --weights-out 90_final/weights.h5))
$(eval $(call stage,final_raycast,raycast,90_final/data_terms.h5,90_final/cells.h5 90_final/weights.h5,\
  --cells 90_final/cells.h5 --weights 90_final/weights.h5 --terms-out 90_final/data_terms.h5))
$(eval $(call stage,final_graphcut,graphcut,90_final/labels.h5,90_final/cells.h5 90_final/weights.h5 90_final/data_terms.h5,\
  --cells 90_final/cells.h5 --weights 90_final/weights.h5 --terms 90_final/data_terms.h5 --labels-out 90_final/labels.h5))

$(eval $(call stage,find_openings,find_openings,$(openings),90_final/cells.h5 90_final/labels.h5 $(cloud)))
$(eval $(call stage,extract,extract,model.ply model.obj summary.json,$(final) $(openings)))
$(eval $(call stage,report,report,report.html,$(cloud) $(slices) $(lines_30) 30_detect_lines/hough.h5 $(lines_40) $(cells) \
  $(weights) $(terms) $(labels) $(lines_80) $(final) $(openings) model.ply summary.json))

run: $(names) ; @:

# What `artefact plan` and `artefact status` read: "name program : outputs : inputs", one stage a line.
rows := $(foreach name,$(names),'$(row_$(name))')

table:
	@printf '%s\n' $(rows)

ifneq ($(MAKECMDGOALS),table)
plan := $(shell printf '%s\n' $(rows) | "$$ROOMCUT_BIN/artefact" plan --scan "$$ROOMCUT_SCAN" --again "$$ROOMCUT_AGAIN" $(MAKECMDGOALS))
ifneq ($(.SHELLSTATUS),0)
$(error what must run could not be found out)
endif
endif
