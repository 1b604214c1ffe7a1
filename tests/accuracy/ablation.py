#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each addition to the paper is worth: every line of stages/presets/paper_2013.yaml alone, all else at its default.

usage: ablation.py BUILD; from the environment ONLY (which scenes, default: seed 1 of every family in every group, and the virtual
buildings), SWITCHES (which, as stage.parameter), JOBS (scenes at a time), ROOT (of the work folders, instead of work/accuracy). Starts
from the runs of `make accuracy`, of which only what follows from the switch is made again. Results are kept in ROOT/ablation.json
and not measured again; delete it for a fresh start.
"""
import json
import os
import re
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor

import ablation_table
import scene_run
import scenes
from ablation_table import ALL, DEFAULT
from accuracy import DATA, PRESETS, ROOT, SOURCE, fail

PRESET = os.path.join(PRESETS, "paper_2013.yaml")
USUAL = "virtual *_1"
# What goes with another line: values that are no addition, and the votes without which mean shift takes every crossing of two streaks in
# the accumulator for a line.
GOES_WITH = {"detect_lines.search": ["detect_lines.min_support_m", "detect_lines.vote_window_deg", "detect_lines.votes"],
             "detect_lines.wider": ["slice.tau_m"], "weigh_faces.correct_density": ["weigh_faces.tau_m"]}
VALUES = ("slice.tau_m", "detect_lines.min_support_m", "weigh_faces.tau_m")
# Only volumes and rooms are looked at: coarser samples of the surface do.
COARSE = ["--set", "sample_spacing_m=0.3", "--set", "column_spacing_m=0.05"]


def read_preset(path):
    """{"stage.parameter": value} as it stands there; a preset is blocks of plain lines."""
    values, block = {}, ""
    with open(path, encoding="utf-8") as text:
        for line in text:
            if found := re.match(r"(\w+):\s*$", line):
                block = found[1]
            elif found := re.match(r"  (\w+): *([^#]*[^#\s])", line):
                values[f"{block}.{found[1]}"] = found[2]
    return values


def variants(preset):
    """{name: parameters that differ from the defaults}, from the last stage to the first: what is quick comes first."""
    single = {name: {key: preset[key] for key in (name, *GOES_WITH.get(name, []))} for name in reversed(preset) if name not in VALUES}
    return {DEFAULT: {}, ALL: preset, **single}


def config_text(values):
    blocks = {}
    for name, value in values.items():
        stage, parameter = name.split(".")
        blocks.setdefault(stage, []).append(f"  {parameter}: {value}\n")
    return "".join(f"{stage}:\n{''.join(lines)}" for stage, lines in blocks.items())


def same_file(a, b):
    with open(a, "rb") as one, open(b, "rb") as other:
        return one.read() == other.read()


def score(build, work, truth, truth_json):
    """The figures of the table."""
    scene_run.run([os.path.join(build, "bin", "evaluate"), "-q", "--threads", "1", "--work", work, "--truth", truth, "--truth-json", truth_json,
                   "--cloud", os.path.join(work, "10_ingest", "cloud.h5"), *COARSE])
    scores = scene_run.read_json(os.path.join(work, "evaluate", "scores.json"))
    row = scene_run.row_of({**scores, "explanation": None}, scene_run.read_json(truth_json), 0.0)
    return {key: row[key] for key in ("iou", "rooms", "missed", "merged")}


def measure(build, scene, values, default):
    """Runs one scene with these parameters in a copy of its default run."""
    base = os.path.join(ROOT, scene["name"])
    work = os.path.join(ROOT, "ablation", scene["name"])
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(base, exist_ok=True)
    try:
        scan, truth, truth_json = scene_run.make_scan(build, scene, base)
        if not values:
            scene_run.make_model(SOURCE, build, base, scan, scene_run.stations_file(scene, truth_json, base), "")
        shutil.copytree(base, work, ignore=shutil.ignore_patterns("scan.ply", "truth.*", "evaluate", ".lock"))
        if values:
            config = os.path.join(work, "parameters.yaml")
            scene_run.write_if_changed(config, config_text(values))
            scene_run.make_model(SOURCE, build, work, scan, scene_run.stations_file(scene, truth_json, work), config)
            if default and "error" not in default and same_file(os.path.join(base, "model.ply"), os.path.join(work, "model.ply")):
                return default
        return score(build, work, truth, truth_json)
    except scene_run.Failed as failure:
        return {"error": str(failure)}
    finally:
        shutil.rmtree(work, ignore_errors=True)


class Results:
    """ROOT/ablation.json: {variant: {"parameters": text, "scenes": {scene: figures}}}."""

    def __init__(self, path):
        self.path = path
        self.content = scene_run.read_json(path) if os.path.isfile(path) else {}

    def of(self, variant, values):
        known = self.content.get(variant)
        if not known or known["parameters"] != config_text(values):
            known = self.content[variant] = {"parameters": config_text(values), "scenes": {}}
        return known["scenes"]

    def save(self):
        with open(self.path + ".new", "w", encoding="utf-8") as text:
            json.dump(self.content, text, indent=1)
        os.replace(self.path + ".new", self.path)


def run_variant(build, chosen, values, known, default, pool):
    """Figures of the scenes that are not known yet; a failure is no figure, and is tried again."""
    todo = [scene for scene in chosen if "error" in known.get(scene["name"], {"error": ""})]
    rows = pool.map(lambda scene: measure(build, scene, values, default.get(scene["name"])), todo)
    for scene, row in zip(todo, rows):
        known[scene["name"]] = row


def main():
    build = os.path.abspath(sys.argv[1])
    every = variants(read_preset(PRESET))
    names = [DEFAULT, *(os.environ.get("SWITCHES", "").split() or list(every)[1:])]
    for name in names:
        if name not in every:
            fail(f"ablation: {name} is no switch of the preset", f"switches: {' '.join(list(every)[1:])}")
    try:
        chosen = [scene for scene in scenes.choose(scenes.all_scenes(DATA), os.environ.get("ONLY") or USUAL) if "mu_m" not in scene]
    except ValueError as problem:
        fail(problem, "ONLY= takes groups, families, buildings, scenes or patterns, as in make accuracy")
    os.makedirs(os.path.join(ROOT, "ablation"), exist_ok=True)
    results = Results(os.path.join(ROOT, "ablation.json"))
    default = results.of(DEFAULT, {})
    with ThreadPoolExecutor(int(os.environ.get("JOBS") or os.cpu_count())) as pool:
        for i, name in enumerate(names):
            known = results.of(name, every[name])
            run_variant(build, chosen, every[name], known, default, pool)
            results.save()
            total = ablation_table.figures([known[scene["name"]] for scene in chosen])
            print(f"[{i + 1}/{len(names)}] {name}: IoU {total['iou']:.4f}, missed {total['missed']}, merged {total['merged']}, failed {total['failed']}",
                  file=sys.stderr, flush=True)
    print(ablation_table.markdown(chosen, results.content, names))


if __name__ == "__main__":
    main()
