# SPDX-License-Identifier: GPL-3.0-or-later
"""Decodes an E57 file for `ingest`: all its scans in common coordinates, block by block. usage: e57.py FILE

Cartesian or spherical coordinates of any representation; poses with or without rotation or translation; points marked invalid and
beams without return are dropped and counted. Every page that is read is checked. A scan's pose is a scanner position, unless it is
the identity of a cartesian scan, which is how registered clouds are written."""
import re

import numpy
from pye57 import libe57

import point_stream

BLOCK = 1 << 17  # points
CARTESIAN = ("cartesianX", "cartesianY", "cartesianZ")
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


def read_scan(image, scan, stream):
    points = child(scan, "points")
    if points is None:
        raise point_stream.ScanError("C04", "a scan without points")
    prototype = libe57.StructureNode(points.prototype())
    spherical = not all(prototype.isDefined(name) for name in CARTESIAN)
    names = SPHERICAL if spherical else CARTESIAN
    missing = [name for name in names if not prototype.isDefined(name)]
    if missing:
        raise point_stream.ScanError("C04", f"a scan has neither cartesian nor spherical coordinates ({missing[0]} is missing)")
    turn, move = pose(scan)
    if turn is not None or move is not None:
        moved = move is not None and move.any()
        turned = turn is not None and not numpy.allclose(turn, numpy.eye(3), atol=1e-12)
        if spherical or moved or turned:
            stream.station(move if move is not None else (0, 0, 0))
    if points.childCount() == 0:
        return
    state = "sphericalInvalidState" if spherical else "cartesianInvalidState"
    columns, buffers = buffers_for(image, (*names, state) if prototype.isDefined(state) else names)
    read = 0
    reader = points.reader(buffers)
    while (count := reader.read()) > 0:
        read += count
        valid = numpy.ones(count, bool) if len(columns) == 3 else columns[3][:count] == 0
        stream.invalid += int(count - valid.sum())
        xyz = cartesian([column[:count][valid] for column in columns[:3]], spherical)
        returned = xyz.any(axis=1)
        stream.no_returns += int(len(xyz) - returned.sum())
        xyz = xyz if returned.all() else xyz[returned]
        if turn is not None:
            xyz = xyz @ turn.T
        if move is not None:
            xyz = xyz + move
        stream.add(xyz)
    reader.close()
    if read != points.childCount():
        raise point_stream.ScanError("C05", f"a scan's header promises {points.childCount()} points, the file holds {read}")


def decode(path, stream):
    image = open_image(path)
    root = image.root()
    scans = child(root, "data3D")
    crs = child(root, "coordinateMetadata")
    if crs and crs.value().strip():
        stream.note("coordinate system: " + " ".join(crs.value().split()))
    for index in range(len(scans) if scans else 0):
        try:
            read_scan(image, scans[index], stream)
        except libe57.E57Exception as error:
            raise scan_error(error, f"scan {index + 1}: ") from None
        except point_stream.ScanError as error:
            error.what = f"scan {index + 1}: {error.what}"
            raise
    if stream.points + stream.no_returns + stream.invalid == 0:
        raise point_stream.ScanError("C06", "there is no scan with points in it")


if __name__ == "__main__":
    point_stream.run(decode)
