#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fit behind `make accuracy-weights` on made-up cells of which the answer is known, and the command on two finished scenes.

usage: weights_test.py SOURCE_DIR BUILD_DIR
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy
except ImportError as missing:
    print(f"skipped: {missing.name} is not installed (python3-numpy, python3-h5py)")
    sys.exit(77)
import jsonschema

import weight_fit
import weight_terms

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
TRUE = numpy.array([0.7, 2.0, -3.0, 0.5])
FREE = (numpy.full(4, -numpy.inf), numpy.full(4, numpy.inf))


def made_up(seed, cells=400, weights=TRUE):
    """Cells whose share of truth is just what `weights` say: these are the optimum of any volumes."""
    random = numpy.random.default_rng(seed)
    terms = numpy.column_stack([numpy.ones(cells), random.random((cells, len(weights) - 1))])
    volume = random.exponential(1.0, cells)
    return terms, volume, volume * weight_terms.probability(terms @ weights)


def labelled(seed):
    """The same with cells that are wholly empty or wholly solid, by chance."""
    terms, volume, empty = made_up(seed)
    return terms, volume, volume * (numpy.random.default_rng(seed + 1000).random(len(volume)) < empty / volume)


class Fit(unittest.TestCase):
    def assert_close(self, a, b, tolerance=1e-5):
        self.assertLess(numpy.abs(a - b).max(), tolerance, f"{a} {b}")

    def test_weights_that_made_the_truth_are_found_again(self):
        for seed in range(5):
            self.assert_close(weight_fit.fit([made_up(seed), made_up(seed + 50)], *FREE, ridge=1e-12), TRUE)

    def test_nothing_near_by_within_the_bounds_is_better(self):
        random = numpy.random.default_rng(1)
        for seed in range(5):
            building = labelled(seed)
            low, high = weight_fit.signs(-TRUE if seed % 2 else TRUE)
            best = weight_fit.fit([building], low, high, ridge=1e-12)
            for _ in range(200):
                other = numpy.clip(best + 0.05 * random.standard_normal(4), low, high)
                self.assertLessEqual(weight_fit.score(building, best)["log_loss"], weight_fit.score(building, other)["log_loss"] + 1e-9)

    def test_a_cell_counts_as_often_as_its_volume_says(self):
        terms, _, empty = labelled(3)
        share = (empty > 0).astype(float)
        times = numpy.random.default_rng(4).integers(0, 4, len(share))
        by_volume = weight_fit.fit([(terms, times.astype(float), times * share)], *FREE)
        by_copies = weight_fit.fit([tuple(numpy.repeat(column, times, axis=0) for column in (terms, numpy.ones(len(share)), share))], *FREE)
        self.assert_close(by_volume, by_copies)
        self.assertGreater(numpy.abs(by_volume - weight_fit.fit([(terms, numpy.ones(len(share)), share)], *FREE)).max(), 1e-2)

    def test_a_large_building_does_not_outvote_a_small_one(self):
        small, large = labelled(5), made_up(6, 4000, numpy.array([-1.0, 0.5, 2.0, 1.0]))
        grown = (large[0], 1000 * large[1], 1000 * large[2])
        self.assert_close(weight_fit.fit([small, large], *FREE), weight_fit.fit([small, grown], *FREE))

    def test_cells_that_no_column_met_change_nothing(self):
        terms, volume, empty = labelled(7)
        none = (numpy.vstack([terms, 100 * numpy.ones((3, 4))]), numpy.append(volume, [0.0] * 3), numpy.append(empty, [0.0] * 3))
        self.assert_close(weight_fit.fit([(terms, volume, empty)], *FREE), weight_fit.fit([none], *FREE), 1e-9)
        self.assertEqual(weight_fit.score((terms, volume, empty), TRUE), weight_fit.score(none, TRUE))

    def test_a_weight_that_would_change_its_sign_is_nought_as_if_the_term_were_not_there(self):
        terms, volume, empty = made_up(8)
        low, high = weight_fit.signs(numpy.array([-1.0, 1.0, 1.0, 1.0]))  # the third is -3 in truth; the constant is free
        bounded = weight_fit.fit([(terms, volume, empty)], low, high)
        self.assertEqual(bounded[2], 0)
        kept = [0, 1, 3]
        self.assert_close(bounded[kept], weight_fit.fit([(terms[:, kept], volume, empty)], low[kept], high[kept]))

    def test_the_constant_may_change_its_sign(self):
        other = numpy.array([-1.5, 2.0, -3.0, 0.5])
        self.assert_close(weight_fit.fit([made_up(10, weights=other)], *weight_fit.signs(TRUE), ridge=1e-12), other)

    def test_what_can_be_told_apart_wholly_keeps_finite_weights(self):
        terms = numpy.column_stack([numpy.ones(100), numpy.linspace(-1, 1, 100)])
        building = (terms, numpy.ones(100), (terms[:, 1] > 0).astype(float))
        weights = weight_fit.fit([building], *(bound[:2] for bound in FREE))
        self.assertTrue(numpy.isfinite(weights).all())
        self.assertEqual(weight_fit.score(building, weights)["wrong"], 0)


