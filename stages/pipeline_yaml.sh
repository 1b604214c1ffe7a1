#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: pipeline_yaml.sh BUILD: prints pipeline.yaml with every default, as the stages themselves know them.
set -eu
cat <<'EOF'
# yaml-language-server: $schema=schemas/pipeline.schema.json
# Parameters of roomcut: one block per stage, nothing shared. What is left out keeps its default, which is what stands here.
# `auto` is derived from the scan (noise, density, extent); every run prints the value that it chose and why.
# Change a value and `make run`: that stage runs again, and of what follows only what its result changes.
EOF
seen=' '
while IFS=' |' read -r run stage _; do
  case $run in '' | '#'*) continue ;; esac
  case $seen in *" $stage "*) continue ;; esac
  seen="$seen$stage "
  echo
  "$1/bin/$stage" --dump-yaml
done < "${0%/*}/pipeline.table"
