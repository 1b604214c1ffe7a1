#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""usage: instructions.py BUILD [--renew]: a regression gate on speed that is no stopwatch.

Counts the instructions of every stage on a small made scan (valgrind, one thread) and compares them with instructions.txt. More
than 10 % above a recorded count is a failure: find out why, or, when the work is worth it, record the new counts with --renew and
say why in the commit. More than 10 % below is a success that should be recorded, so that it is kept. The load and the speed of the
machine do not matter, and the libraries are told to leave the processor's newer instructions alone, so that its kind matters little.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
RECORD = os.path.join(HERE, "instructions.txt")
TOLERANCE = 0.10
POINTS = 200000
sys.path.insert(0, os.path.join(HERE, ".."))
from pipeline_table import RUNS  # noqa: E402

# The first pass of one whole run, in order.
STAGES = [run.name for run in RUNS][:10]


def count(build, folder, stage):
    plain = dict(os.environ, OPENSSL_ia32cap="~0x0:~0x0", GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-AVX512F,-AVX512VL,-ERMS,-FSRM")
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
               os.path.join(build, "bin", stage), "--work", ".", "--threads", "1", "-q"]
    command += ["--scan", "scan.ply"] if stage == "ingest" else []
    done = subprocess.run(command, cwd=folder, env=plain, stderr=subprocess.PIPE, text=True)
    counted = re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)
    if done.returncode != 0 or counted is None:
        sys.exit(f"{stage} failed under valgrind:\n{done.stderr[-2000:]}")
    return int(counted.group(1).replace(",", ""))


def measure(build):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(HERE, "../data/scenes/paper_two_storeys.json")) as file:
            scene = json.load(file)
        scene["sampling"] = {"kind": "tripod", "points": POINTS}
        with open(os.path.join(folder, "scene.json"), "w") as file:
            json.dump(scene, file)
        subprocess.run([os.path.join(build, "bin/synthesize"), "--scene", "scene.json", "--work", ".", "-q"], cwd=folder, check=True)
        return {stage: count(build, folder, stage) for stage in STAGES}


def recorded():
    with open(RECORD) as file:
        lines = [line.split() for line in file if line.strip() and not line.startswith("#")]
    return {name: int(number) for name, number in lines}


def renew(counts):
    with open(RECORD, "w") as out:
        out.write(f"# Instructions of each stage on a tripod scan of {POINTS} points; renew: tests/bench/instructions.py BUILD --renew\n")
        for stage, number in counts.items():
            out.write(f"{stage:14s} {number}\n")
    print(f"recorded in {RECORD}")


def compare(counts, before):
    """The stages that need more than is recorded, or have no record."""
    failed = []
    for stage, number in counts.items():
        change = number / before[stage] - 1 if stage in before else float("inf")
        slower = change > TOLERANCE
        failed += [stage] if slower else []
        remark = "  SLOWER" if slower else "  faster: record it with --renew" if change < -TOLERANCE else ""
        print(f"{stage:14s} {number / 1e6:9.1f} M instructions, {100 * change:+.1f} %{remark}")
    return failed


def main():
    build = os.path.abspath(sys.argv[1])
    if shutil.which("valgrind") is None:
        print("skipped: no valgrind")
        sys.exit(77)
    counts = measure(build)
    if "--renew" in sys.argv:
        renew(counts)
        return
    failed = compare(counts, recorded())
    sys.exit(f"more instructions than recorded: {', '.join(failed)}; what to do stands at the head of {__file__}" if failed else 0)


main()
