#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: reruns.sh SOURCE BUILD [JOBS]: what runs again after which change; every row of the table of DESIGN in a small building.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
jobs=${3:+-j$3}
. "$(dirname "$0")/lib.sh"

line_edit() { # moves an end of the first line by 3 cm; keeps everything else
  python3 - "$1" <<'P'
import json, sys
path = sys.argv[1]
value = json.load(open(path))
value["features"][0]["geometry"]["coordinates"][0][0] += 0.03
json.dump(value, open(path, "w"))
P
}
reformat() {
  python3 - "$1" <<'P'
import json, sys
path = sys.argv[1]
value = json.load(open(path))
value["features"].reverse()
json.dump(value, open(path, "w"), indent=7)
P
}
edit=$work/edits/wall_lines.geojson
old_time() { touch -d '2001-01-01' "$1"; }

printf 'graphcut:\n  mu_m: 0.3\nreport:\n' > "$config"
make_scan 1 "$scan" || exit 1
mark
check "the first run runs every stage" mk run
check "… each once" ran_exactly "$(since ingest)"
check "… and leaves a model" test -s "$work/model.ply" -a -s "$work/model.obj" -a -s "$work/summary.json" -a -s "$work/report.html"
check "… and nothing half-written" no_left_overs
digests "$work" > "$place/first"

mark
mk run
check "a second run has nothing to do" ran_exactly ""

mark
printf '# a comment\nreport: {}\n\ngraphcut: {mu_m: 3e-1}\n' > "$config"
check "comment, order and spelling in pipeline.yaml" mk run
check "… run nothing" ran_exactly ""

mark
printf 'graphcut:\n  mu_m: 0.3000001\n' > "$config"
check "graphcut.mu_m changed" mk run
check "… runs graphcut first, nothing before it" starts_with graphcut
ran | tr ' ' '\n' | grep -q final_graphcut && ok "… and the second pass's too" || not_ok "… and the second pass's too" "$(ran)"
printf 'graphcut:\n  mu_m: 0.3\n' > "$config"
mk run

mark
printf 'accept_lines:\ndetect_lines:\n  max_gap_m: 3.25\ngraphcut:\n  mu_m: 0.3\n' > "$config"
mk run
check "a parameter changed and the payload equal: that stage only" ran_exactly "detect_lines"

mark
check "rerun of a stage with the same outcome" mk rerun-slice
check "… runs that stage only" ran_exactly "slice"
mark
mk run
check "… and nothing later" ran_exactly ""

mark
check "edit-lines" mk edit-lines
check "… runs nothing" ran_exactly ""
check "… and makes the file" test -s "$edit"
mk edit-lines && not_ok "a second edit-lines is refused" || ok "a second edit-lines is refused"
mark
check "an edit that changes nothing" mk run
check "… runs accept_lines only" ran_exactly "accept_lines"
cp "$work/40_accept_lines/wall_lines.geojson" "$place/accepted"

mark
line_edit "$edit"
old_time "$edit"
check "an edit, with an old time stamp" mk run
check "… runs accept_lines first, nothing before it" starts_with accept_lines
ran | tr ' ' '\n' | grep -qx partition && ok "… and what follows" || not_ok "… and what follows" "$(ran)"
mark
mk diff-lines
grep -q moved "$output" && ok "diff-lines says what moved" || not_ok "diff-lines says what moved" "$(cat "$output")"

mark
line_edit "$edit"
old_time "$edit"
mk run
check "edited again: accept_lines first" starts_with accept_lines

mark
reformat "$edit"
mk run
check "reformatted edit: accept_lines only" ran_exactly "accept_lines"

mark
touch "$edit"
mk run
check "touched edit: nothing" ran_exactly ""

mark
cp "$edit" "$place/good_edit"
digests "$work" > "$place/before"
printf '{"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": {"type": "LineString", "coordinates": [[1,1],[1,1]]}}, {"type": "Feature", "geometry": null}]}' > "$edit"
mk run && not_ok "a wrong edit stops the run" || ok "a wrong edit stops the run"
grep -q 'Error 3' "$output" && ok "… with exit code 3" || not_ok "… with exit code 3" "$(cat "$output")"
if [ "$(grep -c 'error\[L' "$output")" -eq 2 ] && grep -q 'features\[0\]' "$output" && grep -q 'features\[1\]' "$output" && grep -q hint: "$output"; then
  ok "… naming every problem, feature and remedy"
else
  not_ok "… naming every problem, feature and remedy" "$(cat "$output")"
fi
digests "$work" > "$place/after"
check "… and nothing of before is lost" cmp "$place/before" "$place/after"
cp "$place/good_edit" "$edit"
mark
mk run
check "the edit put right: accept_lines runs, nothing else" ran_exactly "accept_lines"

mark
cp "$work/model.ply" "$place/model_of_edit"
printf 'detect_lines:\n  min_support_m: 4.5\ngraphcut:\n  mu_m: 0.3\n' > "$config"
check "detection changed under an edit" mk run
check "… reruns detection" starts_with detect_lines
check "… and the model stays" cmp "$work/model.ply" "$place/model_of_edit"
check "… the edit stays" cmp "$edit" "$place/good_edit"
grep -q 'warning: accept_lines: .*the detection changed' "$output" && ok "… with a warning" || not_ok "… with a warning" "$(cat "$output")"
grep -q 'only the edit has' "$output" && ok "… that lists what differs" || not_ok "… that lists what differs" "$(cat "$output")"
printf 'graphcut:\n  mu_m: 0.3\n' > "$config"
mk run

