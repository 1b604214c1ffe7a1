#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: parameters.sh SOURCE BUILD: pipeline.yaml holds every parameter of every stage at its default, and nothing else; its JSON
# Schema is the one that the programs make.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
failed=0
same() { # same FILE COMMAND …
  local file=$1
  shift
  if ! diff "$SOURCE/$file" <("$@" "$BUILD"); then
    echo "$file and the programs differ; if the programs are right: $1 ${2#"$SOURCE/"} build > $file"
    failed=$((failed + 1))
  fi
}
same pipeline.yaml sh "$SOURCE/stages/pipeline_yaml.sh"
same schemas/pipeline.schema.json python3 "$SOURCE/stages/pipeline_schema.py"
echo "$((2 - failed)) passed, $failed failed"
[ $failed -eq 0 ]
