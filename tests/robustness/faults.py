#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every write, fsync, rename, mkdir, mmap and allocation that a stage makes fails once, the n-th for every n; the disk is full from
every write on; and runs are killed at many moments. What counts is what is left: no half file under a final name, an error with code,
cause and hint, and the next run gives the same bytes as ever.

usage: faults.py SOURCE BUILD [--most 0] [--only STAGE …] [--kinds KIND …] [--kills 200] [--json FILE] [--jobs N]

--most N: of each kind of call in a stage not more than N of its calls, spread evenly (allocations: never more than 300, of which there
are ten thousand); 0: all. Ends with 1 when something was found.
"""
import argparse
import json
import multiprocessing
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter

import base_run
import limits
import programs
import results

KINDS = ["write", "full", "fsync", "rename", "open", "mkdir", "truncate", "times", "mmap", "big", "malloc"]
MOST_ALLOCATIONS = 300
ALLOWED = (0, 3, 4, 5)  # 0: what failed was not needed, as the log is; 3: an input could not be read for want of memory
STATE = {}


class Stage:
    """A folder in which one stage runs: its inputs, and nothing of what it writes."""

    def __init__(self, name, scratch):
        self.name, self.program = name, programs.STAGES[name]
        self.folder = os.path.join(scratch, name)
        base = STATE["base"]
        for path in [*self.program.inputs, f"params/{self.program.binary}.json", programs.STATIONS]:
            if os.path.exists(os.path.join(base, path)):
                os.makedirs(os.path.dirname(os.path.join(self.folder, path)), exist_ok=True)
                os.link(os.path.join(base, path), os.path.join(self.folder, path))
        self.whole = results.digests(base, self.program.outputs)
        self.mine = {os.path.relpath(os.path.join(home, name), self.folder) for home, _, names in os.walk(self.folder) for name in names}

    def clear(self, outputs_too):
        """Back to the inputs, or to the inputs and the results of an earlier run."""
        for home, _, names in os.walk(self.folder, topdown=False):
            for name in names:
                path = os.path.relpath(os.path.join(home, name), self.folder)
                if path not in self.mine and (outputs_too or path not in self.whole):
                    os.unlink(os.path.join(home, name))
            if outputs_too and home != self.folder and not os.listdir(home):
                os.rmdir(home)

    def run(self, wish="", count=""):
        command = [*programs.command(self.name, os.path.join(STATE["build"], "bin"), {}), "-q", "--threads", "1",
                   "--params", f"params/{self.program.binary}.json", "--stamp", f"stamps/{self.name}"]
        environment = dict(os.environ)
        if wish:
            environment |= {"LD_PRELOAD": STATE["library"], "ROOMCUT_FAIL": wish} | ({"ROOMCUT_FAIL_COUNT": count} if count else {})
        return limits.run(command, self.folder, STATE["scratch"], environment)


def numbers(total, kind, most):
    """Which of the calls of a kind fail."""
    limit = min(most or total, MOST_ALLOCATIONS if kind == "malloc" else total)
    if total <= limit:
        return list(range(1, total + 1))
    return sorted({1 + round(i * (total - 1) / max(1, limit - 1)) for i in range(limit)})


def counted(stage):
    """Calls of each kind in an undisturbed run."""
    file = os.path.join(STATE["scratch"], "counts")
    if os.path.exists(file):
        os.unlink(file)
    ending = stage.run("write 0", file)
    if ending.code != 0:
        raise AssertionError(f"{stage.name}: exit {ending.code}\n{ending.error}")
    with open(file, encoding="ascii") as text:
        counts = {kind: int(n) for _, kind, n in (line.split() for line in text)}
    return counts | {"full": counts["write"]}


def judge(stage, ending):
    """What is wrong with how a disturbed run ended."""
    wrong = []
    if ending.hung:
        wrong.append("hang")
    elif ending.code < 0 or results.CRASHED in ending.error:
        wrong.append("crash")
    elif ending.code not in ALLOWED:
        wrong.append(f"exit {ending.code}")
    elif ending.code != 0 and not results.MESSAGE.search(ending.error):
        wrong.append("message")
    now = results.digests(stage.folder, stage.whole)
    if any(now[path] not in (None, stage.whole[path]) for path in now):
        wrong.append("half file")
    if ending.code == 0 and now != stage.whole:
        wrong.append("done, but not whole")
    if results.left_overs(stage.folder):
        wrong.append("left over")
    return wrong


def one_stage(job):
    """(stage, kinds and how many of each, exit codes, findings)"""
    name, kinds, most = job
    scratch = tempfile.mkdtemp(dir=STATE["root"])
    STATE["scratch"] = scratch
    stage = Stage(name, scratch)
    counts = counted(stage)
    done, codes, findings = Counter(), Counter(), []
    for kind in kinds:
        for n in numbers(counts[kind], kind, most):
            stage.clear(outputs_too=n % 2 == 1)  # the other half with the results of an earlier run in place
            ending = stage.run(f"{kind} {n}")
            done[kind] += 1
            codes[(kind, ending.code)] += 1
            wrong = judge(stage, ending)
            again = stage.run()
            if again.code != 0 or results.digests(stage.folder, stage.whole) != stage.whole or results.left_overs(stage.folder):
                wrong.append("the rerun is another")
            findings += [{"stage": name, "kind": kind, "n": n, "what": what, "exit": ending.code, "message": ending.error[-300:]} for what in wrong]
    shutil.rmtree(scratch)
    return name, done, codes, findings


def kill_runs(source, build, base, root, moments, seed=7):
    """A whole run, killed at a moment; then what lies there is whole or missing, and the next one ends as ever."""
    outputs = [path for program in programs.STAGES.values() for path in program.outputs]
    whole = results.digests(base, outputs)
    work, draw, findings = os.path.join(root, "killed"), random.Random(seed), []

    def make():
        shutil.copy(os.path.join(base, programs.SCAN), os.path.join(root, programs.SCAN))
        return subprocess.Popen(["make", "--no-print-directory", "-C", source, "run", f"SCAN={os.path.join(root, programs.SCAN)}", f"WORK={work}",
                                 f"BUILD={build}", "QUIET=1"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

    begun = time.monotonic()
    if make().wait() != 0:
        raise AssertionError("the undisturbed run fails")
    length = time.monotonic() - begun
    for moment in range(moments):
        shutil.rmtree(work)
        process = make()
        time.sleep(draw.random() * length)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        now = results.digests(work, outputs)
        wrong = [f"half file {path}" for path in now if now[path] not in (None, whole[path])]
        code = make().wait()
        if code != 0 or results.digests(work, outputs) != whole or results.left_overs(work):
            wrong.append(f"the rerun is another (exit {code}) {results.left_overs(work)}")
        findings += [{"stage": "make run", "kind": "kill", "n": moment, "what": what, "exit": code, "message": ""} for what in wrong]
    return findings


def start(state):
    STATE.update(state)
    limits.set_limits()


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=os.path.abspath)
    parser.add_argument("build", type=os.path.abspath)
    parser.add_argument("--most", type=int, default=0)
    parser.add_argument("--only", nargs="+", default=list(programs.STAGES), choices=list(programs.STAGES))
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS)
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--json", default="")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    return parser.parse_args()


def main():
    options = arguments()
    begun = time.monotonic()
    root = tempfile.mkdtemp(prefix="roomcut faults ", dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
    words = tempfile.mkdtemp(prefix="roomcut_faults_", dir=os.path.dirname(root))  # LD_PRELOAD takes no spaces
    findings, done, codes = [], {}, Counter()
    try:
        base = base_run.make(options.source, options.build, os.path.join(root, "base"))
        library = os.path.join(words, "fail.so")
        here = os.path.dirname(os.path.abspath(__file__))
        base_run.run(["cc", "-O1", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-o", library, os.path.join(here, "fail_nth.c"), "-ldl"])
        state = {"base": base, "build": options.build, "library": library, "root": root}
        with multiprocessing.Pool(options.jobs, start, (state,)) as pool:
            for name, kinds, ended, found in pool.imap_unordered(one_stage, [(name, options.kinds, options.most) for name in options.only]):
                done[name] = kinds
                codes += ended
                findings += found
        if options.kills:
            findings += kill_runs(options.source, options.build, base, root, options.kills)
    finally:
        shutil.rmtree(root, ignore_errors=True)
        shutil.rmtree(words, ignore_errors=True)
    for entry in findings[:100]:
        print(f"{entry['stage']} {entry['kind']} {entry['n']}: {entry['what']} (exit {entry['exit']})")
        print("    " + entry["message"].strip().replace("\n", "\n    "))
    print("stage".ljust(18) + "".join(kind.rjust(9) for kind in options.kinds) + "findings".rjust(10))
    for name in options.only:
        bad = sum(entry["stage"] == name for entry in findings)
        print(name.ljust(18) + "".join(str(done[name][kind]).rjust(9) for kind in options.kinds) + str(bad).rjust(10))
    ends = ", ".join(f"{kind}: " + " ".join(f"exit {code} {codes[kind, code]}x" for code in sorted({c for k, c in codes if k == kind}))
                     for kind in options.kinds if any(k == kind for k, _ in codes))
    print(f"ends: {ends}" + (f"; {options.kills} kills" if options.kills else ""))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"done": done, "findings": findings}, file, indent=1)
    print(f"{sum(sum(kinds.values()) for kinds in done.values())} faults, {len(findings)} findings, {time.monotonic() - begun:.0f} s")
    return 1 if findings or not all(sum(kinds.values()) for kinds in done.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
