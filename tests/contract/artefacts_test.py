#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the pipeline on the smallest scene and holds every artefact against its page and its JSON Schema.

usage: artefacts_test.py SOURCE_DIR BUILD_DIR
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import jsonschema

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def run(*command, cwd=None):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def stage(name, *options):
    return run(os.path.join(BUILD, "bin", name), *options, "-q")


class Artefacts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        work = cls.work = os.path.join(cls.folder.name, "work")
        os.makedirs(work)
        scan, truth = os.path.join(work, "scan.ply"), os.path.join(work, "truth.off")
        scene = os.path.join(SOURCE, "tests/data/scenes/one_room.json")
        stage("synthesize", "--scene", scene, "--scan-out", scan, "--truth-out", truth,
              "--truth-json", os.path.join(work, "truth.json"))
        run("make", "-C", SOURCE, "run", f"SCAN={scan}", f"WORK={work}", f"BUILD={BUILD}")
        final = {name: os.path.join(work, "90_final", name + ".h5") for name in ("cells", "labels", "data_terms")}
        stage("evaluate", "--work", work, "--truth", truth, "--cells", final["cells"], "--labels", final["labels"],
              "--terms", final["data_terms"], "--cells-out", os.path.join(work, "evaluate", "truth_cells.h5"))
        run("make", "-C", SOURCE, "compare", f"A={work}", f"B={work}", f"BUILD={BUILD}")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def files(self, ending):
        found = []
        for folder, _, names in os.walk(self.work):
            found += [os.path.join(folder, name) for name in names if name.endswith(ending)]
        return sorted(found)

    def test_h5dump_reads_every_file(self):
        self.assertGreaterEqual(len(self.files(".h5")), 12)
        for path in self.files(".h5"):
            run("h5dump", "-H", path)

    def test_every_dataset_is_named_on_its_page_and_has_unit_and_description(self):
        for path in self.files(".h5"):
            header = run("h5dump", "-A", path)
            kind = re.search(r'ATTRIBUTE "artefact".*?\(0\): "(\w+)"', header, re.S).group(1)
            with open(os.path.join(SOURCE, "schemas", kind + ".md"), encoding="utf-8") as page:
                text = page.read()
            names = re.findall(r"^ dataset +(\S+)", run("h5dump", "-n", path), re.M)
            self.assertTrue(names, path)
            for name in names:
                with self.subTest(file=os.path.basename(path), dataset=name):
                    documented = re.sub(r"/\d+/", "/<k>/", name.lstrip("/"))
                    self.assertTrue(documented in text or documented.replace("<k>", "k") in text,
                                    f"{documented} is not on schemas/{kind}.md")
                    block = run("h5dump", "-A", "-d", name, path)
                    self.assertIn('ATTRIBUTE "unit"', block)
                    self.assertIn('ATTRIBUTE "description"', block)

    def test_every_json_passes_its_schema(self):
        checked = 0
        pairs = [(path, "wall_lines") for path in self.files("wall_lines.geojson")]
        pairs.append((os.path.join(self.work, "45_accept_planes", "planes.geojson"), "planes"))
        pairs.append((os.path.join(SOURCE, "tests/compat/planes_v1.0.geojson"), "planes"))
        pairs += [(os.path.join(self.work, "summary.json"), "summary"),
                  (os.path.join(self.work, "evaluate", "scores.json"), "scores"),
                  (os.path.join(self.work, "compare", "work", "comparison.json"), "comparison")]
        pairs.append((os.path.join(self.work, "95_find_openings", "openings.geojson"), "openings"))
        scenes = os.path.join(SOURCE, "tests/data/scenes")
        pairs += [(os.path.join(scenes, name), "scene") for name in sorted(os.listdir(scenes)) if name.endswith(".json")]
        for path, kind in pairs:
            with self.subTest(file=path):
                with open(os.path.join(SOURCE, "schemas", kind + ".schema.json"), encoding="utf-8") as schema:
                    rules = json.load(schema)
                with open(path, encoding="utf-8") as text:
                    jsonschema.validate(json.load(text), rules)
                checked += 1
        self.assertGreaterEqual(checked, 11)

    def test_no_artefact_names_this_machine(self):
        marks = [self.folder.name.encode(), SOURCE.encode(), os.uname().nodename.encode()]
        marks = [mark for mark in marks if len(mark) > 5]  # a host called "vm" stands in any megabyte by chance
        endings = (".h5", ".geojson", "model.ply", "model.obj", "summary.json", "comparison.json", "comparison.html")
        for ending in endings:
            for path in self.files(ending):
                with open(path, "rb") as data:
                    content = data.read()
                for mark in marks:
                    self.assertFalse(mark in content, f"{path} holds {mark}")

    def test_provenance_chains_from_the_model_back_to_the_scan(self):
        with open(os.path.join(self.work, "summary.json"), encoding="utf-8") as text:
            inputs = json.load(text)["provenance"]["inputs"]
        digests = {name: record["payload_sha256"] for name, record in inputs.items()} if isinstance(inputs, dict) else {
            record["name"]: record["payload_sha256"] for record in inputs}
        self.assertIn("labels", digests)
        header = run("h5dump", "-A", os.path.join(self.work, "90_final", "labels.h5"))
        self.assertIn(digests["labels"], header)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
