#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rasters of `make layers` as GDAL, the library behind QGIS, sees them: in the same place as the wall lines.

usage: gdal_layers_test.py SOURCE_DIR BIN_DIR
"""
import glob
import os
import subprocess
import sys
import tempfile
import unittest

try:
    from osgeo import gdal, ogr
except ImportError:
    print("skipped: python3-gdal is not installed")
    sys.exit(77)

gdal.UseExceptions()
ogr.UseExceptions()
SOURCE, BIN = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


class GdalLayers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = cls.folder.name
        scan = os.path.join(cls.work, "scan.ply")
        cls.run_program("synthesize", "--scene", os.path.join(SOURCE, "tests/data/scenes/one_room.json"), "--scan-out", scan)
        cls.run_program("ingest", "--scan", scan)
        for name in ("slice", "detect_lines"):
            cls.run_program(name)
        cls.run_program("report", "--only", "layers")
        cls.rasters = sorted(glob.glob(os.path.join(cls.work, "edits/slice_*.png")))
        cls.lines = ogr.Open(os.path.join(cls.work, "30_detect_lines/wall_lines.geojson"))

    @classmethod
    def tearDownClass(cls):
        cls.lines = None
        cls.folder.cleanup()

    @classmethod
    def run_program(cls, name, *options):
        done = subprocess.run([os.path.join(BIN, name), "--work", cls.work, "-q", *options], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise AssertionError(done.stderr)

    def features(self):
        layer = self.lines.GetLayer(0)
        layer.ResetReading()
        return [feature.GetGeometryRef().Clone() for feature in layer]

    def test_there_is_a_raster_for_the_slice(self):
        self.assertEqual([os.path.basename(name) for name in self.rasters], ["slice_0.png"])

    def test_the_coordinate_system_is_that_of_the_lines(self):
        system = gdal.Open(self.rasters[0]).GetSpatialRef()
        self.assertTrue(system.IsLocal())
        self.assertEqual(system.GetLinearUnits(), 1.0)
        self.assertTrue(system.IsSame(self.lines.GetLayer(0).GetSpatialRef()))

    def test_the_world_file_alone_puts_it_in_the_same_place(self):
        both = gdal.Open(self.rasters[0]).GetGeoTransform()
        aux = self.rasters[0] + ".aux.xml"
        os.rename(aux, aux + ".kept")
        try:
            alone = gdal.Open(self.rasters[0]).GetGeoTransform()
        finally:
            os.rename(aux + ".kept", aux)
        for one, other in zip(both, alone):
            self.assertAlmostEqual(one, other, places=8)

    def test_the_lines_lie_on_dark_cells_and_the_room_is_white(self):
        raster = gdal.Open(self.rasters[0])
        left, cell, _, top, _, minus = raster.GetGeoTransform()
        self.assertAlmostEqual(minus, -cell)
        values = raster.GetRasterBand(1).ReadAsArray()

        def darkest(x, y):  # of the cell and those around it: a line may run along the border of two
            column, row = int((x - left) / cell), int((y - top) / minus)
            return values[row - 1:row + 2, column - 1:column + 2].min()

        lines = self.features()
        self.assertGreaterEqual(len(lines), 4)
        for line in lines:
            points = [line.Value(share * line.Length()) for share in (0.1, 0.3, 0.5, 0.7, 0.9)]
            dark = sum(darkest(point.GetX(), point.GetY()) < 200 for point in points)
            self.assertGreaterEqual(dark, 4, line.ExportToWkt())
        self.assertGreater((values == 255).mean(), 0.5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
