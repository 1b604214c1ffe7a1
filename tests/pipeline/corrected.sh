#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: corrected.sh SOURCE BUILD: a sloped plane and a column corrected by hand, each through its door, up to the model.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
. "$(dirname "$0")/lib.sh"
: > "$config"

make_room() { # make_room PROPERTIES POINTS: a scan of one room of 8 x 6 m
  cat > "$place/scene.json" << S
{"name": "corrected", "seed": 3, "noise_m": 0.003, "sampling": {"kind": "uniform", "points": $2}, "storeys": [{"name": "ground", "floor": 0, "ceiling": 2.8,
 "rooms": [{"name": "room", "polygon": [[0, 0], [8, 0], [8, 6], [0, 6]], $1}]}]}
S
  "$BUILD/bin/synthesize" --scene "$place/scene.json" --scan-out "$scan" --truth-out "$place/truth.off" --truth-json "$place/truth.json" -q
}
change() { # change PYTHON: edits $edit; `d` is its content, `f` its features by id
  python3 - "$edit" "$1" << 'P'
import json, sys
d = json.load(open(sys.argv[1]))
f = {feature["id"]: feature for feature in d["features"] if "id" in feature}
exec(sys.argv[2])
json.dump(d, open(sys.argv[1], "w"), indent=3)
P
}
model_says() { # model_says NAME PYTHON: of the model: `volume`, `slopes` (pitch and where it rises, deg, by surface), `corners` in plan, `sound`
  python3 - "$work" "$2" << 'P' > "$output" 2>&1 && ok "$1" || not_ok "$1" "$(cat "$output")"
import json, math, os, sys
mesh = json.load(open(os.path.join(sys.argv[1], "summary.json")))["mesh"]
volume = mesh["volume_m3"]
sound = mesh["closed"] and mesh["manifold"] and mesh["oriented"] and mesh["self_intersections"] == 0
vertices, slopes = [], set()
for line in open(os.path.join(sys.argv[1], "model.obj")):
    words = line.split()
    if words[:1] == ["v"]:
        vertices.append([float(word) for word in words[1:4]])
    if words[:1] == ["f"]:
        a, b, c = (vertices[int(word.split("/")[0]) - 1] for word in words[1:4])
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        pitch = math.degrees(math.acos(abs(n[2]) / math.hypot(*n)))
        up = -1 if n[2] > 0 else 1
        if 0.5 < pitch < 89:
            slopes.add((round(pitch, 1), round(math.degrees(math.atan2(up * n[1], up * n[0]))) % 360))
corners = {(round(x, 2), round(y, 2)) for x, y, z in vertices}
print("volume", volume, "sound", sound, "slopes", sorted(slopes), "corners", sorted(corners))
assert sound and eval(sys.argv[2]), sys.argv[2]
P
}

# A roof of two planes, each rising by 30 degrees to a ridge at x = 4.
edit=$work/edits/planes.geojson
make_room '"ceiling": 5, "roof": {"kind": "gable", "pitch_deg": 30, "eaves": 1.2}' 120000 || exit 1
check "the first run" mk run
model_says "a gable roof" 'abs(volume - 113.03) < 0.1 and slopes == {(30.0, 0), (30.0, 180)}'
digests "$work" > "$place/first"
mk drop-planes
grep -q "^there is no edit" "$output" && ok "drop-planes without an edit says so" || not_ok "drop-planes without an edit says so" "$(cat "$output")"
mark
check "edit-planes" mk edit-planes
check "… runs nothing" ran_exactly ""
grep -qxF "edit this file, one polygon per sloped floor or ceiling: $edit" "$output" && ok "… says where the file is" || not_ok "… says where the file is" "$(cat "$output")"
mk edit-planes && not_ok "a second edit-planes is refused" || ok "a second edit-planes is refused"
mark
change 'd["features"].reverse(); [x["geometry"]["coordinates"][0].reverse() for x in d["features"]]'
check "an edit in another layout and order" mk run
check "… runs accept_planes only" ran_exactly accept_planes

