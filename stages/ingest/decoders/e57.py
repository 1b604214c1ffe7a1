# SPDX-License-Identifier: GPL-3.0-or-later
"""Decodes an E57 file for `ingest`: all its scans in common coordinates, block by block. usage: e57.py FILE

Cartesian or spherical coordinates of any representation; poses with or without rotation or translation; points marked invalid and
beams without return are dropped and counted. Every page that is read is checked. A scan's pose is a scanner position, unless it is
the identity of a cartesian scan, which is how registered clouds are written. Normals as the extension "nor" has them."""
import re

import numpy
from pye57 import libe57

import point_stream

BLOCK = 1 << 17  # points
CARTESIAN = ("cartesianX", "cartesianY", "cartesianZ")
NORMALS = ("nor:normalX", "nor:normalY", "nor:normalZ")
SPHERICAL = ("sphericalRange", "sphericalAzimuth", "sphericalElevation")


def open_image(path):
    try:
        return libe57.ImageFile(path, "r", libe57.CHECKSUM_POLICY_ALL)
    except libe57.E57Exception as error:
        raise scan_error(error) from None


def scan_error(error, where=""):
    text = str(error)
    what = text.splitlines()[0].split(" (Error")[0]
    page = re.search(r"\bpage=(\d+)", text)
    if "ErrorBadChecksum" in text:
        what = f"page {page.group(1) if page else '?'} is damaged: its checksum is wrong"
    return point_stream.ScanError("C04", where + what, "copy the scan again; if that does not help, export it again")


def child(node, name):
    return node[name] if node.isDefined(name) else None


def pose(scan):
    """Rotation matrix and translation, None where they are missing."""
    node = child(scan, "pose")
    rotation = child(node, "rotation") if node else None
    translation = child(node, "translation") if node else None
    turn = None
    if rotation:
        quaternion = numpy.array([rotation[name].value() for name in "wxyz"], float)
        length = numpy.linalg.norm(quaternion)
        if not 0.9 < length < 1.1:
            raise point_stream.ScanError("C04", f"a pose's rotation is no unit quaternion (its length is {length:g})")
        w, x, y, z = quaternion / length
        turn = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    move = numpy.array([translation[name].value() for name in "xyz"], float) if translation else None
    if move is not None and not numpy.isfinite(move).all():
        raise point_stream.ScanError("C04", "a pose's translation is no position")
    return turn, move


def buffers_for(image, names):
    arrays = [numpy.empty(BLOCK) for _ in names]
    buffers = libe57.VectorSourceDestBuffer()
    for name, array in zip(names, arrays):
        buffers.append(libe57.SourceDestBuffer(image, name, array, BLOCK, True, True))
    return arrays, buffers


def cartesian(columns, spherical):
    if not spherical:
        return numpy.stack(columns, axis=1)
    distance, azimuth, elevation = columns
    level = distance * numpy.cos(elevation)
    return numpy.stack((level * numpy.cos(azimuth), level * numpy.sin(azimuth), distance * numpy.sin(elevation)), axis=1)


class Scan:
    """One scan of the file: what is read of it, and where it lies."""

    def __init__(self, node):
        self.points = child(node, "points")
        if self.points is None:
            raise point_stream.ScanError("C04", "a scan without points")
        prototype = libe57.StructureNode(self.points.prototype())
        defined = {prototype.get(index).elementName() for index in range(prototype.childCount())}
        self.spherical = not defined.issuperset(CARTESIAN)
        self.names = SPHERICAL if self.spherical else CARTESIAN
        missing = [name for name in self.names if name not in defined]
        if missing:
            raise point_stream.ScanError("C04", f"a scan has neither cartesian nor spherical coordinates ({missing[0]} is missing)")
        self.normals = NORMALS if defined.issuperset(NORMALS) else ()
        state = "sphericalInvalidState" if self.spherical else "cartesianInvalidState"
        self.state = (state,) if state in defined else ()
        self.turn, self.move = pose(node)

    def station(self):
        """The scanner position; None: the pose says of none."""
        if self.turn is None and self.move is None:
            return None
        moved = self.move is not None and self.move.any()
        turned = self.turn is not None and not numpy.allclose(self.turn, numpy.eye(3), atol=1e-12)
        if not (self.spherical or moved or turned):
            return None
        return self.move if self.move is not None else (0, 0, 0)

    def read(self, image, stream):
        promised = self.points.childCount()
        if promised == 0:
            return
        columns, buffers = buffers_for(image, (*self.names, *self.normals, *self.state))
        read = 0
        reader = self.points.reader(buffers)
        while (count := reader.read()) > 0:
            read += count
            self.add([column[:count] for column in columns], stream)
        reader.close()
        if read != promised:
            raise point_stream.ScanError("C05", f"a scan's header promises {promised} points, the file holds {read}")

    def add(self, columns, stream):
        xyz = cartesian(columns[:3], self.spherical)
        returned = xyz.any(axis=1)
        valid = columns[-1] == 0 if self.state else numpy.ones(len(xyz), bool)
        stream.invalid += int(len(xyz) - valid.sum())
        stream.no_returns += int((valid & ~returned).sum())
        kept = valid & returned
        normals = numpy.stack(columns[3:6], axis=1) if self.normals else None
        if not kept.all():
            xyz = xyz[kept]
            normals = normals[kept] if self.normals else None
        if self.turn is not None:
            xyz = xyz @ self.turn.T
            normals = normals @ self.turn.T if self.normals else None
        if self.move is not None:
            xyz = xyz + self.move
        stream.add(xyz, normals)


def at_scan(index, call):
    """call(), errors named by the scan."""
    try:
        return call()
    except libe57.E57Exception as error:
        raise scan_error(error, f"scan {index + 1}: ") from None
    except point_stream.ScanError as error:
        error.what = f"scan {index + 1}: {error.what}"
        raise


def decode(path, stream):
    image = open_image(path)
    root = image.root()
    nodes = child(root, "data3D")
    crs = child(root, "coordinateMetadata")
    if crs:
        stream.coordinate_system(crs.value())
    scans = [at_scan(index, lambda at=index: Scan(nodes[at])) for index in range(len(nodes) if nodes else 0)]
    for station in filter(lambda place: place is not None, (scan.station() for scan in scans)):
        stream.station(station)
    promised = sum(scan.points.childCount() for scan in scans)
    if promised == 0:
        raise point_stream.ScanError("C06", "there is no scan with points in it")
    stream.begin(promised, point_stream.WITH_NORMALS if any(scan.normals for scan in scans) else point_stream.DOUBLES)
    for index, scan in enumerate(scans):
        at_scan(index, lambda here=scan: here.read(image, stream))


if __name__ == "__main__":
    point_stream.run(decode)
