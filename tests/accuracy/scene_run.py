# SPDX-License-Identifier: GPL-3.0-or-later
"""One scene of `make accuracy`: scan, model, scores. What is up to date is not made again."""
import json
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import moved  # noqa: E402
from pipeline_table import RUNS  # noqa: E402

# Stages whose processor time counts: all that the model needs.
STAGES = tuple(run.name for run in RUNS if run.name != "report")
TOLERANCE_M = 1e-6
VOLUME_TOLERANCE = 1e-6  # relative: rounding of coordinates, far below any cell
OUTER = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "SCAN", "WORK", "CONFIG", "JOBS", "UP", "UNIT", "STATIONS", "TRUTH", "QUIET")


# Of a model without volumes.
OF_NO_ROOMS = {"volume_m3": 0.0, "denied_m3": 0.0, "found": 0, "unknown": 0, "denied": 0}


class Failed(Exception):
    """A stage gave up; the text is its first error."""


def read_json(path):
    with open(path, encoding="utf-8") as text:
        return json.load(text)


def write_if_changed(path, text):
    if not os.path.isfile(path) or open(path, encoding="utf-8").read() != text:
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)


def run(command, **variables):
    environment = {name: value for name, value in os.environ.items() if name not in OUTER}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**environment, **variables})
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if line.startswith("error")] or done.stderr.splitlines() or ["no message"]
        raise Failed(lines[0])


def is_fresh(stamp, key, files):
    """Whether `files` are there and `stamp` holds `key`, which says what they were made from."""
    return all(map(os.path.isfile, files)) and os.path.isfile(stamp) and open(stamp, encoding="utf-8").read() == key


def identity(path):
    status = os.stat(path)
    return f"{path} {status.st_size} {status.st_mtime_ns}"


def scan_files(scene, work):
    """Paths of scan, truth mesh and truth.json."""
    folder, scan = (scene["folder"], "cloud.ply") if "folder" in scene else (work, "scan.ply")
    files = [os.path.join(folder, name) for name in (scan, "truth.off", "truth.json")]
    return [scene.get("scan", files[0]), scene.get("truth", files[1]), files[2]]


def shared_folder(scene):
    """What a scene shares with others, which therefore must not run at the same time: a work folder, or a base that is moved."""
    return scene.get("work") or (scene["kind"] if "base" in scene else scene["name"])


def make_moved(build, scene, work):
    """scan_files() of a scene whose base has been moved; the base lies in a folder beside."""
    folder = os.path.join(os.path.dirname(work), shared_folder(scene))
    os.makedirs(folder, exist_ok=True)
    source, files = make_scan(build, scene["base"], folder), scan_files(scene, work)
    stamp, key = os.path.join(work, "moved.stamp"), json.dumps([moved.POSES[scene["pose"]], *map(identity, source)])
    if not is_fresh(stamp, key, files):
        moved.write_moved(source, files, scene["pose"])
        write_if_changed(stamp, key)
    return files


def make_scan(build, scene, work):
    """scan_files(), made anew where they are out of date."""
    files = scan_files(scene, work)
    if "folder" in scene:
        return files
    if "base" in scene:
        return make_moved(build, scene, work)
    if "truth" in scene:
        write_if_changed(files[2], '{"rooms": [], "stations": []}\n')
        return files
    source, stamp = os.path.join(work, "scene.json"), os.path.join(work, "scene.stamp")
    program = os.path.join(build, "bin", "synthesize")
    density = scene.get("points_per_m2")
    key = f"{json.dumps(scene['scene'], indent=1)}{density or ''}" + subprocess.run([program, "--dump-params"], capture_output=True, text=True, check=True).stdout
    made = [os.path.join(work, "scan.ply"), *files[1:]]
    if not is_fresh(stamp, key, made):
        write_if_changed(source, json.dumps(scene["scene"], indent=1))
        command = [program, "-q", "--threads", "1", "--scene", source, "--scan-out", made[0], "--truth-out", files[1], "--truth-json", files[2]]
        if density:  # a first run measures the building
            run([*command, "--set", "points=1000"])
            command += ["--set", f"points={round(density * read_json(files[2])['surface_area'])}"]
        run(command)
        write_if_changed(stamp, key)
    return files