# Where the roof lies 3 degrees steeper than the points say: they are wrong, the plane is locked.
mark
cp "$edit" "$place/good"
change 'g = [x for x in d["features"] if round(x["properties"]["uphill_deg"]) % 360 == 0][0]["properties"]; g["pitch_deg"] += 3; g["locked"] = True'
check "a pitch changed by 3 degrees" mk run
check "… runs accept_planes first" starts_with accept_planes
model_says "… turns that plane of the model's roof, and leaves the other" 'slopes == {(33.0, 0), (30.0, 180)}'
mk status
grep -Eq '^  accept_planes +fresh, edited: 1 moved, 1 locked$' "$output" && ok "status says what the edit changed" || not_ok "status says what the edit changed" "$(cat "$output")"
cp "$place/good" "$edit"
change 'for x in d["features"]: x["properties"]["height_m"] += 0.04'
mk run
model_says "planes lifted by 4 cm are fitted to the points near them again" 'abs(volume - 113.03) < 0.1 and slopes == {(30.0, 0), (30.0, 180)}'
change 'for x in d["features"]: x["properties"]["locked"] = "yes"'
mk run
model_says "… and stay there when they are locked" 'abs(volume - 113.03 - 48 * 0.04) < 0.1'

cp "$place/good" "$edit"
change 'd["features"] = [x for x in d["features"] if round(x["properties"]["uphill_deg"]) % 360 == 180]'
check "a plane deleted" mk run
model_says "… is gone" 'slopes == {(30.0, 180)}'
cp "$edit" "$place/deleted"
change 'd["features"].append({"type": "Feature", "properties": {"pitch_deg": 31, "uphill_deg": 0, "height_m": 1.2 + 2 * 0.57735},
  "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 6], [0, 6], [0, 0]]]}})'
check "… and drawn again, a little off" mk run
model_says "… is fitted to its points" 'abs(volume - 113.03) < 0.1 and slopes == {(30.0, 0), (30.0, 180)}'

digests "$work" > "$place/before"
change 'd["features"][0]["properties"]["pitch_deg"] = "steep"; d["features"][1]["geometry"] = None; d["features"].append({"type": "Feature"})'
mk run && not_ok "a wrong edit stops the run" || ok "a wrong edit stops the run"
if grep -q 'Error 3' "$output" && [ "$(grep -c 'error\[L' "$output")" -eq 3 ] && [ "$(grep -c '^hint:' "$output")" -ge 3 ]; then
  ok "… with exit code 3, naming every problem and remedy"
else
  not_ok "… with exit code 3, naming every problem and remedy" "$(cat "$output")"
fi
digests "$work" > "$place/after"
check "… and nothing of before is lost" cmp "$place/before" "$place/after"
cp "$edit" "$place/wrong"
check "drop-planes" mk drop-planes
check "… moves the edit aside with all its bytes" cmp "$place/wrong" "$work/edits/old/planes.1.geojson"
mk run
digests "$work" > "$place/now"
check "… and the next run gives the bytes of before the edit" cmp "$place/first" "$place/now"

# A column of 0.4 m: its four short sides are wall lines as others.
rm -rf "$work"
edit=$work/edits/wall_lines.geojson
make_room '"columns": [{"at": [3, 2.5], "width": 0.4}]' 100000 || exit 1
mk run
model_says "a column" 'abs(volume - (48 - 0.16) * 2.8) < 0.1 and (2.8, 2.3) in corners'
mk edit-lines
change 'for x in d["features"]:
    if x["properties"].get("column"):
        x["properties"]["locked"] = True
        for q in x["geometry"]["coordinates"]: q[0] += 0.03'
check "moved by 3 cm and locked" mk run
model_says "… stands 3 cm further" 'abs(volume - (48 - 0.16) * 2.8) < 0.1 and {(2.83, 2.3), (3.23, 2.3), (3.23, 2.7), (2.83, 2.7)} <= corners'
change 'd["features"] = [x for x in d["features"] if not x["properties"].get("column")]'
check "deleted" mk run
model_says "… is gone" 'abs(volume - 48 * 2.8) < 0.1 and len(corners) == 4'
change 'd["features"].append({"type": "Feature", "properties": {}, "geometry": {"type": "LineString",
  "coordinates": [[2.81, 2.31], [3.21, 2.31], [3.21, 2.71], [2.81, 2.71], [2.81, 2.31]]}})'
check "drawn again as one polyline, a centimetre off" mk run
model_says "… stands where its points are" 'abs(volume - (48 - 0.16) * 2.8) < 0.1 and {(2.8, 2.3), (3.2, 2.3), (3.2, 2.7), (2.8, 2.7)} <= corners'
finish
