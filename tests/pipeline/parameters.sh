#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: parameters.sh SOURCE BUILD: pipeline.yaml holds every parameter of every stage at its default, and nothing else; its JSON
# Schema and the tables of the READMEs are those that the programs make.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
failed=0
check() { # check WHAT COMMAND …
  local what=$1
  shift
  if ! "$@"; then
    echo "$what and the programs differ; if the programs are right: make parameters"
    failed=$((failed + 1))
  fi
}
check pipeline.yaml diff "$SOURCE/pipeline.yaml" <(sh "$SOURCE/stages/pipeline_yaml.sh" "$BUILD")
check "the schema of pipeline.yaml" diff "$SOURCE/schemas/pipeline.schema.json" <(python3 "$SOURCE/stages/pipeline_schema.py" "$BUILD")
check "READMEs of programs" python3 "$SOURCE/stages/parameter_tables.py" "$BUILD" --check
echo "$((3 - failed)) passed, $failed failed"
[ $failed -eq 0 ]
