# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs as the pipeline calls them, each on a work folder that is the current one: what they read, what they write.

The stages are those of stages/pipeline.table, the tools those of pipeline.sh; a file that two passes have goes by the names of both.
"""
import os
import sys
from dataclasses import dataclass, field

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from pipeline_table import PLACES, RUNS, other_options  # noqa: E402

CLOUD, SLICES, HOUGH, OPENINGS, EDIT = (PLACES[name] for name in ("cloud", "slices", "hough", "openings", "edit"))
PLANES, PLANES_EDIT = (PLACES[name] for name in ("accepted_planes", "planes_edit"))
LINES_30, LINES_40, LINES_80 = (PLACES[name] for name in ("detected", "accepted", "refined"))
CELLS, WEIGHTS, TERMS, LABELS = (PLACES[name] for name in ("cells", "weights", "terms", "labels"))
FCELLS, FWEIGHTS, FTERMS, FLABELS = (PLACES[f"final_{name}"] for name in ("cells", "weights", "terms", "labels"))
SURFACES, ROOMS, MODEL, OBJ, SUMMARY, REPORT = (PLACES[name] for name in ("surfaces", "rooms", "model", "model_obj", "summary", "report"))
SCAN, STATIONS, TRUTH, TRUTH_JSON, SCENE = "scan.ply", "inputs/stations.txt", "truth.off", "truth.json", "scene.json"


@dataclass
class Program:
    """One call: `binary` with `arguments`, in the work folder. `own_log`: the name of its log and stamp in the pipeline."""
    binary: str
    inputs: list
    outputs: list
    arguments: list = field(default_factory=lambda: ["--work", "."])
    own_log: str = ""
    prints: bool = False  # its result is what it prints


def stage(run):
    """A run as Make calls it. What enters from outside (parameters, edits, options of the scan) is there or not."""
    inputs = [path for option, path in run.reads if option and path not in (EDIT, PLANES_EDIT)]
    scan = ["--scan", SCAN] if run.program == "ingest" else []
    return Program(run.program, inputs + scan[1:], run.paths("writes"), ["--work", ".", *scan, *other_options(run)],
                   "" if run.name == run.program else run.name)


# In the order of the pipeline.
STAGES = {run.name: stage(run) for run in RUNS}

SCORES = ["evaluate/scores.json", "evaluate/distance.ply", "evaluate/distance.png"]


def evaluate(truth):
    return Program("evaluate", [MODEL, truth, TRUTH_JSON, FCELLS, FLABELS, FTERMS, CLOUD], SCORES,
                   ["--work", ".", "--truth", truth, "--truth-json", TRUTH_JSON, "--cells", FCELLS, "--labels", FLABELS, "--terms", FTERMS, "--cloud", CLOUD,
                    "--set", "sample_spacing_m=0.2", "--set", "column_spacing_m=0.2"])


# Besides the stages: what the other commands of the Makefile start. `compare` takes the undamaged run for A.
TOOLS = {
    "diff_lines": Program("diff_lines", [LINES_30, EDIT], [], prints=True),
    "evaluate": evaluate(TRUTH),
    "compare": Program("compare", [CLOUD, SLICES, LINES_30, LINES_40, CELLS, WEIGHTS, TERMS, LABELS, LINES_80, OPENINGS, FCELLS, FLABELS, SUMMARY],
                       ["compare/comparison.json", "compare/comparison.html"],
                       ["--work", "compare", "--a", "{base}", "--b", "."]),
    "synthesize": Program("synthesize", [SCENE], ["made/scan.ply", "made/truth.off", "made/truth.json"],
                          ["--work", "made", "--scene", SCENE, "--set", "points=2000"]),
}
PROGRAMS = {**STAGES, **TOOLS}


def readers(path):
    """Names of the programs that read `path` in the pipeline."""
    return [name for name, program in PROGRAMS.items() if path in program.inputs]


def log_of(name):
    program = PROGRAMS[name]
    return f"logs/{program.own_log or program.binary}.json"


def command(name, binaries, places, words=()):
    """The call of a row of PROGRAMS, or of a binary that has none; `places`: what stands for {base} and {source} in its words."""
    program = PROGRAMS.get(name, Program(name, [], []))
    words = [word.format(**places) for word in words or program.arguments]
    log = ["--log", log_of(name)] if name in STAGES else []
    return [os.path.join(binaries, program.binary), *words, *([] if "--dump-params" in words else log)]
