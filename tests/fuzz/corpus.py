# SPDX-License-Identifier: GPL-3.0-or-later
"""What the fuzz targets begin with: files of a small run, and a few made here for what a run does not have."""
import glob
import os
import re
import shutil
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from pipeline_table import PLACES  # noqa: E402

POINTS = [(0.01 * i % 3, 0.02 * i % 2.5, 0.013 * i % 2.4) for i in range(240)]
HEAD = "ply\nformat {} 1.0\ncomment station 1 2 1.5\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n"


def scans_ply():
    for order, mark in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        for kind, code in (("float", "f"), ("double", "d"), ("int", "i")):
            body = b"".join(struct.pack(mark + "3" + code, *(p if code != "i" else (int(3 * x) for x in p))) for p in POINTS)
            yield HEAD.format(order, len(POINTS), kind, kind, kind).encode() + b"end_header\n" + body
    lines = "".join(f"{x:.3f} {y:.3f} {z:.3f}\n" for x, y, z in POINTS)
    yield (HEAD.format("ascii", len(POINTS), "float", "float", "float") + "end_header\n" + lines).encode()
    normals = "property float nx\nproperty float ny\nproperty float nz\nproperty list uchar int more\n"
    lines = "".join(f"{x:.3f} {y:.3f} {z:.3f} 0 0 1 2 7 8\n" for x, y, z in POINTS)
    yield (HEAD.format("ascii", len(POINTS), "float", "float", "float") + normals + "end_header\n" + lines).encode()


def scans_text():
    rows = [f"{x:.3f}{{0}}{y:.3f}{{0}}{z:.3f}" for x, y, z in POINTS]
    yield "\n".join(row.format(" ") for row in rows).encode()
    yield ("x,y,z,intensity\n" + "\n".join(row.format(",") + ",7" for row in rows)).encode()
    yield (f"{len(rows)}\n" + "\n".join(row.format(" ") + " -5 10 20 30" for row in rows)).encode()
    yield ("# X Y Z\n" + "\r\n".join(row.format("\t") for row in rows)).encode()
    yield "\n".join(row.format(";") for row in rows).encode("utf-16")


def scans_pcd():
    head = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA {1}\n"
    yield (head.format(len(POINTS), "ascii") + "".join(f"{x:.3f} {y:.3f} {z:.3f}\n" for x, y, z in POINTS)).encode()
    body = b"".join(struct.pack("<3f", *p) for p in POINTS)
    yield head.format(len(POINTS), "binary").encode() + body
    columns = b"".join(struct.pack(f"<{len(POINTS)}f", *(p[axis] for p in POINTS)) for axis in range(3))
    literal = b"".join(bytes([len(columns[i:i + 32]) - 1]) + columns[i:i + 32] for i in range(0, len(columns), 32))  # LZF that packs nothing
    yield head.format(len(POINTS), "binary_compressed").encode() + struct.pack("<2I", len(literal), len(columns)) + literal


