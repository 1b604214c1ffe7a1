#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How exact are walls and heights, and do the stated standard deviations hold? The whole pipeline with default parameters on
random buildings of every family, against their exact truth.

  walls.py [--build DIR] [--work DIR] [--json FILE] [--seeds N] [--only NAME …] [--keep]

Per row (sampling, noise): refined wall lines, their offset error at the middle in units of sigma_offset_m (share within the 68 %
and the 95 % interval), the same of the angle, bias and rms of wall thickness in the model, and of floors and ceilings at the middle
of the rooms (levels have no stated deviation).
"""
import argparse
import json
import math
import os
import statistics
import struct
import subprocess
import sys
import tempfile

SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
FAMILIES = ("office", "oblique", "multi_storey", "house", "thin", "curved")
# name: sampling, noise [m], points, more of the scene
ROWS = {
    "uniform_3mm": ("uniform", 0.003, 300000, {}),
    "tripod_3mm": ("tripod", 0.003, 300000, {}),
    "uniform_1cm": ("uniform", 0.010, 300000, {}),
    "tripod_1cm": ("tripod", 0.010, 300000, {}),
    "uniform_2cm": ("uniform", 0.020, 300000, {}),
    "tripod_2cm": ("tripod", 0.020, 300000, {}),
    "furnished_3mm": ("tripod", 0.003, 300000, {"clutter_per_m2": 0.15, "outliers": 0.005, "holes": 0.05}),
}
SAME_PLANE = 1e-4  # m: pieces of one wall
NEAR = 0.05  # m: what a line may stand for
DOUBLED = 0.015  # m: true planes nearer than this to each other are hardly told apart
PARALLEL = math.radians(1.5)
WORTH = 0.1  # a plane counts when it has this share of the truth beside a line


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")


def make_scene(folder, build, family, seed, row):
    sampling, noise, points, more = ROWS[row]
    scene = {"name": f"{family} {seed}", "seed": seed, "noise_m": noise, "sampling": {"kind": sampling, "points": points},
             "random": {"family": family, "seed": seed}, **more}
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "scene.json")
    if os.path.exists(os.path.join(folder, "truth.json")):
        return  # kept from an earlier run
    with open(path, "w", encoding="utf-8") as out:
        json.dump(scene, out)
    run([os.path.join(build, "bin", "synthesize"), "-q", "--scene", path, "--work", folder])


def read_off(path):
    with open(path, encoding="utf-8") as text:
        numbers = iter(text.read().split("OFF", 1)[1].split())
    points, faces, _ = (int(next(numbers)) for _ in range(3))
    vertex = [tuple(float(next(numbers)) for _ in range(3)) for _ in range(points)]
    return vertex, [[int(next(numbers)) for _ in range(int(next(numbers)))] for _ in range(faces)]


def read_model(path):
    """model.ply: vertices, and triangles as (corners, kind)."""
    with open(path, "rb") as file:
        header, size = [], {}
        while not header or header[-1] != "end_header":
            header.append(file.readline().decode().strip())
            words = header[-1].split()
            if words[0] == "element":
                size[words[1]] = int(words[2])
        vertex = [struct.unpack("<3d", file.read(24)) for _ in range(size["vertex"])]
        types = {"uchar": "B", "uint8": "B", "int": "i", "int32": "i", "uint": "I", "uint32": "I", "ushort": "H", "uint16": "H",
             "short": "h", "int16": "h"}
        faces = header[header.index(next(line for line in header if line.startswith("element face"))) + 1:]
        properties = [line.split() for line in faces if line.startswith("property")]
        one = "<"
        for words in properties:
            one += types[words[2]] + "3" + types[words[3]] if words[1] == "list" else types[words[1]]
        kind = 4 + [words[-1] for words in properties[1:]].index("kind")
        rows = struct.iter_unpack(one, file.read(struct.calcsize(one) * size["face"]))
        return vertex, [(row[1:4], row[kind]) for row in rows]


class TruthPiece:
    """A piece of an upright truth face: n·p = d with n out of the room into the wall, its extent along (-n.y, n.x), its area."""

    def __init__(self, corners):
        (x0, y0, _), (x1, y1, _) = max(((a, b) for a in corners for b in corners),
                                       key=lambda ab: math.hypot(ab[0][0] - ab[1][0], ab[0][1] - ab[1][1]))
        area = [0.0, 0.0, 0.0]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            area[0] += (a[1] * b[2] - a[2] * b[1]) / 2
            area[1] += (a[2] * b[0] - a[0] * b[2]) / 2
            area[2] += (a[0] * b[1] - a[1] * b[0]) / 2
        self.area = math.hypot(*area)
        length = math.hypot(x1 - x0, y1 - y0)
        self.upright = self.area > 1e-9 and abs(area[2]) < 1e-6 * self.area and length > 1e-6
        if self.upright:
            self.n = ((y1 - y0) / length, (x0 - x1) / length)
            if self.n[0] * area[0] + self.n[1] * area[1] < 0:
                self.n = (-self.n[0], -self.n[1])
            self.d = self.n[0] * x0 + self.n[1] * y0
            along = [c[1] * self.n[0] - c[0] * self.n[1] for c in corners]
            self.t0, self.t1 = min(along), max(along)


def truth_pieces(path):
    vertex, faces = read_off(path)
    pieces = [TruthPiece([vertex[i] for i in face]) for face in faces]
    return [piece for piece in pieces if piece.upright]


class RefinedLine:
    def __init__(self, feature):
        self.a, self.b = (ax, ay), (bx, by) = [tuple(point) for point in feature["geometry"]["coordinates"]]
        self.length = math.hypot(bx - ax, by - ay)
        self.u = ((bx - ax) / self.length, (by - ay) / self.length)
        self.n = (self.u[1], -self.u[0])
        self.middle = ((self.a[0] + self.b[0]) / 2, (self.a[1] + self.b[1]) / 2)
        properties = feature["properties"]
        self.id, self.source = properties["wall_id"], properties["source"]
        self.sigma, self.sigma_angle = properties["sigma_offset_m"], math.radians(properties["sigma_angle_deg"])

    def beside(self, pieces):
        """(offset of the piece's plane at the line's middle, area beside the line, turn, +1 when its wall is on the normal's side)."""
        found = []
        for p in pieces:
            cosine = self.n[0] * p.n[0] + self.n[1] * p.n[1]
            turn = self.u[0] * p.n[0] + self.u[1] * p.n[1]  # sine of the angle between line and plane
            if abs(turn) > PARALLEL:
                continue
            side = 1 if cosine > 0 else -1
            offset = side * (p.d - p.n[0] * self.middle[0] - p.n[1] * self.middle[1])
            ends = [p.n[0] * e[1] - p.n[1] * e[0] for e in (self.a, self.b)]
            overlap = min(max(ends), p.t1) - max(min(ends), p.t0)
            if abs(offset) < NEAR and overlap > 0:
                found.append((offset, p.area * overlap / max(1e-9, p.t1 - p.t0), side * turn, side))
        return found


def compare_line(line, pieces):
    """The line against the truth beside it. None: there is none."""
    found = line.beside(pieces)
    if not found:
        return None
    groups = {}
    for offset, area, turn, side in found:
        key = next((k for k in groups if abs(k - offset) < SAME_PLANE), offset)
        groups.setdefault(key, []).append((area, turn, side))
    areas = {k: sum(area for area, _, _ in group) for k, group in groups.items()}
    planes = [k for k in areas if areas[k] >= WORTH * sum(areas.values())]
    best = min(planes, key=abs)
    _, turn, side = max(groups[best])
    return {"id": line.id, "length": line.length, "refined": line.source == "refined",
            "doubled": any(0 < abs(k - best) < DOUBLED for k in planes),
            "error": -best, "into_wall": -best * side, "turn": turn, "sigma": line.sigma, "sigma_angle": line.sigma_angle}


def slice_walls(vertex, faces, z):
    """Segments in plan where the model's walls meet the height z."""
    segments = []
    for corners, kind in faces:
        if kind != 2:
            continue
        p = [vertex[i] for i in corners]
        cut = []
        for a, b in zip(p, p[1:] + p[:1]):
            if (a[2] > z) != (b[2] > z):
                s = (z - a[2]) / (b[2] - a[2])
                cut.append((a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])))
        if len(cut) == 2:
            segments.append(cut)
    return segments


