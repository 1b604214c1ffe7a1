# SPDX-License-Identifier: GPL-3.0-or-later
"""Encodes a scan of `synthesize` as E57: every set-up a scan with its pose, points in the scanner's own coordinates as float32.
usage: e57.py FILE cartesian|spherical

GUIDs count the set-ups and dates are left out, so that the same scan is the same file."""
import numpy
from pye57 import libe57

import scan_records

BLOCK = 1 << 16  # points that are handed over at a time
NAMES = {"cartesian": ("cartesianX", "cartesianY", "cartesianZ"),
         "spherical": ("sphericalRange", "sphericalAzimuth", "sphericalElevation")}
RANGE = 1e5  # no coordinate of a set-up is beyond [m]
LIMITS = {"sphericalRange": (0, RANGE), "sphericalAzimuth": (-numpy.pi, numpy.pi), "sphericalElevation": (-numpy.pi / 2, numpy.pi / 2)}


def structure(image, values, make):
    node = libe57.StructureNode(image)
    for name, value in values.items():
        node.set(name, make(value))
    return node


def turn_of(w, x, y, z):
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def columns_of(own, spherical):
    if not spherical:
        return own.T
    distance = numpy.linalg.norm(own, axis=1)
    sine = numpy.divide(own[:, 2], distance, where=distance > 0, out=numpy.zeros_like(distance))
    return distance, numpy.arctan2(own[:, 1], own[:, 0]), numpy.arcsin(sine)


class SetUp:
    """One scan of the file, its points written as they come."""

    def __init__(self, image, scans, pose, form):
        number = scans.childCount() + 1
        self.turn, self.place = (turn_of(*pose[:4]), numpy.array(pose[4:])) if pose else (numpy.eye(3), numpy.zeros(3))
        self.spherical = form == "spherical"
        node = libe57.StructureNode(image)
        node.set("guid", libe57.StringNode(image, f"{{00000000-0000-4000-8000-{number:012d}}}"))
        node.set("name", libe57.StringNode(image, f"set-up {number}"))
        if pose:
            def metres(value):
                return libe57.FloatNode(image, value)
            node.set("pose", structure(image, {"rotation": structure(image, dict(zip("wxyz", pose[:4])), metres),
                                               "translation": structure(image, dict(zip("xyz", pose[4:])), metres)}, lambda part: part))
        prototype = structure(image, {name: LIMITS.get(name, (-RANGE, RANGE)) for name in NAMES[form]},
                              lambda limits: libe57.FloatNode(image, 0.0, libe57.E57_SINGLE, *(float(numpy.float32(v)) for v in limits)))
        points = libe57.CompressedVectorNode(image, prototype, libe57.VectorNode(image, True))
        node.set("points", points)
        scans.append(node)
        self.arrays = [numpy.empty(BLOCK, numpy.float32) for _ in range(3)]
        buffers = libe57.VectorSourceDestBuffer()
        for name, array in zip(NAMES[form], self.arrays):
            buffers.append(libe57.SourceDestBuffer(image, name, array, BLOCK, True, False))
        self.writer = points.writer(buffers)

    def add(self, world):
        columns = columns_of((world - self.place) @ self.turn, self.spherical)
        for first in range(0, len(world), BLOCK):
            count = min(BLOCK, len(world) - first)
            for array, column in zip(self.arrays, columns):
                array[:count] = column[first:first + count]
            self.writer.write(count)

    def close(self):
        self.writer.close()


def encode(path, form):
    image = libe57.ImageFile(path, "w")
    root = image.root()
    root.set("formatName", libe57.StringNode(image, "ASTM E57 3D Imaging Data File"))
    root.set("guid", libe57.StringNode(image, "{00000000-0000-4000-8000-000000000000}"))
    root.set("versionMajor", libe57.IntegerNode(image, 1, 1, 1))
    root.set("versionMinor", libe57.IntegerNode(image, 0, 0, 0))
    scans = libe57.VectorNode(image, True)
    root.set("data3D", scans)
    root.set("images2D", libe57.VectorNode(image, True))
    set_up = None
    for kind, content in scan_records.records():
        if kind == "P":
            set_up.add(content)
            continue
        if set_up:
            set_up.close()
        set_up = SetUp(image, scans, content, form)
    if set_up:
        set_up.close()
    image.close()


if __name__ == "__main__":
    scan_records.run(encode)