def stations_file(scene, truth_json, work):
    """STATIONS of the pipeline: the positions that the truth names, or none."""
    if not scene.get("stations"):
        return "none"
    path = os.path.join(work, "stations.txt")
    positions = [" ".join(map(str, station["position"])) for station in read_json(truth_json)["stations"]]
    write_if_changed(path, "\n".join(positions) + "\n")
    return path


def config_file(scene, work, preset):
    """CONFIG of the pipeline: the parameters that the scene wants to differ, or those of the preset, or none."""
    if "mu_m" not in scene:
        return preset
    path = os.path.join(work, "parameters.yaml")
    write_if_changed(path, f"graphcut:\n  mu_m: {scene['mu_m']}\n")
    return path


def evaluate(build, scene, work, truth, truth_json):
    program, model = os.path.join(build, "bin", "evaluate"), os.path.join(work, "model.ply")
    scores, truth_cells, stamp = (os.path.join(work, "evaluate", name) for name in ("scores.json", "truth_cells.h5", "scores.stamp"))
    cells = [os.path.join(work, "90_final", name + ".h5") for name in ("cells", "labels", "data_terms")]
    cloud = os.path.join(work, "10_ingest", "cloud.h5")
    surfaces = os.path.join(work, "92_fit_surfaces", "surfaces.h5")
    summary = os.path.join(work, "summary.json")
    key = "\n".join(map(identity, (program, model, summary, truth, truth_json, cloud, surfaces, *cells)))
    if not is_fresh(stamp, key, [scores, truth_cells]):
        coarse = ["--set", "sample_spacing_m=0.1", "--set", "column_spacing_m=0.1"] if "mu_m" in scene else []
        run([program, "-q", "--threads", "1", "--work", work, "--truth", truth, "--truth-json", truth_json, *coarse,
             "--cells", cells[0], "--labels", cells[1], "--terms", cells[2], "--surfaces", surfaces, "--summary", summary, "--cloud", cloud, "--cells-out", truth_cells])
        write_if_changed(stamp, key)
    return read_json(scores)


def cpu_seconds(work):
    """Of the stages' last runs, up to the model."""
    return sum(read_json(os.path.join(work, "logs", name + ".json"))["cpu_s"] for name in STAGES)


def share(part, whole):
    return part / whole if whole else None


def row_of(scores, truth, cells_m3):
    """What the table shows of one scene; a model that is not closed has no volume and found no room."""
    volume, rooms, thin, mesh = (scores[name] or {} for name in ("volume", "rooms", "thin", "mesh"))
    scanned = [room for room in truth["rooms"] if room.get("scanned", True)]
    lost = [room for room in rooms.get("list", []) if not room["found"]]
    count = rooms.get("truth", len(truth["rooms"]))
    unentered = rooms.get("unentered") or OF_NO_ROOMS
    return {"iou": volume.get("iou", 0.0), "recall": volume.get("recall", 0.0), "precision": volume.get("precision", 0.0),
            "rooms": count, "found": rooms.get("found", 0), "missed": rooms.get("missed", count),
            "missed_scanned": sum(room["scanned"] for room in lost) if rooms else len(scanned),
            "seen": volume.get("seen", {}).get("iou", 0.0), "denied": share(unentered["denied_m3"], unentered["volume_m3"]),
            "unentered_m3": unentered["volume_m3"], **{f"unentered_{answer}": unentered[answer] for answer in ("found", "unknown", "denied")},
            "merged": rooms.get("merged", 0), "thin_kept": thin.get("walls_kept"), "walls": scores["walls_within_1deg_2cm"],
            "walls_loose": scores["walls_within_1_5deg_4cm"],
            "horizontals": scores["horizontals_within_1deg_2cm"], "horizontals_fine": scores["horizontals_within_1deg_5mm"],
            "elements": elements_of(scores),
            "hausdorff_pct": scores["distance"]["symmetric"]["hausdorff_pct"], **explained(scores, mesh, volume, cells_m3)}