def scans_ptx():
    station = "{0}\n{1}\n1 2 1.5\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 1.5 1\n"
    rows = "".join(f"{x:.3f} {y:.3f} {z:.3f} 0.5\n" for x, y, z in POINTS)
    yield (station.format(20, len(POINTS) // 20) + rows).encode()
    yield (station.format(2, 2) + "0 0 0 0.5\n1 2 3 0.5\n2 2 3 0.1\n0 0 0 0\n" + station.format(20, len(POINTS) // 20) + rows).encode()


DIGEST = "0" * 64
OPENINGS = """{"type": "FeatureCollection", "name": "openings", "roomcut": {"artefact": "openings", "schema_version": "2.0", "length_unit": "m", "coordinates": "scan",
"frame": {"origin": [0.0, 0.0, 0.0], "unit": "m", "up": "z"}, "cells_payload_sha256": "DIGEST",
"provenance": {"inputs": [], "params_json": "{}", "params_sha256": "DIGEST", "payload_sha256": "DIGEST", "stage": "find_openings", "stage_revision": 2}},
"features": [{"type": "Feature", "id": "o0001", "properties": {"opening_id": "o0001", "walls": ["w0006", "w0008"], "thickness_m": 0.149658,
"width_m": 0.898801, "sill_z_m": -0.000094, "head_z_m": 2.05143, "jamb_a": {"points": 20, "spread": 0.5, "sigma_m": 0.002},
"jamb_b": {"points": 20, "spread": 0.5, "sigma_m": 0.002}, "head": {"points": 20, "spread": 0.5, "sigma_m": 0.002}},
"geometry": {"type": "LineString", "coordinates": [[1.0, 7.0], [1.4, 7.8]]}}]}""".replace("DIGEST", DIGEST)

PLANES_EDIT = b"""{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"pitch_deg": 30, "uphill_deg": "90", "height_m": 2, "side": "floor", "locked": true, "note": "n", "mine": [1]},
"geometry": {"type": "Polygon", "coordinates": [[[1, 1], [3, 1], [3, 2], [1, 2], [1, 1]]]}},
{"type": "Feature", "properties": {"plane_id": "p0001", "pitch_deg": 10, "uphill_deg": 0, "height_m": 1},
"geometry": {"type": "MultiPolygon", "coordinates": [[[[0, 0], [2, 0], [1, 0.5], [2, 2]], [[1, 1], [1.5, 1], [1, 1.5]]]]}}]}"""

MADE = {
    "planes_edit": lambda: [PLANES_EDIT],
    "scan_ply": scans_ply,
    "scan_text": scans_text,
    "scan_pcd": scans_pcd,
    "scan_ptx": scans_ptx,
    "openings": lambda: [OPENINGS.encode()],
    "stations": lambda: [b"1 2 1.5\n2,3,1.6\n", b"# none\n1;2;3\n"],
    "mesh_off": lambda: [b"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"],
    "mesh_obj": lambda: [b"o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1/1 2/2 4/3\nf -4 -1 -2\ng b\nf 2//1 3//1 4//1\n"],
    "mesh_ply": lambda: [b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                         b"property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"],
    "stamp": lambda: [b"0" * 64 + b" 1 2 model.ply\n"],
}
for _name in ("cloud", "slices", "hough", "cells", "weights", "data_terms", "labels", "surfaces", "rooms"):
    MADE[_name] = lambda: [b"# a sound file\n", b"number /frame nothing 1\n"]


def of_run(source, run):
    """Target: files of the run and of the repository."""
    edits, scenes = (sorted(glob.glob(os.path.join(source, "tests/data", pattern))) for pattern in ("edits/*.geojson", "scenes/*.json"))
    lines = [os.path.join(run, f"{stage}/wall_lines.geojson") for stage in ("30_detect_lines", "40_accept_lines", "80_refine_lines")]
    planes = [os.path.join(run, PLACES["accepted_planes"]), *sorted(glob.glob(os.path.join(source, "tests/compat/planes_*.geojson")))]
    return {
        "wall_lines": lines,
        "edit": lines[1:2] + edits,
        "planes": planes,
        "planes_edit": planes,
        "openings": [os.path.join(run, "95_find_openings/openings.geojson")],
        "summary": [os.path.join(run, "summary.json")],
        "run_log": [os.path.join(run, "logs/slice.json"), os.path.join(run, "logs/ingest.json")],
        "scores": [os.path.join(run, "evaluate/scores.json")],
        "truth_json": [os.path.join(run, "truth.json")],
        "params_dump": sorted(glob.glob(os.path.join(run, "params/*.json"))),
        "pipeline_yaml": [os.path.join(source, "pipeline.yaml")],
        "mesh_off": [os.path.join(run, "truth.off")],
        "mesh_ply": [os.path.join(run, "model.ply")],
        "mesh_obj": [os.path.join(run, "model.obj")],
        "scene": scenes,
        "hdf5": [os.path.join(run, PLACES[name]) for name in ("labels", "weights", "cells")],
        "stamp": sorted(glob.glob(os.path.join(run, "stamps/*"))),
    }


def fill(source, run, folder):
    """folder/<target>/…; what fuzzing added there before stays."""
    for target, files in of_run(source, run).items():
        os.makedirs(os.path.join(folder, target), exist_ok=True)
        for number, path in enumerate(files):
            shutil.copy(path, os.path.join(folder, target, f"run_{number}"))
    for target, made in MADE.items():
        os.makedirs(os.path.join(folder, target), exist_ok=True)
        for number, content in enumerate(made()):
            with open(os.path.join(folder, target, f"made_{number}"), "wb") as file:
                file.write(content)


def dictionary(target, folder, path):
    """The words of the target's first files, for libFuzzer's -dict; none for the targets that have a mutator for all they do."""
    words = set()
    for name in sorted(os.listdir(folder))[:20]:
        with open(os.path.join(folder, name), "rb") as file:
            words |= set(re.findall(rb'"[A-Za-z_][A-Za-z_0-9]{1,30}"|\b[a-z_]{3,20}\b', file.read(20000)))
    words |= {b"nan", b"inf", b"1e308", b"1e999", b"-1", b"4294967296", b"9223372036854775807", b"18446744073709551616", b"[[[[[[[["}
    with open(path, "wb") as out:
        for word in sorted(words)[:400]:
            out.write(b'"' + word.replace(b'\\', b'\\\\').replace(b'"', b'\\"') + b'"\n')
    return path
