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
	$$(if $$(call is_due,$(1)),$$(call run_stage,$(1),$(2),$(4),$(5) $$(options_$(1))),@:)
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

# What ingest is told beside its files. Every other option is in the table.
options_ingest = --scan "$$ROOMCUT_SCAN" --up "$$ROOMCUT_UP" --unit "$$ROOMCUT_UNIT" $${ROOMCUT_COLUMNS:+--columns="$$ROOMCUT_COLUMNS"} --level "$$ROOMCUT_LEVEL" \
  $$(test ! -s inputs/stations.txt || echo --stations inputs/stations.txt)

# A call of `stage` per line of stages/pipeline.table, as the programs were built with it.
$(eval $(shell "$$ROOMCUT_BIN/artefact" rules))

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
