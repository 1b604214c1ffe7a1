# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of `make accuracy`, and the choice among them.

A scene is a dict with `name` (unique, also the name of its folder), `group`, `kind` (family or building), and either `scene`, what
`synthesize` makes it from (schemas/scene.md), with `points_per_m2` instead of its number of points, or `folder`, where a scan and its truth lie; `stations`: with the scanner positions of the truth;
`mu_m`: a graphcut.mu_m of its own, in the work folder `work` that it shares with its building's other values; `asked`: the word that names it with others, it runs only when named.
A case has `scan`, and either `truth`, a mesh, or `scene`, of which only the truth is taken. A moved scene has `base`, the scene that is moved, and `pose`.
"""
import fnmatch
import json
import math
import os

import moved

FAMILIES = ("office", "oblique", "multi_storey", "house", "thin", "curved")
SEEDS = range(1, 6)
POINTS = 600000
FURNITURE_PER_M2 = 0.12

# All that `synthesize` can add to a random building.
ELEMENTS = ["heights", "arcs", "roof", "ramps", "beams", "columns", "niches"]
# What differs between the groups of synthetic scenes; doors and furniture unless said.
GROUPS = {
    "uniform": {"noise_m": 0.005},
    "tripod": {"noise_m": 0.005, "holes": 0.1, "outliers": 0.01, "sampling": {"kind": "tripod"}, "random": {"unscanned": 0.1}},
    "noise_1cm": {"noise_m": 0.01},
    "noise_2cm": {"noise_m": 0.02},
    "unknown": {"noise_m": 0.005, "holes": 0.1, "outliers": 0.01, "sampling": {"kind": "tripod"}, "random": {"unscanned": 0.3}},
    "handheld": {"noise_m": 0.005, "handheld": {"warp_m": 0.02, "correlation_m": 1, "rounding_m": 0.05}},
    "closed": {"noise_m": 0.005, "clutter_per_m2": 0, "random": {"doors": False, "shafts": False}},
    "roofs": {"noise_m": 0.005, "random": {"elements": ["roof", "ramps"]}},
    "round": {"noise_m": 0.005, "random": {"elements": ["arcs"]}},
    "heights": {"noise_m": 0.005, "random": {"elements": ["heights"]}},
    "columns": {"noise_m": 0.005, "random": {"elements": ["columns"]}},
    "niches": {"noise_m": 0.005, "random": {"elements": ["niches"]}},
    "all_elements": {"noise_m": 0.005, "holes": 0.05, "outliers": 0.01, "sampling": {"kind": "tripod"}, "random": {"elements": ELEMENTS}},
}
# Groups of some families only, and as dense as the scanners that they stand for, whatever the building's size [points per m^2].
FAMILIES_OF = {"handheld": ("office", "oblique", "house"), "roofs": ("house", "oblique"), "round": ("office",), "heights": ("office",), "columns": ("office",), "niches": ("office",), "all_elements": ("house",)}
DENSITIES = {"handheld": 300}
# Buildings that try the mesh, not the accuracy: small scans, half of them from tripods, at three levels of detail; only when asked for.
RANDOM_SEEDS = range(101, 151)
# The same with slopes, arcs, columns and all else that a building may have, by `random_elements`.
ELEMENT_SEEDS = range(201, 251)
RANDOM_MU_M = (0.05, 0.3, 1.0)
RANDOM_POINTS = 150000
# One room under a monopitch roof of every pitch; only when asked for, by `slopes` or by name.
SLOPES_DEG = range(1, 61)
VIRTUAL = ("bimwhale_large", "bodo_school", "duplex", "fzk_haus", "hom", "institute_var2", "kit_edc", "nibs_office", "niedriha", "smiley_west")


# Scenes in several poses: all kinds of angles, storeys, scanners.
MOVED = (("uniform", "house", 1), ("uniform", "oblique", 2), ("tripod", "multi_storey", 3))
MOVED_VIRTUAL = ("virtual_duplex", "virtual_niedriha")
# Cases that are a scene of this repository, or have its truth.
CASES_OF_OWN_SCENES = {"lost_raised_floor": {"file": "paper_two_storeys", "points": 400000}, "sparse_12_per_m2": {"file": "paper_two_storeys", "points": 15000}}
OWN_SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "scenes")


def synthetic(group, family, seed):
    own = GROUPS[group]
    scene = {"name": f"{group}_{family}_{seed}", "seed": seed, "clutter_per_m2": FURNITURE_PER_M2, **own}
    scene["sampling"] = {"points": POINTS, **own.get("sampling", {})}
    scene["random"] = {"family": family, "seed": seed, **own.get("random", {})}
    density = {"points_per_m2": DENSITIES[group]} if group in DENSITIES else {}
    return {"name": scene["name"], "group": group, "kind": family, "scene": scene, **density}


def slope(degrees):
    """A closed room of 6 x 4 m, its ceiling 1.2 m high along one side; turned, so that no pitch has the same azimuth."""
    turn, corners = math.radians(11 * degrees), [(0, 0), (6, 0), (6, 4), (0, 4)]
    polygon = [[round(x * math.cos(turn) - y * math.sin(turn), 6), round(x * math.sin(turn) + y * math.cos(turn), 6)] for x, y in corners]
    azimuth = (11 * degrees - 90) % 360
    scene = {"name": f"slopes_{degrees:02}", "seed": degrees, "noise_m": 0.005, "sampling": {"points": 100000}, "storeys": [{"floor": 0, "ceiling": 20, "rooms": [
        {"name": "a", "polygon": polygon, "roof": {"kind": "monopitch", "pitch_deg": degrees, "azimuth_deg": azimuth, "eaves": 1.2}}]}]}
    return {"name": scene["name"], "group": "slopes", "kind": "slope", "scene": scene, "asked": "slopes"}


def random_building(family, seed, word="random", elements=()):
    """One building at every mu, from small to large."""
    rough = seed % 2 == 1
    scene = {"name": f"{word}_{family}_{seed}", "seed": seed, "noise_m": 0.002 * (1 + seed % 10), "clutter_per_m2": 0.1 * (seed % 3),
             "sampling": {"kind": "tripod" if rough else "uniform", "points": RANDOM_POINTS}, "random": {"family": family, "seed": seed}}
    if elements:
        scene["random"]["elements"] = elements
    if rough:
        scene.update({"holes": 0.1, "outliers": 0.01})
        scene["random"]["unscanned"] = 0.1
    return [{"name": f"{scene['name']}_mu{mu}", "group": f"{word}_mu{mu}", "kind": family, "scene": scene, "work": scene["name"],
             "mu_m": mu, "asked": word} for mu in RANDOM_MU_M]


def virtual(folder):
    """The virtual scans of real buildings, without and with scanner positions; none when the folder is not there."""
    found = [kind for kind in VIRTUAL if os.path.isfile(os.path.join(folder, kind, "cloud.ply"))]
    return [{"name": f"{group}_{kind}", "group": group, "kind": kind, "folder": os.path.join(folder, kind), "stations": stations}
            for group, stations in (("virtual", False), ("virtual_stations", True)) for kind in found]


def cases(folder):
    """Small scans and scenes that each stand for a kind of fault, as far as they have a truth; none when the folder is not there."""
    found = []
    for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
        scan, truth, scene = (os.path.join(folder, name, file) for file in ("scan.ply", "truth.off", "scene.json"))
        case = {"name": f"cases_{name}", "group": "cases", "kind": name}
        if os.path.isfile(scan) and os.path.isfile(truth):
            found.append({**case, "scan": scan, "truth": truth})
        elif os.path.isfile(scene):
            found.append({**case, "scene": read_scene(scene)})
        elif name in CASES_OF_OWN_SCENES:
            found.append({**case, "scene": own_scene(**CASES_OF_OWN_SCENES[name]), **({"scan": scan} if os.path.isfile(scan) else {})})
    return found


def read_scene(path):
    with open(path, encoding="utf-8") as text:
        return json.load(text)


def own_scene(file, points):
    """A scene of tests/data/scenes/ with so many points."""
    scene = read_scene(os.path.join(OWN_SCENES, file + ".json"))
    scene["sampling"] = {**scene["sampling"], "points": points}
    return scene


def moved_scenes(data):
    """Each base in every pose. One after the other: they share the base."""
    raised = {"name": "raised_floor", "scene": own_scene("paper_two_storeys", 400000)}
    bases = [raised] + [synthetic(*base) for base in MOVED] + [scene for scene in virtual(data) if scene["name"] in MOVED_VIRTUAL]
    return [{"name": f"moved_{base['name']}_{pose}", "group": "moved", "kind": f"moved_{base['name']}", "base": base, "pose": pose}
            for base in bases for pose in moved.POSES]


def all_scenes(data):
    """Every scene, the longest first; `data` is the folder of the data to judge by, with virtual/ and cases/."""
    buildings = os.path.join(data, "virtual")
    usual = virtual(buildings) + moved_scenes(buildings) + cases(os.path.join(data, "cases")) + [synthetic(group, family, seed) for group in GROUPS for family in FAMILIES_OF.get(group, FAMILIES) for seed in SEEDS]
    plain = [scene for seed in RANDOM_SEEDS for family in FAMILIES for scene in random_building(family, seed)]
    with_elements = [scene for seed in ELEMENT_SEEDS for family in FAMILIES for scene in random_building(family, seed, "random_elements", ELEMENTS)]
    return usual + [slope(degrees) for degrees in SLOPES_DEG] + plain + with_elements


def choose(scenes, only):
    """The scenes that `only` names: groups, families, buildings, scenes, or patterns of scene names, separated by spaces or commas;
    without any word all but those that are `asked` for: the random buildings, which `random` and `random_elements` name, and the `slopes`.

    Raises ValueError when a word names none.
    """
    words = only.replace(",", " ").split()
    usual = [scene for scene in scenes if "asked" not in scene]
    if not words:
        return usual
    chosen = set()
    for word in words:
        hits = [s["name"] for s in scenes if word == s.get("asked") or fnmatch.fnmatchcase(s["name"], word)]
        hits += [s["name"] for s in usual if word in (s["group"], s["kind"])]
        if not hits:
            groups = " ".join(dict.fromkeys(s["group"] for s in scenes))
            raise ValueError(f"no scene is called {word}; groups: {groups}; families: {' '.join(FAMILIES)}")
        chosen.update(hits)
    return [s for s in scenes if s["name"] in chosen]