class LeaveOut(unittest.TestCase):
    def test_wrong_volume_and_loss_of_three_cells_by_hand(self):
        building = (numpy.array([[1.0, 1.0], [1.0, -3.0], [1.0, 0.0]]), numpy.array([4.0, 2.0, 2.0]), numpy.array([3.0, 1.0, 2.0]))
        got = weight_fit.score(building, numpy.array([0.0, 1.0]))  # sums 1, -3 and 0, which speaks for nothing: solid
        self.assertAlmostEqual(got["wrong"], (1 + 1 + 2) / 8)
        loss = 3 * numpy.log1p(numpy.exp(-1)) + numpy.log1p(numpy.exp(1)) + numpy.log1p(numpy.exp(3)) + numpy.log1p(numpy.exp(-3)) + 2 * numpy.log(2)
        self.assertAlmostEqual(got["log_loss"], loss / 8)
        self.assertAlmostEqual(weight_fit.bound(building), (1 + 1 + 0) / 8)

    def test_no_weights_are_better_than_the_bound(self):
        random = numpy.random.default_rng(2)
        for seed in range(20):
            building = made_up(seed, 50)
            self.assertLessEqual(weight_fit.bound(building), weight_fit.score(building, 3 * random.standard_normal(4))["wrong"] + 1e-12)

    def test_what_is_left_out_has_no_say_in_its_own_weights_but_in_all_others(self):
        buildings = {name: labelled(seed) for seed, name in enumerate("abc")}
        terms, volume, empty = buildings["b"]
        rows, fitted = weight_fit.leave_out(buildings, TRUE)
        turned, turned_all = weight_fit.leave_out({**buildings, "b": (terms, volume, volume - empty)}, TRUE)
        self.assertEqual([row["name"] for row in rows], ["a", "b", "c"])
        self.assertTrue((rows[1]["weights"] == turned[1]["weights"]).all())
        for before, after in ((rows[0]["weights"], turned[0]["weights"]), (rows[2]["weights"], turned[2]["weights"]), (fitted, turned_all)):
            self.assertGreater(numpy.abs(before - after).max(), 0.1)
        self.assertEqual(rows[1]["shipped"], weight_fit.score(buildings["b"], TRUE))

    def test_weights_tuned_to_one_odd_building_are_found_out(self):
        buildings = {**{name: labelled(seed) for seed, name in enumerate("abc")}, "odd": made_up(9, weights=numpy.array([-2.0, 0.0, 0.0, 6.0]))}
        tuned = weight_fit.fit([buildings["odd"]], *weight_fit.signs(TRUE))
        rows, _ = weight_fit.leave_out(buildings, tuned)
        for row in rows:
            better = row["without"]["log_loss"] < row["shipped"]["log_loss"]
            self.assertEqual(better, row["name"] != "odd", row["name"])


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = cls.folder.name
        done = cls.run_script("accuracy.py", ONLY="closed_house_1 closed_thin_1", OUT=os.path.join(cls.root, "accuracy.json"))
        if done.returncode != 0:
            raise AssertionError(done.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def run_script(cls, name, **variables):
        environment = {**os.environ, "ROOT": cls.root, **variables}
        for name_of in {"ONLY", "OUT", "BASE"} - set(variables):
            environment.pop(name_of, None)
        return subprocess.run([sys.executable, os.path.join(SOURCE, "tests", "accuracy", name), BUILD], capture_output=True, text=True,
                              env=environment, check=False)

    def test_two_finished_scenes_give_a_table_and_a_json_that_passes_its_schema(self):
        done = self.run_script("leave_one_out.py")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.root, "left_out.json"), encoding="utf-8") as text, \
                open(os.path.join(SOURCE, "schemas", "left_out.schema.json"), encoding="utf-8") as schema:
            result = json.load(text)
            jsonschema.validate(result, json.load(schema))
        self.assertEqual(sorted(row["name"] for row in result["left_out"]), ["house", "thin"])
        for row in result["left_out"]:
            self.assertLessEqual(row["bound"], row["shipped"]["wrong"] + 1e-12)
            self.assertLess(row["shipped"]["wrong"], 0.05)
            self.assertIn(f"{100 * row['without']['wrong']:.3f}", done.stdout)

    def test_volumes_are_those_that_evaluate_compares(self):
        for name in ("closed_house_1", "closed_thin_1"):
            _, volume, empty = weight_terms.read_terms(os.path.join(self.root, name))
            with open(os.path.join(self.root, name, "evaluate", "scores.json"), encoding="utf-8") as text:
                scores = json.load(text)
            truth, label = scores["volume"]["truth_m3"], empty > 0.5 * volume
            extra, outside = (volume - empty)[label].sum(), scores["explanation"]["lost_m3"]["outside"]
            self.assertAlmostEqual(empty.sum() + outside, truth, delta=0.002 * truth)
            self.assertAlmostEqual(empty[label].sum() / (empty.sum() + outside + extra), scores["explanation"]["bound_iou"], delta=1e-4)

    def test_terms_that_are_not_those_of_raycast_are_refused(self):
        with tempfile.TemporaryDirectory() as copy:
            shutil.copytree(os.path.join(self.root, "closed_thin_1"), copy, dirs_exist_ok=True)
            path = os.path.join(copy, "90_final", "data_terms.h5")
            with h5py.File(path, "r+") as file:
                file["cell/sky"][0] = 1 - file["cell/sky"][0]
            with self.assertRaisesRegex(weight_terms.Unusable, "data_terms.h5: its beta is not what its features"):
                weight_terms.read_terms(copy)
            with h5py.File(path, "r+") as file:
                file.attrs["cells_payload_sha256"] = "0" * 64
            with self.assertRaisesRegex(weight_terms.Unusable, "another cells.h5"):
                weight_terms.read_terms(copy)

    def test_what_was_not_run_is_a_usage_error(self):
        for variables in ({"ONLY": "nonsense"}, {"ONLY": "closed_thin_1"}, {"ROOT": os.path.join(self.root, "nowhere")}):
            done = self.run_script("leave_one_out.py", **variables)
            self.assertEqual(done.returncode, 2)
            self.assertIn("error[U01] make accuracy-weights", done.stderr)
            self.assertIn("hint:", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
