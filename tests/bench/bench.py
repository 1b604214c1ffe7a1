#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole runs on made scans: time, processor time, memory, reading and writing of every stage, beside the yardsticks.

Series (points in millions):
  dense   one building, scanned more and more densely from tripods
  grown   as many copies of the building as millions of points
  lines   1, 2, 4, 8, 16 copies at 0.25 M points each: 25 to 400 wall lines
  edit    one wall line of the largest dense scan moved by hand
  fixed   a scan of 3,000 points, and what a run takes outside its stages: Make, shells, starting and ending processes
Yardsticks, in the same run: cat, CGAL's PLY reader, CGAL's normals from 16 neighbours in a kd-tree on one thread. Of the ratio of
a run to those normals both are stated, of elapsed time (what a user waits; a run has all processors) and of processor time.
"""
import argparse
import glob
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time

from plot import plot

SOURCE = os.path.realpath(os.path.join(os.path.dirname(__file__), "../.."))
sys.path.insert(0, os.path.join(SOURCE, "tests"))
from pipeline_table import RUNS  # noqa: E402

STAGES = [run.name for run in RUNS]
OWN = {"MAKEFLAGS", "MFLAGS", "MAKELEVEL", "SCAN", "WORK", "CONFIG", "JOBS", "UP", "UNIT", "TRUTH", "QUIET"}
ENVIRONMENT = {key: value for key, value in os.environ.items() if key not in OWN}


def timed(command, **options):
    """Runs it; processor and wall seconds, and what it printed."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    out = subprocess.run(command, check=True, env=ENVIRONMENT, stdout=subprocess.PIPE, text=True, **options).stdout
    after, end = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    cpu = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return {"cpu_s": round(cpu, 3), "wall_s": round(end - begin, 3)}, out


