#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`make view` on a real run, over real sockets: what it serves, what it takes, and everything it must refuse.

usage: view_test.py SOURCE_DIR BUILD_DIR
"""
import json
import os
import socket
import subprocess
import sys
import time
import unittest

from view_case import LIMIT, MOVE_M, SOURCE, ViewCase, alive, largest_x, read


class View(ViewCase):
    def test_the_page_its_pictures_and_the_results_are_served_as_they_lie_there(self):
        pictures = sorted(os.listdir(os.path.join(self.work, "pictures")))
        self.assertTrue(any(name.endswith(".svg") for name in pictures))
        for path, file in [("/", "report.html"), ("/report.html", "report.html"), ("/model.ply", "model.ply"),
                           ("/model.obj", "model.obj"), ("/summary.json", "summary.json"),
                           *(("/pictures/" + name, "pictures/" + name) for name in pictures)]:
            with self.subTest(path=path):
                status, headers, body = self.ask("GET", path)
                self.assertEqual(status, 200)
                self.assertEqual(body, read(os.path.join(self.work, file)))
                self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
                self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])
                self.assertNotIn("Access-Control-Allow-Origin", headers)

    def test_it_listens_on_loopback_only(self):
        addresses = []
        for table in ("/proc/net/tcp", "/proc/net/tcp6"):
            for line in read(table).decode().splitlines()[1:]:
                address, port = line.split()[1].split(":")
                if int(port, 16) == self.port and line.split()[3] == "0A":
                    addresses.append(address)
        self.assertEqual(addresses, ["0100007F"])

    def test_status_names_the_work_folder(self):
        self.assertEqual(json.loads(self.ask("GET", "/api/status")[2]),
                         {"work": "w o r k", "running": False, "stage": None, "error": None, "edit": False})
        self.assertEqual(self.ask("PUT", "/api/edit", self.moved_edit())[0], 200)
        self.assertTrue(json.loads(self.ask("GET", "/api/status")[2])["edit"])

    def test_files_are_sent_as_they_are_though_browsers_take_them_packed(self):
        for path in ("/", "/model.obj"):
            status, headers, body = self.ask("GET", path, headers={"Accept-Encoding": "gzip, deflate, br, zstd"})
            self.assertEqual(status, 200)
            self.assertNotIn("Content-Encoding", headers)
            self.assertEqual(body, read(os.path.join(self.work, "report.html" if path == "/" else path[1:])))

    # What is refused.

    def test_nothing_else_is_served(self):
        self.assertTrue(os.path.exists(os.path.join(self.work, "logs/ingest.json")))
        for path in ["/logs/ingest.json", "/stamps/ingest", "/inputs/scan.path", "/10_ingest/cloud.h5", "/pictures/", "/pictures",
                     "/edits/wall_lines.geojson", "/../truth.off", "/%2e%2e/truth.off", "/..%2ftruth.off", "/%2e%2e%2ftruth.off",
                     "/pictures/../logs/ingest.json", "/pictures/%2e%2e/logs/ingest.json", "/pictures/..%2flogs%2fingest.json",
                     "/pictures/%252e%252e/summary.json", "//etc/passwd", "/etc/passwd", "/pictures//etc/passwd", "/model.ply/",
                     "/model.ply%00.png", "/pictures/.hidden.png", "/pictures/..png", "/api", "/api/", "/api/none"]:
            with self.subTest(path=path):
                self.assertIn(self.ask("GET", path)[0], (403, 404))

    def test_no_symbolic_link_is_followed(self):
        secret = os.path.join(self.folder.name, "truth.off")
        link = os.path.join(self.work, "pictures", "link.png")
        os.symlink(secret, link)
        obj, kept = os.path.join(self.work, "model.obj"), os.path.join(self.work, "model.obj.kept")
        pictures, aside = os.path.join(self.work, "pictures"), os.path.join(self.work, "pictures.kept")
        os.rename(obj, kept)
        os.symlink(secret, obj)
        try:
            self.assertEqual(self.ask("GET", "/pictures/link.png")[0], 404)
            self.assertEqual(self.ask("GET", "/model.obj")[0], 404)
            self.assertEqual(self.ask("GET", "/pictures/model.png")[0], 200)
            os.rename(pictures, aside)
            os.symlink(aside, pictures)
            self.assertEqual(self.ask("GET", "/pictures/model.png")[0], 404)
            os.symlink(secret, self.edit)
            self.assertEqual(self.ask("GET", "/api/edit")[0], 404)
        finally:
            os.replace(kept, obj)
            if os.path.isdir(aside):
                os.remove(pictures)
                os.rename(aside, pictures)
            os.remove(link)

    def test_other_names_of_the_server_are_refused(self):
        for host in ["evil.example", f"evil.example:{self.port}", "127.0.0.1", "127.0.0.1:1", f"127.0.0.1.evil.example:{self.port}",
                     f"localhost.:{self.port}", f"0.0.0.0:{self.port}", ""]:
            with self.subTest(host=host):
                self.assertEqual(self.raw(f"GET / HTTP/1.1\nHost: {host}\n\n"), 403)
        self.assertEqual(self.raw("GET / HTTP/1.0\n\n"), 403)
        self.assertEqual(self.raw(f"GET / HTTP/1.1\nHost: 127.0.0.1:{self.port}\nHost: evil.example\n\n"), 403)
        for host in [f"localhost:{self.port}", f"LOCALHOST:{self.port}", f"[::1]:{self.port}", f"127.0.0.1:{self.port}"]:
            self.assertEqual(self.ask("GET", "/api/status", host=host)[0], 200, host)

    def test_other_pages_are_refused(self):
        edit = self.moved_edit()
        for origin in ["http://evil.example", "null", "http://127.0.0.1", f"https://127.0.0.1:{self.port}",
                       "http://127.0.0.1:1", f"http://127.0.0.1:{self.port}.evil.example"]:
            for method, path in [("GET", "/api/status"), ("GET", "/"), ("PUT", "/api/edit"), ("POST", "/api/run"),
                                 ("DELETE", "/api/edit")]:
                with self.subTest(origin=origin, method=method, path=path):
                    body = edit if method == "PUT" else None
                    self.assertEqual(self.ask(method, path, body, {"Origin": origin})[0], 403)
        self.assertFalse(os.path.exists(self.edit))
        self.assertEqual(self.ask("GET", "/api/status", headers={"Origin": f"http://localhost:{self.port}"})[0], 200)

    def test_changes_without_the_mark_are_refused(self):
        for mark in [None, "0", "yes"]:
            for method, path in [("PUT", "/api/edit"), ("POST", "/api/run"), ("DELETE", "/api/edit")]:
                with self.subTest(method=method, mark=mark):
                    body = self.moved_edit() if method == "PUT" else None
                    self.assertEqual(self.ask(method, path, body, {"X-Roomcut": mark}, mark=False)[0], 403)
        self.assertFalse(os.path.exists(self.edit))
        self.assertFalse(json.loads(self.ask("GET", "/api/run")[2])["running"])

    def test_preflights_and_unknown_methods_are_refused(self):
        status, headers, _ = self.ask("OPTIONS", "/api/edit", headers={"Origin": "http://evil.example", "Access-Control-Request-Method": "PUT",
                                                                       "Access-Control-Request-Headers": "x-roomcut"})
        self.assertEqual(status, 403)
        self.assertFalse([name for name in headers if name.lower().startswith("access-control")])
        for method in ["OPTIONS", "PATCH", "TRACE"]:
            self.assertIn(self.ask(method, "/api/edit")[0], (400, 405), method)

    def test_bodies_over_the_limit_of_no_known_length_or_packed_are_refused(self):
        edit = self.moved_edit()
        self.assertEqual(self.ask("PUT", "/api/edit", headers={"Content-Length": str(LIMIT + 1)})[0], 413)
        self.assertEqual(self.ask("PUT", "/api/edit", headers={"Content-Length": "9" * 30})[0], 411, "no number")
        self.assertEqual(self.ask("POST", "/api/run", headers={"Content-Length": str(LIMIT + 1)})[0], 413)
        self.assertEqual(self.ask("PUT", "/api/edit", b"5\r\nhello\r\n0\r\n\r\n",
                                  {"Content-Length": None, "Transfer-Encoding": "chunked"})[0], 411)
        self.assertEqual(self.ask("PUT", "/api/edit")[0], 411)
        self.assertEqual(self.ask("POST", "/api/run", headers={"Content-Length": None})[0], 411)
        self.assertEqual(self.ask("PUT", "/api/edit", headers={"Content-Length": "-1"})[0], 411)
        self.assertEqual(self.ask("PUT", "/api/edit", edit, {"Content-Encoding": "gzip"})[0], 415)
        for kind in ["text/plain", "multipart/form-data; boundary=x", "application/x-www-form-urlencoded", None]:
            self.assertEqual(self.ask("PUT", "/api/edit", edit, {"Content-Type": kind})[0], 415, kind)
        self.assertFalse(os.path.exists(self.edit))
        self.assertEqual(self.ask("PUT", "/api/edit", edit + b" " * (LIMIT - len(edit)))[0], 200, "the limit itself is taken")

    # What is taken.

    def test_an_edit_is_taken_kept_and_dropped(self):
        first, second = self.moved_edit(), self.moved_edit(0.1)
        self.assertEqual(self.ask("GET", "/api/edit")[0], 404)
        status, _, body = self.ask("PUT", "/api/edit", first)
        self.assertEqual(status, 200)
        answer = json.loads(body)
        self.assertTrue(answer["accepted"])
        self.assertTrue([line for line in answer["changes"] if "moved by 250.0 mm" in line], answer)
        self.assertEqual(answer["warnings"], [])
        self.assertEqual(read(self.edit), first)
        self.assertEqual(self.ask("GET", "/api/edit")[2], first)
        self.assertEqual(self.ask("PUT", "/api/edit", first)[0], 200)
        self.assertFalse(os.path.exists(self.old), "the same bytes again make no copy")
        self.assertEqual(self.ask("PUT", "/api/edit", second, {"Content-Type": "application/json; charset=utf-8"})[0], 200)
        self.assertEqual(read(self.edit), second)
        self.assertEqual(read(os.path.join(self.old, "wall_lines.1.geojson")), first)
        status, _, body = self.ask("DELETE", "/api/edit")
        self.assertEqual((status, json.loads(body)), (200, {"kept": "edits/old/wall_lines.2.geojson"}))
        self.assertEqual(read(os.path.join(self.old, "wall_lines.2.geojson")), second)
        self.assertFalse(os.path.exists(self.edit))
        self.assertEqual(self.ask("DELETE", "/api/edit")[0], 404)
        self.assertEqual(self.ask("GET", "/api/edit")[0], 404)

    def test_a_wrong_edit_is_refused_with_all_its_problems_and_nothing_is_written(self):
        first = self.moved_edit()
        self.assertEqual(self.ask("PUT", "/api/edit", first)[0], 200)
        wrong = json.loads(first)
        wrong["features"][0]["geometry"]["coordinates"][1] = wrong["features"][0]["geometry"]["coordinates"][0]
        wrong["features"][1]["geometry"] = None
        for body, codes in [(json.dumps(wrong).encode(), ["L05", "L07"]), (b"", ["L01"]), (b"\xff\xfe{", ["L01"]), (b"{}", ["L02"]),
                            (b'{"type":"FeatureCollection","features":[]}', ["L12"])]:
            with self.subTest(codes=codes):
                status, _, answer = self.ask("PUT", "/api/edit", body)
                self.assertEqual(status, 422)
                problems = json.loads(answer)["problems"]
                self.assertEqual(sorted(problem[6:9] for problem in problems), codes)
                for problem in problems:
                    self.assertIn("edits/wall_lines.geojson", problem)
                    self.assertIn("hint: ", problem)
                    self.assertNotIn(".tmp", problem)
        self.assertEqual(read(self.edit), first)
        self.assertEqual(sorted(os.listdir(os.path.dirname(self.edit))), ["wall_lines.geojson"])

    def test_a_run_is_started_followed_and_moves_the_wall(self):
        model = os.path.join(self.work, "model.ply")
        self.assertEqual(self.ask("POST", "/api/run")[0], 202)
        self.assertEqual(self.wait()["exit"], 0)
        before = largest_x(model)
        self.assertEqual(self.ask("PUT", "/api/edit", self.moved_edit())[0], 200)
        self.assertEqual(self.ask("POST", "/api/run")[0], 202)
        self.assertEqual(self.ask("POST", "/api/run")[0], 409, "one run at a time")
        stages = set()
        while True:
            run = json.loads(self.ask("GET", "/api/run")[2])
            if not run["running"]:
                break
            self.assertLessEqual(run["done"], run["of"])
            stages.add(run["stage"])
            time.sleep(0.01)
        self.assertTrue(stages & {"partition", "weigh_faces", "raycast", "graphcut", "refine_lines", "extract", "report"}, stages)
        self.assertNotIn("ingest", stages)
        self.assertEqual((run["exit"], run["stage"]), (0, None))
        self.assertEqual(run["done"], run["of"])
        self.assertGreaterEqual(run["of"], 15)
        self.assertTrue([line for line in run["log"] if line.startswith("accept_lines:")], run["log"])
        self.assertFalse([line for line in run["log"] if line.startswith("@stage")])
        self.assertAlmostEqual(largest_x(model) - before, MOVE_M, delta=0.005)
        self.ask("DELETE", "/api/edit")
        self.ask("POST", "/api/run")
        self.assertEqual(self.wait()["exit"], 0)
        self.assertAlmostEqual(largest_x(model), before, delta=1e-9)

    def test_a_run_that_fails_says_why(self):
        with open(self.edit, "w", encoding="utf-8") as text:
            text.write("{}")
        self.assertEqual(self.ask("POST", "/api/run")[0], 202)
        run = self.wait()
        self.assertNotEqual(run["exit"], 0)
        self.assertEqual(run["stage"], "accept_lines")
        error = json.loads(self.ask("GET", "/api/status")[2])["error"]
        self.assertIn("error[L02]", error)
        self.assertIn("hint: ", error)
        self.ask("DELETE", "/api/edit")
        self.ask("POST", "/api/run")
        self.assertEqual(self.wait()["exit"], 0)
        self.assertIsNone(json.loads(self.ask("GET", "/api/status")[2])["error"])

    # The program.

    def test_a_port_may_be_chosen_and_a_taken_one_is_an_error(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            free = probe.getsockname()[1]
        server, port, line = self.start(f"PORT={free}")
        self.assertEqual(port, free)
        self.assertIn("Ctrl-C", line)
        done = self.make("view", f"PORT={free}")
        self.assertIn("error[U01] --port: the port cannot be taken", done.stderr)
        self.assertIn("Error 2", done.stderr)
        self.stop(server)
        self.assertRaises(ConnectionRefusedError, socket.create_connection, ("127.0.0.1", free))

    def test_a_port_that_is_none_is_an_error(self):
        for port in ("x", "70000", "-1"):
            done = self.make("view", f"PORT={port}")
            self.assertIn("error[U01]", done.stderr)
            self.assertIn("Error 2", done.stderr)

    def test_without_a_page_it_says_what_to_do(self):
        page = os.path.join(self.work, "report.html")
        os.rename(page, page + ".kept")
        try:
            done = self.make("view")
        finally:
            os.rename(page + ".kept", page)
        self.assertIn("error[A01]", done.stderr)
        self.assertIn("make run", done.stderr)

    def test_ctrl_c_ends_it_and_a_run_that_it_started(self):
        server, self.port, _ = self.start()
        try:
            os.remove(os.path.join(self.work, "10_ingest", "cloud.h5"))
            self.assertEqual(self.ask("POST", "/api/run")[0], 202)
            group = None
            for _ in range(100):
                children = subprocess.run(["ps", "-eo", "pgid=,args="], capture_output=True, text=True, check=True).stdout.splitlines()
                runs = [line.split()[0] for line in children if os.path.join(SOURCE, "stages/pipeline.sh") + " run" in line]
                if runs:
                    group = int(runs[0])
                    break
                time.sleep(0.02)
            self.assertIsNotNone(group)
            self.stop(server)
            self.assertRaises(ConnectionRefusedError, socket.create_connection, ("127.0.0.1", self.port))
            self.assertFalse(alive(group))
        finally:
            del self.port  # of this test's own server
        self.assertEqual(self.make("run").returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
