#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: bench.sh BUILD [POINTS …]: the whole pipeline on the two-storey scene at several sizes; seconds and peak memory per stage.
# CSV to standard output: points,stage,wall_s,cpu_s,peak_mb. The last line of each size is the whole run, as make sees it.
set -eu
SOURCE=$(cd "$(dirname "$0")/../.." && pwd)
BUILD=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- 1000000 4000000 10000000
unset MAKEFLAGS MFLAGS MAKELEVEL SCAN WORK CONFIG JOBS UP UNIT STATIONS TRUTH QUIET
place=$(mktemp -d "${TMPDIR:-/tmp}/roomcut-bench.XXXXXX")
trap 'rm -rf "$place"' EXIT

value() { sed -n "s/^  \"$1\": \([0-9.e+-]*\),*$/\1/p" "$2"; }

echo points,stage,wall_s,cpu_s,peak_mb
for points in "$@"; do
  sed "s/\"points\": *[0-9]*/\"points\": $points/" "$SOURCE/tests/data/scenes/paper_two_storeys.json" > "$place/scene.json"
  "$BUILD/bin/synthesize" --scene "$place/scene.json" --scan-out "$place/scan.ply" --truth-out "$place/truth.off" \
    --truth-json "$place/truth.json" -q
  rm -rf "$place/work"
  begin=$(date +%s%N)
  make -C "$SOURCE" run SCAN="$place/scan.ply" WORK="$place/work" BUILD="$BUILD" QUIET=1 > /dev/null
  end=$(date +%s%N)
  for stage in ingest slice detect_lines accept_lines partition weigh_faces raycast graphcut refine_lines final_partition \
               final_weigh_faces final_raycast final_graphcut find_openings extract report; do
    log=$place/work/logs/$stage.json
    echo "$points,$stage,$(value wall_s "$log"),$(value cpu_s "$log"),$(value peak_memory_mb "$log")"
  done
  echo "$points,run,$(((end - begin) / 1000000))e-3,,"
done