def thickness(wall, segments):
    """Of the model's wall at the middle line of a true wall: median of nine places where both faces are; None without."""
    (ax, ay), (bx, by) = wall["a"], wall["b"]
    length = math.hypot(bx - ax, by - ay)
    u = ((bx - ax) / length, (by - ay) / length)
    half = wall["thickness"] / 2
    measured = []
    for k in range(1, 10):
        x, y = ax + u[0] * length * k / 10, ay + u[1] * length * k / 10
        crossings = []
        for (px, py), (qx, qy) in segments:
            p, q = (px - x) * u[0] + (py - y) * u[1], (qx - x) * u[0] + (qy - y) * u[1]
            if (p > 0) != (q > 0):
                s = p / (p - q)
                e = (px + s * (qx - px) - x) * -u[1] + (py + s * (qy - py) - y) * u[0]
                if abs(e) < half + NEAR:
                    crossings.append(e)
        if len(crossings) == 2 and crossings[0] * crossings[1] < 0:
            measured.append(abs(crossings[0] - crossings[1]))
    return statistics.median(measured) if measured else None


def heights_at(vertex, faces, x, y):
    """Heights of the model's floors and ceilings at a place: (z, kind)."""
    found = []
    for corners, kind in faces:
        if kind == 2:
            continue
        p = [vertex[i] for i in corners]
        turns = [(b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) for a, b in zip(p, p[1:] + p[:1])]
        if all(t >= 0 for t in turns) or all(t <= 0 for t in turns):
            found.append((p[0][2], kind))
    return found


