#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One building gives one model in whatever format, frame, unit and lean it comes: the same rooms, every corner within a millimetre.
Forms that E57, LAS and LAZ need are written in the environment that `make deps` makes (BUILD/python); without it they are skipped."""
import json
import math
import os
import random
import struct
import sys
import tempfile
import unittest

import pipeline

PYTHON = os.path.join(pipeline.BUILD, "python", "bin", "python3")
HAS_DECODERS = os.path.exists(PYTHON)
if HAS_DECODERS and os.path.realpath(sys.prefix) != os.path.realpath(os.path.join(pipeline.BUILD, "python")):
    os.execv(PYTHON, [PYTHON, *sys.argv])
if HAS_DECODERS:
    import formats_test  # it writes E57 and LAS
    import numpy  # only there in the environment

TOLERANCE_M = 0.001
UTM = (691234.567, 5334567.891, 512.345)
STATIONS = ((6.0, 6.9, 1.5), (2.0, 2.5, 1.6))
LEAN = math.radians(0.8)


class Form:
    """Where a scan stands: leaning by `lean` about a level axis, moved by `shift`, in `unit` per metre, in another order of points."""
    def __init__(self, shift=(0, 0, 0), lean=0.0, per_metre=1, shuffled=False):
        self.shift, self.per_metre, self.shuffled = shift, per_metre, shuffled
        c, s, u, v = math.cos(lean), math.sin(lean), 0.6, 0.8  # the axis
        self.turn = ((c + u * u * (1 - c), u * v * (1 - c), v * s), (u * v * (1 - c), c + v * v * (1 - c), -u * s), (-v * s, u * s, c))

    def place(self, points):
        a, b, c = self.turn
        x, y, z = self.shift
        k = self.per_metre
        moved = [(k * (a[0] * p + a[1] * q + a[2] * r + x), k * (b[0] * p + b[1] * q + b[2] * r + y), k * (c[0] * p + c[1] * q + c[2] * r + z))
                 for p, q, r in points]
        if self.shuffled:
            random.Random(1).shuffle(moved)
        return moved

    def back(self, points):
        """Metres of the model to those of the building."""
        a, b, c = self.turn
        for x, y, z in points:
            p, q, r = x - self.shift[0], y - self.shift[1], z - self.shift[2]
            yield a[0] * p + b[0] * q + c[0] * r, a[1] * p + b[1] * q + c[1] * r, a[2] * p + b[2] * q + c[2] * r


def write(path, content):
    with open(path, "wb") as out:
        out.write(content)


def ply(path, points, stations=()):
    comments = "".join("comment station %.6f %.6f %.6f\n" % station for station in stations)
    head = f"ply\nformat binary_little_endian 1.0\n{comments}element vertex {len(points)}\n"
    head += "property double x\nproperty double y\nproperty double z\nend_header\n"
    write(path, head.encode() + b"".join(struct.pack("<3d", *point) for point in points))


def pts(path, points, digits=4):
    line = f"%.{digits}f %.{digits}f %.{digits}f"
    write(path, f"{len(points)}\n".encode() + "\n".join(line % point for point in points).encode())


def pcd(path, points):
    n = len(points)
    head = f"VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {n}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {n}\nDATA binary\n"
    write(path, head.encode() + b"".join(struct.pack("<3d", *point) for point in points))


def halves(points):
    return points[:len(points) // 3], points[len(points) // 3:]


def ptx(path, points, stations):
    """One scan for each station, turned about z."""
    text = []
    for scan, (x, y, z), angle in zip(halves(points), stations, (0.7, -2.1)):
        c, s = math.cos(angle), math.sin(angle)
        text.append(f"{len(scan)}\n1\n{x:.4f} {y:.4f} {z:.4f}\n1 0 0\n0 1 0\n0 0 1\n{c:.15f} {s:.15f} 0 0\n{-s:.15f} {c:.15f} 0 0\n0 0 1 0\n"
                    f"{x:.4f} {y:.4f} {z:.4f} 1\n")
        text += [f"{c * (p - x) + s * (q - y):.5f} {c * (q - y) - s * (p - x):.5f} {r - z:.5f}\n" for p, q, r in scan]
    write(path, "".join(text).encode())


def e57(path, points, stations, **how):
    scans = []
    for scan, station, angle in zip(halves(points), stations, (0.7, -2.1)):
        rotation = formats_test.turn(angle, (0, 0, 1))
        local = formats_test.rotate(rotation * (1, -1, -1, -1), numpy.array(scan) - station)
        scans.append({"points": local, "rotation": rotation, "translation": station, **how})
    formats_test.write_e57(path, scans)


def las(path, points, offset=(0, 0, 0)):
    formats_test.write_las(path, numpy.array(points), scale=0.001, offset=offset)


def vertices_of(path):
    with open(path, "rb") as file:
        content = file.read()
    head = content.index(b"end_header\n") + len(b"end_header\n")
    count = int(content[:head].split(b"element vertex ")[1].split()[0])
    return [struct.unpack_from("<3d", content, head + 24 * i) for i in range(count)]


def farthest(points, others):
    """The largest distance of a point from the nearest of the others."""
    return max(min(math.dist(point, other) for other in others) for point in points)


class Frames(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        with open(os.path.join(pipeline.SCENES, "corridor_rooms.json"), encoding="utf-8") as text:
            scene = json.load(text)
        scene["sampling"] = {"points": 250000}
        path = os.path.join(self.folder, "scene.json")
        with open(path, "w", encoding="utf-8") as out:
            json.dump(scene, out)
        scan = os.path.join(self.folder, "scene.ply")
        pipeline.stage("synthesize", "--scene", path, "--scan-out", scan, "--truth-out", path + ".off", "--truth-json", path + ".truth")
        with open(scan, "rb") as file:
            content = file.read()
        self.points = list(struct.iter_unpack("<3f", content[content.index(b"end_header\n") + len(b"end_header\n"):]))

    def model(self, name, form, writer, *variables, stations=(), **how):
        """Corners in the building's own coordinates, rooms of each storey, volume, stations."""
        path, work = os.path.join(self.folder, name), os.path.join(self.folder, name + ".work")
        points = form.place(self.points)
        if stations:
            writer(path, points, form.place(stations), **how)
        else:
            writer(path, points, **how)
        pipeline.make("extract", path, work, "QUIET=1", *variables)
        os.remove(path)
        summary = pipeline.summary(work)
        with open(os.path.join(work, "logs", "ingest.json"), encoding="utf-8") as text:
            counts = {count["what"]: count["value"] for count in json.load(text)["counts"]}
        return (list(form.back(vertices_of(os.path.join(work, "model.ply")))), [storey["rooms"] for storey in summary["storeys"]],
                summary["totals"]["volume_m3"], counts["stations"])

    def expect_same(self, wanted, name, *form, **how):
        with self.subTest(form=name):
            got = self.model(name, *form, **how)
            self.assertEqual(got[1], wanted[1], "rooms")
            self.assertEqual(got[3], wanted[3], "stations")
            self.assertAlmostEqual(got[2], wanted[2], delta=1e-4 * wanted[2])
            self.assertLess(max(farthest(got[0], wanted[0]), farthest(wanted[0], got[0])), TOLERANCE_M)

    def test_forms_without_scanner_positions_give_one_model(self):
        wanted = self.model("local.ply", Form(), ply)
        self.assertEqual(wanted[1], [9])
        self.expect_same(wanted, "shuffled.pcd", Form(UTM, shuffled=True), pcd)
        self.expect_same(wanted, "millimetres.pts", Form(per_metre=1000), pts, "UNIT=mm", digits=1)
        self.expect_same(wanted, "leaning.ply", Form(UTM, LEAN), ply)
        if not HAS_DECODERS:
            print("skipped: LAS and LAZ, no Python environment (make deps)")
            return
        self.expect_same(wanted, "utm.las", Form(UTM), las, offset=(691000, 5334000, 0))
        self.expect_same(wanted, "leaning.laz", Form((0, 0, 0), LEAN), las)

    def test_forms_with_scanner_positions_give_one_model(self):
        wanted = self.model("stations.ply", Form(), ply, stations=STATIONS)
        self.assertEqual(wanted[1], [9])
        self.assertEqual(wanted[3], len(STATIONS))
        self.expect_same(wanted, "utm.ptx", Form(UTM), ptx, stations=STATIONS)
        if not HAS_DECODERS:
            print("skipped: E57, no Python environment (make deps)")
            return
        self.expect_same(wanted, "cartesian.e57", Form(UTM, LEAN), e57, stations=STATIONS)
        self.expect_same(wanted, "spherical.e57", Form(), e57, stations=STATIONS, spherical=True)
        self.expect_same(wanted, "scaled.e57", Form(UTM), e57, stations=STATIONS, scaled=1e-3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
