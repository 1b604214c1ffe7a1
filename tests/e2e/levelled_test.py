#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan that leans is levelled by its floors: the model is that of the level scan, turned as the scan is."""
import math
import os
import re
import struct
import sys
import tempfile
import unittest

import pipeline

LEAN = math.radians(1.7)


def turned(x, y, z, angle):
    """About the x axis."""
    return x, math.cos(angle) * y - math.sin(angle) * z, math.sin(angle) * y + math.cos(angle) * z


def rewrite(source, target, change):
    """A PLY of float points with each of them changed."""
    with open(source, "rb") as file:
        content = file.read()
    head = content.index(b"end_header\n") + len(b"end_header\n")
    points = struct.iter_unpack("<3f", content[head:])
    with open(target, "wb") as out:
        out.write(content[:head] + b"".join(struct.pack("<3f", *change(*point)) for point in points))


def model_box(path, change=lambda x, y, z: (x, y, z)):
    """Box of the vertices of a model.ply (x, y, z as doubles)."""
    with open(path, "rb") as file:
        content = file.read()
    head = content.index(b"end_header\n") + len(b"end_header\n")
    count = int(content[:head].split(b"element vertex ")[1].split()[0])
    points = [change(*struct.unpack_from("<3d", content, head + 24 * i)) for i in range(count)]
    return [limit(point[axis] for point in points) for axis in range(3) for limit in (min, max)]


def stated_angle(text, words):
    return float(re.search(words + r" (\d+\.\d+) degrees", text).group(1))


class Levelled(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.scan, _, _ = pipeline.synthesize("one_room", self.folder)
        self.leaning = os.path.join(self.folder, "leaning.ply")
        rewrite(self.scan, self.leaning, lambda x, y, z: turned(x, y, z, LEAN))

    def test_the_model_of_a_leaning_scan_is_that_of_the_level_one_turned_with_the_scan(self):
        works = [os.path.join(self.folder, name) for name in ("level", "leaning")]
        pipeline.make("extract", self.scan, works[0])
        pipeline.make("extract", self.leaning, works[1])
        level = model_box(os.path.join(works[0], "model.ply"))
        back = model_box(os.path.join(works[1], "model.ply"), lambda x, y, z: turned(x, y, z, -LEAN))
        as_it_is = model_box(os.path.join(works[1], "model.ply"))
        for wanted, got in zip(level, back):
            self.assertAlmostEqual(wanted, got, delta=0.003)
        self.assertGreater(max(abs(a - b) for a, b in zip(level, as_it_is)), 0.05, "it leans as the scan does")
        volumes = [pipeline.summary(work)["totals"]["volume_m3"] for work in works]
        self.assertAlmostEqual(volumes[0], volumes[1], delta=0.002 * volumes[0])
        self.assertIn("level", pipeline.summary(works[1])["frame"])
        self.assertNotIn("level", pipeline.summary(works[0])["frame"])

    def test_it_is_said_and_can_be_switched_off(self):
        def said(*options):
            done = pipeline.run([os.path.join(pipeline.BUILD, "bin", "ingest"), "--scan", self.leaning, "--work", self.folder, *options])
            return done.stderr
        self.assertAlmostEqual(stated_angle(said(), "leans by"), 1.7, delta=0.02)
        self.assertIn("not levelled", said("--level", "no"))

    def test_more_than_five_degrees_are_refused_with_the_angle(self):
        steep = os.path.join(self.folder, "steep.ply")
        rewrite(self.scan, steep, lambda x, y, z: turned(x, y, z, math.radians(6.5)))
        done = pipeline.stage("ingest", "--scan", steep, "--work", os.path.join(self.folder, "w"), check=False)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("error[C13]", done.stderr)
        self.assertAlmostEqual(stated_angle(done.stderr, "lean by"), 6.5, delta=0.05)
        self.assertIn("--level no", done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "w", "10_ingest", "cloud.h5")))
        pipeline.stage("ingest", "--scan", steep, "--work", os.path.join(self.folder, "w"), "--level", "no")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
