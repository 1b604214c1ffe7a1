#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits sloped planes with GDAL, the library behind QGIS, and hands them to accept_planes.

usage: gdal_planes_test.py SOURCE_DIR BIN_DIR
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    from osgeo import ogr
except ImportError:
    print("skipped: python3-gdal is not installed")
    sys.exit(77)

ogr.UseExceptions()
BIN = os.path.abspath(sys.argv[2])
SCENE = {"name": "gable", "seed": 3, "noise_m": 0.003, "sampling": {"kind": "uniform", "points": 60000},
         "storeys": [{"name": "attic", "floor": 0, "ceiling": 5, "rooms": [
             {"name": "room", "polygon": [[0, 0], [8, 0], [8, 6], [0, 6]], "roof": {"kind": "gable", "pitch_deg": 30, "eaves": 1.2}}]}]}


class GdalPlanes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = cls.folder.name
        with open(os.path.join(cls.work, "scene.json"), "w", encoding="utf-8") as text:
            json.dump(SCENE, text)
        cls.run_program("synthesize", "--scene", "scene.json", "--scan-out", "scan.ply", "--truth-out", "truth.off", "--truth-json", "truth.json")
        cls.run_program("ingest", "--scan", "scan.ply")
        cls.run_program("slice")
        cls.edit = os.path.join(cls.work, "edits/planes.geojson")
        os.makedirs(os.path.dirname(cls.edit))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def run_program(cls, name, *options):
        done = subprocess.run([os.path.join(BIN, name), "--work", ".", "-q", *options], capture_output=True, text=True, cwd=cls.work, check=False)
        assert done.returncode == 0, done.stderr

    def accept(self):
        self.run_program("accept_planes")
        with open(os.path.join(self.work, "45_accept_planes/planes.geojson"), encoding="utf-8") as text:
            return json.load(text)

    def start_edit(self):
        if os.path.exists(self.edit):
            os.remove(self.edit)
        detected = self.accept()
        shutil.copy(os.path.join(self.work, "45_accept_planes/planes.geojson"), self.edit)
        return detected

    def test_what_gdal_saves_without_a_change_is_the_detection(self):
        detected = self.start_edit()
        source = ogr.Open(self.edit, update=1)
        layer = source.GetLayer(0)
        for feature in layer:
            layer.SetFeature(feature)
        del feature, layer
        source = None  # saves
        with open(self.edit, encoding="utf-8") as text:
            self.assertIn("roomcut", json.load(text), "GDAL keeps our member")
        self.assertEqual(self.accept()["roomcut"]["provenance"]["payload_sha256"], detected["roomcut"]["provenance"]["payload_sha256"])

    def test_planes_turned_drawn_and_deleted_with_gdal_are_accepted(self):
        self.start_edit()
        source = ogr.Open(self.edit, update=1)
        layer = source.GetLayer(0)
        for feature in layer:
            if feature.GetField("plane_id") == "p0001":
                feature.SetField("pitch_deg", 33)
                layer.SetFeature(feature)
            else:
                layer.DeleteFeature(feature.GetFID())
        drawn = ogr.Feature(layer.GetLayerDefn())
        drawn.SetGeometry(ogr.CreateGeometryFromWkt("POLYGON ((1 1, 1 5, 3 5, 3 1, 1 1))"))
        for name, value in (("pitch_deg", 20), ("uphill_deg", 90), ("height_m", 2)):
            drawn.SetField(name, value)
        layer.CreateFeature(drawn)
        del drawn, feature, layer
        source = None
        planes = {feature["properties"]["plane_id"]: feature["properties"] for feature in self.accept()["features"]}
        self.assertEqual(sorted(planes), ["e0001", "p0001"])
        self.assertEqual((planes["p0001"]["source"], planes["p0001"]["pitch_deg"]), ("edited", 33))
        self.assertEqual([planes["e0001"][name] for name in ("source", "pitch_deg", "uphill_deg", "height_m", "side")], ["added", 20, 90, 2, "ceiling"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
