# SPDX-License-Identifier: GPL-3.0-or-later
"""For tests of E57, LAS and LAZ: the environment that reads them, files to be read, what a decoder streams. Importing it starts the
test again in that environment (BUILD/python), and ends it with 77 where there is none."""
import json
import math
import os
import struct
import subprocess
import sys
import time

SOURCE, BUILD = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
PYTHON = os.path.join(BUILD, "python", "bin", "python3")
if not os.path.exists(PYTHON):
    print("skipped: no Python environment for E57, LAS and LAZ (make deps)")
    sys.exit(77)
if os.path.realpath(sys.prefix) != os.path.realpath(os.path.join(BUILD, "python")):
    os.execv(PYTHON, [PYTHON, *sys.argv])

import laspy  # noqa: E402  only there in the environment
import numpy  # noqa: E402
import pye57  # noqa: E402
from pye57 import libe57  # noqa: E402

DATA = os.path.join(SOURCE, "..", "shared", "data", "formats")
INGEST = os.path.join(BUILD, "bin", "ingest")


def decode(path):
    """What a decoder streams, taken apart as decoders/point_stream.py describes it: points, stations, counts, error; the texts in `said`."""
    name = "e57" if path.endswith(".e57") else "las"
    done = subprocess.run([PYTHON, "-Es", os.path.join(BUILD, "decoders", name + ".py"), path], capture_output=True, check=False)
    parts, stations, dropped, error, at = [], [], None, None, 0
    form, scale, offset = 0, 1, 0
    said.clear()
    while at < len(done.stdout):
        kind, size = done.stdout[at:at + 1], struct.unpack_from("<Q", done.stdout, at + 1)[0]
        payload = done.stdout[at + 9:at + 9 + size]
        at += 9 + size
        if kind == b"B":
            _, form, *numbers = struct.unpack("<2Q6d", payload)
            scale, offset = numpy.array(numbers[:3]), numpy.array(numbers[3:])
        elif kind == b"P":
            parts.append(numpy.frombuffer(payload, [("point", "<i4" if form == 1 else "<f8", 3), ("normal", "<f4", 3 * (form == 2))]))
        elif kind == b"S":
            stations.append(struct.unpack("<3d", payload))
        elif kind == b"D":
            dropped = struct.unpack("<2Q", payload)
        elif kind == b"X":
            error = payload.decode()
        elif kind in b"NC":
            said.setdefault(kind, []).append(payload.decode())
    points = numpy.concatenate([part["point"] for part in parts]) if parts else numpy.empty((0, 3))
    said["normals"] = numpy.concatenate([part["normal"] for part in parts]) if parts else None
    return (points * scale + offset if form == 1 else points), stations, dropped, error


said = {}


def ingest(path, work, *options):
    return subprocess.run([INGEST, "--scan", path, "--work", work, *options], capture_output=True, text=True, check=False)


def counts(work):
    with open(os.path.join(work, "logs", "ingest.json"), encoding="utf-8") as text:
        return {count["what"]: count["value"] for count in json.load(text)["counts"]}


def gone(process):
    """Whether it ends within ten seconds."""
    for _ in range(100):
        try:
            with open(f"/proc/{process}/stat", encoding="utf-8", errors="replace") as file:
                if file.read().rsplit(")", 1)[1].split()[0] == "Z":
                    return True
        except OSError:
            return True
        time.sleep(0.1)
    return False


def turn(angle, axis):
    """Unit quaternion w x y z."""
    axis = numpy.array(axis, float) / numpy.linalg.norm(axis)
    return numpy.concatenate(([math.cos(angle / 2)], math.sin(angle / 2) * axis))


def rotate(quaternion, points):
    w, vector = quaternion[0], quaternion[1:]
    return points + 2 * numpy.cross(vector, numpy.cross(vector, points) + w * points)


def room(count=20000, size=(6.0, 5.0, 2.6), seed=1):
    draw = numpy.random.default_rng(seed)
    points = draw.random((count, 3)) * size
    face = draw.integers(0, 6, count)
    for axis in range(3):
        points[face == axis, axis] = draw.normal(0, 0.003, (face == axis).sum())
        points[face == axis + 3, axis] = draw.normal(size[axis], 0.003, (face == axis + 3).sum())
    return points


def write_e57(path, scans):
    """scans: dicts with points (local), and optionally rotation, translation, spherical, scaled (step) and invalid (a mask)."""
    file = pye57.E57(path, mode="w")
    image = file.image_file
    for number, scan in enumerate(scans):
        local = scan["points"]
        if scan.get("spherical"):
            distance = numpy.linalg.norm(local, axis=1)
            columns = {"sphericalRange": distance, "sphericalAzimuth": numpy.arctan2(local[:, 1], local[:, 0]),
                       "sphericalElevation": numpy.arcsin(local[:, 2] / distance)}
        else:
            columns = dict(zip(("cartesianX", "cartesianY", "cartesianZ"), local.T))
        node = libe57.StructureNode(image)
        node.set("guid", libe57.StringNode(image, f"{{scan {number}}}"))
        if "normals" in scan:
            if number == 0:  # once in a file
                image.extensionsAdd("nor", "http://www.libe57.org/E57_NOR_surface_normals.txt")
            columns |= dict(zip(("nor:normalX", "nor:normalY", "nor:normalZ"), scan["normals"].T))
        pose = libe57.StructureNode(image)
        for member, names in (("rotation", "wxyz"), ("translation", "xyz")):
            if member in scan:
                part = libe57.StructureNode(image)
                for name, value in zip(names, scan[member]):
                    part.set(name, libe57.FloatNode(image, float(value)))
                pose.set(member, part)
        if "rotation" in scan or "translation" in scan:
            node.set("pose", pose)
        prototype = libe57.StructureNode(image)
        for name, values in columns.items():
            if "scaled" in scan:
                step = scan["scaled"]
                low, high = (int(v) for v in (numpy.floor(values.min() / step), numpy.ceil(values.max() / step)))
                prototype.set(name, libe57.ScaledIntegerNode(image, low, low, high, step, 0.0))
            else:
                prototype.set(name, libe57.FloatNode(image, 0.0, libe57.E57_DOUBLE, -1e9, 1e9))
        if "invalid" in scan:
            state = "sphericalInvalidState" if scan.get("spherical") else "cartesianInvalidState"
            prototype.set(state, libe57.IntegerNode(image, 0, 0, 2))
            columns[state] = scan["invalid"].astype(float)
        points = libe57.CompressedVectorNode(image, prototype, libe57.VectorNode(image, True))
        node.set("points", points)
        file.data3d.append(node)
        if len(local) == 0:
            continue
        buffers = libe57.VectorSourceDestBuffer()
        kept = [numpy.ascontiguousarray(values, float) for values in columns.values()]
        for name, values in zip(columns, kept):
            buffers.append(libe57.SourceDestBuffer(image, name, values, len(values), True, True))
        writer = points.writer(buffers)
        writer.write(len(local))
        writer.close()
    file.close()


def write_las(path, points, version="1.2", point_format=1, scale=0.0001, offset=(0, 0, 0), withheld=None):
    las = laspy.LasData(laspy.LasHeader(version=version, point_format=point_format))
    las.header.scales, las.header.offsets = [scale] * 3, offset
    las.x, las.y, las.z = points.T
    if withheld is not None:
        las.withheld = withheld
    las.write(path)
