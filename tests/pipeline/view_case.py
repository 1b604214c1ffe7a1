# SPDX-License-Identifier: GPL-3.0-or-later
"""A real run behind `make view`, and how the tests ask it over real sockets (view_test.py SOURCE_DIR BUILD_DIR)."""
import http.client
import json
import os
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
MOVE_M = 0.25
LIMIT = 16 << 20
CLEAN = {key: value for key, value in os.environ.items()
         if key not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "SCAN", "WORK", "CONFIG", "JOBS", "PORT", "QUIET")}


def read(path):
    with open(path, "rb") as data:
        return data.read()


def largest_x(path):
    """Of the vertices of a model.ply (binary, double coordinates first)."""
    content = read(path)
    end = content.index(b"end_header\n") + len(b"end_header\n")
    head = content[:end].decode()
    count = int(head.split("element vertex ")[1].split()[0])
    stride = 8 * head.split("element vertex")[1].split("element")[0].count("property double")
    return max(struct.unpack_from("<d", content, end + i * stride)[0] for i in range(count))


def alive(group):
    """Whether a process of the group still runs (zombies do not)."""
    for name in os.listdir("/proc"):
        if name.isdigit():
            try:
                state, _, of_group = read(f"/proc/{name}/stat").decode().rsplit(") ", 1)[1].split()[:3]
            except (OSError, IndexError):
                continue
            if int(of_group) == group and state not in "ZX":
                return True
    return False


class ViewCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="roomcut büro ")
        place = cls.folder.name
        cls.scan, cls.work = os.path.join(place, "räume 1.ply"), os.path.join(place, "w o r k")
        cls.edit = os.path.join(cls.work, "edits", "wall_lines.geojson")
        cls.old = os.path.join(cls.work, "edits", "old")
        subprocess.run([os.path.join(BUILD, "bin", "synthesize"), "-q", "--scene",
                        os.path.join(SOURCE, "tests/data/scenes/one_room.json"), "--scan-out", cls.scan,
                        "--truth-out", os.path.join(place, "truth.off"), "--truth-json", os.path.join(place, "truth.json")],
                       check=True)
        cls.make("run").check_returncode()
        cls.server, cls.port, _ = cls.start()

    @classmethod
    def tearDownClass(cls):
        cls.stop(cls.server)
        cls.folder.cleanup()

    @classmethod
    def command(cls, target, *variables):
        return ["make", "--no-print-directory", "-C", SOURCE, target, f"SCAN={cls.scan}", f"WORK={cls.work}",
                f"BUILD={BUILD}", *variables]

    @classmethod
    def make(cls, target, *variables):
        return subprocess.run(cls.command(target, *variables), capture_output=True, text=True, env=CLEAN, check=False)

    @classmethod
    def start(cls, *variables):
        server = subprocess.Popen(cls.command("view", *variables), stdout=subprocess.PIPE, text=True, env=CLEAN,
                                  start_new_session=True)
        line = server.stdout.readline()
        return server, int(line.split("http://127.0.0.1:")[1].split("/")[0]), line

    @staticmethod
    def stop(server):
        """Ctrl-C: the whole foreground group gets it."""
        os.killpg(server.pid, signal.SIGINT)
        server.wait(20)
        server.stdout.close()

    def setUp(self):
        shutil.rmtree(os.path.join(self.work, "edits"))
        os.mkdir(os.path.join(self.work, "edits"))

    def ask(self, method, path, body=None, headers=None, host=None, mark=True):
        """(status, headers, body); `headers` with None as a value are left out."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)
        head = {"Host": host or f"127.0.0.1:{self.port}"}
        if mark and method not in ("GET", "HEAD"):
            head["X-Roomcut"] = "1"
        if method == "PUT":
            head["Content-Type"] = "application/geo+json"
        if method == "POST":
            head["Content-Length"] = "0"
        head.update(headers or {})
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in head.items():
            if value is not None:
                connection.putheader(name, value)
        if body is not None and "Content-Length" not in head:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders()
        try:
            if body:
                connection.send(body)
        except (BrokenPipeError, ConnectionResetError):
            pass  # refused before all of it was sent
        answer = connection.getresponse()
        got = (answer.status, answer.headers, answer.read())
        connection.close()
        return got

    def raw(self, text):
        """Status of an answer to these very bytes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=120) as line:
            line.sendall(text.replace("\n", "\r\n").encode())
            return int(line.makefile("rb").readline().split()[1])

    def moved_edit(self, move=MOVE_M):
        """The accepted lines with the wall of the largest x moved out and locked."""
        lines = json.loads(read(os.path.join(self.work, "40_accept_lines", "wall_lines.geojson")))
        wall = max(lines["features"], key=lambda f: min(p[0] for p in f["geometry"]["coordinates"]))
        for point in wall["geometry"]["coordinates"]:
            point[0] += move
        wall["properties"]["locked"] = True
        return json.dumps(lines).encode()

    def wait(self):
        for _ in range(600):
            status, _, body = self.ask("GET", "/api/run")
            self.assertEqual(status, 200)
            run = json.loads(body)
            if not run["running"]:
                return run
            time.sleep(0.1)
        self.fail("the run does not end")

    # What is served.
