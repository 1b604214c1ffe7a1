# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of `make accuracy`, and the choice among them.

A scene is a dict with `name` (unique, also the name of its folder), `group`, `kind` (family or building), and either `scene`, what
`synthesize` makes it from (schemas/scene.md), or `folder`, where a scan and its truth lie; `stations`: with the scanner positions of the truth;
`mu_m`: a graphcut.mu_m of its own, in the work folder `work` that it shares with its building's other values.
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
# Buildings that try the mesh, not the accuracy: small scans, half of them from tripods, at three levels of detail; only when asked for.
RANDOM_SEEDS = range(101, 151)
RANDOM_MU_M = (0.05, 0.3, 1.0)
RANDOM_POINTS = 150000
VIRTUAL = ("bimwhale_large", "bodo_school", "duplex", "fzk_haus", "hom", "institute_var2", "kit_edc", "nibs_office", "niedriha", "smiley_west")


def synthetic(group, family, seed):
    own = GROUPS[group]
    scene = {"name": f"{group}_{family}_{seed}", "seed": seed, "clutter_per_m2": FURNITURE_PER_M2, **own}
    scene["sampling"] = {"points": POINTS, **own.get("sampling", {})}
    scene["random"] = {"family": family, "seed": seed, **own.get("random", {})}
    return {"name": scene["name"], "group": group, "kind": family, "scene": scene}


def random_building(family, seed):
    """One building at every mu, from small to large."""
    rough = seed % 2 == 1
    scene = {"name": f"random_{family}_{seed}", "seed": seed, "noise_m": 0.002 * (1 + seed % 10), "clutter_per_m2": 0.1 * (seed % 3),
             "sampling": {"kind": "tripod" if rough else "uniform", "points": RANDOM_POINTS}, "random": {"family": family, "seed": seed}}
    if rough:
        scene.update({"holes": 0.1, "outliers": 0.01})
        scene["random"]["unscanned"] = 0.1
    return [{"name": f"{scene['name']}_mu{mu}", "group": f"random_mu{mu}", "kind": family, "scene": scene, "work": scene["name"],
             "mu_m": mu} for mu in RANDOM_MU_M]


def virtual(folder):
    """The virtual scans of real buildings, without and with scanner positions; none when the folder is not there."""
    found = [kind for kind in VIRTUAL if os.path.isfile(os.path.join(folder, kind, "cloud.ply"))]
    return [{"name": f"{group}_{kind}", "group": group, "kind": kind, "folder": os.path.join(folder, kind), "stations": stations}
            for group, stations in (("virtual", False), ("virtual_stations", True)) for kind in found]


def all_scenes(data):
    """Every scene, the longest first; `data` is the folder of the virtual buildings."""
    usual = virtual(data) + [synthetic(group, family, seed) for group in GROUPS for family in FAMILIES for seed in SEEDS]
    return usual + [scene for seed in RANDOM_SEEDS for family in FAMILIES for scene in random_building(family, seed)]


def choose(scenes, only):
    """The scenes that `only` names: groups, families, buildings, scenes, or patterns of scene names, separated by spaces or commas;
    without any word all but the random buildings, which `random` names.

    Raises ValueError when a word names none.
    """
    words = only.replace(",", " ").split()
    usual = [scene for scene in scenes if "mu_m" not in scene]
    if not words:
        return usual
    chosen = set()
    for word in words:
        hits = [s["name"] for s in scenes if "mu_m" in s and word == "random" or fnmatch.fnmatchcase(s["name"], word)]
        hits += [s["name"] for s in usual if word in (s["group"], s["kind"])]
        if not hits:
            groups = " ".join(dict.fromkeys(s["group"] for s in scenes))
            raise ValueError(f"no scene is called {word}; groups: {groups}; families: {' '.join(FAMILIES)}")
        chosen.update(hits)
    return [s for s in scenes if s["name"] in chosen]
