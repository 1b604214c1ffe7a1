# SPDX-License-Identifier: GPL-3.0-or-later
# Part of pipeline.sh: what enters a work folder from outside, and what is remembered of it. All of it by content.
#   inputs/scan.path     where the scan was last          inputs/config.path  the CONFIG= that was accepted last
#   inputs/scan.options  up, unit, columns, level         inputs/config.yaml  what stood in it
#   inputs/stations.txt  scanner positions; may be empty  params/             resolved parameters of every stage
#   inputs/.former/      the first three as ingest accepted them last, while it has not accepted the new ones

# The files in params/.
answers=
for stage in $stages; do answers="$answers params/$stage.json"; done

# Whether $1 is a file of the text $2 and a newline.
holds() {
  [ -f "$1" ] || return 1
  held=
  while IFS= read -r line; do held="$held$line
"; done < "$1"
  [ "$held" = "$2
" ]
}

# Writes $2 and a newline to $1 when it differs.
record() {
  if holds "$1" "$2"; then return; fi
  { printf '%s\n' "$2" > "$1.new" && mv -f "$1.new" "$1"; } 2> /dev/null || { rm -f "$1.new"; cannot_write "$PWD/$1" "it cannot be written"; }
}

# Copies $2 to $1 when it differs.
record_file() {
  if [ -f "$1" ] && cmp -s "$2" "$1"; then return; fi
  { cat "$2" > "$1.new" && mv -f "$1.new" "$1"; } 2> /dev/null || { rm -f "$1.new"; cannot_write "$PWD/$1" "it cannot be written"; }
}

# The scan must be a file, or be gone while what was made from it is here; otherwise nothing is begun or made.
check_scan() {
  if [ -f "$SCAN" ]; then return; fi
  if [ "$SCAN" = "$former_scan" ] && [ -f "$WORK/stamps/ingest" ]; then
    echo "note: $SCAN is gone; what was made from it stays" >&2
    return
  fi
  hint="SCAN= names a file with a point cloud: PLY, E57, LAS, LAZ, PTX, PTS, PCD or text"
  case $SCAN in
    *://*) cause="is an address, not a file" hint="download the scan first, then name the file" ;;
    *) if [ -d "$SCAN" ]; then cause="is a folder, not a scan"; elif [ -e "$SCAN" ]; then cause="is not a regular file"; else cause="there is no such file"; fi ;;
  esac
  complain C01 "$SCAN: $cause" "$hint" 3
}

# Work folders are named after scans, so two scans of one name meet in one folder; then the user must say what is meant.
check_work_folder() {
  if [ -z "$former_scan" ] || [ "$SCAN" = "$former_scan" ] || [ "$SCAN" -ef "$former_scan" ]; then return; fi
  if [ -n "$work_given" ] || [ ! -e "$former_scan" ]; then
    echo "note: $WORK was made from $former_scan, now from $SCAN" >&2
    return
  fi
  fail "$WORK was made from another scan of this name, $former_scan" \
    "give this one a folder of its own with WORK=; or say WORK=$WORK to make that one anew from $SCAN"
}

# What ingest accepted last comes back when it refuses what is new.
keep_former() {
  if [ -d inputs/.former ]; then return; fi
  {
    mkdir inputs/.former.new &&
      for file in scan.path scan.options stations.txt; do
        [ ! -f inputs/$file ] || cp inputs/$file inputs/.former.new/ || break
      done &&
      mv inputs/.former.new inputs/.former
  } 2> /dev/null || cannot_write "$PWD/inputs" "what holds so far cannot be kept"
}

