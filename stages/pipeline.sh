#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: pipeline.sh run|status|verify|view|edit-lines|diff-lines|drop-edit|edit-planes|drop-planes|layers|evaluate|compare|plot|clean|rerun [NAME …]
# One command on one work folder; the Makefile calls it. Reads SCAN, WORK, CONFIG, BUILD, JOBS, UP, UNIT, LEVEL, STATIONS, TRUTH, PORT,
# QUIET, A, B and TEXT_COLUMNS (COLUMNS= of make) from the environment. Works with any characters in file names: every name is quoted, and Make sees relative names only.
set -eu

# Every process that this script starts costs milliseconds, a run should cost a quarter of a second: builtins where they do.
root=$(cd "${0%/*}/.." && pwd)
runs= stages= # of the pipeline, and each program once
while IFS=' |' read -r run program _; do
  case $run in '' | '#'* | -) continue ;; esac
  runs="$runs $run"
  case " $stages " in *" $program "*) ;; *) stages="$stages $program" ;; esac
done < "$root/stages/pipeline.table"
runs=${runs# } stages=${stages# }
. "$root/stages/pipeline_inputs.sh"
: "${SCAN:=}" "${WORK:=}" "${CONFIG:=}" "${BUILD:=$root/build}" "${JOBS:=}" "${UP:=}" "${UNIT:=}" "${TEXT_COLUMNS:=}" "${LEVEL:=}" "${STATIONS:=}" "${TRUTH:=}"
: "${PORT:=}" "${QUIET:=}" "${A:=}" "${B:=}"

complain() { # complain CODE CAUSE REMEDY EXIT_CODE
  echo "error[$1] $2" >&2
  echo "hint: $3" >&2
  exit "$4"
}
fail() { complain U01 "$1" "$2" 2; }
cannot_write() { # cannot_write FILE CAUSE
  complain O01 "$1: $2" "choose a folder that you may write and that has room, with WORK=" 5
}

absolute() {
  case $1 in
    /*) printf '%s' "$1" ;;
    *) printf '%s/%s' "$PWD" "$1" ;;
  esac
}

# JOBS goes to every program; nothing but a number may.
check_jobs() {
  case $JOBS in
    '') ;;
    0* | *[!0-9]* | ?????*) fail "JOBS=$JOBS: is no number of threads" "give a whole number from 1 to 4096, or leave it out for all" ;;
    *) [ "$JOBS" -le 4096 ] || fail "JOBS=$JOBS: are too many threads" "give a whole number from 1 to 4096" ;;
  esac
}

find_work_folder() {
  work_given=$WORK
  case $SCAN in '' | *://*) ;; *) SCAN=$(absolute "$SCAN") ;; esac
  if [ -z "$WORK" ]; then
    [ -n "$SCAN" ] || fail "make $command: no scan given" "say which: make $command SCAN=office.ply (or WORK=work/office)"
    name=${SCAN##*/}
    name=${name%.*}
    case $name in '' | . | ..) fail "$SCAN: its name gives no name for a work folder" "say where: WORK=work/office" ;; esac
    WORK=$root/work/$name
  fi
  WORK=$(absolute "$WORK")
  former_scan=
  if [ -f "$WORK/inputs/scan.path" ]; then IFS= read -r former_scan < "$WORK/inputs/scan.path"; fi
  SCAN=${SCAN:-$former_scan}
  [ -n "$SCAN" ] || fail "make $command: $WORK was not made from any scan yet" "say which: make $command SCAN=office.ply"
  case $CONFIG in '' | none) ;; *) CONFIG=$(absolute "$CONFIG") ;; esac
  BUILD=$(absolute "$BUILD")
  BIN=$BUILD/bin
  case $STATIONS in '' | none) ;; *) STATIONS=$(absolute "$STATIONS") ;; esac
  [ -z "$TRUTH" ] || TRUTH=$(absolute "$TRUTH")
}

