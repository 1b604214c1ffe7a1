#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives the damaged files of tests/data/broken to their readers: fuzz_replay on a sound run made with the programs of BUILD.

usage: replay_test.py SOURCE BUILD REPLAY
"""
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "robustness"))
import base_run  # noqa: E402
import fuzz  # noqa: E402

source, build, replay = (os.path.abspath(path) for path in sys.argv[1:4])
with tempfile.TemporaryDirectory() as folder:
    run = base_run.make(source, build, os.path.join(folder, "run"), points=fuzz.POINTS)
    sys.exit(subprocess.run([replay, os.path.join(source, "tests/data/broken")], check=False,
                            env=os.environ | fuzz.environment(source, run, folder)).returncode)
