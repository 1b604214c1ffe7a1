#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the fuzz targets, each for some seconds, and prints one line for each.

usage: fuzz.py SOURCE BUILD FUZZ_BUILD [--seconds 60] [--only TARGET …] [--jobs N] [--list]

BUILD: programs that make the sound run (FUZZ_BUILD/run) that the corpus comes from. What crashed a target is kept in
FUZZ_BUILD/findings/<target>/, with what libFuzzer said of it. Ends with 1 when anything did. The corpus grows in FUZZ_BUILD/corpus/.
"""
import argparse
import concurrent.futures
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

import corpus

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "robustness"))
import base_run  # noqa: E402

LENGTH = {"scan_ply": 20000, "scan_text": 20000, "scan_pcd": 20000, "scan_ptx": 20000, "hdf5": 30000}  # longest input; else LONGEST
EDITS = ("cloud", "slices", "hough", "cells", "weights", "data_terms", "labels", "surfaces", "rooms")
LONGEST = 12000
POINTS = 3000  # of the sound run: a target reads a whole artefact at every turn


def environment(source, run, temporary):
    """`temporary`: where the targets put what they read, better in memory."""
    return {"TMPDIR": temporary, "ASAN_OPTIONS": "allocator_may_return_null=1:handle_abort=1", "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
            "LSAN_OPTIONS": f"suppressions={source}/.ci/lsan.supp:print_suppressions=0", "ROOMCUT_FUZZ_SEEDS": run}


class Runner:
    def __init__(self, source, build, fuzz_build, seconds, temporary):
        self.source, self.folder, self.seconds = source, fuzz_build, seconds
        self.run = os.path.join(fuzz_build, "run")
        self.make_run(build)
        corpus.fill(source, self.run, os.path.join(fuzz_build, "corpus"))
        self.environment = os.environ | environment(source, self.run, temporary)

    def make_run(self, build):
        base_run.make(self.source, build, self.run, points=POINTS)
        base_run.run([os.path.join(build, "bin", "evaluate"), "-q", "--work", ".", "--truth", "truth.off"], cwd=self.run)

    def names(self):
        done = subprocess.run([os.path.join(self.folder, "bin", "fuzz")], capture_output=True, text=True, env=self.environment, check=False)
        return done.stderr.split("\n")[1:-1]

    def target(self, name):
        """(name, runs, coverage, findings) of one target; it is started again after each finding, while there is time."""
        program = os.path.join(self.folder, "bin", f"fuzz_{name}")
        if os.path.lexists(program):
            os.unlink(program)
        os.symlink("fuzz", program)
        findings = os.path.join(self.folder, "findings", name)
        shutil.rmtree(findings, ignore_errors=True)
        os.makedirs(findings)
        inputs = os.path.join(self.folder, "corpus", name)
        options = [f"-artifact_prefix={findings}/", "-timeout=12", "-rss_limit_mb=3000", "-malloc_limit_mb=1024", "-print_final_stats=1",
                   f"-max_len={LENGTH.get(name, 2000 if name in EDITS else LONGEST)}"]
        if name not in EDITS:
            options.append("-dict=" + corpus.dictionary(name, inputs, os.path.join(self.folder, f"{name}.dict")))
        regressions = os.path.join(self.source, "tests/data/broken", name)
        folders = [inputs] + ([regressions] if os.path.isdir(regressions) else [])
        begun, runs, cover, seen = time.monotonic(), 0, 0, {}
        for turn in range(1, 30):
            left = int(self.seconds - (time.monotonic() - begun))
            if left < 1 and turn > 1:
                break
            done = subprocess.run([program, *options, f"-seed={turn}", f"-max_total_time={max(1, left)}", *folders], cwd=findings,
                                  capture_output=True, env=self.environment, check=False)
            text = done.stderr.decode("utf-8", "replace")
            runs += max([int(n) for n in re.findall(r"number_of_executed_units: *(\d+)", text)] or
                        [int(n) for n in re.findall(r"^#(\d+)\t", text, re.M)] or [0])
            cover = max([cover, *(int(n) for n in re.findall(r"\bcov: (\d+)", text))])
            if done.returncode == 0:
                continue
            what = describe(text)
            if what not in seen:
                with open(os.path.join(findings, f"finding_{len(seen)}.txt"), "w", encoding="utf-8") as out:
                    out.write(text[-20000:])
            seen[what] = seen.get(what, 0) + 1
            # A corpus file that crashes would do so at every start.
            remove_crashing(text, inputs)
        return name, runs, cover, seen


def describe(text):
    """The first line that says what happened, with the innermost frame of ours."""
    found = re.search(r"^(?:.*ERROR: (?:AddressSanitizer|libFuzzer|LeakSanitizer): [^\n]*|.*runtime error: [^\n]*|terminate called[^\n]*\n[^\n]*)",
                      text, re.M)
    line = found.group(0) if found else (text.strip().split("\n") or [""])[-1]
    line = re.sub(r"==\d+==|0x[0-9a-f]+|\(pc.*|/dev/shm/roomcut_fuzz_\w+/|line \d+, column \d+.*|parsing '.*", "", line).replace("\n", " ").strip()[:200]
    frame = re.search(r"#\d+ 0x[0-9a-f]+ in (?!roomcut::fuzz)(roomcut::[^\n]*)", text)
    return line + (f"  [{frame.group(1)[:120]}]" if frame else "")


def remove_crashing(text, inputs):
    """Takes the artefact that libFuzzer wrote out of the corpus, when it stands there."""
    found = re.search(r"Test unit written to (\S+)", text)
    if found and os.path.exists(found.group(1)):
        with open(found.group(1), "rb") as file:
            content = file.read()
        for path in glob.glob(os.path.join(glob.escape(inputs), "*")):
            with open(path, "rb") as file:
                same = file.read() == content
            if same:
                os.unlink(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for word in ("source", "build", "fuzz_build"):
        parser.add_argument(word, type=os.path.abspath)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="roomcut_fuzz_", dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None) as temporary:
        return fuzz(Runner(options.source, options.build, options.fuzz_build, options.seconds, temporary), options)


def fuzz(runner, options):
    names = runner.names()
    if options.list:
        print("\n".join(names))
        return 0
    unknown = set(options.only) - set(names)
    if unknown:
        print(f"there is no target {' '.join(sorted(unknown))}; the targets are: {' '.join(names)}", file=sys.stderr)
        return 2
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for name, runs, cover, seen in pool.map(runner.target, options.only or names):
            print(f"{name:14} {runs:9} runs  {cover:6} edges  {len(seen)} findings", flush=True)
            for what, times in seen.items():
                print(f"    {times} x {what}")
            bad += len(seen) + (runs == 0)
            if runs == 0:
                print("    it did not run")
    print(f"{bad} findings" + (f"; inputs and reports in {os.path.join(options.fuzz_build, 'findings')}" if bad else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
