#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""stages/presets/paper_2013.yaml: the method as published, from a scan to a closed model."""
import os
import tempfile
import unittest

import pipeline

PRESET = os.path.join(pipeline.SOURCE, "stages", "presets", "paper_2013.yaml")


def content(path):
    with open(path, "rb") as file:
        return file.read()


class Preset(unittest.TestCase):
    def test_the_paper_makes_a_closed_model_in_one_pass_without_openings(self):
        with tempfile.TemporaryDirectory() as folder:
            scan, truth, truth_json = pipeline.synthesize("l_shape", folder)
            pipeline.make("run", scan, folder, f"CONFIG={PRESET}")
            score = pipeline.scores(folder, truth, truth_json)
            figures = f"IoU {score['volume']['iou']:.4f}, rooms {score['rooms']['found']} of {score['rooms']['truth']}"
            print(figures)
            mesh = score["mesh"]
            self.assertTrue(mesh["watertight"] and mesh["manifold"] and mesh["oriented"])
            self.assertEqual(mesh["self_intersections"], 0)
            self.assertGreater(score["volume"]["iou"], 0.9, figures)
            self.assertEqual(score["rooms"]["found"], score["rooms"]["truth"], figures)
            self.assertEqual(pipeline.summary(folder)["openings"], [])
            first, second = (os.path.join(folder, name) for name in ("70_graphcut/labels.h5", "90_final/labels.h5"))
            pipeline.run(["h5diff", first, second, "/cell/label"])

    def test_nothing_of_it_is_left_when_it_is_taken_back(self):
        with tempfile.TemporaryDirectory() as folder:
            scan = pipeline.synthesize("one_room", folder)[0]
            model = os.path.join(folder, "model.ply")
            pipeline.make("extract", scan, folder)
            default = content(model)
            pipeline.make("extract", scan, folder, f"CONFIG={PRESET}")
            self.assertNotEqual(content(model), default)
            pipeline.make("extract", scan, folder, "CONFIG=none")
            self.assertEqual(content(model), default)


if __name__ == "__main__":
    unittest.main(argv=["preset_test.py"], verbosity=2)
