#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What people open lies on the scan: lines, openings, summary and layers of a scan in UTM, level or leaning, are those of the scan near
the origin, moved and turned as the scan is; lines edited there are taken; two models of one scan, one levelled, are compared."""
import json
import math
import os
import struct
import sys
import tempfile
import unittest

import pipeline

PLACE = (691234.123, 5334567.456, 512.5)
LEAN = math.radians(1.7)


def turned(point, angle):
    """About the x axis."""
    x, y, z = point
    return x, math.cos(angle) * y - math.sin(angle) * z, math.sin(angle) * y + math.cos(angle) * z


def to_site(point, angle):
    return [a + b for a, b in zip(turned(point, angle), PLACE)]


def from_site(point, angle):
    return turned([a - b for a, b in zip(point, PLACE)], -angle)


def at_the_site(source, target, angle):
    """A PLY of float points as one of doubles, turned and moved to the site."""
    with open(source, "rb") as file:
        content = file.read()
    head = content.index(b"end_header\n") + len(b"end_header\n")
    with open(target, "wb") as out:
        out.write(content[:head].replace(b"float", b"double"))
        out.write(b"".join(struct.pack("<3d", *to_site(point, angle)) for point in struct.iter_unpack("<3f", content[head:])))


def read(*names):
    with open(os.path.join(*names), encoding="utf-8") as text:
        return json.load(text)


def distance(point, line):
    (ax, ay), (bx, by) = line
    length = math.hypot(bx - ax, by - ay)
    return abs((by - ay) * (point[0] - ax) - (bx - ax) * (point[1] - ay)) / length


class Georeference(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        scan, _, cls.truth = pipeline.synthesize("one_room", cls.folder)
        cls.works, cls.scans = {}, {"home": scan}
        for name, angle in (("level", 0.0), ("leaning", LEAN)):
            cls.scans[name] = os.path.join(cls.folder, name + ".ply")
            at_the_site(scan, cls.scans[name], angle)
        for name, path in cls.scans.items():
            cls.works[name] = os.path.join(cls.folder, "work " + name)
            pipeline.make("extract", path, cls.works[name])

    def lines(self, name, angle):
        """Wall lines of a run, back at home: at the height at which the file says that its plan is."""
        file = read(self.works[name], "80_refine_lines", "wall_lines.geojson")
        height = file["roomcut"]["frame"]["origin"][2]
        return [[from_site((*point, height), angle)[:2] if name != "home" else point for point in feature["geometry"]["coordinates"]]
                for feature in file["features"]]

    def test_lines_lie_where_the_walls_of_the_scan_are(self):
        home = self.lines("home", 0)
        for name, angle in (("level", 0.0), ("leaning", LEAN)):
            with self.subTest(scan=name):
                lines = self.lines(name, angle)
                self.assertEqual(len(lines), len(home))
                for a, b in lines:
                    self.assertLess(min(max(distance(a, line), distance(b, line)) for line in home), 0.005)

    def test_the_summary_says_places_of_the_scan(self):
        home = pipeline.summary(self.works["home"])["rooms"][0]
        for name, angle in (("level", 0.0), ("leaning", LEAN)):
            room = pipeline.summary(self.works[name])["rooms"][0]
            wanted = to_site((*home["centre_m"], home["floor_z_m"]), angle)
            for a, b in zip(wanted, [*room["centre_m"], room["floor_z_m"]]):
                self.assertAlmostEqual(a, b, delta=0.005)
            self.assertAlmostEqual(room["height_m"], home["height_m"], delta=0.002)
            self.assertAlmostEqual(room["volume_m3"], home["volume_m3"], delta=0.002 * home["volume_m3"])

    def test_layers_lie_beneath_the_lines(self):
        for name in ("level", "leaning"):
            with self.subTest(scan=name):
                pipeline.make("layers", self.scans[name], self.works[name])
                with open(os.path.join(self.works[name], "edits", "slice_0.pgw"), encoding="ascii") as text:
                    a, d, b, e, x, y = [float(number) for number in text.read().split()]
                with open(os.path.join(self.works[name], "edits", "slice_0.png"), "rb") as png:
                    width, height = struct.unpack(">2I", png.read(24)[16:])
                corners = [(x + a * column + b * row, y + d * column + e * row) for column in (0, width) for row in (0, height)]
                points = [point for feature in read(self.works[name], "40_accept_lines", "wall_lines.geojson")["features"]
                          for point in feature["geometry"]["coordinates"]]
                for axis in (0, 1):
                    self.assertLess(min(corner[axis] for corner in corners), min(point[axis] for point in points))
                    self.assertGreater(max(corner[axis] for corner in corners), max(point[axis] for point in points))
                    self.assertLess(max(corner[axis] for corner in corners) - max(point[axis] for point in points), 1)

    def test_a_line_edited_in_the_scans_own_coordinates_is_taken_so_is_a_local_one_of_before(self):
        for name in ("level", "leaning"):
            with self.subTest(scan=name):
                scan, work = self.scans[name], self.works[name]
                pipeline.make("edit-lines", scan, work)
                path = os.path.join(work, "edits", "wall_lines.geojson")
                edit = read(path)
                for case in ("scan", "local"):
                    file = json.loads(json.dumps(edit))
                    first = file["features"][0]
                    (ax, ay), (bx, by) = first["geometry"]["coordinates"]
                    length = math.hypot(bx - ax, by - ay)
                    for point in first["geometry"]["coordinates"]:
                        point[0] -= 0.1 * (by - ay) / length
                        point[1] += 0.1 * (bx - ax) / length
                    if case == "local" and name == "level":
                        file["roomcut"]["schema_version"] = "1.0"
                        del file["roomcut"]["coordinates"]
                        x, y, _ = file["roomcut"]["frame"]["origin"]
                        for feature in file["features"]:
                            feature["geometry"]["coordinates"] = [[p[0] - x, p[1] - y] for p in feature["geometry"]["coordinates"]]
                    with open(path, "w", encoding="utf-8") as out:
                        json.dump(file, out)
                    said = pipeline.make("diff-lines", scan, work).stdout
                    self.assertRegex(said, rf"moved:   {first['properties']['wall_id']} moved by (100\.|99\.9)")
                    self.assertIn(f"{len(file['features']) - 1} as detected, 1 moved, 0 added, 0 deleted", said)
                pipeline.make("drop-edit", scan, work)

    def test_runs_of_one_scan_with_and_without_levelling_are_compared_in_the_same_axes(self):
        """Of a scan that leans by less than makes its floor a slope: with LEVEL=no that one is, and its walls end at other slices."""
        scan = os.path.join(self.folder, "leaning a little.ply")
        at_the_site(self.scans["home"], scan, math.radians(0.45))
        levelled, work = (os.path.join(self.folder, name) for name in ("levelled", "not levelled"))
        pipeline.make("extract", scan, levelled)
        pipeline.make("extract", scan, work, "LEVEL=no")
        with open(os.path.join(levelled, "logs", "ingest.json"), encoding="utf-8") as text:
            self.assertIn("leans by 0.4", text.read())
        out = os.path.join(self.folder, "comparison.json")
        pipeline.stage("compare", "--work", self.folder, "--a", levelled, "--b", work, "--comparison", out)
        found = read(out)
        self.assertEqual(found["lines"]["only_a"] + found["lines"]["only_b"], [])
        self.assertTrue(all(pair["offset_m"] < 0.015 for pair in found["lines"]["moved"]))
        self.assertEqual(len(found["rooms"]["both"]), len(pipeline.summary(levelled)["rooms"]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
