#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Edits wall lines with GDAL, the library behind QGIS, and hands them to accept_lines.

usage: gdal_edit_test.py SOURCE_DIR BIN_DIR
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
SOURCE, BIN = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
DETECTED = os.path.join(SOURCE, "tests/compat/wall_lines_v1.0.geojson")
X, Y = 85123.5, 447001.25  # its origin: edits are in the scan's own coordinates


class GdalEdit(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.work = self.folder.name
        self.edit = os.path.join(self.work, "edits/wall_lines.geojson")
        os.makedirs(os.path.dirname(self.edit))
        os.makedirs(os.path.join(self.work, "30_detect_lines"))
        shutil.copy(DETECTED, os.path.join(self.work, "30_detect_lines/wall_lines.geojson"))

    def tearDown(self):
        self.folder.cleanup()

    def run_program(self, name, *options):
        done = subprocess.run([os.path.join(BIN, name), "--work", self.work, *options], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def accept(self):
        self.run_program("accept_lines", "-q")
        with open(os.path.join(self.work, "40_accept_lines/wall_lines.geojson"), encoding="utf-8") as text:
            return json.load(text)

    def start_edit(self):
        self.accept()
        shutil.copy(os.path.join(self.work, "40_accept_lines/wall_lines.geojson"), self.edit)

    @staticmethod
    def by_id(document):
        return {feature["properties"]["wall_id"]: feature for feature in document["features"]}

    def test_lines_moved_drawn_and_deleted_with_gdal_are_accepted(self):
        self.start_edit()
        source = ogr.Open(self.edit, update=1)
        layer = source.GetLayer(0)
        for feature in layer:
            if feature.GetField("wall_id") == "w0005":
                line = ogr.Geometry(ogr.wkbLineString)
                line.AddPoint_2D(X - 0.25, Y - 3)
                line.AddPoint_2D(X - 0.25, Y + 3)
                feature.SetGeometry(line)
                layer.SetFeature(feature)
            elif feature.GetField("wall_id") == "w0006":
                layer.DeleteFeature(feature.GetFID())
        drawn = ogr.Feature(layer.GetLayerDefn())
        drawn.SetGeometry(ogr.CreateGeometryFromWkt(f"LINESTRING ({X + 1} {Y - 2.123456789}, {X + 3} {Y - 2.123456789})"))
        layer.CreateFeature(drawn)
        del drawn, feature, layer
        source = None  # saves

        with open(self.edit, encoding="utf-8") as text:
            self.assertIn("roomcut", json.load(text), "GDAL keeps our member")
        told = self.run_program("diff_lines", "-q").stdout
        self.assertIn("w0005 moved by 190.0 mm", told)
        self.assertIn("deleted: w0006", told)
        accepted = self.accept()
        lines = self.by_id(accepted)
        self.assertEqual(lines["w0005"]["properties"]["source"], "edited")
        self.assertEqual(lines["w0005"]["geometry"]["coordinates"], [[X - 0.25, Y - 3], [X - 0.25, Y + 3]])
        self.assertNotIn("w0006", lines)
        new = lines["e0002"]
        self.assertEqual(new["properties"]["source"], "added")
        self.assertEqual(new["geometry"]["coordinates"][0], [X + 1, round(Y - 2.123457, 6)])
        self.assertEqual(lines["w0001"]["properties"]["source"], "detected")
        self.assertEqual(lines["w0007"]["properties"]["colour"], "red")
        self.assertTrue(lines["w0007"]["properties"]["locked"])
        self.assertEqual(lines["w0007"]["properties"]["levels"], [0, 2])
        self.assertTrue(accepted["crs"]["properties"]["name"].startswith("LOCAL_CS"))

    def test_saving_without_a_change_changes_nothing(self):
        self.start_edit()
        before = self.accept()["roomcut"]["provenance"]["payload_sha256"]
        source = ogr.Open(self.edit, update=1)
        layer = source.GetLayer(0)
        feature = layer.GetNextFeature()
        layer.SetFeature(feature)
        del feature, layer
        source = None
        self.assertEqual(self.accept()["roomcut"]["provenance"]["payload_sha256"], before)

    def test_a_copy_by_ogr2ogr_and_one_through_a_geopackage_are_accepted(self):
        if shutil.which("ogr2ogr") is None:
            self.skipTest("ogr2ogr is not installed")
        self.start_edit()
        original = self.by_id(self.accept())
        package = os.path.join(self.work, "lines.gpkg")
        for steps in ([[self.edit + ".copy.geojson", self.edit]],
                      [[package, self.edit], [self.edit + ".back.geojson", package]]):
            for target, origin in steps:
                subprocess.run(["ogr2ogr", "-f", "GPKG" if target.endswith("gpkg") else "GeoJSON", target, origin],
                               check=True, capture_output=True)
            shutil.copy(self.edit, self.edit + ".kept")
            os.replace(steps[-1][0], self.edit)
            self.assertEqual(
                {name: line["geometry"] for name, line in self.by_id(self.accept()).items()},
                {name: line["geometry"] for name, line in original.items()})
            os.replace(self.edit + ".kept", self.edit)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
