#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the weights of the data term are tuned to the buildings they were found on: they are fitted anew with every building left out.

Takes the scenes that `make accuracy` ran, as they lie. Left out is one of the virtual buildings, or one family of synthetic ones, with all its
scans; the weights are fitted to all others (weight_fit.py) and scored on what was left out, beside those that raycast has.

usage: leave_one_out.py BUILD; from the environment ONLY (which scenes), OUT (where to write), JOBS (evaluations at a time), ROOT (of the
work folders, instead of work/accuracy). No scene is made or reconstructed; only `evaluate` runs where its scores are out of date.
"""
import json
import os
import sys
from concurrent.futures import ThreadPoolExecutor

import accuracy
import scene_run
import scenes

try:
    import weight_fit
    import weight_terms
except ImportError as missing:
    print(f"error[U01] make accuracy-weights: {sys.executable} has no {missing.name}\n"
          "hint: apt-get install python3-numpy python3-h5py, and use Debian's /usr/bin/python3", file=sys.stderr)
    sys.exit(2)

SCORED = (("shipped", "shipped"), ("without", "without it"), ("all", "with all"))
FINAL = [os.path.join("90_final", name + ".h5") for name in ("cells", "weights", "data_terms", "labels")]


def fail(text, hint, code="U01", status=2):
    print(f"error[{code}] make accuracy-weights: {text}\nhint: {hint}", file=sys.stderr)
    sys.exit(status)


def finished(scene):
    """Whether `make accuracy` came to a model of this scene. Those with a mu of their own share their building's folder; a moved scene is
    a building that is there already."""
    work = os.path.join(accuracy.ROOT, scene["name"])
    files = [os.path.join(work, name) for name in (*FINAL, "model.ply")] + scene_run.scan_files(scene, work)[1:]
    return "mu_m" not in scene and "base" not in scene and all(map(os.path.isfile, files))


def read_scene(scene, build):
    work = os.path.join(accuracy.ROOT, scene["name"])
    _, truth, truth_json = scene_run.scan_files(scene, work)
    scene_run.evaluate(build, scene, work, truth, truth_json)
    return weight_terms.read_terms(work)


def read_buildings(chosen, build):
    """The building of each kind: family, or virtual building with and without scanner positions."""
    parts = {}
    with ThreadPoolExecutor(int(os.environ.get("JOBS") or os.cpu_count())) as pool:
        for scene, part in zip(chosen, pool.map(lambda scene: read_scene(scene, build), chosen)):
            parts.setdefault(scene["kind"], []).append(part)
    return {kind: weight_fit.joined(of_kind) for kind, of_kind in parts.items()}, {kind: len(of_kind) for kind, of_kind in parts.items()}


def mean_row(rows):
    means = {key: {figure: sum(row[key][figure] for row in rows) / len(rows) for figure in ("wrong", "log_loss")} for key, _ in SCORED}
    return {"name": "mean", "scenes": sum(row["scenes"] for row in rows), "cells": sum(row["cells"] for row in rows),
            "volume_m3": sum(row["volume_m3"] for row in rows), "bound": sum(row["bound"] for row in rows) / len(rows), **means}


def score_table(rows):
    width = max(len(row["name"]) for row in rows + [{"name": "left out"}])
    head = f"{'':<{width}} {'':>6} {'':>7} {'':>9} {'wrong sign, % of the volume':>44}  {'mean log-loss':>32}"
    names = f"{'left out':<{width}} {'scenes':>6} {'cells':>7} {'volume m3':>9} {'bound':>11}" + "".join(f"{name:>11}" for _, name in SCORED)
    lines = [head, names + " " + "".join(f"{name:>11}" for _, name in SCORED)]
    for row in [*rows, mean_row(rows)]:
        lines.append(f"{row['name']:<{width}} {row['scenes']:>6} {row['cells']:>7} {row['volume_m3']:>9.0f} {100 * row['bound']:>11.3f}"
                     + "".join(f"{100 * row[key]['wrong']:>11.3f}" for key, _ in SCORED) + " "
                     + "".join(f"{row[key]['log_loss']:>11.4f}" for key, _ in SCORED))
    better = sum(row["without"]["wrong"] < row["shipped"]["wrong"] for row in rows)
    return "\n".join([*lines, f"weights that never saw the building have fewer wrong signs than the shipped ones in {better} of {len(rows)}"])


def weight_table(rows, shipped, fitted):
    lines = [f"{'weight':<16} {'shipped':>8} {'with all':>9} {'smallest':>9} {'largest':>9}  (over what was left out)"]
    for name, value in shipped.items():
        folds = [row["weights"][name] for row in rows]
        lines.append(f"{name:<16} {value:>8.2f} {fitted[name]:>9.2f} {min(folds):>9.2f} {max(folds):>9.2f}")
    return "\n".join(lines)


def write(rows, fitted):
    out = os.path.abspath(os.environ.get("OUT") or os.path.join(accuracy.ROOT, "left_out.json"))
    with open(out + ".new", "w", encoding="utf-8") as text:
        json.dump({"artefact": "left_out", "schema_version": "1.0", "ridge": weight_fit.RIDGE, "shipped": weight_terms.SHIPPED,
                   "all": fitted, "left_out": rows, "mean": mean_row(rows)}, text, indent=1)
        text.write("\n")
    os.replace(out + ".new", out)
    return out


def main():
    build = os.path.abspath(sys.argv[1])
    try:
        named = scenes.choose(scenes.all_scenes(accuracy.DATA), os.environ.get("ONLY", ""))
    except ValueError as problem:
        fail(problem, "ONLY= takes groups, families, buildings, scenes or patterns, separated by spaces or commas")
    chosen = [scene for scene in named if finished(scene)]
    if len({scene["kind"] for scene in chosen}) < 2:
        fail(f"{accuracy.ROOT}: fewer than two buildings or families are finished", "make accuracy first, with the same ONLY= and ROOT=")
    try:
        buildings, counts = read_buildings(chosen, build)
    except weight_terms.Unusable as problem:
        fail(problem, problem.remedy, "A05", 3)
    except scene_run.Failed as problem:
        fail(f"evaluate: {problem}", "make accuracy for this scene again", "A05", 3)
    found, fitted = weight_fit.leave_out(buildings, weight_terms.shipped_weights())
    named_weights = [dict(zip(weight_terms.SHIPPED, map(float, weights))) for weights in [fitted, *(row["weights"] for row in found)]]
    rows = [{**row, "scenes": counts[row["name"]], "weights": weights} for row, weights in zip(found, named_weights[1:])]
    print(f"{len(chosen)} scenes of {len(named)} are finished\n\n{score_table(rows)}\n\n{weight_table(rows, weight_terms.SHIPPED, named_weights[0])}\n")
    print(f"written: {os.path.relpath(write(rows, named_weights[0]))}")


if __name__ == "__main__":
    main()
