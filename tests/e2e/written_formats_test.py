#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `synthesize` writes as PTX, E57, LAS and LAZ is, read independently, the scan that it writes as PLY; `ingest` finds its scanner
positions; a run on it finds the truth. Needs the environment that `make deps` makes (BUILD/python); without it the test is skipped."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import pipeline
from format_files import BUILD, laspy, numpy, pye57  # skips where the environment is missing

SCENE = {"name": "two rooms", "noise_m": 0.003,
         "storeys": [{"floor": 0, "ceiling": 2.6, "rooms": [{"name": "a", "polygon": [[0, 0], [5, 0], [5, 4], [0, 4]]},
                                                            {"name": "b", "polygon": [[5.2, 0], [9, 0], [9, 4], [5.2, 4]]}]}],
         "doors": [{"between": ["a", "b"], "at": [5.1, 2]}], "sampling": {"kind": "tripod", "points": 200000}}
FORMS = {"s.ptx": (), "s.e57": (), "spherical.e57": ("--e57", "spherical"), "s.las": (), "s.laz": ()}
RESOLUTION = {".ptx": 2e-6, ".e57": 1e-5, ".las": 0.51e-4, ".laz": 0.51e-4}  # of a coordinate [m]


WKT = ('PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_1989",SPHEROID["GRS 1980",6378137,298.257222101]],'
       'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],'
       'PARAMETER["central_meridian",9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],'
       'UNIT["metre",1],AUTHORITY["EPSG","25832"]]')


def read_ply(path):
    with open(path, "rb") as file:
        content = file.read()
    return numpy.frombuffer(content, "<f4", offset=content.index(b"end_header\n") + len(b"end_header\n")).reshape(-1, 3).astype(float)


def read_ptx(path):
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")
    points, at = [], 0
    while at < len(lines) - 1:
        count = int(lines[at]) * int(lines[at + 1])
        matrix = numpy.array([line.split() for line in lines[at + 6:at + 10]], float)
        own = numpy.array([line.split()[:3] for line in lines[at + 10:at + 10 + count]], float)
        points.append(own @ matrix[:3, :3] + matrix[3, :3])
        at += 10 + count
    return numpy.concatenate(points)


def read_independently(path):
    ending = os.path.splitext(path)[1]
    if ending == ".ptx":
        return read_ptx(path)
    if ending == ".e57":
        with pye57.E57(path) as file:
            scans = [file.read_scan(index, ignore_missing_fields=True) for index in range(file.scan_count)]
        return numpy.concatenate([numpy.stack([scan["cartesian" + axis] for axis in "XYZ"], axis=1) for scan in scans])
    return laspy.read(path).xyz


def numbers(work, *what):
    dump = subprocess.run(["h5dump", "-m", "%.6f", "-y", *what, os.path.join(work, "10_ingest", "cloud.h5")],
                          capture_output=True, text=True, check=True).stdout
    return numpy.array(re.findall(r"-?\d+\.\d{6}", dump), float).reshape(-1, 3)


def positions_found(work):
    """In the scan's own coordinates."""
    return numbers(work, "-d", "/stations/xyz") + numbers(work, "-a", "/frame/origin")


