# SPDX-License-Identifier: GPL-3.0-or-later
"""What the end-to-end tests share: running stages and the Makefile, and reading what they leave.

Every test file is called as: <name>_test.py SOURCE_DIR BUILD_DIR
"""
import json
import os
import subprocess
import sys

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
SCENES = os.path.join(SOURCE, "tests", "data", "scenes")
REAL = os.path.join(SOURCE, "..", "shared", "data", "scans")


def run(command, check=True, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if check and done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done


def stage(name, *options, check=True, **more):
    return run([os.path.join(BUILD, "bin", name), "-q", *options], check=check, **more)


def make(target, scan, work, *variables):
    return run(["make", "--no-print-directory", "-C", SOURCE, target, f"SCAN={scan}", f"WORK={work}", f"BUILD={BUILD}", *variables])


def synthesize(scene, folder):
    """scan, truth mesh and truth.json of a shipped scene."""
    os.makedirs(folder, exist_ok=True)
    names = [os.path.join(folder, name) for name in ("scan.ply", "truth.off", "truth.json")]
    stage("synthesize", "--scene", os.path.join(SCENES, scene + ".json"), "--scan-out", names[0], "--truth-out", names[1],
          "--truth-json", names[2])
    return names


def scores(work, truth, truth_json):
    stage("evaluate", "--work", work, "--truth", truth, "--truth-json", truth_json)
    with open(os.path.join(work, "evaluate", "scores.json"), encoding="utf-8") as text:
        return json.load(text)


def summary(work):
    with open(os.path.join(work, "summary.json"), encoding="utf-8") as text:
        return json.load(text)


def model_check(work):
    """evaluate's judgement of the model alone: the model is its own truth."""
    model = os.path.join(work, "model.ply")
    stage("evaluate", "--work", work, "--truth", model)
    with open(os.path.join(work, "evaluate", "scores.json"), encoding="utf-8") as text:
        return json.load(text)["mesh"]
