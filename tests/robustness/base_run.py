# SPDX-License-Identifier: GPL-3.0-or-later
"""A small whole run, made by the programs themselves: two rooms with a door between them, all artefacts, a truth, an edit."""
import json
import os
import shutil
import subprocess

import programs

SCENE = "tests/data/scenes/l_shape.json"
POINTS = 60000


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: exit {done.returncode}\n{done.stdout}\n{done.stderr}")


def make(source, build, folder, points=POINTS):
    """Fills `folder` (made anew). The whole pipeline as make runs it, then what `make evaluate` and the editor add."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    shutil.copy(os.path.join(source, SCENE), os.path.join(folder, programs.SCENE))
    run([os.path.join(build, "bin", "synthesize"), "-q", "--scene", programs.SCENE, "--set", f"points={points}",
         "--scan-out", programs.SCAN, "--truth-out", programs.TRUTH, "--truth-json", programs.TRUTH_JSON], cwd=folder)
    clean = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
    run(["make", "--no-print-directory", "-C", source, "run", f"SCAN={os.path.join(folder, programs.SCAN)}", f"WORK={folder}",
         f"BUILD={build}", "QUIET=1"], env=clean)
    shutil.copy(os.path.join(source, "pipeline.yaml"), os.path.join(folder, "my.yaml"))
    # The edits are not part of the run above: the doors and diff_lines find them when a test puts them into their places.
    shutil.copy(os.path.join(folder, programs.LINES_40), os.path.join(folder, "edit.geojson"))
    with open(os.path.join(folder, programs.PLANES), encoding="utf-8") as text:
        planes = json.load(text)
    ring = [[0.5, 0.5], [2.5, 0.5], [2.5, 1.5], [0.5, 1.5], [0.5, 0.5]]
    planes["features"].append({"type": "Feature", "properties": {"pitch_deg": 20, "uphill_deg": 0, "height_m": 2, "side": "ceiling", "locked": False},
                               "geometry": {"type": "Polygon", "coordinates": [ring]}})
    with open(os.path.join(folder, "planes_edit.geojson"), "w", encoding="utf-8") as text:
        json.dump(planes, text, indent=1)
    return folder


def python_of(build):
    return os.path.join(build, "python", "bin", "python3")


def can_be_surveyed(build):
    return os.path.exists(python_of(build))


def surveyed(build, folder, points):
    """Adds surveyed/scan.e57, .las, .laz to a run: `points`, x y z on each line, as surveyors' software writes them."""
    home = os.path.join(folder, "surveyed")
    os.makedirs(home)
    with open(os.path.join(home, "points.txt"), "wb") as text:
        text.write(points)
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "surveyed.py")
    run([python_of(build), "-Es", program, os.path.join(home, "points.txt"), home])
