# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of `make accuracy`, and the choice among them.

A scene is a dict with `name` (unique, also the name of its folder), `group`, `kind` (family or building), and either `scene`, what
`synthesize` makes it from (schemas/scene.md), or `folder`, where a scan and its truth lie; `stations`: with the scanner positions of the truth.
"""
import fnmatch
import os

FAMILIES = ("office", "oblique", "multi_storey", "house", "thin", "curved")
SEEDS = range(1, 6)
POINTS = 600000
FURNITURE_PER_M2 = 0.12

# What differs between the groups of synthetic scenes; doors and furniture unless said.
GROUPS = {
    "uniform": {"noise_m": 0.005},
    "tripod": {"noise_m": 0.005, "holes": 0.1, "outliers": 0.01, "sampling": {"kind": "tripod"}, "random": {"unscanned": 0.1}},
    "noise_1cm": {"noise_m": 0.01},
    "noise_2cm": {"noise_m": 0.02},
    "closed": {"noise_m": 0.005, "clutter_per_m2": 0, "random": {"doors": False, "shafts": False}},
}
VIRTUAL = ("bimwhale_large", "duplex", "fzk_haus", "institute_var2", "niedriha")


def synthetic(group, family, seed):
    own = GROUPS[group]
    scene = {"name": f"{group}_{family}_{seed}", "seed": seed, "clutter_per_m2": FURNITURE_PER_M2, **own}
    scene["sampling"] = {"points": POINTS, **own.get("sampling", {})}
    scene["random"] = {"family": family, "seed": seed, **own.get("random", {})}
    return {"name": scene["name"], "group": group, "kind": family, "scene": scene}


def virtual(folder):
    """The virtual scans of real buildings, without and with scanner positions; none when the folder is not there."""
    found = [kind for kind in VIRTUAL if os.path.isfile(os.path.join(folder, kind, "cloud.ply"))]
    return [{"name": f"{group}_{kind}", "group": group, "kind": kind, "folder": os.path.join(folder, kind), "stations": stations}
            for group, stations in (("virtual", False), ("virtual_stations", True)) for kind in found]


def all_scenes(data):
    """Every scene, the longest first; `data` is the folder of the virtual buildings."""
    return virtual(data) + [synthetic(group, family, seed) for group in GROUPS for family in FAMILIES for seed in SEEDS]


def choose(scenes, only):
    """The scenes that `only` names: groups, families, buildings, scenes, or patterns of scene names, separated by spaces or commas.

    Raises ValueError when a word names none.
    """
    words = only.replace(",", " ").split()
    chosen = set()
    for word in words:
        hits = [s["name"] for s in scenes if word in (s["group"], s["kind"]) or fnmatch.fnmatchcase(s["name"], word)]
        if not hits:
            groups = " ".join(dict.fromkeys(s["group"] for s in scenes))
            raise ValueError(f"no scene is called {word}; groups: {groups}; families: {' '.join(FAMILIES)}")
        chosen.update(hits)
    return [s for s in scenes if not words or s["name"] in chosen]
