#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: commands.sh SOURCE BUILD: every command of the Makefile on a real run.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
. "$(dirname "$0")/lib.sh"
edit=$work/edits/wall_lines.geojson

says() { # says NAME PATTERN: a line of the output matches, blanks as they come
  if grep -Eq "$2" "$output"; then ok "$1"; else not_ok "$1" "$(cat "$output")"; fi
}
status_says() { # status_says STAGE PATTERN
  mk status
  says "status: $1: $2" "^  $1 +$2\$"
}
refused() { # refused NAME COMMAND …
  local name=$1
  shift
  if "$@"; then not_ok "$name"; else ok "$name"; fi
}
change() { # change FILE PYTHON: edits a JSON file; `d` is its content, `f` its features by wall_id
  python3 - "$1" "$2" <<'P'
import json, sys
d = json.load(open(sys.argv[1]))
f = {feature["properties"].get("wall_id"): feature for feature in d.get("features", [])}
exec(sys.argv[2])
json.dump(d, open(sys.argv[1], "w"))
P
}
config_text() { printf "$1" > "$config"; }

config_text 'graphcut:\n  mu_m: 0.3\n'
make_scan 1 "$scan" || exit 1
mk status
[ "$(grep -c ' never run$' "$output")" -eq "$(echo $ALL | wc -w)" ] && ok "status before the first run: nothing has run" ||
  not_ok "status before the first run: nothing has run" "$(cat "$output")"
mk run || { cat "$output"; exit 1; }

# status: one line a stage, with the reason
mk status
says "status when all is done" '^Everything is up to date'
config_text 'graphcut:\n  mu_m: 0.5\nslice:\n'
status_says graphcut 'stale: parameter mu_m changed 0.3 -> 0.5'
says "… and of the second pass" '^  final_graphcut +stale: parameter mu_m changed 0.3 -> 0.5$'
says "… those before are fresh" '^  raycast +fresh$'
says "… those after wait for it" '^  refine_lines +fresh, runs only if graphcut comes out different$'
says "… and the model for both" '^  extract +fresh, runs only if graphcut or final_graphcut comes out different$'
config_text 'graphcut:\n  mu_m: 0.3\n'
mk run
rm "$work/20_slice/slices.h5"
status_says slice 'stale: its output 20_slice/slices.h5 is missing'
mk run
rm "$work/stamps/raycast" && touch "$work/stamps/raycast.before"
status_says raycast 'stale: it did not finish last time'
mk run
printf ' ' >> "$scan" && mk status UP=y
says "status: a changed scan, read another way" '^  ingest +stale: the scan changed, the scan is to be read with another up axis or unit$'
make_scan 1 "$scan"
mk run UP=z
touch "$work/90_final/cells.h5"
status_says final_weigh_faces 'fresh'
cp "$work/50_partition/cells.h5" "$work/90_final/cells.h5"
status_says final_partition 'stale: its output 90_final/cells.h5 was changed or damaged'
says "… and those after it wait" '^  final_weigh_faces +fresh, runs only if final_partition comes out different$'
mk run

