#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Damages files of a small run and gives each to every program that reads it.

usage: mutate.py SOURCE BUILD [--n 330] [--seed 1] [--only KIND …] [--json FILE] [--keep FOLDER] [--jobs N] [--list]

A finding is: a crash, exit 1, more than 12 s, more than 1 GB resident, a message without code, cause or hint, a failed program that
left an output, or an artefact that was believed although its content is not what was written (another result with exit 0).
Ends with 1 when there was one. Exit 77: h5py or numpy is not installed.
"""
import argparse
import json
import multiprocessing
import os
import random
import shutil
import sys
import tempfile
import time
from collections import Counter

import base_run
import limits
import mutations
import programs
import results

try:
    import h5_mutations
    import kinds as kinds_table
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PEAK = 1 << 30
COLUMNS = ["files", "runs", "refused", "crash", "exit 1", "hang", "memory", "believed", "message", "left"]
FAULTS = COLUMNS[3:]


def result_of(folder, program, ending):
    """What a program made of its inputs: digests of its outputs, or what it prints."""
    if program is None:
        return []
    return [ending.out] if program.prints else list(results.digests(folder, program.outputs).values())


class Place:
    """A work folder of hard links to the undamaged run; what a call wrote is put back after it."""

    def __init__(self, base, scratch, binaries, source):
        self.base, self.binaries = base, binaries
        self.places = {"base": base, "source": source}
        self.work = os.path.join(scratch, "work")
        self.scratch = scratch
        shutil.copytree(base, self.work, copy_function=os.link)
        self.expected = {}

    def path(self, name):
        return os.path.join(self.work, name)

    def put_back(self, name):
        if os.path.lexists(self.path(name)):
            os.unlink(self.path(name))
        if os.path.exists(os.path.join(self.base, name)):
            os.link(os.path.join(self.base, name), self.path(name))

    def call(self, call):
        program = programs.PROGRAMS.get(call.name) if not call.reads_only else None
        outputs = program.outputs if program else []
        for name in outputs:
            if os.path.lexists(self.path(name)):
                os.unlink(self.path(name))
        ending = limits.run(programs.command(call.name, self.binaries, self.places, call.words), self.work, self.scratch)
        result = result_of(self.work, program, ending)
        for name in outputs:
            self.put_back(name)
        if call.name in programs.STAGES:
            self.put_back(programs.log_of(call.name))
        return ending, result

    def undamaged(self, kind, index):
        """What the calls of this kind make of the undamaged file."""
        calls = kind.of(index).calls
        key = (kind.of(index).path, index % len(kind.variants) if kind.variants else 0)
        if key not in self.expected:
            self.expected[key] = [self.call(call) for call in calls]
            for call, (ending, _) in zip(calls, self.expected[key]):
                if ending.code != 0:
                    raise AssertionError(f"{call.name} {call.words} of the undamaged file: exit {ending.code}\n{ending.error}")
        return self.expected[key]


def judge(call, belief, ending, result, expected):
    """Names of the faults of one run."""
    faults = []
    if ending.hung:
        return ["hang"]
    if ending.code < 0 or results.CRASHED in ending.error:
        faults.append("crash")
    elif ending.code == 1:
        faults.append("exit 1")
    elif ending.code != 0:
        if not results.MESSAGE.search(ending.error):
            faults.append("message")
        outputs = [] if call.reads_only or programs.PROGRAMS[call.name].prints else result
        if any(entry is not None for entry in outputs):
            faults.append("left")
    elif belief and not call.reads_only and result != expected:
        faults.append("believed")
    if ending.peak > PEAK:
        faults.append("memory")
    return faults


STATE = {}


def start(base, source, binaries, scratch, seed, keep):
    limits.set_limits()
    folder = tempfile.mkdtemp(dir=scratch)
    STATE.update(place=Place(base, folder, binaries, source), kinds=kinds_table.all_kinds(), content={}, seed=seed, keep=keep)


def damaged(name, index):
    """File `index` of a kind: its bytes, and what was done."""
    kind = STATE["kinds"][name].of(index)
    if kind.path not in STATE["content"]:
        content = kind.source(STATE["place"].base)
        STATE["content"][kind.path] = content, h5_mutations.of_file(content) if kind.flavour == "hdf5" else ()
    content, extra = STATE["content"][kind.path]
    draw = random.Random(f"{STATE['seed']} {name} {index}")
    head = kind.head(content) if kind.head else len(content)
    changed, how = mutations.damage(content[:head], kind.flavour, draw, extra)
    changed += content[head:]
    if kind.finish:
        base = STATE["place"].base
        return kind.finish(base, content), kind.finish(base, changed), how
    return content, changed, how


def one_file(job):
    """(kind, number of runs, number refused, [(fault, program, exit, message, how)])"""
    name, index = job
    place, kind = STATE["place"], STATE["kinds"][name]
    content, changed, how = damaged(name, index)
    path = place.path(kind.of(index).path)
    os.makedirs(os.path.dirname(path), exist_ok=True)

    def put(what):
        if os.path.lexists(path):
            os.unlink(path)
        with open(path, "wb") as file:
            file.write(what)

    if (key := (kind.of(index).path, index % len(kind.variants) if kind.variants else 0)) not in place.expected:
        put(content)
        place.undamaged(kind, index)
    expected = place.expected[key]
    put(changed)
    findings, refused = [], 0
    for call, (_, result_before) in zip(kind.of(index).calls, expected):
        ending, result = place.call(call)
        refused += ending.code != 0
        for fault in judge(call, kind.of(index).belief, ending, result, result_before):
            findings.append((fault, " ".join([call.name, *call.words[:1]]), ending.code, ending.error[-300:], how))
    os.unlink(path)
    place.put_back(kind.of(index).path)
    if findings and STATE["keep"]:
        os.makedirs(STATE["keep"], exist_ok=True)
        with open(os.path.join(STATE["keep"], f"{name}_{index}{os.path.splitext(path)[1]}"), "wb") as file:
            file.write(changed)
    return name, index, len(kind.of(index).calls), refused, findings


def table(counts):
    width = max(len(name) for name in counts) + 2
    lines = ["kind".ljust(width) + "".join(column.rjust(10) for column in COLUMNS)]
    for name, row in [*counts.items(), ("all", sum(counts.values(), Counter()))]:
        lines.append(name.ljust(width) + "".join(str(row[column]).rjust(10) for column in COLUMNS))
    return "\n".join(lines)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source")
    parser.add_argument("build")
    parser.add_argument("--n", type=int, default=330, help="files of each kind")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--json", default="")
    parser.add_argument("--keep", default="", help="folder for the files of findings")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--list", action="store_true", help="print the names of the kinds")
    options = parser.parse_args()
    known = kinds_table.all_kinds()
    if options.list:
        print("\n".join(known))
        sys.exit(0)
    unknown = [name for name in options.only if name not in known]
    if unknown or options.n < 1:
        parser.error(f"there is no kind {' '.join(unknown)}; the kinds are: {' '.join(known)}" if unknown else "--n must be at least 1")
    options.only = options.only or list(known)
    return options


def main():
    options = arguments()
    source, build = os.path.abspath(options.source), os.path.abspath(options.build)
    keep = os.path.abspath(options.keep) if options.keep else ""
    if not base_run.can_be_surveyed(build):
        print("skipped: E57, LAS and LAZ: no Python environment that reads them (make deps)")
        options.only = [name for name in options.only if not kinds_table.all_kinds()[name].surveyed]
    begun = time.monotonic()
    scratch = tempfile.mkdtemp(prefix="roomcut mutations ", dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
    counts = {name: Counter() for name in options.only}
    kept = []
    try:
        base = base_run.make(source, build, os.path.join(scratch, "base"))
        if any(kinds_table.all_kinds()[name].surveyed for name in options.only):
            base_run.surveyed(build, base, kinds_table.text(base))
        jobs = [(name, index) for name in options.only for index in range(options.first, options.first + options.n)]
        with multiprocessing.Pool(options.jobs, start, (base, source, os.path.join(build, "bin"), scratch, options.seed, keep)) as pool:
            for name, index, runs, refused, findings in pool.imap(one_file, jobs, chunksize=8):
                counts[name] += Counter({"files": 1, "runs": runs, "refused": refused} | Counter(finding[0] for finding in findings))
                for fault, program, code, message, how in findings:
                    kept.append({"kind": name, "index": index, "fault": fault, "program": program, "exit": code, "message": message, "how": how})
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    for entry in kept[:200]:
        print(f"{entry['kind']} {entry['index']}: {entry['fault']}: {entry['program']} (exit {entry['exit']}; {entry['how']})")
        print("    " + (entry["message"].strip().replace("\n", "\n    ") or "no message"))
    print(table(counts))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"n": options.n, "seed": options.seed, "counts": counts, "findings": kept}, file, indent=1)
    faults = sum(row[fault] for row in counts.values() for fault in FAULTS)
    print(f"{sum(row['runs'] for row in counts.values())} runs, {faults} findings, {time.monotonic() - begun:.0f} s (seed {options.seed})")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
