#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Real scans without truth: the model is valid, and has the storeys, heights and sizes that anyone sees in the points."""
import os
import sys
import tempfile
import unittest

import pipeline

# storeys that must be there and bounds of the volume [m3]
SCANS = {
    "indoor_office_2storey": {"storeys": 2, "volume": (900, 3200)},
    "tls_office_floor_a": {"storeys": 1, "volume": (500, 1200)},
    # the lab has 145 m3; the space behind its glass wall was scanned, too, floor, ceiling and walls
    "pcl_lab_two_scans": {"storeys": 1, "volume": (130, 330)},
    "small_room_normals": {"storeys": 1, "volume": (7, 11)},
}


class RealScans(unittest.TestCase):
    def test_every_scan_gives_a_valid_and_plausible_model(self):
        for name, expected in SCANS.items():
            with self.subTest(scan=name), tempfile.TemporaryDirectory() as work:
                pipeline.make("run", os.path.join(pipeline.REAL, name + ".ply"), work)
                mesh = pipeline.model_check(work)
                print(f"{name}: {mesh['triangles']} triangles, {mesh['volume_m3']:.1f} m3")
                self.assertTrue(mesh["valid"], mesh)
                self.assertGreater(mesh["volume_m3"], expected["volume"][0])
                self.assertLess(mesh["volume_m3"], expected["volume"][1])
                self.assertGreaterEqual(len(pipeline.summary(work)["storeys"]), expected["storeys"])


if __name__ == "__main__":
    if not os.path.isdir(pipeline.REAL):
        print("skipped: no ../shared/data")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
