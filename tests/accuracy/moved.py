# SPDX-License-Identifier: GPL-3.0-or-later
"""The group `moved` of `make accuracy`: scans and their truths in other poses and thinned out. The building stays the same, so the model should."""
import json
import math
import os
import random
import re
import struct
from array import array

# Of a pose: `turn` about the vertical axis [degrees], `shift` after it [m], `decimals` to which coordinates are rounded, `copies` of every
# point, `thin`: one point of so many is kept; `lopsided`: of the points beyond the middle in x and in y that share is left out. The stages'
# grids begin at the mean of the points, so a shift moves them with the building; some points fewer on two sides move them against it.
# utm is what a survey exports.
POSES = {
    "still": {},
    "lopsided": {"lopsided": 0.03},
    "shift_12cm": {"shift": (-0.12, 0.12, 0.031)},
    "turn_17": {"turn": 17.0},
    "turn_45": {"turn": 45.0},
    "turn_90": {"turn": 90.0, "shift": (3.217, -1.433, 0.0)},
    "utm_1mm": {"shift": (431207.317, 5411873.551, 112.404), "decimals": 3},
    "doubled": {"copies": 2},
    "half": {"thin": 2},
    "quarter": {"thin": 4},
    "eighth": {"thin": 8},
}
TYPES = {"float": "f", "float32": "f", "double": "d", "float64": "d", "uchar": "B", "uint8": "B", "char": "b", "int8": "b", "ushort": "H", "uint16": "H",
         "short": "h", "int16": "h", "uint": "I", "uint32": "I", "int": "i", "int32": "i"}


def mover(pose):
    """The function that moves x, y, z."""
    angle, (dx, dy, dz) = math.radians(pose.get("turn", 0.0)), pose.get("shift", (0.0, 0.0, 0.0))
    c, s, decimals = math.cos(angle), math.sin(angle), pose.get("decimals", 9)
    return lambda x, y, z: (round(c * x - s * y + dx, decimals), round(s * x + c * y + dy, decimals), round(z + dz, decimals))


def read_points(path):
    """x, y, z of a binary little-endian PLY whose only element is `vertex`."""
    with open(path, "rb") as file:
        content = file.read()
    end = content.index(b"end_header\n") + len(b"end_header\n")
    header = content[:end].decode("ascii")
    properties = re.findall(r"^property (\w+) (\w+)$", header, re.M)
    layout = struct.Struct("<" + "".join(TYPES[kind] for kind, _ in properties))
    place = [[name for _, name in properties].index(axis) for axis in "xyz"]
    count = int(re.search(r"^element vertex (\d+)$", header, re.M)[1])
    return [tuple(values[i] for i in place) for values in layout.iter_unpack(content[end:end + count * layout.size])]


def write_points(path, points):
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\nproperty double z\nend_header\n"
    with open(path, "wb") as file:
        file.write(header.encode("ascii"))
        values = array("d", (value for point in points for value in point))
        file.write(struct.pack(f"<{len(values)}d", *values))


def moved_points(points, pose):
    move, draw = mover(pose), random.Random(1)
    middle = [sum(axis) / len(points) for axis in zip(*points)]

    def kept(point):
        beyond = (point[0] > middle[0]) + (point[1] > middle[1])
        return draw.random() < (1 - beyond * pose.get("lopsided", 0.0)) / pose.get("thin", 1)
    return [move(*point) for point in points if kept(point)] * pose.get("copies", 1)


def moved_off(text, pose):
    """An OFF mesh whose vertices have been moved."""
    move, lines = mover(pose), text.splitlines()
    first = next(i for i, line in enumerate(lines) if re.match(r"\d+ \d+", line))
    count = int(lines[first].split()[0])
    for i in range(first + 1, first + 1 + count):
        lines[i] = " ".join(map(repr, move(*map(float, lines[i].split()[:3]))))
    return "\n".join(lines) + "\n"


def moved_truth(truth, pose):
    """What `evaluate` and the stations need of a truth.json. Boxes that it ignores would not stay boxes."""
    if truth.get("ignore_boxes"):
        raise ValueError("a truth with ignore_boxes cannot be moved")
    move = mover(pose)
    rooms = []
    for room in truth["rooms"]:
        own = {"name": room["name"], "scanned": room.get("scanned", True), "center": move(*room["center"]),
               **{end: move(0.0, 0.0, room[end])[2] for end in ("floor", "ceiling")}}
        if "polygon" in room:
            own["polygon"] = [move(x, y, 0.0)[:2] for x, y in room["polygon"]]
        rooms.append(own)
    return {"rooms": rooms, "stations": [{"position": move(*station["position"])} for station in truth["stations"]]}


def write_moved(source, target, pose_name):
    """Writes scan, truth mesh and truth.json of `source` (three paths) to `target`, moved."""
    pose = POSES[pose_name]
    write_points(target[0], moved_points(read_points(source[0]), pose))
    with open(source[1], encoding="utf-8") as off, open(source[2], encoding="utf-8") as truth:
        texts = moved_off(off.read(), pose), json.dumps(moved_truth(json.load(truth), pose), indent=1)
    for path, text in zip(target[1:], texts):
        with open(path + ".new", "w", encoding="utf-8") as out:
            out.write(text)
        os.replace(path + ".new", path)
