#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: clock.sh SOURCE BUILD: content decides what runs again, whatever the times of the files say.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
. "$(dirname "$0")/lib.sh"
edit=edits/wall_lines.geojson

parameters() { printf 'graphcut:\n  mu_m: %s\n' "$1" > "$config"; }
moved_edit() { # moved_edit METRES: the detected lines as an edit with one end moved
  mkdir -p "$work/edits"
  python3 - "$master/30_detect_lines/wall_lines.geojson" "$work/$edit" "$1" << 'P'
import json, sys
lines = json.load(open(sys.argv[1]))
lines["features"][0]["geometry"]["coordinates"][0][0] += float(sys.argv[3])
json.dump(lines, open(sys.argv[2], "w"))
P
}
damage() { # damage FILE: one bit in its middle, in place, its time put back
  python3 - "$1" << 'P'
import os, sys
path = sys.argv[1]
state = os.stat(path)
with open(path, "r+b") as file:
    file.seek(state.st_size // 2)
    byte = file.read(1)[0]
    file.seek(state.st_size // 2)
    file.write(bytes([byte ^ 1]))
os.utime(path, ns=(state.st_atime_ns, state.st_mtime_ns))
P
}
up_to_date() { # both what runs and what is said
  mk status && grep -q '^Everything is up to date' "$output" && mk run && ran_exactly ""
}
all_in_order() { mk verify && grep -q '^ok  model.ply' "$output"; }

# Ways in which a work folder gets times that say nothing.
shift_all() { find "$1" -exec touch -h -d "$2" {} +; }
make_as() { # make_as WAY: $work as a copy of the finished run
  rm -rf "$work"
  case $1 in
    'a day ahead') cp -a "$master" "$work" && shift_all "$work" '+1 day' ;;
    'a day back') cp -a "$master" "$work" && shift_all "$work" '-1 day' ;;
    'all equal') cp -a "$master" "$work" && shift_all "$work" '2020-02-02' ;;
    'copied with times') cp -a "$master" "$work" ;;
    'copied without times') cp -r "$master" "$work" ;;
    # As after the clock was set back: what is written from now on is older than all that lies there but the logs.
    'of a clock set back') cp -a "$master" "$work" && find "$work" -name '*.json' -prune -o -exec touch -h -d '+1 hour' {} + ;;
  esac
}

parameters 0.3
make_scan 1 "$scan" || exit 1
make_scan 2 "$place/other.ply" || exit 1
# Two scans of one size, so that size and time together say nothing.
size=$(stat -c %s "$scan")
truncate -s "$size" "$place/other.ply"
cp -p "$scan" "$place/first.ply"
mk run || { cat "$output"; exit 1; }
master=$place/master
mv "$work" "$master"
digests "$master" > "$place/first"

for way in 'a day ahead' 'a day back' 'all equal' 'copied with times' 'copied without times' 'of a clock set back'; do
  make_as "$way"
  mark
  check "$way: nothing runs" up_to_date
  check "… and verify finds all in order" all_in_order

  make_as "$way"
  mark
  parameters 0.3000001
  mk status
  check "$way: a changed parameter is seen" grep -q '^  graphcut  *stale: parameter mu_m changed 0.3 -> 0.3000001$' "$output"
  mk run
  check "… and runs its stage first" starts_with graphcut
  parameters 0.3

  make_as "$way"
  mark
  moved_edit 0.03
  touch -r "$work/40_accept_lines/wall_lines.geojson" "$work/$edit"
  mk run
  check "$way: an edit put in place is taken" starts_with accept_lines
  [ "$way" = 'copied with times' ] || shift_all "$work" '+1 day'
  mark
  moved_edit 0.06
  mk run
  check "… changed: taken again" starts_with accept_lines
  mark
  rm "$work/$edit"
  mk run
  check "… removed: taken back" starts_with accept_lines
  digests "$work" > "$place/now"
  check "… to the bytes of before" cmp "$place/first" "$place/now"

  make_as "$way"
  mark
  touch -r "$scan" "$place/other.ply"
  cat "$place/other.ply" > "$scan" && touch -r "$place/other.ply" "$scan"
  mk status
  check "$way: another scan of the same size and time is seen" grep -q '^  ingest  *stale: the scan changed$' "$output"
  mk run
  check "… and read" starts_with ingest
  cat "$place/first.ply" > "$scan" && touch -r "$place/first.ply" "$scan"

  make_as "$way"
  mark
  rm "$work/50_partition/cells.h5"
  mk run
  check "$way: a deleted file is made again, nothing after it" ran_exactly partition

  make_as "$way"
  mark
  damage "$work/50_partition/cells.h5"
  mk status
  check "$way: a damaged file is seen" grep -q '^  partition  *stale: its output 50_partition/cells.h5 was changed or damaged$' "$output"
  mk run
  check "… made again, nothing after it" ran_exactly partition
  check "… and the note says so" grep -q '^note: 50_partition/cells.h5 was changed or damaged after partition wrote it' "$output"
  digests "$work" > "$place/now"
  check "… with the bytes of before" cmp "$place/first" "$place/now"