# One command at a time works in a folder: a second one waits.
take_lock() {
  for folder in inputs params stamps logs edits; do
    [ -d "$WORK/$folder" ] || why=$(LC_ALL=C mkdir -p "$WORK/$folder" 2>&1) ||
      cannot_write "$WORK/$folder" "the folder cannot be made: ${why##*: }"
  done
  cd "$WORK"
  for folder in . inputs params stamps logs edits; do
    [ -w $folder ] || cannot_write "$WORK/$folder" "you may not write there"
  done
  exec 9>> stamps/.lock
  wait_for_lock
  # What a make that was killed had not finished writing; never through a link to somewhere else.
  for file in inputs/*.new inputs/.former.new params/.new params/.asked.new edits/.*.new pictures/*.new; do
    if [ -e "$file" ] && [ ! -L "${file%/*}" ]; then rm -rf "$file"; fi
  done
}

wait_for_lock() {
  flock -n 9 || { echo "waiting for another make in $WORK" >&2; flock 9; }
}

# For commands that write nothing: also in a folder that nobody may write, an archive.
enter_to_read() {
  [ -d "$WORK" ] || fail "$WORK: there is no such work folder" "make run SCAN=office.ply makes one"
  cd "$WORK"
  if [ -w stamps/.lock ]; then
    exec 9>> stamps/.lock
    wait_for_lock
  fi
}

pipeline_table() {
  ROOMCUT_BIN=$BIN "${MAKE:-make}" -f "$root/stages/pipeline.mk" table
}

# rules GOAL …: runs what is not what it should be, up to and including the goals; in any case the stage $again.
rules() {
  # Memory that is fresh costs more than most of what is done with it. So: one heap for all threads, which is kept and used again,
  # instead of every large array being mapped and unmapped by itself; and pages of 2 MB where the system has them, but for ingest,
  # which uses too much memory once only: clearing 2 MB at a time empties the processor's caches.
  heap=glibc.malloc.arena_max=1:glibc.malloc.mmap_threshold=1073741824:glibc.malloc.trim_threshold=4294967296
  failed=0
  ROOMCUT_INGEST_HEAP=${GLIBC_TUNABLES:-$heap} \
  GLIBC_TUNABLES=${GLIBC_TUNABLES:-$heap:glibc.malloc.hugetlb=1} \
  ROOMCUT_BIN=$BIN ROOMCUT_SCAN=$SCAN ROOMCUT_UP=$UP ROOMCUT_UNIT=$UNIT ROOMCUT_COLUMNS=$TEXT_COLUMNS ROOMCUT_LEVEL=$LEVEL \
  ROOMCUT_THREADS=$JOBS ROOMCUT_VERBOSITY=${QUIET:+-q} ROOMCUT_AGAIN=$again \
    "${MAKE:-make}" -f "$root/stages/pipeline.mk" "$@" || failed=$?
  settle_inputs $failed
  [ $failed -eq 0 ] || exit $failed
}

known_stage() {
  case " $runs " in
    *" $1 "*) ;;
    *) fail "there is no stage $1" "the stages are: $runs" ;;
  esac
}

# Those of the table's runs that have a stamp here.
stamped() {
  for name in $runs; do
    if [ -f "stamps/$name" ]; then echo "$name"; fi
  done
}

# What a run would do, found out beside the work folder, which is left as it is: with its own copy of what run would write.
show_status() {
  shadow=$(mktemp -d) || exit 5
  trap 'rm -rf "$shadow"' EXIT
  for entry in "$WORK"/*; do
    case ${entry##*/} in inputs | params) ;; *) if [ -e "$entry" ]; then ln -s "$entry" "$shadow/"; fi ;; esac
  done
  mkdir "$shadow/inputs" "$shadow/params"
  for folder in inputs params; do
    cp "$WORK/$folder"/* "$shadow/$folder/" 2> /dev/null || true
  done
  if [ -f "$WORK/params/.asked" ]; then cp "$WORK/params/.asked" "$shadow/params/"; fi
  cd "$shadow"
  refresh
  echo "$WORK"
  echo "  scan    $SCAN (up $UP, unit $UNIT${TEXT_COLUMNS:+, columns $TEXT_COLUMNS}, level $LEVEL)"
  echo "  config  ${config_path:-${CONFIG:-none}}${config_path:+ (CONFIG= given; CONFIG=none goes back to pipeline.yaml)}"
  for edit in wall_lines planes; do
    if [ -f edits/$edit.geojson ]; then echo "  edit    $WORK/edits/$edit.geojson is in force"; fi
  done
  pipeline_table | "$BIN/artefact" status --scan "$SCAN"
}

# The accepted file of that name, to be edited; only where there is none.
no_edit_yet() { # no_edit_yet NAME COMMAND
  [ ! -f "edits/$1.geojson" ] || fail "$WORK/edits/$1.geojson: an edit is there already" \
    "go on with it, or make $2 first (it is moved aside, not deleted)"
}
copy_to_edit() { # copy_to_edit FOLDER NAME
  cp "$1/$2.geojson" "edits/.$2.geojson.new"
  mv -f "edits/.$2.geojson.new" "edits/$2.geojson"
}

edit_lines() {
  copy_to_edit 40_accept_lines wall_lines
  echo "edit this file, one line per wall: $WORK/edits/wall_lines.geojson"
  echo "beneath it, for QGIS: edits/slice_<k>.png, where points are in each slice"
  echo "then: make diff-lines to see what changes, make run to apply it, make drop-edit to go back"
}

edit_planes() {
  copy_to_edit 45_accept_planes planes
  echo "edit this file, one polygon per sloped floor or ceiling: $WORK/edits/planes.geojson"
  echo "its numbers: pitch_deg, uphill_deg (where it rises to, counter-clockwise from x), height_m (at its middle)"
  echo "then: make run to apply it, make drop-planes to go back"
}

# The evidence beneath the lines, for QGIS: rasters that say where they lie, beside the file that is edited.
draw_layers() {
  rm -f edits/slice_*.png edits/slice_*.pgw edits/slice_*.png.aux.xml
  "$BIN/report" --work . --params params/report.json --only layers --log logs/layers.json -q
}

# The pictures of one stage, as SVG and as PNG.
plot() {
  [ "$1" != report ] || set pictures
  command -v rsvg-convert > /dev/null ||
    fail "make plot: rsvg-convert is not installed" "make deps installs it (Debian's librsvg2-bin)"
  "$BIN/report" --work . --params params/report.json --only "$1" --log logs/plot.json -q > stamps/.pictures
  while IFS= read -r file; do
    name=${file%.svg}
    # Those that are rasters by nature have their PNG already.
    if [ "$name" != "$file" ] && ! grep -qxF "$name.png" stamps/.pictures; then
      rsvg-convert --unlimited --background-color white --output "$name.new" "$file"
      mv -f "$name.new" "$name.png"
      echo "$name.png" >> stamps/.pictures
    fi
  done < stamps/.pictures
  [ -s stamps/.pictures ] || echo "there is nothing to draw of $1 yet"
  sort stamps/.pictures | while IFS= read -r file; do echo "$WORK/$file"; done
  rm -f stamps/.pictures
}

drop_edit() { # drop_edit NAME WHAT
  if [ ! -f "edits/$1.geojson" ]; then
    echo "there is no edit in $WORK/edits"
    return
  fi
  mkdir -p edits/old
  n=1
  while [ -e "edits/old/$1.$n.geojson" ]; do n=$((n + 1)); done
  mv "edits/$1.geojson" "edits/old/$1.$n.geojson"
  echo "the edit lies now in $WORK/edits/old/$1.$n.geojson; make run goes back to the detected $2"
}

# Serves the page until Ctrl-C, without the lock: what the page asks for is another run of this script.
view() {
  [ -x "$BIN/view" ] || fail "$BIN: the programs are not built" "make build"
  export SCAN WORK CONFIG BUILD JOBS UP UNIT TEXT_COLUMNS LEVEL STATIONS ROOMCUT_PROGRESS=1
  unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES TRUTH QUIET
  exec "$BIN/view" --work "$WORK" --port "${PORT:-0}" --pipeline "$root/stages/pipeline.sh" -q
}

# Two work folders as they lie; what is found goes into that of B. The distance of the models is evaluate's, A taken for the truth.
compare() {
  for side in A B; do
    eval "folder=\$$side"
    [ -n "$folder" ] || fail "make compare: no $side given" "name two work folders: make compare A=work/x B=work/y"
    [ -d "$folder" ] || fail "make compare: $folder: there is no such folder" "name two work folders: make compare A=work/x B=work/y"
  done
  A=$(cd "$A" && pwd)
  B=$(cd "$B" && pwd)
  [ -x "$BUILD/bin/compare" ] || fail "$BUILD/bin: the programs are not built" "make build"
  found=$B/compare/${A##*/}
  why=$(LC_ALL=C mkdir -p "$found" 2>&1) || complain O01 "$found: the folder cannot be made: ${why##*: }" \
    "what is found goes into B: name a folder there that you may write, or change A and B" 5
  rm -f "$found/distance.json" "$found/distance.png"
  if [ -f "$A/model.ply" ] && [ -f "$B/model.ply" ]; then
    "$BUILD/bin/evaluate" --work "$found" --model "$B/model.ply" --truth "$A/model.ply" --scores "$found/distance.json" \
      --coloured "$found/distance.ply" --picture "$found/distance.png" ${JOBS:+--threads "$JOBS"} -q
  fi
  "$BUILD/bin/compare" --work "$found" --a "$A" --b "$B" ${QUIET:+-q}
  [ -n "$QUIET" ] || echo "all of it, with plans side by side: $found/comparison.html (and .json)"
  exit 0
}

