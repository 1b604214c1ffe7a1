#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `make accuracy` itself: choice of scenes, means, differences, and a run of one scene.

usage: accuracy_test.py SOURCE_DIR BUILD_DIR
"""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

import jsonschema

import ablation
import ablation_table
import moved
import scene_run
import scenes
import table

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
NOWHERE = "/nonexistent"


def row(name, group="g", **figures):
    given = {"iou": 1.0, "recall": 1.0, "precision": 1.0, "rooms": 4, "found": 4, "missed": 0, "missed_scanned": 0, "merged": 0,
             "seen": 1.0, "denied": None, "invented": 0.0, "unentered_m3": 0.0, "unentered_found": 0, "unentered_unknown": 0, "unentered_denied": 0,
             "bound": 1.0, "lost": {"labels": 0.1}, "extra": {"labels": 0.0}, "thin_kept": 1.0, "walls": 1.0, "walls_loose": 1.0, "horizontals": 1.0, "horizontals_fine": 1.0, "hausdorff_pct": 0.1, "valid": True, "cpu_s": 1.0}
    return {"name": name, "group": group, "kind": "office", **given, **figures}


class Choice(unittest.TestCase):
    def setUp(self):
        self.every = scenes.all_scenes(NOWHERE)

    def names(self, only):
        return [scene["name"] for scene in scenes.choose(self.every, only)]

    def test_all_families_and_groups_have_five_seeds_and_unique_names(self):
        names = self.names("")
        of_families = [scene for scene in self.every if scene["group"] in scenes.GROUPS]
        self.assertEqual(len(of_families), 5 * sum(len(scenes.FAMILIES_OF.get(group, scenes.FAMILIES)) for group in scenes.GROUPS))
        self.assertLessEqual({scene["name"] for scene in of_families}, set(names))
        self.assertEqual(len(set(names)), len(names))

    def test_groups_families_scenes_and_patterns(self):
        self.assertEqual(len(self.names("uniform")), 5 * len(scenes.FAMILIES))
        self.assertEqual(len(self.names("house")), 5 * sum("house" in scenes.FAMILIES_OF.get(group, scenes.FAMILIES) for group in scenes.GROUPS))
        self.assertEqual(len(self.names("slopes")), 60)  # when asked for
        self.assertFalse({"slopes_07"} & set(self.names("")))
        self.assertEqual(self.names("tripod_thin_2"), ["tripod_thin_2"])
        self.assertEqual(self.names("moved_uniform_house_1"), [f"moved_uniform_house_1_{pose}" for pose in moved.POSES])
        self.assertEqual(self.names("uniform_house_1"), ["uniform_house_1"])
        self.assertEqual(self.names("random_thin_101*"), [f"random_thin_101_mu{mu}" for mu in scenes.RANDOM_MU_M])
        self.assertEqual(len(self.names("random")), 900)
        self.assertEqual(len(self.names("random_elements")), 900)
        self.assertEqual(self.names("noise_*_curved_1, uniform_house_3"), ["uniform_house_3", "noise_1cm_curved_1", "noise_2cm_curved_1"])

    def test_a_word_that_names_nothing_is_an_error(self):
        with self.assertRaisesRegex(ValueError, "uniforms"):
            scenes.choose(self.every, "uniform uniforms")

    def test_a_density_is_met_whatever_the_size_of_the_building(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = {"name": "x", "group": "g", "kind": "k", "points_per_m2": 20, "scene": {"name": "x", "random": {"family": "house", "seed": 1}}}
            truth = scene_run.read_json(scene_run.make_scan(BUILD, scene, folder)[2])
        self.assertAlmostEqual(truth["points"] / truth["surface_area"], 20, delta=0.01)

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


    def test_denied_volume_is_a_share_of_all_that_nobody_entered(self):
        group, = table.group_rows([row("a", denied=0.5, unentered_m3=10.0, unentered_denied=1), row("b", denied=0.0, unentered_m3=90.0), row("c")])
        self.assertAlmostEqual(group["denied"], 0.05)
        self.assertEqual(group["unentered_denied"], 1)
        self.assertIsNone(table.group_rows([row("c")])[0]["denied"])


class Elements(unittest.TestCase):
    """Slopes, columns and niches beside the main figures."""

    PLAIN = {"volume_error": 0.001, "slopes_m2": 0.0, "angle_deg": None, "angle_p95_deg": None, "slopes_close": None, "columns": 0, "columns_found": 0,
             "columns_false": 0, "floor_m2": 500.0, "niches": 0, "niches_m2": 0.0, "niches_near_m2": 0.0, "heights": 8, "heights_1mm": 6, "height_worst_m": 0.0125,
             "columns_25cm": 0, "columns_25cm_found": 0, "niches_10cm_m2": 0.0, "niches_10cm_near_m2": 0.0,
             "arcs": 0, "arcs_found": 0, "arcs_false": 0, "arcs_close": 0}

    def test_a_group_weighs_slopes_by_their_area_and_names_its_worst_volume(self):
        members = [row("a", elements={**self.PLAIN, "slopes_m2": 30.0, "angle_deg": 0.1, "angle_p95_deg": 1.0, "slopes_close": 1.0, "volume_error": -0.02}),
                   row("b", elements={**self.PLAIN, "slopes_m2": 10.0, "angle_deg": 0.5, "angle_p95_deg": 1.0, "slopes_close": 0.0}), row("c", elements=self.PLAIN)]
        group, = table.group_rows(members)
        self.assertAlmostEqual(group["elements"]["angle_deg"], 0.2)
        self.assertAlmostEqual(group["elements"]["slopes_close"], 0.75)
        self.assertEqual(group["elements"]["volume_error"], -0.02)

    def test_the_table_has_their_lines_only_where_there_are_any(self):
        found = row("a", elements={**self.PLAIN, "columns": 4, "columns_found": 3, "columns_false": 1, "columns_25cm": 2, "columns_25cm_found": 2, "niches_10cm_m2": 2.0, "niches_10cm_near_m2": 1.8, "niches": 2, "niches_m2": 4.0, "niches_near_m2": 3.0,
                                    "arcs": 4, "arcs_found": 3, "arcs_false": 1, "arcs_close": 2})
        rows = [found, row("plain", elements=self.PLAIN)]
        text = table.table(rows, table.group_rows(rows)).split("elements ")[1]
        self.assertNotIn("plain", text)
        line, = [line for line in text.splitlines() if line.startswith("a ")]
        self.assertEqual(line.split(), ["a", "0.100", "–", "–", "–", "3/4", "100.0", "1", "2.00", "2", "75.0", "90.0", "75.0", "12.5", "3/4", "1", "75.0", "66.7"])
        self.assertNotIn("elements", table.table(rows[1:], table.group_rows(rows[1:])))


class Moved(unittest.TestCase):
    """Scans in other poses, and how the spread of their models is counted."""

    def test_points_mesh_and_truth_move_together(self):
        for pose in moved.POSES.values():
            move = moved.mover(pose)
            corners = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 1.0, 3.0)]
            off = moved.moved_off("OFF\n3 1 0\n" + "".join("%r %r %r\n" % corner for corner in corners) + "3 0 1 2\n", pose).splitlines()
            self.assertEqual([tuple(map(float, line.split())) for line in off[2:5]], [move(*corner) for corner in corners])
            self.assertEqual(off[5], "3 0 1 2")
            truth = moved.moved_truth({"rooms": [{"name": "a", "floor": 0.0, "ceiling": 3.0, "center": [2.0, 0.0, 0.0], "polygon": [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]],
                                                  "scanned": False}], "stations": [{"position": [2.0, 0.0, 0.0]}]}, pose)
            room, = truth["rooms"]
            self.assertEqual((room["polygon"][1], room["floor"], room["ceiling"]), (move(*corners[1])[:2], move(*corners[0])[2], move(*corners[2])[2]))
            self.assertEqual((room["center"], truth["stations"][0]["position"], room["scanned"]), (move(*corners[1]), move(*corners[1]), False))
            for a, b in ((0, 1), (1, 2)):  # a building stays as large as it is
                self.assertAlmostEqual(math.dist(move(*corners[a]), move(*corners[b])), math.dist(corners[a], corners[b]), delta=0.002)

    def test_a_scan_is_thinned_doubled_and_keeps_its_digits_far_from_the_origin(self):
        points = [(i / 1000, 1.0, 2.0) for i in range(4000)]
        self.assertEqual(moved.moved_points(points, {"copies": 2}), points * 2)
        half = moved.moved_points(points, {"thin": 2})
        self.assertTrue(set(half) < set(points))
        self.assertAlmostEqual(len(half) / len(points), 0.5, delta=0.05)
        lopsided = moved.moved_points(points, {"lopsided": 0.2})
        self.assertEqual(lopsided[:2000], points[:2000])  # the other side of the middle
        self.assertAlmostEqual(len(lopsided) / len(points), 0.9, delta=0.02)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scan.ply")
            far = moved.moved_points(points, moved.POSES["utm_1mm"])
            moved.write_points(path, far)
            self.assertEqual(moved.read_points(path), far)
            self.assertEqual(far[1][0], 431207.318)

    def test_a_truth_with_boxes_that_would_not_stay_boxes_is_refused(self):
        with self.assertRaisesRegex(ValueError, "ignore_boxes"):
            moved.moved_truth({"rooms": [], "stations": [], "ignore_boxes": [[[0, 0, 0], [1, 1, 1]]]}, {"turn": 17})

    def test_the_spread_counts_pairs_of_poses_of_the_same_building(self):
        def pose(kind, name, rooms, openings, volume):
            return {**row(name, "moved", model={"rooms": rooms, "openings": openings, "volume_m3": volume}), "kind": kind}
        rows = [pose("a", "a1", 4, 3, 100.0), pose("a", "a2", 4, 2, 100.2), pose("a", "a3", 5, 3, 110.0), pose("b", "b1", 9, 9, 500.0), pose("b", "b2", 9, 9, 500.0)]
        group, = table.group_rows(rows)
        self.assertEqual(group["spread"]["pairs"], 4)
        self.assertEqual((group["spread"]["rooms_same"], group["spread"]["openings_same"], group["spread"]["volume_same"]), (0.5, 0.5, 0.5))
        self.assertAlmostEqual(group["spread"]["volume"], 10 / 110)
        text = table.table(rows, [group])
        self.assertIn("a: rooms 4 (2) 5 (1), the same in 33.3 % of 3 pairs", text)
        self.assertIsNone(table.group_rows([row("x")])[0]["spread"])


class Cases(unittest.TestCase):
    def test_cases_are_those_with_a_truth(self):
        with tempfile.TemporaryDirectory() as folder:
            for path in ("both/scan.ply", "both/truth.off", "made/scene.json", "without/scan.ply", "sparse_12_per_m2/scan.ply"):
                os.makedirs(os.path.join(folder, os.path.dirname(path)), exist_ok=True)
                with open(os.path.join(folder, path), "w", encoding="utf-8") as text:
                    text.write('{"name": "made"}')
            found = {scene["kind"]: scene for scene in scenes.cases(folder)}
        self.assertEqual(list(found), ["both", "made", "sparse_12_per_m2"])
        self.assertEqual(scene_run.scan_files(found["both"], "/w"), [os.path.join(folder, "both", name) for name in ("scan.ply", "truth.off")] + ["/w/truth.json"])
        self.assertEqual(found["made"]["scene"], {"name": "made"})
        self.assertEqual(found["sparse_12_per_m2"]["scene"]["sampling"]["points"], 15000)
        self.assertEqual(scene_run.scan_files(found["sparse_12_per_m2"], "/w")[:2], [os.path.join(folder, "sparse_12_per_m2", "scan.ply"), "/w/truth.off"])

    def test_the_table_names_what_the_stages_warned_of(self):
        text = table.table([row("cases_x", "cases", warnings=["too sparse"])], table.group_rows([row("cases_x", "cases")]))
        self.assertIn("cases_x: too sparse", text)


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
        self.assertEqual(self.variants["weigh_faces.correct_density"], {"weigh_faces.correct_density": "false", "weigh_faces.tau_m": "0.12"})
        for value in ablation.VALUES:
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
                summary = json.load(text)
            cut = sum(opening["volume_m3"] for opening in summary["openings"])
            self.assertGreater(cut, 0)  # doors
            empty = summary["mesh"]["cells_m3"]
            self.assertAlmostEqual(scores["mesh"]["volume_m3"], empty, delta=1e-6 * empty)
            # Floors and ceilings lie at their own heights, not at their levels: by a centimetre or so of 2.5 m.
            self.assertAlmostEqual(scores["explanation"]["empty_m3"] + cut, empty, delta=0.005 * empty)

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
