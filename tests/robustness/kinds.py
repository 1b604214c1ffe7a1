# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of file that are damaged: where each lies in a run, how it is damaged, and which programs then read it."""
import os
import random
import struct
from dataclasses import dataclass, field

import programs as p
import scan_formats


@dataclass
class Kind:
    """`path`: where the damaged file stands in the work folder. `source`: makes the undamaged bytes from the base run.
    `belief`: an artefact, so that no other result than the undamaged file's may come out of it. `head`: only so many of the first
    bytes are damaged. `finish`: makes the file of (base run, damaged bytes). `variants`: the kind is several files, taken in turn.
    `surveyed`: the file is written in the Python environment that reads E57 and LAS (base_run.surveyed)."""
    path: str
    flavour: str
    calls: list
    belief: bool = False
    source: object = None
    head: object = None
    finish: object = None
    surveyed: bool = False
    variants: list = field(default_factory=list)

    def of(self, index):
        return self.variants[index % len(self.variants)] if self.variants else self


@dataclass
class Call:
    """A row of p.PROGRAMS, or a binary by its name; `words`: instead of those of the row."""
    name: str
    words: list = field(default_factory=list)
    reads_only: bool = False  # it has no output: --dump-params, artefact show


def _scan_points(base):
    """The first points of the binary scan that synthesize wrote: x y z as float32."""
    with open(os.path.join(base, p.SCAN), "rb") as file:
        content = file.read()
    begin = content.index(b"end_header\n") + len(b"end_header\n")
    points = list(struct.iter_unpack("<3f", content[begin:]))
    return random.Random(1).sample(points, 12000)


def ply_binary(base):
    points = _scan_points(base)
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
    return head.encode() + b"".join(struct.pack("<3f", *point) for point in points)


def ply_ascii(base):
    points = _scan_points(base)
    head = f"ply\nformat ascii 1.0\ncomment station 1 2 1.5\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
    return head.encode() + text(base)


def text(base):
    return "".join(f"{x:.3f} {y:.3f} {z:.3f}\n" for x, y, z in _scan_points(base)).encode()


def csv(base):
    return b"x,y,z,intensity\n" + "".join(f"{x:.3f},{y:.3f},{z:.3f},{i % 256}\n" for i, (x, y, z) in enumerate(_scan_points(base))).encode()


def after_header(content):
    return content.index(b"end_header\n") + len(b"end_header\n")


def stations(_base):
    return b"# scanner positions\n1.0 2.0 1.5\n2.5, 3.5, 1.6\n0.5 1.5 1.55\n"


def mesh_as_ply(base):
    """The truth as an ascii PLY."""
    with open(os.path.join(base, p.TRUTH), encoding="ascii") as file:
        words = file.read().split("\n", 2)
    vertices, faces, _ = (int(n) for n in words[1].split())
    head = f"ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n"
    head += f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    return (head + words[2]).encode()


def file_of(path):
    def source(base):
        with open(os.path.join(base, path), "rb") as file:
            return file.read()
    return source


def ingest(scan):
    return Call("ingest", ["--work", ".", "--scan", scan])


VERIFY = Call("verify", ["--schemas", "{source}/schemas", *(f"stamps/{name}" for name in p.STAGES)], reads_only=True)


def artefact(path):
    calls = [Call(name) for name in p.readers(path)] + [Call("artefact", ["show", path], reads_only=True), VERIFY]
    return Kind(path, "hdf5" if path.endswith(".h5") else "json", calls, True, file_of(path))


BINARIES = sorted({program.binary for program in p.STAGES.values()})


def asked(binary, option, path):
    return Call(binary, [option, path, "--dump-params"], reads_only=True)


def params(binary):
    path = f"params/{binary}.json"
    return Kind(path, "json", [asked(binary, "--params", path)], source=file_of(path))


def log(name):
    path = f"logs/{name}.json"
    return Kind(path, "json", [Call("report"), Call("compare")], source=file_of(path))


def of_points(write):
    return lambda base: write(_scan_points(base))


def las_header(content):
    return struct.unpack_from("<I", content, 96)[0]  # up to the points


def pcd_header(content):
    return content.index(b"\nDATA ") + 30