# Deletes what the table says that a stage writes, whatever the folder's own files say.
clean() {
  line=$(pipeline_table | grep "^$1 ")
  files=${line#* : }
  files=${files%% : *}
  for file in $files; do
    case $file in
      */*) [ ! -L "${file%/*}" ] || fail "$WORK/${file%/*}: is a link to another folder" "delete it, or what is in it, yourself" ;;
    esac
    if [ -f "$file" ] || [ -L "$file" ]; then rm -f "$file"; fi
  done
  rm -f "stamps/$1" "stamps/$1.before" "logs/$1.json"
  rmdir [0-9]*_* 2> /dev/null || true
}

command=$1
shift
again=
check_jobs
if [ "$command" = compare ]; then
  BUILD=$(absolute "$BUILD")
  compare
fi
find_work_folder
for name in "$@"; do known_stage "$name"; done
case $command in
  clean | drop-edit | drop-planes | verify) ;;
  *) check_scan ;;
esac
check_work_folder
case $command in
  view) view ;;
  status) if [ -d "$WORK" ]; then enter_to_read; fi ;;
  verify) enter_to_read ;;
  clean | drop-edit | drop-planes)
    [ -d "$WORK" ] || fail "$WORK: there is no such work folder" "make run SCAN=office.ply makes one"
    take_lock ;;
  *) take_lock ;;
esac
case $command in
  run)
    refresh
    rules "${@:-run}"
    if [ $# -eq 0 ] && [ -z "$QUIET" ]; then echo "up to date: $WORK/model.ply, model.obj, summary.json, report.html"; fi ;;
  rerun)
    # Of what follows only what was made before, and is changed by it.
    refresh
    again=$1
    rules "$1" $(stamped) ;;
  edit-lines)
    no_edit_yet wall_lines drop-edit
    refresh
    rules accept_lines
    draw_layers
    edit_lines ;;
  edit-planes)
    no_edit_yet planes drop-planes
    refresh
    rules accept_planes
    edit_planes ;;
  layers)
    refresh
    rules slice
    draw_layers
    ls "$WORK"/edits/slice_*.png ;;
  diff-lines)
    refresh
    rules detect_lines
    "$BIN/diff_lines" --work . ;;
  drop-edit) drop_edit wall_lines lines ;;
  drop-planes) drop_edit planes planes ;;
  status) show_status ;;
  verify) "$BIN/verify" --schemas "$root/schemas" --scan "$SCAN" $(stamped | sed 's|^|stamps/|') ;;
  clean) clean "$1" ;;
  evaluate)
    [ -n "$TRUTH" ] || fail "make evaluate: no truth given" "make evaluate SCAN=… TRUTH=truth.off"
    refresh
    rules extract
    if [ -n "$CONFIG" ]; then set -- --config "$CONFIG"; else set --; fi
    if [ -f "${TRUTH%.*}.json" ]; then set -- "$@" --truth-json "${TRUTH%.*}.json"; fi
    "$BIN/evaluate" --work . --truth "$TRUTH" --cells 90_final/cells.h5 --labels 90_final/labels.h5 --terms 90_final/data_terms.h5 --surfaces 92_fit_surfaces/surfaces.h5 --cloud 10_ingest/cloud.h5 ${JOBS:+--threads "$JOBS"} ${QUIET:+-q} "$@" ;;
  plot)
    refresh
    rules "$1"
    plot "$1" ;;
  *) fail "pipeline.sh: no command $command" "see make help" ;;
esac
