#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: pipeline.sh run|status|verify|view|edit-lines|diff-lines|drop-edit|layers|evaluate|compare|plot|clean|rerun [NAME …]
# One command on one work folder; the Makefile calls it. Reads SCAN, WORK, CONFIG, BUILD, JOBS, UP, UNIT, STATIONS, TRUTH, PORT, QUIET,
# A, B from the environment. Works with any characters in file names: every name is quoted, and Make sees relative names only.
set -eu

# Every process that this script starts costs milliseconds, a run should cost a quarter of a second: builtins where they do.
root=$(cd "${0%/*}/.." && pwd)
stages="ingest slice detect_lines accept_lines partition weigh_faces raycast graphcut refine_lines find_openings extract report"
: "${SCAN:=}" "${WORK:=}" "${CONFIG:=}" "${BUILD:=$root/build}" "${JOBS:=}" "${UP:=}" "${UNIT:=}" "${STATIONS:=}" "${TRUTH:=}"
: "${PORT:=}" "${QUIET:=}" "${A:=}" "${B:=}"

fail() {
  echo "error[U01] $1" >&2
  echo "hint: $2" >&2
  exit 2
}

absolute() {
  case $1 in
    /*) printf '%s' "$1" ;;
    *) printf '%s/%s' "$PWD" "$1" ;;
  esac
}

# Whether $1 is a file of the text $2 and a newline.
holds() {
  [ -f "$1" ] || return 1
  held=
  while IFS= read -r line; do held="$held$line
"; done < "$1"
  [ "$held" = "$2
" ]
}

# Writes $2 and a newline to $1 only when it differs: the time of the file is that of its last change.
record() {
  if holds "$1" "$2"; then return; fi
  printf '%s\n' "$2" > "$1.new"
  mv -f "$1.new" "$1"
}

# Copies $2 to $1 only when it differs.
record_file() {
  if [ -f "$1" ] && cmp -s "$2" "$1"; then return; fi
  cat "$2" > "$1.new"
  mv -f "$1.new" "$1"
}

find_work_folder() {
  if [ -z "$WORK" ]; then
    [ -n "$SCAN" ] || fail "make $command: no scan given" "say which: make $command SCAN=office.ply (or WORK=work/office)"
    name=${SCAN##*/}
    WORK=$root/work/${name%.*}
  fi
  WORK=$(absolute "$WORK")
  if [ -n "$SCAN" ]; then
    SCAN=$(absolute "$SCAN")
  elif [ -f "$WORK/inputs/scan.path" ]; then
    IFS= read -r SCAN < "$WORK/inputs/scan.path"
  else
    fail "make $command: $WORK was not made from any scan yet" "say which: make $command SCAN=office.ply"
  fi
  if [ -n "$CONFIG" ]; then
    CONFIG=$(absolute "$CONFIG")
  elif [ -f "$root/pipeline.yaml" ]; then
    CONFIG=$root/pipeline.yaml
  fi
  BUILD=$(absolute "$BUILD")
  BIN=$BUILD/bin
  case $STATIONS in '' | none) ;; *) STATIONS=$(absolute "$STATIONS") ;; esac
  [ -z "$TRUTH" ] || TRUTH=$(absolute "$TRUTH")
}

