#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: pipeline.sh run|status|verify|edit-lines|diff-lines|drop-edit|evaluate|plot|clean|rerun|make [NAME …]
# One command on one work folder; the Makefile calls it. Reads SCAN, WORK, CONFIG, BUILD, JOBS, UP, UNIT, STATIONS, TRUTH, QUIET
# from the environment. Works with any characters in file names: every name is quoted, and Make sees relative names only.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
stages="ingest slice detect_lines accept_lines partition weigh_faces raycast graphcut refine_lines extract report"
: "${SCAN:=}" "${WORK:=}" "${CONFIG:=}" "${BUILD:=$root/build}" "${JOBS:=}" "${UP:=}" "${UNIT:=}" "${STATIONS:=}" "${TRUTH:=}" "${QUIET:=}"

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

# Writes standard input to $1 only when it differs: the time of the file is that of its last change.
record() {
  cat > "$1.new"
  if cmp -s "$1.new" "$1"; then rm -f "$1.new"; else mv -f "$1.new" "$1"; fi
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
    SCAN=$(cat "$WORK/inputs/scan.path")
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
  mkdir -p "$WORK" 2> /dev/null || {
    echo "error[O01] $WORK: the folder cannot be made" >&2
    echo "hint: choose another with WORK=" >&2
    exit 5
  }
  cd "$WORK"
  mkdir -p inputs params stamps logs edits
  exec 9> stamps/.lock
  flock -n 9 || { echo "waiting for another make in $WORK" >&2; flock 9; }
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
  printf '%s\n%s\n' "$UP" "$UNIT" | record inputs/scan.options
  if [ ! -e "$SCAN" ] && [ -f stamps/ingest ]; then
    echo "note: $SCAN is gone; what was made from it stays" >&2
    return
  fi
  if [ -f inputs/scan.path ] && [ "$(cat inputs/scan.path)" != "$SCAN" ]; then
    echo "note: $WORK was made from $(cat inputs/scan.path), now from $SCAN" >&2
  fi
  printf '%s\n' "$SCAN" | record inputs/scan.path
  stat -L -c '%s %y %d %i' "$SCAN" > inputs/scan.stat.new 2> /dev/null || echo none > inputs/scan.stat.new
  if ! cmp -s inputs/scan.stat.new inputs/scan.stat || [ ! -f inputs/scan.id ]; then
    known=$("$BIN/artefact" input 10_ingest/cloud.h5 scan 2> /dev/null) || known=
    if [ -n "$known" ] && [ -f inputs/scan.id ] && [ -f "$SCAN" ]; then
      now=$("$BIN/artefact" bytes "$SCAN")
      [ "$now" = "$known" ] || echo "$now" | record inputs/scan.id
    else
      record inputs/scan.id < inputs/scan.stat.new
    fi
    mv -f inputs/scan.stat.new inputs/scan.stat
  else
    rm -f inputs/scan.stat.new
  fi
}

# Scanner positions enter as a copy: said once, they hold until said otherwise; STATIONS=none takes them away. Empty: none given.
record_stations() {
  case $STATIONS in
    '') [ -f inputs/stations.txt ] || : > inputs/stations.txt ;;
    none) record inputs/stations.txt < /dev/null ;;
    *)
      [ -f "$STATIONS" ] || {
        echo "error[C01] $STATIONS: there is no such file" >&2
        echo "hint: STATIONS= names a text file with the scanner positions, x y z on each line" >&2
        exit 3
      }
      record inputs/stations.txt < "$STATIONS" ;;
  esac
}

# The hand edit enters by its bytes too, never by its time.
record_edit() {
  if [ -f edits/wall_lines.geojson ]; then
    sha256sum < edits/wall_lines.geojson | record inputs/edit.id
  else
    echo none | record inputs/edit.id
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
  failed=0
  for stage in $stages; do
    if [ -n "$CONFIG" ]; then set -- --config "$CONFIG"; else set --; fi
    if "$BIN/$stage" --dump-params "$@" > "params/.dump" 2> params/.errors; then
      record "params/$stage.json" < "params/.dump"
    else
      failed=$?
      cat params/.errors >> params/.all_errors
    fi
    rm -f "params/.dump" params/.errors
  done
  if [ $failed -ne 0 ]; then
    # Every stage complains of what is wrong at the top of the file; once is enough.
    awk '!seen[$0]++' params/.all_errors >&2
    rm -f params/.all_errors params/.asked.new
    exit "$failed"
  fi
  mv -f params/.asked.new params/.asked
}

refresh() {
  record_scan
  record_stations
  record_edit
  record_params
}

rules() {
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
  export ROOMCUT_STATUS=1
  rules run > /dev/null
  echo "$WORK"
  echo "  scan  $SCAN (up $UP, unit $UNIT)"
  if [ -f edits/wall_lines.geojson ]; then echo "  edit  $WORK/edits/wall_lines.geojson is in force"; fi
  waits=
  for stage in $stages; do
    names=$stage
    case $stage in refine_lines) names="$stage final_partition final_weigh_faces final_raycast final_graphcut" ;; esac
    for name in $names; do
      why=$(sed -n "s/^$name //p" stamps/.status)
      if ! grep -q "^$name " stamps/.status; then
        if [ -z "$waits" ]; then state="up to date"; else state="up to date, if $waits comes out as before"; fi
      elif [ ! -f "stamps/$name" ] && [ ! -f "stamps/$name.before" ]; then
        state="never run"
        waits=$name
      elif [ ! -f "stamps/$name" ]; then
        state="to run: did not finish last time"
        waits=$name
      else
        state="to run: changed or missing: $why"
        waits=$name
      fi
      printf '  %-18s %s\n' "$name" "$state"
    done
  done
  rm -f stamps/.status
}

edit_lines() {
  cp 40_accept_lines/wall_lines.geojson edits/.wall_lines.geojson.new
  mv -f edits/.wall_lines.geojson.new edits/wall_lines.geojson
  echo "edit this file, one line per wall: $WORK/edits/wall_lines.geojson"
  echo "then: make diff-lines to see what changes, make run to apply it, make drop-edit to go back"
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
find_work_folder
case $command in
  run | edit-lines | evaluate | rerun | plot)
    [ -d "$WORK/inputs" ] || [ -e "$SCAN" ] || { echo "error[C01] $SCAN: there is no such file" >&2; exit 3; } ;;
esac
for name in "$@"; do known_stage "$name"; done
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
    edit_lines ;;
  diff-lines)
    refresh
    rules detect_lines
    "$BIN/diff_lines" --work . ;;
  drop-edit) drop_edit ;;
  status)
    refresh
    show_status ;;
  verify) "$BIN/artefact" verify $(ls stamps/* 2> /dev/null | grep -v '\.before$') ;;
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
    # Some stages are seen best in the picture of another one.
    case $1 in
      ingest) only=ingest files=cloud ;;
      slice) only=slice files=slice_histogram ;;
      detect_lines | accept_lines) only=detect_lines files=slice_[0-9] ;;
      partition | weigh_faces | raycast | graphcut) only=graphcut files=cells ;;
      refine_lines | final_*) only=refine_lines files=refine_lines ;;
      *) only=extract files='[ms][ot][do][er][le]' ;;
    esac
    "$BIN/report" --work . --params params/report.json --only $only --log logs/plot.json -q
    ls "$WORK"/pictures/$files* ;;
  *) fail "pipeline.sh: no command $command" "see make help" ;;
esac