def inside(polygon, x, y):
    turns = 0
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            turns += 1
    return turns % 2 == 1


def compare_heights(truth, vertex, faces):
    """Errors of floors and ceilings, each the median of the places around a room's middle where it is (a stairwell may not be)."""
    errors, missing = [], 0
    for room in truth["rooms"]:
        x, y = room["center"][:2]
        for z, kind in ((room["floor"], 0), (room["ceiling"], 1)):
            found = []
            for dx, dy in ((0, 0), (1.3, 0), (-1.3, 0), (0, 1.3), (0, -1.3), (2.1, 2.1), (-2.1, 2.1), (2.1, -2.1), (-2.1, -2.1)):
                if inside(room["polygon"], x + dx, y + dy):
                    near = [h - z for h, what in heights_at(vertex, faces, x + dx, y + dy) if what == kind and abs(h - z) < 0.1]
                    found += [min(near, key=abs)] if near else []
            if found:
                errors.append(statistics.median(found))
            else:
                missing += 1
    return errors, missing


def measure(folder, build, family, seed, row):
    make_scene(folder, build, family, seed, row)
    work = os.path.join(folder, "work")
    run(["make", "--no-print-directory", "-C", SOURCE, "extract", f"SCAN={folder}/scan.ply", f"WORK={work}", f"BUILD={build}", "QUIET=1",
         "JOBS=1"])
    with open(os.path.join(folder, "truth.json"), encoding="utf-8") as text:
        truth = json.load(text)
    with open(os.path.join(work, "80_refine_lines", "wall_lines.geojson"), encoding="utf-8") as text:
        lines = json.load(text)
    pieces = truth_pieces(os.path.join(folder, "truth.off"))
    found = [compare_line(RefinedLine(feature), pieces) for feature in lines["features"]]
    vertex, faces = read_model(os.path.join(work, "model.ply"))
    walls = []
    slices = {}
    for wall in truth["walls"]:
        z = (wall["z0"] + wall["z1"]) / 2
        if z not in slices:
            slices[z] = slice_walls(vertex, faces, z)
        walls.append({"truth": wall["thickness"], "model": thickness(wall, slices[z])})
    errors, missing = compare_heights(truth, vertex, faces)
    return {"scene": f"{family}_{seed}", "lines": [line for line in found if line], "spurious": sum(not line for line in found),
            "walls": walls, "heights": errors, "heights_missing": missing}


def rms(values):
    return math.sqrt(statistics.fmean(v * v for v in values)) if values else 0


def share(values, limit):
    return 100 * sum(abs(v) <= limit for v in values) / len(values) if values else 0


