#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The shipped scenes, reconstructed with default parameters and judged against their exact truth."""
import sys
import tempfile
import unittest

import pipeline

# IoU and, where the scene promises them, walls within 1 degree and 2 cm and the symmetric Hausdorff distance in % of the
# diagonal. A closed door alone is 0.45 m, so only scenes without doors have a bound on the latter.
SCENES = {
    "one_room": {"iou": 0.99, "walls": 0.98, "hausdorff": 0.05},
    "l_shape": {"iou": 0.99, "walls": 0.98},
    "corridor_rooms": {"iou": 0.99, "walls": 0.98},
    "curved_wall": {"iou": 0.99},
    "paper_two_storeys": {"iou": 0.99, "walls": 0.98},
    "paper_two_storeys_no_doors": {"iou": 0.99, "walls": 0.98, "hausdorff": 0.05},
    "thin_walls_clutter": {"iou": 0.99},
}


class Scenes(unittest.TestCase):
    def test_every_scene_reaches_its_bars(self):
        for name, bars in SCENES.items():
            with self.subTest(scene=name), tempfile.TemporaryDirectory() as folder:
                scan, truth, truth_json = pipeline.synthesize(name, folder)
                pipeline.make("run", scan, folder)
                score = pipeline.scores(folder, truth, truth_json)
                mesh, rooms = score["mesh"], score["rooms"]
                figures = (f"{name}: IoU {score['volume']['iou']:.4f}, walls {score['walls_within_1deg_2cm']:.4f}, "
                           f"Hausdorff {score['distance']['symmetric']['hausdorff_pct']:.4f} %, "
                           f"rooms {rooms['found']} of {rooms['truth']}")
                print(figures)
                self.assertTrue(mesh["watertight"] and mesh["manifold"] and mesh["oriented"], figures)
                self.assertEqual(mesh["self_intersections"], 0, figures)
                self.assertGreaterEqual(score["volume"]["iou"], bars["iou"], figures)
                self.assertEqual(rooms["found"], rooms["truth"], figures)
                if "walls" in bars:
                    self.assertGreaterEqual(score["walls_within_1deg_2cm"], bars["walls"], figures)
                if "hausdorff" in bars:
                    self.assertLessEqual(score["distance"]["symmetric"]["hausdorff_pct"], bars["hausdorff"], figures)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
