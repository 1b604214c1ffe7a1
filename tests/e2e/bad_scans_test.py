#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scans that are none: each has its own documented error and exit code, quickly, and leaves nothing behind."""
import math
import os
import random
import struct
import sys
import tempfile
import time
import unittest

import pipeline

HEADER = "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nend_header\n"


def ply(points, claimed=None):
    count = len(points) if claimed is None else claimed
    return HEADER.format(count).encode() + b"".join(struct.pack("<3f", *p) for p in points)


def floor_points(z=0.0, count=40000):
    draw = random.Random(1)
    return [(draw.uniform(0, 5), draw.uniform(0, 4), z + draw.gauss(0, 0.003)) for _ in range(count)]


# name: (file content or None, codes that may be given, exit code)
CASES = {
    "empty": (b"", {"C03"}, 3),
    "header_only": (ply([]), {"C06"}, 3),
    "truncated": (ply(floor_points(count=1000))[:-500], {"C05"}, 3),
    "claims_4e9": (ply(floor_points(count=1000), 4_000_000_000), {"C05"}, 3),
    "promises_less": (ply(floor_points(count=1000), 500), {"C05"}, 3),
    "float32_utm": (ply([(x + 500_000, y + 5_500_000, z) for x, y, z in floor_points()]), {"C10"}, 3),
    "all_nan": (ply([(math.nan,) * 3] * 1000), {"C06"}, 3),
    "one_point": (ply([(1.0, 2.0, 3.0)]), {"C07"}, 3),
    "one_plane": (ply(floor_points()), {"N01", "N02"}, 4),
    "no_vertical": (ply(floor_points() + floor_points(2.5)), {"N02"}, 4),
    "one_line": (b" ".join(b"%.3f" % value for point in floor_points(count=1000) for value in point), {"C04"}, 3),
    "prose": (b"Dear surveyor,\nplease find the points attached.\nRegards\n", {"C04"}, 3),
}


class BadScans(unittest.TestCase):
    def judge(self, path, codes, exit_code):
        """Runs the stages until one gives up, and checks code, exit code, time and what is left."""
        with tempfile.TemporaryDirectory() as work:
            begun = time.monotonic()
            done = pipeline.stage("ingest", "--scan", path, "--work", work, check=False)
            if done.returncode == 0:
                self.assertTrue(any(code.startswith("N") for code in codes), f"ingest accepted {path}")
                done = pipeline.stage("slice", "--work", work, check=False)
                self.assertFalse(os.path.exists(os.path.join(work, "20_slice", "slices.h5")))
            else:
                self.assertFalse(os.path.exists(os.path.join(work, "10_ingest", "cloud.h5")))
            taken = time.monotonic() - begun
            self.assertEqual(done.returncode, exit_code, done.stderr)
            self.assertTrue(any(f"error[{code}]" in done.stderr for code in codes), done.stderr)
            self.assertIn("hint:", done.stderr)
            self.assertLess(taken, 2.0)
            left = [name for _, _, names in os.walk(work) for name in names if name.endswith(".tmp")]
            self.assertEqual(left, [])

    def test_files_that_are_no_scan(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, (content, codes, exit_code) in CASES.items():
                with self.subTest(case=name):
                    path = os.path.join(folder, name + (".xyz" if name in ("prose", "one_line") else ".ply"))
                    with open(path, "wb") as out:
                        out.write(content)
                    self.judge(path, codes, exit_code)

    def test_a_directory_and_a_missing_file(self):
        with tempfile.TemporaryDirectory() as folder:
            self.judge(folder, {"C01"}, 3)
            self.judge(os.path.join(folder, "nowhere.ply"), {"C01"}, 3)

    def test_an_unreadable_file(self):
        nobody = {"user": 65534} if os.geteuid() == 0 else {}  # root reads everything
        ingest = os.path.join(pipeline.BUILD, "bin", "ingest")
        try:
            pipeline.run([ingest, "--version"], **nobody)
        except PermissionError:
            self.skipTest("the build folder is closed to other users")
        with tempfile.TemporaryDirectory() as folder:
            os.chmod(folder, 0o777)
            scan = os.path.join(folder, "scan.ply")
            with open(scan, "wb") as out:
                out.write(ply(floor_points(count=1000)))
            os.chmod(scan, 0)
            done = pipeline.stage("ingest", "--scan", scan, "--work", os.path.join(folder, "work"), check=False, **nobody)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("error[C02]", done.stderr)
            self.assertIn("hint:", done.stderr)
            self.assertFalse(os.path.exists(os.path.join(folder, "work", "10_ingest", "cloud.h5")))

    def test_bad_values_inside_a_good_scan_are_dropped_and_counted(self):
        with tempfile.TemporaryDirectory() as folder:
            scan, _, _ = pipeline.synthesize("one_room", folder)
            with open(scan, "rb") as data:
                content = data.read()
            head = content.index(b"end_header\n") + len(b"end_header\n")
            stride = 12
            self.assertEqual((len(content) - head) % stride, 0)
            spoilt = bytearray(content)
            for i in range(0, 1000, 10):
                struct.pack_into("<3f", spoilt, head + i * stride, math.nan, math.inf, 0.0)
            bad = os.path.join(folder, "spoilt.ply")
            with open(bad, "wb") as out:
                out.write(spoilt)
            done = pipeline.run([os.path.join(pipeline.BUILD, "bin", "ingest"), "--scan", bad, "--work", folder])
            self.assertIn("not finite 100", (done.stdout + done.stderr).replace(",", ""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