# edit-lines, diff-lines, drop-edit
mk diff-lines
says "diff-lines without an edit says so" '^no edit at .*: all [0-9]+ lines are as detected$'
mk drop-edit
says "drop-edit without an edit says so" '^there is no edit in '
check "edit-lines" mk edit-lines
says "… says where the file is and what comes next" "^edit this file, one line per wall: $edit\$"
mk diff-lines
says "diff-lines of an untouched copy" '^[0-9]+ as detected, 0 moved, 0 added, 0 deleted, 0 locked$'
status_says accept_lines 'stale: a hand edit was put in place'
ids=($(python3 -c 'import json,sys; print(*[x["properties"]["wall_id"] for x in json.load(open(sys.argv[1]))["features"]])' "$edit"))
change "$edit" '
a, b, c = [f[i] for i in sorted(f)[:3]]
p, q = a["geometry"]["coordinates"]
n = [q[1] - p[1], p[0] - q[0]]; s = 0.12 / (n[0] ** 2 + n[1] ** 2) ** 0.5
for point in (p, q): point[0] += s * n[0]; point[1] += s * n[1]
b["properties"]["locked"] = True
d["features"].remove(c)
d["features"].append({"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[1, 1], [1, 2.5]]}})'
mk diff-lines
says "diff-lines: moved by how much" "^moved:   ${ids[0]} moved by 120.0 mm, turned by 0.00 deg\$"
says "diff-lines: locked" "^locked:  ${ids[1]} \\("
says "diff-lines: deleted" "^deleted: ${ids[2]} \\("
says "diff-lines: added" '^added:   e0001 \(1.50 m, from \(1.00, 1.00\) to \(1.00, 2.50\)\)$'
says "diff-lines: all in one line" '^[0-9]+ as detected, 1 moved, 1 added, 1 deleted, 1 locked$'
mk accept_lines
status_says accept_lines 'fresh, edited: 1 moved, 1 added, 1 deleted, 1 locked'
change "$edit" 'f[sorted(i for i in f if i)[0]]["properties"]["note"] = "looked at"'
status_says accept_lines 'stale: the hand edit changed'
mk accept_lines
cp "$edit" "$place/edit"
check "drop-edit" mk drop-edit
says "… says where it went" "^the edit lies now in $work/edits/old/wall_lines.1.geojson"
check "… with all its bytes" cmp "$place/edit" "$work/edits/old/wall_lines.1.geojson"
status_says accept_lines 'stale: the hand edit was dropped'
mk edit-lines && mk drop-edit
check "a second drop-edit keeps the first" test -s "$work/edits/old/wall_lines.1.geojson" -a -s "$work/edits/old/wall_lines.2.geojson"
mk run

# layers for QGIS, beside the file that is edited (where they lie: tests/contract/gdal_layers_test.py)
rm -f "$work"/edits/slice_*
touch "$work/edits/slice_99.png"
check "layers" mk layers
says "… says which" "^$work/edits/slice_0.png\$"
for ending in png pgw png.aux.xml; do check "… with its $ending" test -s "$work/edits/slice_0.$ending"; done
check "… and takes away those of former slices" test ! -e "$work/edits/slice_99.png"
rm -f "$work"/edits/slice_*
mk edit-lines && mk drop-edit
check "edit-lines makes them too" test -s "$work/edits/slice_0.png" -a -s "$work/edits/slice_0.pgw"

# plot-STAGE: SVG and PNG of every stage, with words that say what they show
whole() { # whole LIST FOLDER: the files of the list are all there are, SVGs have words, PNGs are whole and not blank
  python3 - "$1" "$2" << 'P'
import os, sys, xml.etree.ElementTree, zlib
named = open(sys.argv[1]).read().split("\n")[:-1]
there = [os.path.join(sys.argv[2], name) for name in os.listdir(sys.argv[2])]
assert sorted(named) == sorted(there), (named, there)
for path in named:
    content = open(path, "rb").read()
    if path.endswith(".svg"):
        texts = [text for text in xml.etree.ElementTree.fromstring(content).iter() if text.tag.endswith("}text")]
        assert len(texts) >= 2 and all(text.text for text in texts[:2]), path
    else:
        assert content.startswith(b"\x89PNG") and content[-8:-4] == b"IEND", path
        at, pixels = 8, b""
        while at < len(content):
            size = int.from_bytes(content[at : at + 4], "big")
            pixels += content[at + 8 : at + 8 + size] if content[at + 4 : at + 8] == b"IDAT" else b""
            at += 12 + size
        assert len(set(zlib.decompress(pixels))) > 3, path + ": one colour"
P
}
for stage in $ALL; do
  rm -rf "$work/pictures"
  check "plot-$stage" mk "plot-$stage"
  grep '^/' "$output" > "$place/drawn"
  svgs=$(grep -c '\.svg$' "$place/drawn")
  if [ "$svgs" -ge 1 ] && [ "$svgs" -eq "$(grep -c '\.png$' "$place/drawn")" ]; then ok "… a PNG for each SVG"; else
    not_ok "… a PNG for each SVG" "$(cat "$output")"
  fi
  check "… all whole, not blank, nothing besides" whole "$place/drawn" "$work/pictures"
done
rm "$work/90_final/labels.h5"
mk plot-final_graphcut
check "plot-STAGE makes first what is missing" test -s "$work/90_final/labels.h5"
mk rerun-report

# compare: two runs of one scan, one of them with another dial and a wall moved by 12 cm
other="$place/an other"
compare_says() { # compare_says NAME PYTHON: a condition on comparison.json, `d`
  if python3 -c 'import json, sys; d = json.load(open(sys.argv[1])); sys.exit(not (eval(sys.argv[2])))' "$other/compare/w o r k/comparison.json" "$2"; then
    ok "$1"
  else
    not_ok "$1" "$(cat "$output")"
  fi
}
cp -a "$work" "$other"
check "compare of a run with its copy" mk compare A="$work" B="$other"
compare_says "… finds the same scan, parameters and lines" 'd["same_scan"] and not d["parameters"] and not d["lines"]["moved"] and d["lines"]["same"] >= 4'
compare_says "… and the same model" 'd["distance"]["a_to_b"]["hausdorff_m"] < 1e-9 and abs(d["distance"]["a_m3"] - d["distance"]["common_m3"]) < 1e-9'
mkdir -p "$other/edits"
cp "$other/40_accept_lines/wall_lines.geojson" "$other/edits/wall_lines.geojson"
change "$other/edits/wall_lines.geojson" '
east = max(d["features"], key=lambda line: min(p[0] for p in line["geometry"]["coordinates"]))
for point in east["geometry"]["coordinates"]: point[0] += 0.12
east["properties"]["locked"] = True'
config_text 'graphcut:\n  mu_m: 0.35\n'
first_work=$work && work=$other
mk run
work=$first_work
config_text 'graphcut:\n  mu_m: 0.3\n'
digests "$work" > "$place/before"
check "compare of two runs" mk compare A="$work" B="$other"
digests "$work" > "$place/after"
check "… leaves the first as it was" cmp "$place/before" "$place/after"
says "… says the dial" '^ +graphcut\.mu_m +0\.3 +0\.35$'
says "… and the wall" '^ +w[0-9]+ +w[0-9]+ +moved +1[12][0-9]\.[0-9] '
compare_says "… the wall moved by as much" 'sum(abs(m["offset_m"] - 0.12) < 0.005 for m in d["lines"]["moved"]) == 1 and d["b"]["edited"] and not d["a"]["edited"]'
compare_says "… and the model with it" 'abs(d["distance"]["b_to_a"]["hausdorff_m"] - 0.12) < 0.01 and d["distance"]["b_m3"] > d["distance"]["a_m3"] + 0.5'
compare_says "… only B is empty there" 'd["distance"]["a_m3"] - d["distance"]["common_m3"] < 0.1 < d["distance"]["b_m3"] - d["distance"]["common_m3"]'
compare_says "… and the room is larger" 'len(d["rooms"]["both"]) == 1 and d["rooms"]["both"][0]["area_m2"][1] > d["rooms"]["both"][0]["area_m2"][0] + 0.2'
check "… with a page" grep -q 'Storey 0, floor at' "$other/compare/w o r k/comparison.html"
refused "compare without A is refused" mk compare B="$other"
says "… with a remedy" 'hint: name two work folders'
refused "compare with a folder that holds no run is refused" mk compare A="$place" B="$other"
says "… naming it" "error\\[A01\\] $place/10_ingest/cloud.h5"

# verify: every kind of flaw
check "verify finds all in order" mk verify
[ "$(grep -c '^ok  ' "$output")" -ge 17 ] && ok "… in every file" || not_ok "… in every file" "$(cat "$output")"
flaw() { # flaw FILE CODE PATTERN COMMAND …: the command damages FILE, verify says so, the file comes back
  local file=$1 code=$2 pattern=$3 name="verify: $1: $3"
  shift 3
  cp -p "$work/$file" "$place/kept"
  "$@"
  if mk verify; then not_ok "$name"; else says "$name" "error\\[$code\\] $file: .*$pattern"; fi
  grep -q 'Error 3' "$output" || grep -q 'Error 4' "$output" || not_ok "… with its exit code" "$(cat "$output")"
  cp -p "$place/kept" "$work/$file"
}
flaw summary.json A02 'rooms.0.area_m2: ' change "$work/summary.json" 'd["rooms"][0]["area_m2"] = "large"'
flaw summary.json A02 'does not have the digest' change "$work/summary.json" 'd["rooms"][0]["area_m2"] += 1'
flaw summary.json A02 'the parameters do not have the digest' change "$work/summary.json" 'd["provenance"]["params_json"] = "{}"'
flaw summary.json A05 'was made from another version of' change "$work/summary.json" '
inputs = d["provenance"]["inputs"]
(inputs["labels"] if isinstance(inputs, dict) else [i for i in inputs if i["name"] == "labels"][0])["payload_sha256"] = "0" * 64'
flaw 40_accept_lines/wall_lines.geojson A02 'features.0.properties.*support_m' change "$work/40_accept_lines/wall_lines.geojson" \
  'd["features"][0]["properties"]["support_m"] = -1'
flaw 95_find_openings/openings.geojson A02 '' change "$work/95_find_openings/openings.geojson" 'd["roomcut"]["frame"]["origin"][0] += 1'
flaw model.ply A05 'is not the file that its stage wrote' python3 -c '
import sys
content = bytearray(open(sys.argv[1], "rb").read())
end = content.index(b"end_header\n") + 11
content[end + 6] ^= 1
open(sys.argv[1], "wb").write(content)' "$work/model.ply"
flaw model.ply A05 'encloses [0-9.]+ m3, summary.json states' python3 -c '
import struct, sys
content = bytearray(open(sys.argv[1], "rb").read())
end = content.index(b"end_header\n") + 11
count = int(content[:end].decode().split("element vertex ")[1].split()[0])
z = [struct.unpack_from("<d", content, end + 24 * i + 16)[0] for i in range(count)]
for i in range(count):
    if z[i] > max(z) - 1e-6:
        struct.pack_into("<d", content, end + 24 * i + 16, z[i] + 0.5)
open(sys.argv[1], "wb").write(content)' "$work/model.ply"
flaw model.ply N06 '' python3 -c '
import sys
content = bytearray(open(sys.argv[1], "rb").read())
end = content.index(b"end_header\n") + 11
face = end + 24 * int(content[:end].decode().split("element vertex ")[1].split()[0]) + 1
content[face : face + 8] = content[face + 4 : face + 8] + content[face : face + 4]  # the first triangle: turned around
open(sys.argv[1], "wb").write(content)' "$work/model.ply"
flaw 20_slice/slices.h5 A05 '' cp "$work/50_partition/cells.h5" "$work/20_slice/slices.h5"
cp "$scan" "$place/scan" && printf ' ' >> "$scan"
refused "verify finds another scan" mk verify
says "… and says so" 'error\[A05\] 10_ingest/cloud.h5: was made from other bytes than '
cp "$place/scan" "$scan"
mk run
check "verify finds all in order again" mk verify

finish