class WrittenFormats(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        with open(self.path("scene.json"), "w", encoding="utf-8") as out:
            json.dump(SCENE, out)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def synthesize(self, name, *options, check=True, program=None):
        return pipeline.run([program or os.path.join(BUILD, "bin", "synthesize"), "-q", "--work", self.folder, "--scene",
                             self.path("scene.json"), "--scan-out", self.path(name), *options], check=check)

    def truth(self):
        with open(self.path("truth.json"), encoding="utf-8") as text:
            return json.load(text)

    def test_every_format_holds_the_points_of_the_ply(self):
        self.synthesize("s.ply")
        wanted = read_ply(self.path("s.ply"))
        for name, options in FORMS.items():
            with self.subTest(file=name):
                self.synthesize(name, *options)
                numpy.testing.assert_allclose(read_independently(self.path(name)), wanted, rtol=0,
                                              atol=RESOLUTION[os.path.splitext(name)[1]])

    def test_set_ups_have_their_poses_and_ingest_finds_the_positions(self):
        for name, options in FORMS.items():
            self.synthesize(name, *options)
        stations = [station["position"] for station in self.truth()["stations"]]
        self.assertEqual(len(stations), 2)
        with pye57.E57(self.path("s.e57")) as file:
            for index, station in enumerate(stations):
                header = file.get_header(index)
                numpy.testing.assert_allclose(header.translation, station, atol=1e-9)
                self.assertGreater(numpy.abs(header.rotation_matrix - numpy.eye(3)).max(), 0.1, "it is turned")
        self.assertEqual(sorted(set(laspy.read(self.path("s.laz")).point_source_id)), [1, 2])
        for name in FORMS:
            work = self.path("work of " + name)
            pipeline.stage("ingest", "--scan", self.path(name), "--work", work)
            with self.subTest(file=name):
                found = positions_found(work)
                if name.endswith(("las", "laz")):
                    self.assertEqual(len(found), 0, "the format has none")
                else:
                    numpy.testing.assert_allclose(found, stations, rtol=0, atol=1e-3)

    def test_a_run_on_e57_finds_rooms_and_volume_of_the_truth(self):
        self.synthesize("s.e57", "--e57", "spherical")
        work = self.path("run")
        pipeline.make("extract", self.path("s.e57"), work)
        summary, truth = pipeline.summary(work), self.truth()
        self.assertEqual(sum(storey["rooms"] for storey in summary["storeys"]), len(truth["rooms"]))
        self.assertAlmostEqual(summary["totals"]["volume_m3"], truth["volume"], delta=0.01 * truth["volume"])

    def test_the_coordinate_system_of_a_scan_goes_with_every_output(self):
        self.synthesize("s.ply")
        las = laspy.LasData(laspy.LasHeader(version="1.4", point_format=6))
        las.header.scales, las.header.offsets = [0.0001] * 3, (691000, 5334000, 0)
        las.header.global_encoding.wkt = True
        las.header.vlrs.append(laspy.VLR("LASF_Projection", 2112, "", WKT.encode() + b"\0"))
        las.x, las.y, las.z = (read_ply(self.path("s.ply")) + (691234.5, 5334567.25, 512)).T
        las.write(self.path("site.laz"))
        work = self.path("site")
        pipeline.make("extract", self.path("site.laz"), work)
        pipeline.make("layers", self.path("site.laz"), work)
        for name in ("30_detect_lines/wall_lines", "80_refine_lines/wall_lines", "95_find_openings/openings"):
            with open(os.path.join(work, name + ".geojson"), encoding="utf-8") as text:
                self.assertEqual(json.load(text)["crs"]["properties"]["name"], WKT, name)
        self.assertEqual(pipeline.summary(work)["frame"]["crs"], WKT)
        for name, form in {"edits/slice_0.prj": WKT, "edits/slice_0.png.aux.xml": f"<SRS>{WKT}</SRS>".replace('"', "&quot;"),
                           "model.ply": "coordinate system: " + WKT, "model.obj": "coordinate system: " + WKT}.items():
            with open(os.path.join(work, name), "rb") as file:
                self.assertIn(form.encode(), file.read(), name)

    def test_the_same_scene_is_the_same_file_with_any_number_of_threads(self):
        for name, options in FORMS.items():
            with self.subTest(file=name):
                contents = []
                for threads in ("1", "3"):
                    self.synthesize(name, *options, "--threads", threads)
                    with open(self.path(name), "rb") as file:
                        contents.append(file.read())
                self.assertEqual(contents[0], contents[1])

    def test_a_uniform_scan_has_no_positions(self):
        with open(self.path("scene.json"), "w", encoding="utf-8") as out:
            json.dump({**SCENE, "sampling": {"points": 50000}}, out)
        self.synthesize("s.ply")
        for name in ("s.ptx", "s.e57", "s.laz"):
            self.synthesize(name)
            with self.subTest(file=name):
                numpy.testing.assert_allclose(read_independently(self.path(name)), read_ply(self.path("s.ply")), rtol=0, atol=1e-4)
                pipeline.stage("ingest", "--scan", self.path(name), "--work", self.path("work of " + name))
                self.assertEqual(len(positions_found(self.path("work of " + name))), 0)

    def test_what_cannot_be_written_leaves_nothing_and_says_what_to_do(self):
        for place in ("bin", "encoders"):
            os.mkdir(self.path(place))
        program = self.path("bin", "synthesize")
        shutil.copy(os.path.join(BUILD, "bin", "synthesize"), program)
        done = self.synthesize("s.e57", check=False, program=program)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("error[C12]", done.stderr)
        self.assertIn("make deps", done.stderr)
        os.symlink(os.path.join(BUILD, "python"), self.path("python"))
        for ending, script in {"fails": "import sys\nsys.exit('no luck')", "is killed": "import os\nos.kill(os.getpid(), 9)",
                               "reads little": "import sys\nsys.stdin.buffer.read(100000)\nsys.exit('disk full')"}.items():
            with self.subTest(encoder=ending):
                with open(self.path("encoders", "e57.py"), "w", encoding="ascii") as out:
                    out.write(script)
                done = self.synthesize("s.e57", check=False, program=program)
                self.assertEqual(done.returncode, 5, done.stderr)
                self.assertRegex(done.stderr, r"error\[O01\].*encoder")
        done = self.synthesize("s.pts", check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("error[U01]", done.stderr)
        self.assertEqual([name for name in os.listdir(self.folder) if "s.e57" in name or "s.pts" in name], [])

    def test_an_interrupted_one_leaves_nothing_half_written(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen([os.path.join(BUILD, "bin", "synthesize"), "-q", "--work", self.folder, "--scene", self.path("scene.json"),
                                   "--scan-out", self.path("s.laz"), "--set", "points=20000000"], stderr=subprocess.DEVNULL) as process:
                deadline = time.monotonic() + 20
                while not any("s.laz" in name for name in os.listdir(self.folder)) and time.monotonic() < deadline:
                    time.sleep(0.02)
                process.send_signal(number)
                self.assertNotEqual(process.wait(timeout=20), 0)
            self.assertEqual([name for name in os.listdir(self.folder) if "s.laz" in name], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
