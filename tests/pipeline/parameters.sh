#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: parameters.sh SOURCE BUILD: pipeline.yaml holds every parameter of every stage at its default, and nothing else.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
if diff "$SOURCE/pipeline.yaml" <(sh "$SOURCE/stages/pipeline_yaml.sh" "$BUILD"); then
  echo "1 passed, 0 failed"
else
  echo "pipeline.yaml and the stages differ; if the stages are right: sh stages/pipeline_yaml.sh build > pipeline.yaml"
  echo "0 passed, 1 failed"
  exit 1
fi
