#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`make accuracy-weights` on two finished scenes; the learning itself is tested in learn/learn_test.cpp.

usage: weights_test.py SOURCE_DIR BUILD_DIR
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import jsonschema

import left_out_table

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as text:
        return text.read()


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = cls.folder.name
        made = cls.run_script("accuracy.py", OUT=os.path.join(cls.root, "accuracy.json"))
        if made.returncode != 0:
            raise AssertionError(made.stderr)
        cls.done = cls.run_script("leave_one_out.py", FOLDS="thin")
        if cls.done.returncode != 0:
            raise AssertionError(cls.done.stderr)
        cls.result = json.loads(read(cls.root, "left_out.json"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def run_script(cls, name, **variables):
        known = {"ROOT": cls.root, "ONLY": "closed_house_1 closed_thin_1", "GENERATIONS": "20", **variables}
        environment = {key: value for key, value in os.environ.items() if key not in ("OUT", "BASE", "FOLDS", "PRESET")}
        return subprocess.run([sys.executable, os.path.join(SOURCE, "tests", "accuracy", name), BUILD], capture_output=True, text=True,
                              env={**environment, **known}, check=False)

    def test_the_result_passes_its_schema_and_the_table_shows_it(self):
        jsonschema.validate(self.result, json.loads(read(SOURCE, "schemas", "left_out.schema.json")))
        self.assertEqual({row["name"] for row in self.result["buildings"]}, {"house", "thin"})
        for row in self.result["buildings"]:
            self.assertEqual(row["iou"]["without"] is not None, row["name"] == "thin")
            for iou in filter(None, row["iou"].values()):
                self.assertLessEqual(iou, row["bound"] + 1e-9)
            for figure in (*row["iou"].values(), *row["loss"].values()):
                self.assertIn("–" if figure is None else f"{figure:.4f}", self.done.stdout)

    def test_with_the_shipped_weights_the_iou_is_the_one_that_evaluate_finds(self):
        for row in self.result["buildings"]:
            scores = json.loads(read(self.root, f"closed_{row['name']}_1", "evaluate", "scores.json"))
            self.assertAlmostEqual(row["iou"]["shipped"], scores["explanation"]["labels_iou"], delta=5e-4)
            self.assertAlmostEqual(row["bound"], scores["explanation"]["bound_iou"], delta=5e-4)

    def test_again_and_with_one_thread_it_finds_the_same(self):
        other = os.path.join(self.root, "other.json")
        self.assertEqual(self.run_script("leave_one_out.py", FOLDS="thin", JOBS="1", OUT=other).returncode, 0)
        self.assertEqual(read(other), read(self.root, "left_out.json"))

    def test_the_learned_table_is_the_mean_of_what_was_learned_drawn_to_the_prior(self):
        rows = [line.split("|") for line in read(self.root, "learned.table").splitlines() if "|" in line and not line.startswith("#")]
        written = {name.strip(): float(weight) for name, weight, _ in rows}
        weights = self.result["weights"]
        learned = [weights["all"], *weights["without"].values()]
        self.assertEqual(set(written), set(weights["prior"]))
        for name, weight in written.items():
            expected = 0.75 * sum(one[name] for one in learned) / len(learned) + 0.25 * weights["prior"][name]
            self.assertAlmostEqual(weight, expected, delta=0.00501, msg=name)

    def test_both_passes_are_lessons_and_a_first_that_is_gone_is_not(self):
        first, out = os.path.join(self.root, "closed_thin_1", "55_weigh_faces"), os.path.join(self.root, "other.json")
        os.rename(first, first + ".gone")
        try:
            done = self.run_script("leave_one_out.py", FOLDS="none", OUT=out)
        finally:
            os.rename(first + ".gone", first)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("2 scenes of 2 are finished: 3 lessons", done.stdout)
        self.assertIn("2 scenes of 2 are finished: 4 lessons", self.done.stdout)

    def test_a_file_of_other_cells_is_an_input_error(self):
        house, thin = (os.path.join(self.root, f"closed_{name}_1", "90_final", "weights.h5") for name in ("house", "thin"))
        os.rename(thin, thin + ".kept")
        try:
            shutil.copyfile(house, thin)
            done = self.run_script("leave_one_out.py", FOLDS="none")
        finally:
            os.replace(thin + ".kept", thin)
        self.assertEqual(done.returncode, 3)
        self.assertIn("error[A05] make accuracy-weights", done.stderr)
        self.assertIn("hint:", done.stderr)

    def test_what_was_not_run_is_a_usage_error(self):
        for variables in ({"ONLY": "nonsense"}, {"ONLY": "closed_thin_1"}, {"ROOT": os.path.join(self.root, "nowhere")}, {"FOLDS": "office"},
                          {"GENERATIONS": "few"}):
            done = self.run_script("leave_one_out.py", **variables)
            self.assertEqual(done.returncode, 2, variables)
            self.assertIn("error[U01] make accuracy-weights", done.stderr)
            self.assertIn("hint:", done.stderr)


class Table(unittest.TestCase):
    def test_a_building_is_scored_by_the_weights_that_never_saw_it(self):
        def lessons(**iou):
            of_final = [{"scene": name, "building": name, "final": True, "iou": value, "bound": 1.0, "loss": 1 - value} for name, value in iou.items()]
            return {"weights": {"constant": 1.0}, "lessons": of_final + [{**lesson, "final": False, "iou": 0.0} for lesson in of_final]}

        found = {"shipped": lessons(a=0.9, b=0.8), "prior": lessons(a=0.5, b=0.5), "all": lessons(a=0.95, b=0.85), "without b": lessons(a=0.99, b=0.7)}
        rows = left_out_table.rows_of(found, {"a": False, "b": False})
        self.assertEqual([row["iou"]["without"] for row in rows], [None, 0.7])
        self.assertEqual([row["loss"]["without"] for row in rows], [None, 1 - 0.7])
        means = left_out_table.mean_rows(rows)
        self.assertAlmostEqual(means["real"]["iou"]["shipped"], 0.85)
        self.assertNotIn("without", means["real"]["iou"])
        self.assertEqual(means["left_out"]["iou"], {"shipped": 0.8, "prior": 0.5, "all": 0.85, "without": 0.7})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
