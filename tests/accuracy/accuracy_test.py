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

import ablation
import ablation_table
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


    def test_a_preset_stands_beside_the_defaults_over_the_scenes_of_both(self):
        defaults = [row("a", iou=0.9), row("b", iou=0.8, merged=1), row("only", iou=0.1)]
        text = table.beside([row("a", iou=0.6, missed=2), row("b", iou=0.5, merged=3), row("other")], defaults, "paper_2013").splitlines()
        self.assertEqual(text[-1].split(), ["g", "2", "0.8500", "0.5500", "0", "2", "1", "3"])


class Switches(unittest.TestCase):
    """The variants of `make ablation`."""

    def setUp(self):
        self.preset = ablation.read_preset(ablation.PRESET)
        self.variants = ablation.variants(self.preset)

    def test_every_line_of_the_preset_differs_from_the_default(self):
        defaults = ablation.read_preset(os.path.join(SOURCE, "pipeline.yaml"))
        self.assertGreater(len(self.preset), 20)
        for name, value in self.preset.items():
            self.assertIn(name, defaults)
            self.assertNotEqual(defaults[name], value, name)

    def test_each_addition_is_switched_off_alone_and_all_of_them_together(self):
        self.assertEqual(self.variants["graphcut.free_from"], {"graphcut.free_from": "1"})
        self.assertEqual(self.variants["detect_lines.search"], {"detect_lines.search": "mean_shift", "detect_lines.min_support_m": "1.5"})
        for value in ("detect_lines.min_support_m", "weigh_faces.tau_m"):
            self.assertIn(value, self.preset)
            self.assertNotIn(value, self.variants)
        self.assertEqual((self.variants["default"], self.variants["all"]), ({}, self.preset))

    def test_parameters_are_written_as_blocks(self):
        text = ablation.config_text({"slice.drift": "false", "graphcut.free_from": "1", "slice.step_m": "0"})
        self.assertEqual(text, "slice:\n  drift: false\n  step_m: 0\ngraphcut:\n  free_from: 1\n")

    def test_the_table_says_what_a_switch_costs_and_a_failed_scene_misses_all_its_rooms(self):
        chosen = [{"name": "a", "group": "g"}, {"name": "b", "group": "h"}]
        good = {"iou": 0.9, "rooms": 4, "missed": 0, "merged": 1}
        content = {"default": {"parameters": "", "scenes": {"a": good, "b": good}},
                   "x.y": {"parameters": "x:\n  y: 0\n", "scenes": {"a": {**good, "iou": 0.88, "merged": 3}, "b": {"error": "N03"}}}}
        text = ablation_table.markdown(chosen, content, ["default", "x.y", "not measured"]).splitlines()
        self.assertEqual(text[2], "| **default** | 0.9000, 0 missed, 1 merged | 0.9000, 0 missed, 1 merged | 0.9000, 0 missed, 2 merged |")
        self.assertEqual(text[3], "| `x: y: 0` | -20.0, +2 merged | -900.0, +4 missed, -1 merged, 1 failed | -460.0, +4 missed, +1 merged, 1 failed |")
        del content["x.y"]["scenes"]["b"]
        text = ablation_table.markdown(chosen, content, ["default", "x.y"]).splitlines()
        self.assertEqual(text[3], "| `x: y: 0` | -20.0, +2 merged | – | – |")


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

    def test_a_preset_runs_in_a_folder_of_its_own_and_stands_beside_the_defaults(self):
        with tempfile.TemporaryDirectory() as folder:
            default = self.run_accuracy(folder, ONLY="closed_house_1", OUT="")
            self.assertEqual(default.returncode, 0, default.stderr)
            paper = self.run_accuracy(folder, ONLY="closed_house_1", OUT="", PRESET="paper_2013")
            self.assertEqual(paper.returncode, 0, paper.stderr)
            self.assertIn("beside the defaults", paper.stdout)
            ious = []
            for name in ("accuracy.json", os.path.join("paper_2013", "accuracy.json")):
                with open(os.path.join(folder, name), encoding="utf-8") as text:
                    ious.append(json.load(text)["scenes"][0]["iou"])
            self.assertNotEqual(*ious)
            self.assertGreater(ious[1], 0.9)
            self.assertFalse(os.path.exists(os.path.join(folder, "paper_2013", "closed_house_1", "scan.ply")))

    def test_the_ablation_of_a_switch_is_measured_once_and_leaves_the_default_run_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, os.path.join(SOURCE, "tests", "accuracy", "ablation.py"), BUILD]
            environment = {**os.environ, "ROOT": folder, "ONLY": "closed_house_1", "SWITCHES": "raycast.evidence ingest.drop_ghosts"}
            done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("| `raycast: evidence: parity` |", done.stdout)
            with open(os.path.join(folder, "ablation.json"), encoding="utf-8") as text:
                result = {name: variant["scenes"]["closed_house_1"] for name, variant in json.load(text).items()}
            self.assertLess(result["raycast.evidence"]["iou"], result["default"]["iou"])
            self.assertEqual(result["ingest.drop_ghosts"], result["default"])
            with open(os.path.join(folder, "closed_house_1", "params", "raycast.json"), encoding="utf-8") as text:
                self.assertIn('"evidence":"combined"', text.read())
            again = subprocess.run(command, capture_output=True, text=True, env={**environment, "PATH": "/nonexistent"}, check=False)
            self.assertEqual(again.stdout, done.stdout)

    def test_wrong_words_and_files_are_usage_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            for variables in ({"ONLY": "nonsense"}, {"PRESET": "nonsense"}, {"PRESET": "paper_2013", "ONLY": "random_house_101*"}, {"BASE": os.path.join(folder, "nowhere.json")}):
                done = self.run_accuracy(folder, **variables)
                self.assertEqual(done.returncode, 2)
                self.assertIn("error[U01]", done.stderr)
                self.assertIn("hint:", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
