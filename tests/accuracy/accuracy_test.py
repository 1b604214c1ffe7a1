#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `make accuracy` itself: choice of scenes, means, differences, and a run of one scene.

usage: accuracy_test.py SOURCE_DIR BUILD_DIR
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

import jsonschema

import scenes
import table

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
NOWHERE = "/nonexistent"


def row(name, group="g", **figures):
    given = {"iou": 1.0, "recall": 1.0, "precision": 1.0, "rooms": 4, "found": 4, "missed": 0, "missed_scanned": 0, "merged": 0,
             "bound": 1.0, "lost": {"labels": 0.1}, "extra": {"labels": 0.0}, "thin_kept": 1.0, "walls": 1.0, "horizontals": 1.0, "hausdorff_pct": 0.1, "valid": True, "cpu_s": 1.0}
    return {"name": name, "group": group, "kind": "office", **given, **figures}


class Choice(unittest.TestCase):
    def setUp(self):
        self.every = scenes.all_scenes(NOWHERE)

    def names(self, only):
        return [scene["name"] for scene in scenes.choose(self.every, only)]

    def test_all_families_and_groups_have_five_seeds_and_unique_names(self):
        names = self.names("")
        self.assertEqual(len(names), 5 * len(scenes.FAMILIES) * len(scenes.GROUPS))
        self.assertEqual(len(set(names)), len(names))

    def test_groups_families_scenes_and_patterns(self):
        self.assertEqual(len(self.names("uniform")), 5 * len(scenes.FAMILIES))
        self.assertEqual(len(self.names("house")), 5 * len(scenes.GROUPS))
        self.assertEqual(self.names("tripod_thin_2"), ["tripod_thin_2"])
        self.assertEqual(self.names("random_thin_101*"), [f"random_thin_101_mu{mu}" for mu in scenes.RANDOM_MU_M])
        self.assertEqual(len(self.names("random")), 900)
        self.assertEqual(self.names("noise_*_curved_1, uniform_house_3"), ["uniform_house_3", "noise_1cm_curved_1", "noise_2cm_curved_1"])

    def test_a_word_that_names_nothing_is_an_error(self):
        with self.assertRaisesRegex(ValueError, "uniforms"):
            scenes.choose(self.every, "uniform uniforms")

    def test_groups_differ_only_in_what_they_are_named_for(self):
        uniform, noisy = (scenes.synthetic(group, "house", 1)["scene"] for group in ("uniform", "noise_2cm"))
        self.assertEqual({key for key in uniform if uniform[key] != noisy[key]}, {"name", "noise_m"})


class Means(unittest.TestCase):
    def test_shares_are_averaged_and_counts_summed(self):
        group, = table.group_rows([row("a", iou=0.9, merged=2), row("b", iou=0.7, merged=1, valid=False, thin_kept=None)])
        self.assertAlmostEqual(group["iou"], 0.8)
        self.assertEqual((group["merged"], group["rooms"], group["valid"], group["scenes"]), (3, 8, 1, 2))
        self.assertEqual((group["worst_iou"], group["thin_kept"], group["lost"]), (0.7, 1.0, {"labels": 0.1}))

    def test_a_failed_scene_counts_as_nothing_found(self):
        group, = table.group_rows([row("a"), {"name": "b", "group": "g", "kind": "office", "error": "error[N03]"}])
        self.assertEqual((group["iou"], group["failed"], group["worst_iou"]), (0.5, 1, 0.0))

    def test_differences_name_what_moved_and_by_how_much(self):
        base = {"scenes": [row("a", iou=0.90, merged=2), row("gone"), row("same")]}
        rows = [row("a", iou=0.95), row("same"), row("new", iou=0.1)]
        text = table.changes(rows, table.group_rows(rows), base)
        self.assertIn("2 scenes in common", text)
        self.assertIn("a: iou 0.9000 -> 0.9500 (+0.0500), merged 2 -> 0", text)
        self.assertIn("mean g: iou 0.9500 -> 0.9750 (+0.0250)", text)
        self.assertNotIn("same:", text)
        self.assertNotIn("new", text)


class Run(unittest.TestCase):
    def run_accuracy(self, folder, **variables):
        environment = {**os.environ, "ROOT": folder, "OUT": os.path.join(folder, "out.json"), **variables}
        return subprocess.run([sys.executable, os.path.join(SOURCE, "tests", "accuracy", "accuracy.py"), BUILD],
                              capture_output=True, text=True, env=environment, check=False)

    def test_one_scene_gives_a_table_and_a_json_that_passes_its_schema(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_accuracy(folder, ONLY="closed_house_1")
            self.assertEqual(done.returncode, 0, done.stderr)
            out = os.path.join(folder, "out.json")
            with open(out, encoding="utf-8") as text, open(os.path.join(SOURCE, "schemas", "accuracy.schema.json"), encoding="utf-8") as schema:
                result = json.load(text)
                jsonschema.validate(result, json.load(schema))
            scene, = result["scenes"]
            self.assertGreater(scene["iou"], 0.99)
            self.assertEqual(scene["found"], scene["rooms"])
            self.assertIn(f"{scene['iou']:.4f}", done.stdout)
            again = self.run_accuracy(folder, ONLY="closed_house_1", BASE=out)
            self.assertIn("nothing differs", again.stdout)
            with open(out, encoding="utf-8") as text:
                self.assertEqual(json.load(text), result)  # nothing ran again, so even the times are the same

    def test_random_buildings_give_valid_models_of_all_their_empty_cells_at_every_level_of_detail(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_accuracy(folder, ONLY="random_house_101_* random_oblique_102_*")
            self.assertEqual(done.returncode, 0, done.stdout)
            with open(os.path.join(folder, "out.json"), encoding="utf-8") as text:
                result = json.load(text)
            self.assertEqual([group["valid"] for group in result["groups"]], [2, 2, 2])
            with open(os.path.join(folder, "random_house_101", "evaluate", "scores.json"), encoding="utf-8") as text:
                scores = json.load(text)
            with open(os.path.join(folder, "random_house_101", "summary.json"), encoding="utf-8") as text:
                openings = json.load(text)["openings"]
            empty = scores["explanation"]["empty_m3"] + sum(opening["volume_m3"] for opening in openings)
            self.assertGreater(empty, scores["explanation"]["empty_m3"])  # doors were cut
            self.assertAlmostEqual(scores["mesh"]["volume_m3"], empty, delta=1e-6 * empty)

    def test_wrong_words_and_files_are_usage_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            for variables in ({"ONLY": "nonsense"}, {"BASE": os.path.join(folder, "nowhere.json")}):
                done = self.run_accuracy(folder, **variables)
                self.assertEqual(done.returncode, 2)
                self.assertIn("error[U01]", done.stderr)
                self.assertIn("hint:", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