# One command at a time works in a folder: a second one waits.
take_lock() {
  [ -d "$WORK" ] || mkdir -p "$WORK" 2> /dev/null || {
    echo "error[O01] $WORK: the folder cannot be made" >&2
    echo "hint: choose another with WORK=" >&2
    exit 5
  }
  cd "$WORK"
  for folder in inputs params stamps logs edits; do [ -d $folder ] || mkdir $folder; done
  exec 9> stamps/.lock
  flock -n 9 || { echo "waiting for another make in $WORK" >&2; flock 9; }
  # What a make that was killed had not finished writing.
  rm -rf inputs/*.new params/.new params/.asked.new edits/.*.new pictures/*.new
}

# The scan enters by its bytes. They are read again only when size, time or file changed, and when an earlier run knows their
# digest; the first time ingest takes it while reading.
record_scan() {
  # How the scan is to be read belongs to the scan: said once, it holds until said otherwise.
  if [ -f inputs/scan.options ]; then
    { read -r old_up; read -r old_unit; } < inputs/scan.options || true
  fi
  UP=${UP:-${old_up:-z}}
  UNIT=${UNIT:-${old_unit:-m}}
  record inputs/scan.options "$UP
$UNIT"
  if [ ! -e "$SCAN" ] && [ -f stamps/ingest ]; then
    echo "note: $SCAN is gone; what was made from it stays" >&2
    return
  fi
  if [ -f inputs/scan.path ] && ! holds inputs/scan.path "$SCAN"; then
    echo "note: $WORK was made from $(cat inputs/scan.path), now from $SCAN" >&2
  fi
  record inputs/scan.path "$SCAN"
  state=$(stat -L -c '%s %y %d %i' "$SCAN" 2> /dev/null) || state=none
  if ! holds inputs/scan.stat "$state" || [ ! -f inputs/scan.id ]; then
    known=
    if [ -f 10_ingest/cloud.h5 ]; then known=$("$BIN/artefact" input 10_ingest/cloud.h5 scan 2> /dev/null) || known=; fi
    if [ -n "$known" ] && [ -f inputs/scan.id ] && [ -f "$SCAN" ]; then
      now=$("$BIN/artefact" bytes "$SCAN")
      [ "$now" = "$known" ] || record inputs/scan.id "$now"
    else
      record inputs/scan.id "$state"
    fi
    record inputs/scan.stat "$state"
  fi
}

# Scanner positions enter as a copy: said once, they hold until said otherwise; STATIONS=none takes them away. Empty: none given.
record_stations() {
  case $STATIONS in
    '') [ -f inputs/stations.txt ] || : > inputs/stations.txt ;;
    none) record_file inputs/stations.txt /dev/null ;;
    *)
      [ -f "$STATIONS" ] || {
        echo "error[C01] $STATIONS: there is no such file" >&2
        echo "hint: STATIONS= names a text file with the scanner positions, x y z on each line" >&2
        exit 3
      }
      record_file inputs/stations.txt "$STATIONS" ;;
  esac
}

# The hand edit enters by its bytes too, never by its time.
record_edit() {
  if [ -f edits/wall_lines.geojson ]; then
    record inputs/edit.id "$(sha256sum < edits/wall_lines.geojson)"
  else
    record inputs/edit.id none
  fi
}

# Every stage prints its resolved parameters; asked only when pipeline.yaml or a program changed. params/.asked holds both.
record_params() {
  (cd "$BIN" && stat -L -c '%n %s %y' $stages) > params/.asked.new 2> /dev/null ||
    fail "$BIN: the stages are not built" "make build"
  if [ -n "$CONFIG" ]; then
    [ -f "$CONFIG" ] || { echo "error[U02] $CONFIG: there is no such file" >&2; rm -f params/.asked.new; exit 2; }
    cat "$CONFIG" >> params/.asked.new
  fi
  complete=yes
  for stage in $stages; do [ -f "params/$stage.json" ] || complete=no; done
  if [ $complete = yes ] && cmp -s params/.asked.new params/.asked; then
    rm -f params/.asked.new
    return
  fi
  rm -rf params/.new
  mkdir params/.new
  take_known_params || ask_params
  for stage in $stages; do
    if [ -f "params/$stage.json" ] && cmp -s "params/.new/$stage.json" "params/$stage.json"; then rm -f "params/.new/$stage.json"; fi
  done
  rmdir params/.new 2> /dev/null || { mv -f params/.new/*.json params/ && rmdir params/.new; }
  mv -f params/.asked.new params/.asked
}

# The answers that the same programs gave to the same pipeline.yaml in another work folder. From inside the folder that holds them:
# when another run replaces it meanwhile, a file is missing, never of other programs.
take_known_params() {
  work=$PWD
  (cd "$BUILD/parameters" && cmp -s .asked "$work/params/.asked.new" && cp ./*.json "$work/params/.new/") 2> /dev/null
}

ask_params() {
  asked=
  for stage in $stages; do
    "$BIN/$stage" --dump-params ${CONFIG:+--config "$CONFIG"} > "params/.new/$stage.json" 2> "params/.new/$stage.errors" 9>&- &
    asked="$asked $!"
  done
  failed=0
  for process in $asked; do wait "$process" || failed=$?; done
  if [ $failed -ne 0 ]; then
    # Every stage complains of what is wrong at the top of the file; once is enough.
    (cd params/.new && for stage in $stages; do cat "$stage.errors"; done | awk '!seen[$0]++' >&2)
    rm -rf params/.new params/.asked.new
    exit "$failed"
  fi
  rm -f params/.new/*.errors
  # For the next work folder; where the programs lie may not be writable.
  {
    cp -R params/.new "$BUILD/parameters.$$" && cp params/.asked.new "$BUILD/parameters.$$/.asked" &&
      rm -rf "$BUILD/parameters" && mv -T "$BUILD/parameters.$$" "$BUILD/parameters"
  } 2> /dev/null || rm -rf "$BUILD/parameters.$$"
}

refresh() {
  record_scan
  record_stations
  record_edit
  record_params
}

rules() {
  # Memory that is fresh costs more than most of what is done with it. So: one heap for all threads, which is kept and used again,
  # instead of every large array being mapped and unmapped by itself; and pages of 2 MB where the system has them, but for ingest,
  # which uses too much memory once only: clearing 2 MB at a time empties the processor's caches.
  heap=glibc.malloc.arena_max=1:glibc.malloc.mmap_threshold=1073741824:glibc.malloc.trim_threshold=4294967296
  ROOMCUT_INGEST_HEAP=${GLIBC_TUNABLES:-$heap} \
  GLIBC_TUNABLES=${GLIBC_TUNABLES:-$heap:glibc.malloc.hugetlb=1} \
  ROOMCUT_BIN=$BIN ROOMCUT_SCAN=$SCAN ROOMCUT_UP=$UP ROOMCUT_UNIT=$UNIT ROOMCUT_THREADS=$JOBS ROOMCUT_VERBOSITY=${QUIET:+-q} \
    "${MAKE:-make}" -f "$root/stages/pipeline.mk" "$@"
}

known_stage() {
  case " $stages final_partition final_weigh_faces final_raycast final_graphcut " in
    *" $1 "*) ;;
    *) fail "there is no stage $1" "the stages are: $stages" ;;
  esac
}

outputs_of() { # what the last stamp of a stage lists
  cut -d ' ' -f 4- "stamps/$1" 2> /dev/null || cut -d ' ' -f 4- "stamps/$1.before" 2> /dev/null || true
}

show_status() {
  : > stamps/.status
  rules table > stamps/.table
  (export ROOMCUT_STATUS=1 && rules run > /dev/null)
  echo "$WORK"
  echo "  scan  $SCAN (up $UP, unit $UNIT)"
  if [ -f edits/wall_lines.geojson ]; then echo "  edit  $WORK/edits/wall_lines.geojson is in force"; fi
  failed=0
  "$BIN/artefact" status stamps/.table stamps/.status || failed=$?
  rm -f stamps/.status stamps/.table
  return $failed
}

edit_lines() {
  cp 40_accept_lines/wall_lines.geojson edits/.wall_lines.geojson.new
  mv -f edits/.wall_lines.geojson.new edits/wall_lines.geojson
  echo "edit this file, one line per wall: $WORK/edits/wall_lines.geojson"
  echo "beneath it, for QGIS: edits/slice_<k>.png, where points are in each slice"
  echo "then: make diff-lines to see what changes, make run to apply it, make drop-edit to go back"
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

drop_edit() {
  if [ ! -f edits/wall_lines.geojson ]; then
    echo "there is no edit in $WORK/edits"
    return
  fi
  mkdir -p edits/old
  n=1
  while [ -e "edits/old/wall_lines.$n.geojson" ]; do n=$((n + 1)); done
  mv edits/wall_lines.geojson "edits/old/wall_lines.$n.geojson"
  echo "the edit lies now in $WORK/edits/old/wall_lines.$n.geojson; make run goes back to the detected lines"
}

# Serves the page until Ctrl-C, without the lock: what the page asks for is another run of this script.
view() {
  [ -x "$BIN/view" ] || fail "$BIN: the programs are not built" "make build"
  export SCAN WORK CONFIG BUILD JOBS UP UNIT STATIONS ROOMCUT_PROGRESS=1
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
  mkdir -p "$found" 2> /dev/null || { echo "error[O01] $found: the folder cannot be made" >&2; exit 5; }
  rm -f "$found/distance.json" "$found/distance.png"
  if [ -f "$A/model.ply" ] && [ -f "$B/model.ply" ]; then
    "$BUILD/bin/evaluate" --work "$found" --model "$B/model.ply" --truth "$A/model.ply" --scores "$found/distance.json" \
      --coloured "$found/distance.ply" --picture "$found/distance.png" ${JOBS:+--threads "$JOBS"} -q
  fi
  "$BUILD/bin/compare" --work "$found" --a "$A" --b "$B" ${QUIET:+-q}
  [ -n "$QUIET" ] || echo "all of it, with plans side by side: $found/comparison.html (and .json)"
  exit 0
}

# A stage again, and of what follows only what was made before and is changed by it.
rerun() {
  if [ -f "stamps/$1" ]; then mv -f "stamps/$1" "stamps/$1.before"; fi
  rules "$1"
  after=
  for stamp in stamps/*; do
    case $stamp in *.before | 'stamps/*') ;; *) after="$after ${stamp#stamps/}" ;; esac
  done
  rules $after
}

clean() {
  outputs_of "$1" | while IFS= read -r file; do rm -f "$file"; done
  rm -f "stamps/$1" "stamps/$1.before" "logs/$1.json"
  rmdir [0-9]*_* 2> /dev/null || true
}

command=$1
shift
if [ "$command" = compare ]; then
  BUILD=$(absolute "$BUILD")
  compare
fi
find_work_folder
case $command in
  run | edit-lines | layers | evaluate | rerun | plot)
    [ -d "$WORK/inputs" ] || [ -e "$SCAN" ] || { echo "error[C01] $SCAN: there is no such file" >&2; exit 3; } ;;
esac
for name in "$@"; do known_stage "$name"; done
if [ "$command" = view ]; then view; fi
take_lock
case $command in
  run)
    refresh
    rules "${@:-run}"
    if [ $# -eq 0 ] && [ -z "$QUIET" ]; then echo "up to date: $WORK/model.ply, model.obj, summary.json, report.html"; fi ;;
  rerun)
    refresh
    rerun "$1" ;;
  edit-lines)
    [ ! -f edits/wall_lines.geojson ] || fail "$WORK/edits/wall_lines.geojson: an edit is there already" \
      "go on with it, or make drop-edit first (it is moved aside, not deleted)"
    refresh
    rules accept_lines
    draw_layers
    edit_lines ;;
  layers)
    refresh
    rules slice
    draw_layers
    ls "$WORK"/edits/slice_*.png ;;
  diff-lines)
    refresh
    rules detect_lines
    "$BIN/diff_lines" --work . ;;
  drop-edit) drop_edit ;;
  status)
    refresh
    show_status ;;
  verify) "$BIN/artefact" verify --schemas "$root/schemas" --scan "$SCAN" $(ls stamps/* 2> /dev/null | grep -v '\.before$') ;;
  clean) clean "$1" ;;
  evaluate)
    [ -n "$TRUTH" ] || fail "make evaluate: no truth given" "make evaluate SCAN=… TRUTH=truth.off"
    refresh
    rules extract
    if [ -n "$CONFIG" ]; then set -- --config "$CONFIG"; else set --; fi
    if [ -f "${TRUTH%.*}.json" ]; then set -- "$@" --truth-json "${TRUTH%.*}.json"; fi
    "$BIN/evaluate" --work . --truth "$TRUTH" --cells 90_final/cells.h5 --labels 90_final/labels.h5 --terms 90_final/data_terms.h5 ${JOBS:+--threads "$JOBS"} ${QUIET:+-q} "$@" ;;
  plot)
    refresh
    rules "$1"
    plot "$1" ;;
  *) fail "pipeline.sh: no command $command" "see make help" ;;
esac