done

# Damage in any file, right after a run in the same folder, where every shortcut is in force.
rm -rf "$work"
mk run
mk run
for file in $(cd "$work" && ls [0-9]*/* model.ply model.obj summary.json report.html pictures/*); do
  mark
  damage "$work/$file"
  mk run
  digests "$work" > "$place/now"
  maker=$(maker_of "$file")
  if [ "$(ran)" = "$maker" ] && cmp -s "$place/first" "$place/now"; then ok "$file damaged: $maker alone makes it again"; else
    not_ok "$file damaged" "ran: $(ran)
$(diff "$place/first" "$place/now")
$(tail -3 "$output")"
  fi
  case $file in
    *.h5) ;;
    *)
      name=${file//\//.}
      check "… and the other one is kept" test -s "$work/edits/old/${name%.*}.1.${name##*.}" ;;
  esac
done

# What a person changed in the wrong place is kept, and the note says where the right one is.
mark
cp "$work/40_accept_lines/wall_lines.geojson" "$place/mine"
sed -i 's/"note": *""/"note": "mine"/; s/"locked": *false/"locked": true/' "$place/mine"
cp "$place/mine" "$work/40_accept_lines/wall_lines.geojson"
mk run
check "lines edited in place: accept_lines makes them again" ran_exactly accept_lines
check "… the edit is kept" cmp "$place/mine" "$work/edits/old/40_accept_lines.wall_lines.2.geojson"
check "… and the note says where edits belong" grep -q '^note: .*edits/wall_lines.geojson' "$output"

rm -rf "$work/pictures"
mk status
check "pictures/ deleted is noticed" grep -q '^  report  *stale: its output pictures/.* is missing' "$output"
mark
mk run
check "… and made again by report alone" ran_exactly report
rm "$work/pictures/model.png"
mark
mk run
check "… a single one too" ran_exactly report

# Parameters that are damaged are asked for again.
mark
for file in "$work"/params/*.json; do damage "$file"; done
check "damaged parameters" mk run
check "… run nothing" ran_exactly ""
digests "$work" > "$place/now"
check "… and change nothing" cmp "$place/first" "$place/now"

# Stamps of an older roomcut had no inputs.
for stamp in "$work"/stamps/*; do sed -n 's/^out \([^ ]*\) [^ ]* /\1 1795893684 327142387 /p' "$stamp" > "$place/old" && cp "$place/old" "$stamp"; done
check "stamps of an older roomcut" mk run
check "… are said" grep -q '^note: stamps of an older roomcut' "$output"
digests "$work" > "$place/now"
check "… and the run ends as ever" cmp "$place/first" "$place/now"
mark
mk run
check "… once" ran_exactly ""

# verify compares parameters too (what ran before content decided: a folder that is stale and says nothing).
sed -i 's/"mu_m":0.3/"mu_m":0.4/' "$work/params/graphcut.json"
mk verify && not_ok "verify finds other parameters than the artefact was made with" || ok "verify finds other parameters than the artefact was made with"
check "… and says which" grep -q 'error\[A05\] 70_graphcut/labels.h5: was made with other parameters than params/graphcut.json' "$output"
finish
