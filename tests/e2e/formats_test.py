#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""E57, LAS and LAZ: what the decoders give is what an independent reading gives, damaged files are errors, and the formats of one
building give one cloud. Runs in the environment that `make deps` makes (BUILD/python); without it the test is skipped."""
import math
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from format_files import BUILD, DATA, INGEST, counts, decode, gone, ingest, laspy, numpy, pye57, room, rotate, said, turn, write_e57, write_las


class Decoders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_e57_gives_all_scans_in_common_coordinates_with_their_positions(self):
        world = room()
        for name, form in {"cartesian": {}, "spherical": {"spherical": True}, "scaled": {"scaled": 1e-5}}.items():
            with self.subTest(form=name):
                scans = []
                for k, (rotation, place) in enumerate([(turn(0.7, (0, 0, 1)), (2, 2, 1.5)), (turn(2.1, (1, 2, 3)), (500004, 5600003, 1.6))]):
                    local = rotate(rotation * (1, -1, -1, -1), world[k::2] - (2 + 2 * k, 2 + k, 1.5))
                    scans.append({"points": local, "rotation": rotation, "translation": place, **form})
                write_e57(self.path("r.e57"), scans)
                points, stations, dropped, error = decode(self.path("r.e57"))
                self.assertIsNone(error)
                self.assertEqual(dropped, (0, 0))
                numpy.testing.assert_allclose(stations, [s["translation"] for s in scans])
                wanted = numpy.concatenate([world[0::2], world[1::2] + (500000, 5600000, 0.1)])
                numpy.testing.assert_allclose(points, wanted, rtol=0, atol=3e-5)

    def test_e57_poses_may_miss_a_part_and_points_may_be_none(self):
        local = room(300)
        local[7] = local[8] = 0
        write_e57(self.path("p.e57"), [{"points": local, "translation": (1, 2, 3)}, {"points": numpy.empty((0, 3))},
                                       {"points": local, "rotation": turn(math.pi / 2, (0, 0, 1)), "invalid": numpy.arange(300) % 3},
                                       {"points": local}])
        points, stations, dropped, error = decode(self.path("p.e57"))
        self.assertIsNone(error)
        self.assertEqual(stations, [(1, 2, 3), (0, 0, 0)], "no pose, no position")
        valid = local[(numpy.arange(300) % 3 == 0) & (local != 0).any(axis=1)]
        self.assertEqual(dropped, (2 + 0 + 2, 200))
        numpy.testing.assert_allclose(points[:298], local[(local != 0).any(axis=1)] + (1, 2, 3))
        numpy.testing.assert_allclose(points[298:298 + len(valid)], valid[:, [1, 0, 2]] * (-1, 1, 1), atol=1e-12)

    def test_a_damaged_page_of_e57_is_named(self):
        write_e57(self.path("d.e57"), [{"points": room(5000)}])
        with open(self.path("d.e57"), "r+b") as file:
            file.seek(20 * 1024 + 100)
            byte = file.read(1)
            file.seek(-1, 1)
            file.write(bytes([byte[0] ^ 1]))
        done = ingest(self.path("d.e57"), self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"error\[C04\].*page 20 is damaged")
        self.assertIn("hint:", done.stderr)
        self.assertFalse(os.path.exists(self.path("10_ingest/cloud.h5")))

    def test_las_and_laz_of_every_point_format_give_exact_coordinates(self):
        world = room(3000) + (691234.5, 5334567.25, 500)
        for point_format in range(11):
            for ending in ("las", "laz"):
                with self.subTest(format=point_format, ending=ending):
                    path = self.path("f." + ending)
                    withheld = numpy.arange(3000) % 10 == 0
                    write_las(path, world, "1.4" if point_format > 5 else "1.3", point_format, 0.0001, (691000, 5334000, 0), withheld)
                    points, _, dropped, error = decode(path)
                    self.assertIsNone(error)
                    self.assertEqual(dropped, (0, 300))
                    las = laspy.read(path)
                    wanted = numpy.stack((las.X * 0.0001 + 691000, las.Y * 0.0001 + 5334000, las.Z * 0.0001), axis=1)[~withheld]
                    numpy.testing.assert_array_equal(points, wanted)

    def test_coordinate_system_and_set_ups_of_las_are_said_and_kept(self):
        wkt = 'PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89"],UNIT["metre",1],AUTHORITY["EPSG","25832"]]'
        keys = struct.pack("<12H", 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 25832)
        for name, record, wanted in (("wkt", laspy.VLR("LASF_Projection", 2112, "", wkt.encode() + b"\0"), wkt),
                                     ("keys", laspy.VLR("LASF_Projection", 34735, "", keys), "EPSG:25832"), ("none", None, None)):
            with self.subTest(crs=name):
                las = laspy.LasData(laspy.LasHeader(version="1.4", point_format=6))
                las.header.scales = [0.001] * 3
                if record:
                    las.header.vlrs.append(record)
                las.x, las.y, las.z = room().T
                las.point_source_id = numpy.arange(20000) % 3 + 7 if name == "wkt" else numpy.full(20000, 7)
                las.write(self.path("c.laz"))
                done = ingest(self.path("c.laz"), self.path("w"))
                self.assertEqual(done.returncode, 0, done.stderr)
                said_there = done.stdout + done.stderr
                self.assertEqual("3 set-ups by the points' source ids (7 ... 9)" in said_there, name == "wkt", said_there)
                dump = subprocess.run(["h5dump", "-A", "-g", "/frame", self.path("w/10_ingest/cloud.h5")], capture_output=True, text=True,
                                      check=True).stdout.replace('\\"', '"')
                if wanted:
                    self.assertIn(wanted, dump)
                    self.assertIn("coordinate system: " + ("ETRS89 / UTM zone 32N" if name == "wkt" else wanted), said_there)
                else:
                    self.assertNotIn("crs", dump)

    def test_normals_of_e57_turn_with_their_scan(self):
        world = room(3000)
        normals = numpy.tile((0.6, 0.0, 0.8), (3000, 1))
        quarter = turn(math.pi / 2, (0, 0, 1))
        write_e57(self.path("n.e57"), [{"points": world, "normals": normals, "rotation": quarter}, {"points": world}])
        points, _, _, error = decode(self.path("n.e57"))
        self.assertIsNone(error)
        numpy.testing.assert_allclose(points[:3000], rotate(quarter, world), atol=1e-9)
        numpy.testing.assert_allclose(said["normals"][:3000], rotate(quarter, normals), atol=1e-6)
        self.assertFalse(said["normals"][3000:].any(), "no normal, no direction")
        self.assertEqual(ingest(self.path("n.e57"), self.path("w")).returncode, 0)

    def test_las_with_fewer_or_more_points_than_promised_is_refused(self):
        write_las(self.path("a.las"), room(1000))
        with open(self.path("a.las"), "rb") as file:
            whole = file.read()
        for name, content in {"fewer": whole[:-500], "more": whole[:107] + struct.pack("<I", 400) + whole[111:],
                              "huge": whole[:107] + struct.pack("<I", 4000000000) + whole[111:]}.items():
            with self.subTest(case=name):
                with open(self.path("b.las"), "wb") as file:
                    file.write(content)
                done = ingest(self.path("b.las"), self.folder)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn("error[C05]", done.stderr)
                self.assertIn("hint:", done.stderr)

    def test_all_formats_of_one_building_give_one_cloud(self):
        world = numpy.round(room(30000), 4) + 0.0  # no -0
        text = "".join(f"{x:.4f} {y:.4f} {z:.4f}\n" for x, y, z in world)
        header = "ply\nformat ascii 1.0\nelement vertex 30000\nproperty double x\nproperty double y\nproperty double z\nend_header\n"
        with open(self.path("s.ply"), "w", encoding="ascii") as out:
            out.write(header + text)
        with open(self.path("s.ptx"), "w", encoding="ascii") as out:
            out.write("30000\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n" + text)
        write_e57(self.path("s.e57"), [{"points": world}])
        write_las(self.path("s.las"), world)
        write_las(self.path("s.laz"), world)
        clouds = {}
        for ending in ("ply", "ptx", "e57", "las", "laz"):
            work = self.path(ending)
            done = ingest(self.path("s." + ending), work)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(counts(work)["kept"], 30000)
            dump = subprocess.run(["h5dump", "-m", "%.4f", "-w", "1000", "-d", "/points/x", "-d", "/points/z", "-d", "/points/surface",
                                   os.path.join(work, "10_ingest", "cloud.h5")], capture_output=True, text=True, check=True).stdout
            clouds[ending] = re.sub(r"HDF5 .*\n", "", dump)
        for ending, cloud in clouds.items():
            self.assertEqual(cloud, clouds["ply"], ending)

    def test_threads_do_not_matter_to_a_decoded_scan_nor_does_reading_it_again_to_level_it(self):
        lean = turn(math.radians(1.2), (1, 0.5, 0))
        write_las(self.path("t.laz"), rotate(lean, room(400000, (9.0, 14.0, 2.6))), withheld=numpy.arange(400000) % 3 == 0)
        clouds = []
        for threads in "1", "2", "5":
            done = ingest(self.path("t.laz"), self.path("w"), "--threads", threads)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("it was levelled by its floors", done.stderr)
            self.assertEqual(counts(self.path("w"))["invalid"], 133334)
            with open(self.path("w/10_ingest/cloud.h5"), "rb") as file:
                clouds.append(file.read())
        self.assertEqual(clouds[0], clouds[1])
        self.assertEqual(clouds[0], clouds[2])

    def test_promises_that_no_file_can_hold_are_refused_at_once(self):
        write_las(self.path("h.laz"), room(3000), "1.4", 6)
        with open(self.path("h.laz"), "r+b") as file:
            file.seek(247)
            file.write(struct.pack("<Q", 1 << 40))
        done = ingest(self.path("h.laz"), self.path("w"))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("error[C05]", done.stderr)
        self.assertIn("promise 1099511627776 points", done.stderr)

    def test_points_outside_of_the_box_in_the_header_are_questioned(self):
        for ending in ("las", "laz"):
            write_las(self.path("b." + ending), room(), offset=(1, 2, 3))
            self.assertNotIn("outside of the box", ingest(self.path("b." + ending), self.path("w")).stderr)
            with open(self.path("b." + ending), "r+b") as file:
                file.seek(131)  # x scale
                file.write(struct.pack("<d", 0.0002))
            done = ingest(self.path("b." + ending), self.path("w"))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("outside of the box that its header states", done.stderr)

    def own_ingest(self):
        """A copy of the program in a build folder of its own, whose decoders can be replaced; its path."""
        os.mkdir(self.path("bin"))
        os.symlink(os.path.join(BUILD, "python"), self.path("python"))
        os.mkdir(self.path("decoders"))
        shutil.copy(INGEST, self.path("bin/ingest"))
        return self.path("bin/ingest")

    def left(self):
        return [file for _, _, files in os.walk(self.path("w")) for file in files if file != "ingest.json"]

    def test_a_decoder_that_dies_leaves_an_error_and_no_half_cloud(self):
        write_las(self.path("k.las"), room(200000))
        copy = self.own_ingest()
        write = "import os, signal, struct, sys; put = lambda k, b: sys.stdout.buffer.write(k + struct.pack('<Q', len(b)) + b); "
        head = write + "put(b'B', struct.pack('<2Q6d', 200000, 0, *[1.0] * 6)); put(b'P', bytes(24 * 150000)); sys.stdout.flush(); "
        death = {"says nothing": "pass", "closes the pipe": "import os, signal; os.close(1); signal.pause()",
                 "stops": write + "sys.stdout.buffer.write(b'P'); sys.stdout.flush(); os._exit(0)",
                 "stops behind points": head + "sys.stdout.buffer.write(b'P'); sys.stdout.flush(); os._exit(0)",
                 "is killed": "import os; os.kill(os.getpid(), 9)", "is killed behind points": head + "os.kill(os.getpid(), 9)",
                 "is stopped": "import os, signal; os.kill(os.getpid(), signal.SIGSTOP)",
                 "is stopped behind points": head + "os.kill(os.getpid(), signal.SIGSTOP)",
                 "is stopped behind the end": head + "put(b'E', struct.pack('<Q', 150000)); sys.stdout.flush(); os.kill(os.getpid(), signal.SIGSTOP)",
                 "fails": "raise SystemExit('no luck')", "fails behind points": head + "raise SystemExit('no luck')",
                 "fails behind the end": head + "put(b'E', struct.pack('<Q', 150000)); raise SystemExit('no luck')",
                 "ends without the end": head, "points before the head": write + "put(b'P', bytes(48)); put(b'E', struct.pack('<Q', 2))",
                 "lies": head + "put(b'E', struct.pack('<Q', 150001))", "gives half a point": head + "put(b'P', bytes(20))",
                 "gives more than it said": head + "put(b'P', bytes(24 * 50001))",
                 "claims": "import sys; sys.stdout.buffer.write(b'N' + bytes([255] * 8))", "babbles": "while True: print('text')"}
        for name, program in death.items():
            with self.subTest(decoder=name):
                with open(self.path("decoders/las.py"), "w", encoding="ascii") as out:
                    out.write(program)
                done = subprocess.run([copy, "--scan", self.path("k.las"), "--work", self.path("w")], capture_output=True, text=True,
                                      check=False, timeout=60)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertRegex(done.stderr, r"error\[C04\].*decoder did not come to the end")
                self.assertIn("hint:", done.stderr)
                self.assertEqual(self.left(), [])
        os.remove(self.path("python"))
        done = subprocess.run([copy, "--scan", self.path("k.las"), "--work", self.path("w")], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertIn("error[C12]", done.stderr)
        self.assertIn("make deps", done.stderr)

    def test_killed_at_any_moment_the_decoder_is_an_error_and_ingest_leaves_nothing(self):
        world = room(1500000)
        write_las(self.path("k.laz"), world)
        begun = time.monotonic()
        self.assertEqual(ingest(self.path("k.laz"), self.path("whole")).returncode, 0)
        whole = time.monotonic() - begun
        for victim in ("decoder", "ingest"):
            ended_early = 0
            for moment in range(6):
                with self.subTest(victim=victim, moment=moment):
                    shutil.rmtree(self.path("w"), ignore_errors=True)
                    process = subprocess.Popen([INGEST, "--scan", self.path("k.laz"), "--work", self.path("w")], stderr=subprocess.PIPE, text=True)
                    time.sleep(whole * (0.05 + 0.12 * moment))
                    with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as text:
                        decoders = [int(child) for child in text.read().split()]
                    for child in decoders if victim == "decoder" else [process.pid]:
                        os.kill(child, signal.SIGKILL)
                    _, error = process.communicate(timeout=60)
                    if process.returncode == 0:
                        continue  # it had done its work by then
                    ended_early += 1
                    if victim == "decoder":
                        self.assertEqual(process.returncode, 3, error)
                        self.assertRegex(error, r"error\[C04\].*ended by signal 9")
                        self.assertEqual(self.left(), [])
                    else:
                        self.assertFalse(os.path.exists(self.path("w/10_ingest/cloud.h5")))
                        for child in decoders:
                            self.assertTrue(gone(child), "a decoder without ingest goes on")
            self.assertGreater(ended_early, 0)

    def test_mutated_files_are_read_or_refused_with_a_remedy(self):
        world = room(2000)
        write_e57(self.path("m.e57"), [{"points": world, "rotation": turn(1, (0, 0, 1)), "translation": (1, 2, 3)}])
        write_las(self.path("m.las"), world)
        write_las(self.path("m.laz"), world)
        draw = numpy.random.default_rng(7)
        for ending in ("e57", "las", "laz"):
            with open(self.path("m." + ending), "rb") as file:
                whole = file.read()
            for k in range(12):
                content = bytearray(whole)
                if k % 4 == 0:
                    content = content[:draw.integers(1, len(content))]
                else:
                    for at in draw.integers(0, 400 if k % 2 else len(content), 3):
                        content[at] = draw.integers(0, 256)
                path = self.path(f"m{k}." + ending)
                with open(path, "wb") as file:
                    file.write(content)
                done = ingest(path, self.path("w"))
                with self.subTest(file=ending, mutation=k):
                    self.assertIn(done.returncode, (0, 3), done.stderr)
                    if done.returncode == 3:
                        self.assertRegex(done.stderr, r"error\[C\d\d\]")
                        self.assertIn("hint:", done.stderr)


class SharedFiles(unittest.TestCase):
    """The small files of other projects, against pye57 and laspy themselves."""

    def setUp(self):
        if not os.path.isdir(DATA):
            self.skipTest("skipped: no ../shared/data")

    def test_e57(self):
        refused = {"corrupt_crc": "C04", "olv_InvalidFileLength": "C04", "empty": "C06", "empty_pc": "C06", "olv_ZeroPoints": "C06",
                   "olv_InvalidCVHeader": "C06", "olv_NoPrototype": None}
        for name in sorted(os.listdir(DATA)):
            stem, ending = os.path.splitext(name)
            if ending != ".e57":
                continue
            with self.subTest(file=name):
                points, _, dropped, error = decode(os.path.join(DATA, name))
                if stem in refused:
                    if refused[stem]:
                        self.assertEqual(error.split("\n")[0], refused[stem])
                    continue
                self.assertIsNone(error)
                with pye57.E57(os.path.join(DATA, name)) as file:
                    wanted = []
                    for index in range(file.scan_count):
                        data = file.read_scan(index, ignore_missing_fields=True)
                        wanted.append(numpy.stack([data["cartesian" + axis] for axis in "XYZ"], axis=1))
                wanted = numpy.concatenate(wanted)
                self.assertEqual(len(points), len(wanted) - dropped[0])
                numpy.testing.assert_allclose(points, wanted[wanted.any(axis=1)] if dropped[0] else wanted, rtol=0, atol=1e-9)

    def test_las(self):
        for name in sorted(os.listdir(DATA)):
            stem, ending = os.path.splitext(name)
            if ending not in (".las", ".laz"):
                continue
            with self.subTest(file=name):
                points, _, dropped, error = decode(os.path.join(DATA, name))
                if stem.startswith(("broken_", "no-points")):
                    self.assertIn(error.split("\n")[0], ("C04", "C06"))
                    continue
                self.assertIsNone(error)
                twin = os.path.join(DATA, stem + ".las")  # holds the same, and every library reads it
                las = laspy.read(twin if os.path.exists(twin) else os.path.join(DATA, name))
                kept = ~numpy.asarray(las.withheld, bool)
                wanted = numpy.stack((las.x, las.y, las.z), axis=1)[kept]
                self.assertEqual(dropped[1], (~kept).sum())
                numpy.testing.assert_array_equal(points, wanted)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
