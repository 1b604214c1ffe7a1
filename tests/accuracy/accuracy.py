#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How right the models are: runs scenes of known truth with default parameters, scores them, prints one table, writes it as JSON.

usage: accuracy.py BUILD; from the environment ONLY (which scenes), BASE (an earlier result to compare with), OUT (where to write),
JOBS (scenes at a time), ROOT (of the work folders, instead of work/accuracy), PRESET (parameters of stages/presets/ instead of the
defaults; in ROOT/PRESET/). Exit code 1 when a scene gave no model or no valid one.
"""
import json
import os
import sys
from concurrent.futures import ThreadPoolExecutor

import scene_run
import scenes
import table

SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
DATA = os.path.join(SOURCE, "..", "shared", "data")
ROOT = os.environ.get("ROOT") or os.path.join(SOURCE, "work", "accuracy")
PRESETS = os.path.join(SOURCE, "stages", "presets")


def fail(text, hint):
    print(f"error[U01] make accuracy: {text}\nhint: {hint}", file=sys.stderr)
    sys.exit(2)


def preset_file(name):
    """The parameters of PRESET, or "" without one."""
    path = os.path.join(PRESETS, name + ".yaml")
    if name and not os.path.isfile(path):
        known = sorted(file.removesuffix(".yaml") for file in os.listdir(PRESETS) if file.endswith(".yaml"))
        fail(f"PRESET={name}: there is no {os.path.relpath(path, SOURCE)}", f"presets: {' '.join(known)}")
    return path if name else ""


def run_all(chosen, build, jobs, root, preset):
    rows, tasks = {}, {}
    for scene in chosen:  # those that share a folder run one after the other
        tasks.setdefault(scene_run.shared_folder(scene), []).append(scene)
    with ThreadPoolExecutor(jobs) as pool:
        run_task = lambda task: [scene_run.run_scene(SOURCE, build, scene, root, preset, ROOT) for scene in task]  # noqa: E731
        for made in pool.map(run_task, tasks.values()):
            for row in made:
                rows[row["name"]] = row
                result = row.get("error") or f"{row['iou']:.4f}{'' if row['valid'] else ' NOT VALID'}"
                print(f"[{len(rows)}/{len(chosen)}] {row['name']}: {result}", file=sys.stderr, flush=True)
    return [rows[scene["name"]] for scene in chosen]


def load_base(path):
    try:
        return scene_run.read_json(path)
    except (OSError, ValueError) as problem:
        fail(f"BASE={path}: {problem}", "BASE= names the JSON of an earlier make accuracy")


def main():
    build = os.path.abspath(sys.argv[1])
    base = load_base(os.environ["BASE"]) if os.environ.get("BASE") else None
    preset_name = os.environ.get("PRESET", "")
    preset, root = preset_file(preset_name), os.path.join(ROOT, preset_name)
    every = scenes.all_scenes(DATA)
    if not any("folder" in scene for scene in every):
        print("virtual buildings and cases skipped: no ../shared/data")
    try:
        chosen = scenes.choose(every, os.environ.get("ONLY", ""))
    except ValueError as problem:
        fail(problem, "ONLY= takes groups, families, buildings, scenes or patterns, separated by spaces or commas")
    if preset and any("mu_m" in scene for scene in chosen):
        fail("PRESET= and random buildings: these have parameters of their own", "leave one of them out")
    rows = run_all(chosen, build, int(os.environ.get("JOBS") or os.cpu_count()), root, preset)
    groups = table.group_rows(rows)
    out = os.path.abspath(os.environ.get("OUT") or os.path.join(root, "accuracy.json"))
    with open(out + ".new", "w", encoding="utf-8") as text:
        json.dump({"artefact": "accuracy", "schema_version": "1.0", "groups": groups, "scenes": rows}, text, indent=1)
        text.write("\n")
    os.replace(out + ".new", out)
    print(table.table(rows, groups))
    default = os.path.join(ROOT, "accuracy.json")
    if preset and os.path.isfile(default):
        print(table.beside(rows, load_base(default)["scenes"], preset_name))
    if base:
        print(table.changes(rows, groups, base))
    print(f"written: {os.path.relpath(out)}")
    sys.exit(0 if all(row.get("valid") for row in rows) else 1)


if __name__ == "__main__":
    main()
