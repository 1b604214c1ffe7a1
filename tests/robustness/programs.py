# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs as the pipeline calls them, each on a work folder that is the current one: what they read, what they write.

The rows say what stages/pipeline.mk and pipeline.sh say; a file that two passes have goes by the names of both.
"""
import os
from dataclasses import dataclass, field

CLOUD = "10_ingest/cloud.h5"
SLICES = "20_slice/slices.h5"
HOUGH = "30_detect_lines/hough.h5"
LINES_30, LINES_40, LINES_80 = (f"{s}/wall_lines.geojson" for s in ("30_detect_lines", "40_accept_lines", "80_refine_lines"))
CELLS, WEIGHTS, TERMS, LABELS = "50_partition/cells.h5", "55_weigh_faces/weights.h5", "60_raycast/data_terms.h5", "70_graphcut/labels.h5"
FCELLS, FWEIGHTS, FTERMS, FLABELS = (f"90_final/{n}.h5" for n in ("cells", "weights", "data_terms", "labels"))
OPENINGS = "95_find_openings/openings.geojson"
EDIT = "edits/wall_lines.geojson"
MODEL, OBJ, SUMMARY, REPORT = "model.ply", "model.obj", "summary.json", "report.html"
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


def final(binary, inputs, output, **options):
    given = [word for name, path in options.items() for word in (f"--{name.replace('_', '-')}", path)]
    return Program(binary, inputs, [output], ["--work", ".", *given], f"final_{binary}")


ALL_FINAL = [FCELLS, FWEIGHTS, FTERMS, FLABELS]
REPORTED = [CLOUD, SLICES, LINES_30, HOUGH, LINES_40, CELLS, WEIGHTS, TERMS, LABELS, LINES_80, *ALL_FINAL, OPENINGS, MODEL, SUMMARY]

# In the order of the pipeline.
STAGES = {
    "ingest": Program("ingest", [SCAN], [CLOUD], ["--work", ".", "--scan", SCAN]),
    "slice": Program("slice", [CLOUD], [SLICES]),
    "detect_lines": Program("detect_lines", [SLICES], [LINES_30, HOUGH]),
    "accept_lines": Program("accept_lines", [LINES_30], [LINES_40]),
    "partition": Program("partition", [LINES_40, SLICES], [CELLS]),
    "weigh_faces": Program("weigh_faces", [CELLS, CLOUD], [WEIGHTS]),
    "raycast": Program("raycast", [CELLS, WEIGHTS], [TERMS]),
    "graphcut": Program("graphcut", [CELLS, WEIGHTS, TERMS], [LABELS]),
    "refine_lines": Program("refine_lines", [LINES_40, CELLS, WEIGHTS, LABELS, CLOUD], [LINES_80]),
    "final_partition": final("partition", [LINES_80, SLICES], FCELLS, lines=LINES_80, cells_out=FCELLS),
    "final_weigh_faces": final("weigh_faces", [FCELLS, CLOUD], FWEIGHTS, cells=FCELLS, weights_out=FWEIGHTS),
    "final_raycast": final("raycast", [FCELLS, FWEIGHTS], FTERMS, cells=FCELLS, weights=FWEIGHTS, terms_out=FTERMS),
    "final_graphcut": final("graphcut", [FCELLS, FWEIGHTS, FTERMS], FLABELS, cells=FCELLS, weights=FWEIGHTS, terms=FTERMS,
                            labels_out=FLABELS),
    "find_openings": Program("find_openings", [FCELLS, FLABELS, CLOUD], [OPENINGS]),
    "extract": Program("extract", [*ALL_FINAL, OPENINGS], [MODEL, OBJ, SUMMARY]),
    "report": Program("report", REPORTED, [REPORT]),
}

SCORES = ["evaluate/scores.json", "evaluate/distance.ply", "evaluate/distance.png"]


def evaluate(truth):
    return Program("evaluate", [MODEL, truth, TRUTH_JSON, FCELLS, FLABELS, FTERMS], SCORES,
                   ["--work", ".", "--truth", truth, "--truth-json", TRUTH_JSON, "--cells", FCELLS, "--labels", FLABELS, "--terms", FTERMS,
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
