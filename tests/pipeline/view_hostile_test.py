#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`make view` against peers that ask for too much, too slowly, too often, or say nothing at all.

usage: view_hostile_test.py SOURCE_DIR BUILD_DIR
"""
import collections
import contextlib
import http.client
import json
import os
import socket
import sys
import threading
import time
import unittest

from view_case import ViewCase, read

SOON_S = 2  # for an answer that nothing may hold up; alone it takes some milliseconds


class HostileRequests(ViewCase):
    def tearDown(self):
        begin = time.monotonic()
        self.assertEqual(self.ask("GET", "/api/status")[0], 200, "the server lives")
        self.assertLess(time.monotonic() - begin, SOON_S)

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=30)

    def send(self, *parts):
        """(status, JSON of the answer) to these very bytes."""
        with self.connect() as line:
            for part in parts:
                line.sendall(part)
            answer = http.client.HTTPResponse(line)
            answer.begin()
            return answer.status, json.loads(answer.read())

    def head(self, first, *lines):
        return "\r\n".join([first, f"Host: 127.0.0.1:{self.port}", *lines, "", ""]).encode()

    def put_head(self, length):
        return self.head("PUT /api/edit HTTP/1.1", "X-Roomcut: 1", "Content-Type: application/json", f"Content-Length: {length}")

    def test_ranges_never_reach_beyond_the_file(self):
        content = read(os.path.join(self.work, "summary.json"))
        size = len(content)
        for asked, begin, end in [("0-99", 0, 100), ("5-5", 5, 6), ("0-999999", 0, size), ("100-99999999999", 100, size), (f"{size - 1}-", size - 1, size),
                                  ("-10", size - 10, size), ("-99999999999999999999999", 0, size), ("7-18446744073709551615", 7, size),
                                  ("3-99999999999999999999999", 3, size)]:
            status, headers, body = self.ask("GET", "/summary.json", headers={"Range": "bytes=" + asked})
            self.assertEqual((status, body), (206, content[begin:end]), asked)
            self.assertEqual(headers["Content-Range"], f"bytes {begin}-{end - 1}/{size}", asked)
        for asked in (f"{size}-", f"{size}-{size + 5}", "18446744073709551615-18446744073709551616", "99999999999999999999999-", "-0"):
            status, headers, body = self.ask("GET", "/summary.json", headers={"Range": "bytes=" + asked})
            self.assertEqual((status, headers["Content-Range"]), (416, f"bytes */{size}"), asked)
            self.assertEqual(list(json.loads(body)), ["error"])
        for asked in ("bytes=0-1,5-6", "bytes=" + ",".join(f"{i}-{i + 100000}" for i in range(1000)), "bytes=9-3", "bytes=a-b", "bytes=-", "bytes=--5",
                      "bytes=1--5", "lines=0-5", "", "="):
            status, _, body = self.ask("GET", "/summary.json", headers={"Range": asked})
            self.assertEqual((status, body), (200, content), asked)
        status, headers, body = self.ask("HEAD", "/summary.json", headers={"Range": "bytes=0-99999999"})
        self.assertEqual((status, headers["Content-Length"], body), (206, str(size), b""))

    def test_idle_connections_hold_up_nobody(self):
        for first in (b"", b"GET / HTTP/1.1\r\nHost: x", self.put_head(1000)):
            with self.subTest(first=first), contextlib.ExitStack() as lines:
                for _ in range(200):
                    line = lines.enter_context(self.connect())
                    line.sendall(first)
                for _ in range(3):
                    begin = time.monotonic()
                    self.assertEqual(self.ask("GET", "/api/status")[0], 200)
                    self.assertLess(time.monotonic() - begin, SOON_S)

    def test_connections_that_take_no_answer_hold_up_nobody(self):
        with contextlib.ExitStack() as lines:
            for _ in range(100):
                line = lines.enter_context(self.connect())
                line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
                line.sendall(self.head("GET /report.html HTTP/1.1"))
            begin = time.monotonic()
            self.assertEqual(self.ask("GET", "/report.html")[2], read(os.path.join(self.work, "report.html")))
            self.assertLess(time.monotonic() - begin, SOON_S)

    def test_who_makes_room_is_told(self):
        with contextlib.ExitStack() as lines:
            oldest = lines.enter_context(self.connect())
            for _ in range(100):
                lines.enter_context(self.connect())
            answer = http.client.HTTPResponse(oldest)
            answer.begin()
            self.assertEqual(answer.status, 503)
            self.assertIn("too many connections", json.loads(answer.read())["error"])

    def test_a_request_that_comes_byte_by_byte_or_stops_is_ended_and_told(self):
        results = {}

        def trickle(name, first, rest):
            with self.connect() as line:
                begin = time.monotonic()
                line.sendall(first)
                line.settimeout(0.25)
                got = b""
                while not got and time.monotonic() - begin < 30:
                    try:
                        got = line.recv(65536)
                    except TimeoutError:
                        line.sendall(rest)
                results[name] = (got.split(b" ")[1:2], time.monotonic() - begin)

        threads = [threading.Thread(target=trickle, args=case) for case in
                   [("silent", b"", b""), ("head", b"GET / HT", b"T"), ("header", self.head("GET / HTTP/1.1")[:-2], b"X"),
                    ("body", self.put_head(1000) + b"[", b" "), ("no body", self.put_head(1000), b"")]]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for name, (status, seconds) in results.items():
            self.assertEqual(status, [b"408"], name)
            self.assertLess(seconds, 15, name)

    def test_heads_that_are_too_large_are_refused_and_told(self):
        host = f"Host: 127.0.0.1:{self.port}\r\n".encode()
        for name, request in [("path", b"GET /" + b"a" * 200000 + b" HTTP/1.1\r\n" + host + b"\r\n"),
                              ("headers", b"GET / HTTP/1.1\r\n" + host + b"".join(b"X-%d: y\r\n" % i for i in range(100000)) + b"\r\n"),
                              ("header", b"GET / HTTP/1.1\r\n" + host + b"X: " + b"y" * 10000000 + b"\r\n\r\n")]:
            with self.subTest(name):
                status, answer = self.send(request)
                self.assertEqual(status, 431)
                self.assertIn("KiB", answer["error"])

    def test_what_is_no_http_is_refused_and_told(self):
        host = f"Host: 127.0.0.1:{self.port}\r\n".encode()
        for request in (b"\x00\xff\x16\x03\x01" * 100 + b"\r\n\r\n", b"GET /\r\n\r\n", b"GET / HTTP/9.9\r\n" + host + b"\r\n",
                        b"GET / HTTP/1.1\r\n" + host + b"no colon\r\n\r\n", b"\r\n" * 3000):
            status, answer = self.send(request)
            self.assertEqual((status, list(answer)), (400, ["error"]), request[:40])
        self.assertEqual(self.send(b"GET / HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n evil\r\n\r\n" % self.port)[0], 403)
        for lengths in (b"Content-Length: 2\r\nContent-Length: 3\r\n", b"Content-Length: -1\r\n", b"Content-Length: 1e3\r\n"):
            status, _ = self.send(b"PUT /api/edit HTTP/1.1\r\n" + host + b"X-Roomcut: 1\r\nContent-Type: application/json\r\n" + lengths + b"\r\n{}")
            self.assertEqual(status, 411, lengths)

    def test_one_connection_carries_one_request(self):
        with self.connect() as line:
            line.sendall(self.head("GET /api/status HTTP/1.1") + self.head("DELETE /api/edit HTTP/1.1", "X-Roomcut: 1"))
            self.assertEqual(line.makefile("rb").read().count(b"HTTP/1.1 "), 1)

    def test_a_body_that_waits_to_be_asked_for_is_asked_for(self):
        edit = self.moved_edit()
        with self.connect() as line:
            line.sendall(self.put_head(len(edit))[:-2] + b"Expect: 100-continue\r\n\r\n")
            answers = line.makefile("rb")
            self.assertEqual(answers.readline().split()[1], b"100")
            self.assertEqual(answers.readline(), b"\r\n")
            line.sendall(edit)
            self.assertEqual(answers.readline().split()[1], b"200")
        self.assertEqual(read(self.edit), edit)

    def test_an_edit_nested_without_end_is_refused_and_leaves_nothing_behind(self):
        first = self.moved_edit()
        self.assertEqual(self.ask("PUT", "/api/edit", first)[0], 200)
        for deep in ("[" * 50000 + "]" * 50000, '{"a":' * 50000 + "1" + "}" * 50000):
            for inner in (f'"geometry": {deep}', f'"properties": {{"note": null, "mine": {deep}}}'):
                body = '{"type": "FeatureCollection", "features": [{"type": "Feature", ' + inner + "}]}"
                status, _, answer = self.ask("PUT", "/api/edit", body.encode())
                self.assertEqual(status, 422)
                self.assertIn("error[L01] edits/wall_lines.geojson", json.loads(answer)["problems"][0])
        self.assertEqual(read(self.edit), first)
        self.assertEqual(os.listdir(os.path.dirname(self.edit)), ["wall_lines.geojson"])

    def test_many_edits_and_runs_at_once_lose_none_and_leave_nothing_behind(self):
        results = collections.Counter()

        def ask(*request):
            results[request[0], self.ask(*request)[0]] += 1

        threads = [threading.Thread(target=ask, args=("PUT", "/api/edit", self.moved_edit(0.01 + 0.001 * i))) for i in range(30)]
        threads += [threading.Thread(target=ask, args=("POST", "/api/run")) for _ in range(10)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results["PUT", 200], 30)
        self.assertGreaterEqual(results["POST", 202], 1)
        self.assertEqual(results["POST", 202] + results["POST", 409], 10)
        self.assertEqual(self.wait()["exit"], 0)
        kept = {read(self.edit)} | {read(os.path.join(self.old, name)) for name in os.listdir(self.old)}
        self.assertEqual(len(kept), 30)
        self.assertEqual(sorted(os.listdir(os.path.dirname(self.edit))), ["old", "wall_lines.geojson"])
        self.ask("DELETE", "/api/edit")
        self.assertEqual(self.make("run").returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