# After a run of the rules: $1 is its exit code. A killed ingest has refused nothing.
settle_inputs() {
  if [ ! -d inputs/.former ]; then return; fi
  if [ -f stamps/ingest ]; then
    rm -rf inputs/.former
  elif [ "$1" -ne 0 ] && grep -q '"exit_code": [23],' logs/ingest.json 2> /dev/null; then
    if [ -f inputs/.former/scan.path ] || [ -s inputs/stations.txt ]; then
      echo "note: what was said of the scan in this call was refused and is forgotten" >&2
    fi
    rm -f inputs/scan.options inputs/stations.txt
    mv -f inputs/.former/* inputs/ 2> /dev/null || true
    rm -rf inputs/.former
    # The scan need not be read again: whether its stamp still holds is decided by content.
    if [ -f stamps/ingest.before ]; then mv -f stamps/ingest.before stamps/ingest; fi
  fi
}

# How the scan is to be read belongs to the scan: said once, it holds until said otherwise.
record_scan() {
  old_up= old_unit= old_columns= old_level=
  if [ -f inputs/scan.options ]; then
    { read -r old_up; read -r old_unit; read -r old_columns; read -r old_level; } < inputs/scan.options || true
  fi
  if [ "${UP:-$old_up}" != "$old_up" ] || [ "${UNIT:-$old_unit}" != "$old_unit" ] || [ "${LEVEL:-$old_level}" != "$old_level" ]; then
    "$BIN/ingest" ${UP:+--up="$UP"} ${UNIT:+--unit="$UNIT"} ${LEVEL:+--level="$LEVEL"} --dump-params > /dev/null || exit $?
  fi
  UP=${UP:-${old_up:-z}}
  UNIT=${UNIT:-${old_unit:-m}}
  TEXT_COLUMNS=${TEXT_COLUMNS:-$old_columns}
  if [ "$TEXT_COLUMNS" = auto ]; then TEXT_COLUMNS=; fi
  LEVEL=${LEVEL:-${old_level:-yes}}
  options="$UP
$UNIT
$TEXT_COLUMNS
$LEVEL"
  if ! holds inputs/scan.options "$options" || ! holds inputs/scan.path "$SCAN"; then
    keep_former
    record inputs/scan.options "$options"
    record inputs/scan.path "$SCAN"
  fi
}

# Scanner positions enter as a copy: said once, they hold until said otherwise; STATIONS=none takes them away. Empty: none given.
record_stations() {
  case $STATIONS in
    '') if [ -f inputs/stations.txt ]; then return; fi; from=/dev/null ;;
    none) from=/dev/null ;;
    *)
      [ -f "$STATIONS" ] || complain C01 "$STATIONS: there is no such file" \
        "STATIONS= names a text file with the scanner positions, x y z on each line" 3
      from=$STATIONS ;;
  esac
  if [ -f inputs/stations.txt ] && cmp -s "$from" inputs/stations.txt; then return; fi
  if [ -n "$STATIONS" ]; then keep_former; fi
  record_file inputs/stations.txt "$from"
}

# Parameters come from the CONFIG= that was accepted last, until CONFIG=none. A file that is gone goes on as it was.
choose_config() {
  config_path=
  case $CONFIG in
    none) ;;
    '') if [ -f inputs/config.path ]; then IFS= read -r config_path < inputs/config.path; fi ;;
    *) config_path=$CONFIG ;;
  esac
  if [ -z "$config_path" ]; then
    CONFIG=
    if [ -f "$root/pipeline.yaml" ]; then CONFIG=$root/pipeline.yaml; fi
  elif [ -z "$CONFIG" ] && [ ! -e "$config_path" ] && [ -f inputs/config.yaml ]; then
    echo "note: $config_path is gone; what it said holds (inputs/config.yaml) until CONFIG= names another file or none" >&2
    CONFIG=$PWD/inputs/config.yaml
  else
    CONFIG=$config_path
    cause="there is no such file"
    if [ -d "$CONFIG" ]; then cause="is a folder"; fi
    [ -f "$CONFIG" ] || complain U02 "$CONFIG: $cause" \
      "CONFIG= names a file like pipeline.yaml, which holds all defaults; CONFIG=none goes back to it" 2
  fi
}

# Once its parameters were accepted.
record_config() {
  if [ -z "$config_path" ]; then
    rm -f inputs/config.path inputs/config.yaml
  else
    record_file inputs/config.yaml "$CONFIG"
    record inputs/config.path "$config_path"
  fi
}

config_is_recorded() {
  if [ -n "$config_path" ]; then holds inputs/config.path "$config_path" && [ -f inputs/config.yaml ]; else [ ! -e inputs/config.path ]; fi
}

# What the parameters depend on: the programs as they lie there and the text of the CONFIG.
asked_of() {
  (cd "$BIN" && stat -L -c '%n %i %s %.9Y %.9Z' $stages) && cat ${CONFIG:+"$CONFIG"} /dev/null
}

# Every stage prints its resolved parameters; asked only when pipeline.yaml, a program or an answer changed: params/.asked holds them all.
record_params() {
  if { asked_of && cat $answers; } 2> /dev/null | cmp -s - params/.asked && config_is_recorded; then return; fi
  rm -f params/.asked
  { printf '' > params/.asked.new; } 2> /dev/null || cannot_write "$PWD/params" "it cannot be written"
  # A program that was written in this very moment may be written again unseen: its answers are not kept.
  moment=$(stat -c %.9Z params/.asked.new)
  { asked_of > params/.asked.new; } 2> /dev/null || { rm -f params/.asked.new; cannot_write "$PWD/params" "it cannot be written"; }
  newest=$(cd "$BIN" && stat -L -c %.9Z $stages | sort -n | tail -n 1)
  settled=
  if [ "$newest" \< "$moment" ]; then settled=yes; fi
  mkdir params/.new 2> /dev/null || cannot_write "$PWD/params" "it cannot be written"
  { [ -n "$settled" ] && take_known_params; } || ask_params
  { mv -f params/.new/*.json params/ && rmdir params/.new; } 2> /dev/null || cannot_write "$PWD/params" "it cannot be written"
  record_config
  if [ -n "$settled" ]; then
    { cat $answers >> params/.asked.new && mv -f params/.asked.new params/.asked; } 2> /dev/null ||
      { rm -f params/.asked.new; cannot_write "$PWD/params/.asked" "it cannot be written"; }
  else
    rm -f params/.asked.new
  fi
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
  [ -z "$settled" ] || {
    cp -R params/.new "$BUILD/parameters.$$" && cp params/.asked.new "$BUILD/parameters.$$/.asked" &&
      rm -rf "$BUILD/parameters" && mv -T "$BUILD/parameters.$$" "$BUILD/parameters"
  } 2> /dev/null || rm -rf "$BUILD/parameters.$$"
}

refresh() {
  for program in artefact $stages; do
    [ -x "$BIN/$program" ] || fail "$BIN: the stages are not built" "make build"
  done
  choose_config
  record_params
  record_scan
  record_stations
}