def surveyed_kinds():
    """E57, LAS and LAZ: as they are, and behind right checksums, where most of the reader lies."""
    whole = file_of("surveyed/scan.e57")
    kinds = {
        "e57": Kind("scans/s.e57", "binary", [ingest("scans/s.e57")], source=whole),
        "e57_sound_pages": Kind("scans/p.e57", "binary", [ingest("scans/p.e57")], source=lambda base: scan_formats.e57_content(whole(base)),
                                finish=lambda _, content: scan_formats.e57_file(content)),
        "e57_xml": Kind("scans/x.e57", "text", [ingest("scans/x.e57")], source=lambda base: scan_formats.e57_xml(whole(base)),
                        finish=lambda base, xml: scan_formats.e57_with_xml(whole(base), xml)),
        "las": Kind("scans/s.las", "binary", [ingest("scans/s.las")], source=file_of("surveyed/scan.las")),
        "las_header": Kind("scans/h.las", "binary", [ingest("scans/h.las")], source=file_of("surveyed/scan.las"), head=las_header),
        "laz": Kind("scans/s.laz", "binary", [ingest("scans/s.laz")], source=file_of("surveyed/scan.laz")),
        "laz_header": Kind("scans/h.laz", "binary", [ingest("scans/h.laz")], source=file_of("surveyed/scan.laz"), head=las_header),
        "laz_layers": Kind("scans/l.laz", "binary", [ingest("scans/l.laz")], source=file_of("surveyed/scan14.laz")),
    }
    for kind in kinds.values():
        kind.surveyed = True
    return kinds


def all_kinds():
    kinds = {
        "ply_ascii": Kind("scans/a.ply", "text", [ingest("scans/a.ply")], source=ply_ascii),
        "ply_binary": Kind("scans/b.ply", "binary", [ingest("scans/b.ply")], source=ply_binary),
        "ply_header": Kind("scans/h.ply", "text", [ingest("scans/h.ply")], source=ply_binary, head=after_header),
        "text": Kind("scans/t.xyz", "text", [ingest("scans/t.xyz")], source=text),
        "csv": Kind("scans/c.csv", "text", [ingest("scans/c.csv")], source=csv),
        "ptx": Kind("scans/s.ptx", "text", [ingest("scans/s.ptx")], source=of_points(scan_formats.ptx)),
        "pts": Kind("scans/s.pts", "text", [ingest("scans/s.pts")], source=of_points(scan_formats.pts)),
        "pcd_ascii": Kind("scans/a.pcd", "text", [ingest("scans/a.pcd")], source=of_points(scan_formats.pcd_ascii)),
        "pcd_binary": Kind("scans/b.pcd", "binary", [ingest("scans/b.pcd")], source=of_points(scan_formats.pcd_binary)),
        "pcd_header": Kind("scans/h.pcd", "text", [ingest("scans/h.pcd")], source=of_points(scan_formats.pcd_compressed), head=pcd_header),
        "pcd_compressed": Kind("scans/c.pcd", "binary", [ingest("scans/c.pcd")], source=of_points(scan_formats.pcd_compressed)),
        **surveyed_kinds(),
        "stations": Kind(p.STATIONS, "text", [Call("ingest", ["--work", ".", "--scan", p.SCAN, "--stations", p.STATIONS])], source=stations),
        "edit": Kind(p.EDIT, "json", [Call("accept_lines"), Call("diff_lines")], source=file_of("edit.geojson")),
        "planes_edit": Kind(p.PLANES_EDIT, "json", [Call("accept_planes")], source=file_of("planes_edit.geojson")),
        "pipeline_yaml": Kind("my.yaml", "yaml", [asked(binary, "--config", "my.yaml") for binary in [*BINARIES, "evaluate", "synthesize"]],
                              source=file_of("my.yaml")),
        "params": Kind("", "json", [], variants=[params(binary) for binary in BINARIES]),
        "logs": Kind("", "json", [], variants=[log(name) for name in p.STAGES if name != "report"]),
        "model_ply": Kind(p.MODEL, "binary", [Call("report"), Call("evaluate")], source=file_of(p.MODEL)),
        "truth_off": Kind(p.TRUTH, "text", [Call("evaluate")], source=file_of(p.TRUTH)),
        "truth_ply": Kind("truth.ply", "text", [Call("evaluate", p.evaluate("truth.ply").arguments)], source=mesh_as_ply),
        "truth_json": Kind(p.TRUTH_JSON, "json", [Call("evaluate")], source=file_of(p.TRUTH_JSON)),
        "scene": Kind(p.SCENE, "json", [Call("synthesize")], source=file_of(p.SCENE)),
    }
    artefacts = {
        "cloud": p.CLOUD, "slices": p.SLICES, "hough": p.HOUGH, "lines_30": p.LINES_30, "lines_40": p.LINES_40, "lines_80": p.LINES_80, "planes": p.PLANES,
        "cells": p.CELLS, "final_cells": p.FCELLS, "weights": p.WEIGHTS, "final_weights": p.FWEIGHTS, "data_terms": p.TERMS,
        "final_data_terms": p.FTERMS, "labels": p.LABELS, "final_labels": p.FLABELS, "surfaces": p.SURFACES, "rooms": p.ROOMS, "openings": p.OPENINGS, "summary": p.SUMMARY,
    }
    return kinds | {name: artefact(path) for name, path in artefacts.items()}