def elements_of(scores):
    """Of slopes, columns, niches and curved walls; counts and areas, so that a group's shares are those of all its buildings together."""
    volume, slopes, columns, niches, arcs = scores["volume"] or {}, scores["slopes"], scores["columns"] or {}, scores["niches"], scores["arcs"] or {}
    thick = [column for column in columns.get("list", []) if column["size_m"] >= 0.25 - TOLERANCE_M]
    deep = [niche for niche in niches["list"] if niche["depth_m"] >= 0.10 - TOLERANCE_M]
    return {"volume_error": share(volume.get("model_m3", 0.0) - volume["truth_m3"], volume["truth_m3"]) if volume else None,
            "slopes_m2": slopes["area_m2"], "angle_deg": slopes["angle_median_deg"], "angle_p95_deg": slopes["angle_p95_deg"],
            "slopes_close": slopes["within_1deg_2cm"], "columns": columns.get("truth", 0), "columns_found": columns.get("found", 0),
            "columns_false": columns.get("false", 0), "floor_m2": columns.get("floor_m2", 0.0), "niches": niches["truth"],
            "columns_25cm": len(thick), "columns_25cm_found": sum(column["found"] for column in thick),
            "niches_10cm_m2": sum(niche["area_m2"] for niche in deep), "niches_10cm_near_m2": sum(niche["area_m2"] * (niche["within_2cm"] or 0.0) for niche in deep),
            "arcs": arcs.get("truth", 0), "arcs_found": arcs.get("found", 0), "arcs_false": arcs.get("false", 0), "arcs_close": arcs.get("close", 0),
            **heights_of((scores["rooms"] or {}).get("list", [])), "niches_m2": niches["area_m2"], "niches_near_m2": niches["area_m2"] * (niches["within_2cm"] or 0.0)}


def heights_of(rooms):
    """Of the floors and ceilings of all rooms: how many, how many within 1 mm, and by how much the worst is off."""
    off = [room[end] for room in rooms for end in ("floor_off_m", "ceiling_off_m") if room[end] is not None]
    return {"heights": len(off), "heights_1mm": sum(abs(value) <= 0.001 for value in off), "height_worst_m": max(map(abs, off), default=None)}


def explained(scores, mesh, volume, cells_m3):
    """The bound of the cells, the causes of what is wrong as shares of the truth, and whether the mesh encloses just its empty
    cells, which have `cells_m3`."""
    explanation = scores["explanation"]
    if not explanation:
        return {"bound": None, "lost": None, "extra": None, "invented": None, "valid": False}
    equal = abs(mesh["volume_m3"] - cells_m3) <= VOLUME_TOLERANCE * cells_m3
    shares = {kind: {cause: m3 / volume["truth_m3"] for cause, m3 in explanation[kind + "_m3"].items()} for kind in ("lost", "extra")}
    return {"bound": explanation["bound_iou"], **shares, "invented": explanation["invented_m3"] / volume["truth_m3"], "valid": mesh["valid"] and equal}


def make_model(source, build, work, scan, stations, config):
    run(["make", "--no-print-directory", "-C", source, "extract"], SCAN=scan, WORK=work, BUILD=build, JOBS="1", QUIET="1",
        STATIONS=stations, CONFIG=config or "none")


def run_scene(source, build, scene, root, preset="", scans=""):
    """Makes what is not up to date, scores it, and returns the scene's row; `error` in it says why there are no figures.

    `preset`: a file of parameters; `scans`: a root whose scans are taken, instead of `root`."""
    row = {"name": scene["name"], "group": scene["group"], "kind": scene["kind"]}
    folder = scene.get("work", scene["name"])
    work, scan_folder = os.path.join(root, folder), os.path.join(scans or root, folder)
    for path in (work, scan_folder):
        os.makedirs(path, exist_ok=True)
    try:
        scan, truth, truth_json = make_scan(build, scene, scan_folder)
        make_model(source, build, work, scan, stations_file(scene, truth_json, work), config_file(scene, work, preset))
        summary = read_json(os.path.join(work, "summary.json"))
        row.update(row_of(evaluate(build, scene, work, truth, truth_json), read_json(truth_json), summary["mesh"]["cells_m3"]))
        row["model"] = {"rooms": len(summary["rooms"]), "openings": len(summary["openings"]), "volume_m3": summary["totals"]["volume_m3"]}
        row["warnings"] = [text for name in STAGES for text in read_json(os.path.join(work, "logs", name + ".json"))["warnings"]]
        row["cpu_s"] = round(cpu_seconds(work), 3)
    except Failed as failure:
        row["error"] = str(failure)
    return row