def make_scan(arguments, place, points, copies, kind="tripod", building="paper_two_storeys"):
    with open(os.path.join(SOURCE, f"tests/data/scenes/{building}.json")) as file:
        scene = json.load(file)
    columns = max(k for k in range(1, int(copies ** 0.5) + 1) if copies % k == 0)
    scene["sampling"] = {"kind": kind, "points": points}
    scene["repeat"] = {"x": columns, "y": copies // columns, "storeys": 1}
    with open(os.path.join(place, "scene.json"), "w") as file:
        json.dump(scene, file)
    subprocess.run([os.path.join(arguments.build, "bin/synthesize"), "--scene", "scene.json", "--work", ".", "-q"], cwd=place, check=True)
    return os.path.join(place, "scan.ply")


def yardsticks(arguments, scan, millions):
    result = {"cat": timed(f"cat '{scan}' > /dev/null", shell=True)[0]}
    if millions <= arguments.kd:
        program = os.path.join(arguments.build, "bin/bench_yardsticks")
        result.update(json.loads(timed([program, scan, "normals"])[1]))
    return result


def make(arguments, scan, target="run"):
    command = ["make", "-C", SOURCE, target, f"SCAN={scan}", f"WORK={os.path.dirname(scan)}/work", f"BUILD={arguments.build}", "QUIET=1"]
    return timed(command + ([f"JOBS={arguments.threads}"] if arguments.threads else []))[0]


def stage_rows(work):
    cloud = os.path.getsize(os.path.join(work, "10_ingest/cloud.h5"))
    rows = {}
    for stage in STAGES:
        path = os.path.join(work, f"logs/{stage}.json")
        if os.path.exists(path):
            with open(path) as file:
                log = json.load(file)
            rows[stage] = {key: round(log[key], 3) for key in ("cpu_s", "wall_s", "peak_memory_mb")}
            rows[stage].update(read_mb=round(log["bytes_read"] / 1e6, 1), written_mb=round(log["bytes_written"] / 1e6, 1))
            if stage != "ingest":
                rows[stage]["passes"] = round(log["bytes_read"] / cloud, 1)
    return rows


def outside_stages(case):
    return round(case["run"]["wall_s"] - sum(row["wall_s"] for row in case["stages"].values()), 3)


def fixed_run(arguments, place):
    """The median of five runs on next to nothing."""
    scan = make_scan(arguments, place, 3000, 1, "uniform", "one_room")
    work = os.path.join(place, "work")
    cases = []
    for _ in range(5):
        shutil.rmtree(work, ignore_errors=True)
        case = {"run": make(arguments, scan), "stages": stage_rows(work)}
        cases.append({"run": case["run"], "outside_stages_s": outside_stages(case)})
    cases.sort(key=lambda case: case["outside_stages_s"])
    case = cases[len(cases) // 2]
    print(f"3,000 points: make run {case['run']['wall_s']:.2f} s, of it outside the stages {case['outside_stages_s']:.2f} s", flush=True)
    return case


def whole_run(arguments, place, points, copies):
    scan = make_scan(arguments, place, points, copies)
    millions = points / 1e6
    case = {"points_m": millions, "copies": copies, "scan_mb": round(os.path.getsize(scan) / 1e6, 1)}
    case["yardsticks"] = yardsticks(arguments, scan, millions)
    work = os.path.join(place, "work")
    shutil.rmtree(work, ignore_errors=True)
    case["run"] = make(arguments, scan)
    case["nothing_to_do"] = make(arguments, scan)
    case["stages"] = stage_rows(work)
    case["artefacts_mb"] = round(sum(os.path.getsize(f) for f in glob.glob(work + "/**", recursive=True) if os.path.isfile(f)) / 1e6, 1)
    case["outside_stages_s"] = outside_stages(case)
    if "kd_normals_s" in case["yardsticks"]:
        kd = case["yardsticks"]["kd_normals_s"]
        case["ratio_to_kd_normals"] = {key: round(case["run"][key] / kd, 3) for key in ("wall_s", "cpu_s")}
    print_case(case)
    return case


def line_run(arguments, place, copies):
    scan = make_scan(arguments, place, 250000 * copies, copies, "uniform")
    work = os.path.join(place, "work")
    shutil.rmtree(work, ignore_errors=True)
    make(arguments, scan, "graphcut")
    with open(os.path.join(work, "40_accept_lines/wall_lines.geojson")) as file:
        lines = len(json.load(file)["features"])
    with open(os.path.join(work, "logs/partition.json")) as file:
        counts = {count["what"]: count["value"] for count in json.load(file)["counts"]}
    case = {"copies": copies, "lines": lines, "cells": counts.get("cells"), "stages": stage_rows(work)}
    case["four_s"] = round(sum(case["stages"][s]["wall_s"] for s in ("partition", "weigh_faces", "raycast", "graphcut")), 3)
    print(f"{copies:3d} copies: {lines:4d} lines, {case['cells']:.0f} cells; partition to graphcut {case['four_s']:.2f} s", flush=True)
    return case


def edit_run(arguments, place):
    """After a whole run in `place`: one line moved by 3 cm, everything that follows from it."""
    work, scan = os.path.join(place, "work"), os.path.join(place, "scan.ply")
    make(arguments, scan, "edit-lines")
    path = os.path.join(work, "edits/wall_lines.geojson")
    with open(path) as file:
        edit = json.load(file)
    for end in edit["features"][0]["geometry"]["coordinates"]:
        end[0] += 0.03
        end[1] += 0.03
    with open(path, "w") as file:
        json.dump(edit, file)
    before = os.stat(os.path.join(work, "stamps/detect_lines")).st_mtime_ns
    result = make(arguments, scan)
    result["nothing_before_ran"] = os.stat(os.path.join(work, "stamps/detect_lines")).st_mtime_ns == before
    print(f"edit of one line: {result}", flush=True)
    return result


def print_case(case):
    print(f"\n{case['points_m']:g} M points, {case['copies']} buildings, scan {case['scan_mb']} MB, all artefacts {case['artefacts_mb']} MB")
    print(f"  {'':18s} {'cpu s':>8s} {'wall s':>8s} {'peak MB':>8s} {'read MB':>9s} {'written':>9s} {'passes':>7s}")
    for name, row in case["stages"].items():
        print(f"  {name:18s} {row['cpu_s']:8.3f} {row['wall_s']:8.3f} {row['peak_memory_mb']:8.1f} {row['read_mb']:9.1f} "
              f"{row['written_mb']:9.1f} {row.get('passes', ''):>7}")
    for name in ("run", "nothing_to_do"):
        print(f"  make {name:13s} {case[name]['cpu_s']:8.3f} {case[name]['wall_s']:8.3f}")
    print(f"  outside the stages {case['outside_stages_s']:.3f} s; yardsticks: {case['yardsticks']}")
    if "ratio_to_kd_normals" in case:
        ratio = case["ratio_to_kd_normals"]
        print(f"  make run / normals in a kd-tree: {ratio['wall_s']:.3f} elapsed, {ratio['cpu_s']:.3f} processor time", flush=True)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--series", default="fixed,dense,grown,lines,edit", help="which of them (default: all)")
    parser.add_argument("--sizes", default="1,4,10", help="millions of points; 40 and 100 need 10 GB of disk and some minutes")
    parser.add_argument("--kd", type=float, default=10, help="largest size for CGAL's normals (3 s per million)")
    parser.add_argument("--threads", default="", help="threads of a stage; default: all")
    parser.add_argument("--place", default="", help="folder for the scans; default: a temporary one, removed at the end")
    parser.add_argument("--out", default="work/bench", help="folder for bench.json and bench.svg")
    return parser.parse_args()


def run(arguments, place):
    series = arguments.series.split(",")
    sizes = [float(size) for size in arguments.sizes.split(",")]
    result = {"processors": len(os.sched_getaffinity(0)), "load": os.getloadavg()}
    if "fixed" in series:
        result["fixed"] = fixed_run(arguments, place)
    if "dense" in series or "edit" in series:
        result["dense"] = [whole_run(arguments, place, int(size * 1e6), 1) for size in sizes]
    if "edit" in series:
        result["edit"] = edit_run(arguments, place)
    if "grown" in series:
        result["grown"] = [whole_run(arguments, place, int(size * 1e6), max(1, round(size))) for size in sizes]
    if "lines" in series:
        result["lines"] = [line_run(arguments, place, copies) for copies in (1, 2, 4, 8, 16)]
    return result


def main():
    arguments = parse_arguments()
    arguments.build = os.path.abspath(arguments.build)
    os.makedirs(arguments.out, exist_ok=True)
    place = arguments.place or tempfile.mkdtemp(prefix="roomcut-bench.")
    os.makedirs(place, exist_ok=True)
    try:
        result = run(arguments, os.path.abspath(place))
    finally:
        if not arguments.place:
            shutil.rmtree(place, ignore_errors=True)
    with open(os.path.join(arguments.out, "bench.json"), "w") as file:
        json.dump(result, file, indent=1)
    with open(os.path.join(arguments.out, "bench.svg"), "w") as file:
        file.write(plot(result))
    print(f"\n{arguments.out}/bench.json, bench.svg")


sys.exit(main())