mark
check "drop-edit" mk drop-edit
check "… moves the edit aside" test -s "$work/edits/old/wall_lines.1.geojson" -a ! -e "$edit"
check "the edit removed" mk run
check "… runs accept_lines first" starts_with accept_lines
digests "$work" > "$place/now"
check "… and gives the bytes of before the edit" cmp "$place/first" "$place/now"

mark
touch "$scan"
mk run
check "the scan touched: nothing" ran_exactly ""
cp "$scan" "$place/copy" && mv "$place/copy" "$scan"
mk run
check "the scan copied over itself: nothing" ran_exactly ""

for file in 20_slice/slices.h5 50_partition/cells.h5 30_detect_lines/hough.h5 90_final/weights.h5 model.obj; do
  mark
  rm "$work/$file"
  mk run
  check "$file deleted: remade, nothing after it" ran_exactly "$(maker_of "$file")"
  check "… and it is there" test -s "$work/$file"
done
mark
rm "$work/20_slice/slices.h5" "$work/70_graphcut/labels.h5"
mk run
check "two files deleted: both remade, nothing else" ran_exactly "slice graphcut"
digests "$work" > "$place/now"
check "… with the same bytes" cmp "$place/first" "$place/now"

check "verify finds all in order" mk verify
size=$(stat -c %s "$work/10_ingest/cloud.h5")
head -c 200 /dev/zero | dd of="$work/10_ingest/cloud.h5" bs=1 seek=$((size / 2)) conv=notrunc 2> /dev/null
mk verify && not_ok "verify finds a changed byte" || ok "verify finds a changed byte"
rm "$work/10_ingest/cloud.h5"
mk run
check "… and the file made again is in order" mk verify

mark
mk status
check "status changes nothing" ran_exactly ""
[ "$(grep -c ' fresh$' "$output")" -eq "$(echo $ALL | wc -w)" ] && ok "status: all fresh" || not_ok "status: all fresh" "$(cat "$output")"
printf 'raycast:\n  nonsense: 1\nraycasts:\n' > "$config"
mk run && not_ok "wrong parameters stop the run" || ok "wrong parameters stop the run"
if [ "$(grep -c 'error\[U03\]' "$output")" -eq 2 ] && grep -q "pipeline.yaml:2: raycast.nonsense" "$output"; then
  ok "… naming each once, with its line"
else
  not_ok "… naming each once, with its line" "$(cat "$output")"
fi
printf 'graphcut:\n  mu_m: 0.4\n' > "$config"
mk status
grep -q '^  graphcut  *stale: parameter mu_m changed 0.3 -> 0.4$' "$output" && ok "status names the stage that will run" || not_ok "status names the stage that will run" "$(cat "$output")"
printf 'graphcut:\n  mu_m: 0.3\n' > "$config"
mk run

mark
mk clean-graphcut
check "clean-graphcut deletes its file" test ! -e "$work/70_graphcut/labels.h5"
mk run
digests "$work" > "$place/now"
check "… and the next run brings back the same" cmp "$place/first" "$place/now"

# Names relative to where make runs; how the scan is to be read holds until said otherwise.
scan=$(realpath --relative-to="$SOURCE" "$scan") && first_work=$work && work="$place/second"
check "a scan named relatively" mk ingest
check "… is found" test -s "$work/10_ingest/cloud.h5"
mark
check "UP=y" mk ingest UP=y
check "… reads the scan again" ran_exactly "ingest"
mark
mk ingest
check "… and holds for the next run" ran_exactly ""
scan=$(realpath "$SOURCE/$scan") && work=$first_work

# Scanner positions: by content, remembered, taken away with none.
printf '2.5 2.0 1.6\n' > "$place/scanner positions.txt"
mark
check "STATIONS=file" mk ingest STATIONS="$place/scanner positions.txt"
check "… reads the scan again" ran_exactly "ingest"
numbers() { h5dump -y -m %.6f "$@" "$work/10_ingest/cloud.h5" | grep -oE -- '-?[0-9]+\.[0-9]{6}'; }
positions=$(paste <(numbers -d /stations/xyz) <(numbers -a /frame/origin) | awk '{ printf "%.3f ", $1 + $2 }')
check "… and writes the positions, from the local origin" test "$positions" = "2.500 2.000 1.600 "
mark
touch "$place/scanner positions.txt"
mk ingest STATIONS="$place/scanner positions.txt"
rm "$place/scanner positions.txt"
mk ingest
check "… they hold, whatever becomes of the file" ran_exactly ""
mk ingest STATIONS="$place/nowhere.txt" && not_ok "a missing file is an error" || ok "a missing file is an error"
check "… that is named" grep -q 'error\[C01\].*nowhere.txt' "$output"
mark
mk ingest STATIONS=none
check "STATIONS=none takes them away" ran_exactly "ingest"
mk run
digests "$work" > "$place/now"
check "… and the result is the first again" cmp "$place/first" "$place/now"

mark
make_scan 2 "$scan"
check "another scan of the same name" mk run
check "… runs everything" ran_exactly "$(since ingest)"
finish
