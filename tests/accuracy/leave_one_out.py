#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Learns the weights of the data term with the cut in the loop, with all buildings and with each of the virtual ones left out.

Takes the scenes that `make accuracy` ran, as they lie: both passes of each are lessons. The learner (learn/) searches from learn/prior.table,
which knows no data. Scored on what was left out, beside the weights that raycast has, it says how much these are tuned to the buildings they
were found on.

usage: leave_one_out.py BUILD; from the environment ONLY (which scenes), FOLDS (which buildings or families to leave out instead of all virtual
buildings, `none`), GENERATIONS (of the search), OUT (where to write), JOBS (threads), ROOT (of the work folders, instead of work/accuracy). No
scene is made or reconstructed; only `evaluate` runs where its scores are out of date. Writes what it found as learned.table beside OUT, in the
form of stages/raycast/weights.table: the mean of what was learned with all and without each, drawn to the prior (left_out_table.py).
"""
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import accuracy
import left_out_table
import scene_run
import scenes

HERE = os.path.dirname(os.path.abspath(__file__))
PRIOR = os.path.join(HERE, "learn", "prior.table")
SHIPPED = os.path.join(accuracy.SOURCE, "stages", "raycast", "weights.table")
GENERATIONS = 80
JOBS = int(os.environ.get("JOBS") or os.cpu_count())
FILES = ("cells", "weights", "data_terms", "labels")
PASSES = {"first": ("50_partition", "55_weigh_faces", "60_raycast", "70_graphcut"), "final": ("90_final",) * 4}
COARSE = ["--set", "sample_spacing_m=0.3"]  # of the truth of the cells nothing is needed that samples of surfaces give


def fail(text, hint, code="U01", status=2):
    print(f"error[{code}] make accuracy-weights: {text}\nhint: {hint}", file=sys.stderr)
    sys.exit(status)


def files_of(work, name):
    return {file: os.path.join(work, folder, file + ".h5") for file, folder in zip(FILES, PASSES[name])}


def finished(scene):
    """Whether `make accuracy` came to a model of this scene. Those with a mu of their own share their building's folder; a moved scene is
    a building that is there already."""
    work = os.path.join(accuracy.ROOT, scene["name"])
    files = [*files_of(work, "final").values(), os.path.join(work, "model.ply"), os.path.join(work, "params", "graphcut.json")]
    return "mu_m" not in scene and "base" not in scene and all(map(os.path.isfile, files + scene_run.scan_files(scene, work)[1:]))


def first_truth(build, work, truth, truth_json, files):
    """How much of every cell of the first pass is empty in the truth; made anew where it is out of date."""
    program, model = os.path.join(build, "bin", "evaluate"), os.path.join(work, "model.ply")
    out, stamp = (os.path.join(work, "evaluate", name) for name in ("first_cells.h5", "first_cells.stamp"))
    key = "\n".join(map(scene_run.identity, (program, truth, truth_json, files["cells"])))
    if not scene_run.is_fresh(stamp, key, [out]):
        with tempfile.TemporaryDirectory() as other:
            unused = [part for name in ("scores", "coloured", "picture") for part in ("--" + name, os.path.join(other, name))]
            scene_run.run([program, "-q", "--threads", "1", "--model", model, "--truth", truth, "--truth-json", truth_json, *COARSE,
                           "--cells", files["cells"], "--labels", files["labels"], *unused, "--cells-out", out])
        scene_run.write_if_changed(stamp, key)
    return out


def lessons_of(build, scene):
    """What learn_weights reads of a scene: its final pass, and the first where it lies on disk."""
    work = os.path.join(accuracy.ROOT, scene["name"])
    _, truth, truth_json = scene_run.scan_files(scene, work)
    scene_run.evaluate(build, scene, work, truth, truth_json)
    passes = {"final": os.path.join(work, "evaluate", "truth_cells.h5")}
    first = files_of(work, "first")
    if all(map(os.path.isfile, first.values())):
        passes["first"] = first_truth(build, work, truth, truth_json, first)
    return [{"scene": scene["name"], "building": scene["kind"], "made_up": scene["group"] not in ("virtual", "virtual_stations"), "final": name == "final",
             "params": os.path.join(work, "params", "graphcut.json"), "truth": cells_truth,
             **{key: files_of(work, name)[file] for key, file in (("cells", "cells"), ("weights", "weights"), ("terms", "data_terms"))}}
            for name, cells_truth in passes.items()]


def learn(build, lessons, generations, folds):
    """{"shipped", "prior", "all", "without BUILDING": what learn_weights found}, in the order of its lines."""
    with tempfile.NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
        json.dump(lessons, file)
        file.flush()
        command = [os.path.join(build, "bin", "learn_weights"), file.name, PRIOR, str(generations), str(JOBS), *folds]
        found = {}
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as learner:
            for line in learner.stdout:
                result = json.loads(line)
                found[result["name"]] = result
                print(f"[{len(found)}/{len(folds) + 3}] {result['name']}", file=sys.stderr, flush=True)
            text = learner.stderr.read().strip()
        if learner.returncode != 0:
            fail(text or f"learn_weights: exit code {learner.returncode}", "make accuracy for these scenes again", "A05", 3)
    return found


def choose():
    """The finished scenes that ONLY names, the buildings or families to leave out, and how many scenes these are."""
    try:
        named = scenes.choose(scenes.all_scenes(accuracy.DATA), os.environ.get("ONLY", ""))
    except ValueError as problem:
        fail(problem, "ONLY= takes groups, families, buildings, scenes or patterns, separated by spaces or commas")
    chosen = [scene for scene in named if finished(scene)]
    kinds = list(dict.fromkeys(scene["kind"] for scene in chosen))
    if len(kinds) < 2:
        fail(f"{accuracy.ROOT}: fewer than two buildings or families are finished", "make accuracy first, with the same ONLY= and ROOT=")
    wanted = os.environ.get("FOLDS", "").replace(",", " ").split()
    folds = [kind for kind in wanted if kind != "none"] if wanted else [kind for kind in kinds if kind in scenes.VIRTUAL]
    if unknown := sorted(set(folds) - set(kinds)):
        fail(f"FOLDS={' '.join(unknown)}: no finished scene is of that building", f"buildings and families: {' '.join(kinds)}; or none")
    return chosen, folds, f"{len(chosen)} scenes of {len(named)} are finished"


def read_generations():
    text = os.environ.get("GENERATIONS") or str(GENERATIONS)
    if not text.isdecimal():
        fail(f"GENERATIONS={text}: is no number", "GENERATIONS= is how long the search goes on, e.g. 200")
    return int(text)


def write(path, text):
    with open(path + ".new", "w", encoding="utf-8") as out:
        out.write(text)
    os.replace(path + ".new", path)
    print(f"written: {os.path.relpath(path)}")


def main():
    build, generations = os.path.abspath(sys.argv[1]), read_generations()
    chosen, folds, said = choose()
    try:
        with ThreadPoolExecutor(JOBS) as pool:
            lessons = [lesson for of_scene in pool.map(lambda scene: lessons_of(build, scene), chosen) for lesson in of_scene]
    except scene_run.Failed as problem:
        fail(f"evaluate: {problem}", "make accuracy for this scene again", "A05", 3)
    print(f"{said}: {len(lessons)} lessons")
    found = learn(build, lessons, generations, folds)
    rows = left_out_table.rows_of(found, {lesson["building"]: lesson["made_up"] for lesson in lessons})
    print(f"\n{left_out_table.score_table(rows)}\n\n{left_out_table.weight_table(found)}\n")
    out = os.path.abspath(os.environ.get("OUT") or os.path.join(accuracy.ROOT, "left_out.json"))
    write(out, json.dumps(left_out_table.as_json(found, rows, generations), indent=1) + "\n")
    with open(SHIPPED, encoding="utf-8") as shipped:
        write(os.path.join(os.path.dirname(out), "learned.table"), left_out_table.with_weights(shipped.read(), left_out_table.robust_weights(found)))


if __name__ == "__main__":
    main()