def summarise(scenes):
    lines = [line for scene in scenes for line in scene["lines"]]
    clean = [line for line in lines if line["refined"] and not line["doubled"]]
    offsets = [line["error"] / line["sigma"] for line in clean if line["sigma"] > 0]
    angles = [line["turn"] / line["sigma_angle"] for line in clean if line["sigma_angle"] > 0]
    walls = [wall for scene in scenes for wall in scene["walls"]]
    thick = [wall["model"] - wall["truth"] for wall in walls if wall["model"] is not None]
    heights = [error for scene in scenes for error in scene["heights"]]
    return {
        "lines": len(clean), "lines_doubled": sum(line["doubled"] for line in lines),
        "lines_not_refined": sum(not line["refined"] for line in lines), "lines_spurious": sum(s["spurious"] for s in scenes),
        "offset_bias_mm": 1e3 * statistics.fmean(line["into_wall"] for line in clean),
        "offset_rms_mm": 1e3 * rms([line["error"] for line in clean]),
        "offset_within_68": share(offsets, 0.994), "offset_within_95": share(offsets, 1.96),
        "angle_rms_deg": math.degrees(rms([line["turn"] for line in clean])),
        "angle_within_68": share(angles, 0.994), "angle_within_95": share(angles, 1.96),
        "walls": len(thick), "walls_missing": len(walls) - len(thick),
        "thickness_bias_mm": 1e3 * statistics.fmean(thick), "thickness_rms_mm": 1e3 * rms(thick),
        "thickness_median_abs_mm": 1e3 * statistics.median(abs(t) for t in thick),
        "heights": len(heights), "heights_missing": sum(s["heights_missing"] for s in scenes),
        "height_bias_mm": 1e3 * statistics.fmean(heights), "height_rms_mm": 1e3 * rms(heights),
        "height_worst_mm": 1e3 * max(map(abs, heights)),
    }


COLUMNS = (("lines", "lines", "{:.0f}"), ("doubled", "lines_doubled", "{:.0f}"), ("bias mm", "offset_bias_mm", "{:.2f}"),
           ("rms mm", "offset_rms_mm", "{:.2f}"), ("68 %", "offset_within_68", "{:.1f}"), ("95 %", "offset_within_95", "{:.1f}"),
           ("angle 68", "angle_within_68", "{:.1f}"), ("95", "angle_within_95", "{:.1f}"), ("walls", "walls", "{:.0f}"),
           ("lost", "walls_missing", "{:.0f}"), ("thick: bias", "thickness_bias_mm", "{:.2f}"), ("rms", "thickness_rms_mm", "{:.2f}"),
           ("heights", "heights", "{:.0f}"), ("lost", "heights_missing", "{:.0f}"), ("bias", "height_bias_mm", "{:.2f}"),
           ("rms", "height_rms_mm", "{:.2f}"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(SOURCE, "build"))
    parser.add_argument("--work", help="folder for scans and results; default: a temporary one")
    parser.add_argument("--json", help="all figures, down to the line")
    parser.add_argument("--seeds", type=int, default=2, help="buildings per family")
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=list(FAMILIES))
    parser.add_argument("--only", nargs="+", choices=ROWS, default=list(ROWS))
    parser.add_argument("--keep", action="store_true", help="keep every scene's folder")
    options = parser.parse_args()
    result = {}
    print(" | ".join(["scan"] + [name for name, _, _ in COLUMNS]))
    with tempfile.TemporaryDirectory() as temporary:
        for row in options.only:
            scenes = []
            for family in options.families:
                for seed in range(1, options.seeds + 1):
                    folder = os.path.join(os.path.abspath(options.work or temporary), row, f"{family}_{seed}")
                    scenes.append(measure(folder, os.path.abspath(options.build), family, seed, row))
                    if not options.keep:
                        subprocess.run(["rm", "-rf", folder], check=True)
            result[row] = {"summary": summarise(scenes), "scenes": scenes}
            print(" | ".join([row] + [form.format(result[row]["summary"][key]) for _, key, form in COLUMNS]), flush=True)
            if options.json:
                with open(options.json, "w", encoding="utf-8") as out:
                    json.dump(result, out, indent=1)


if __name__ == "__main__":
    sys.exit(main())
