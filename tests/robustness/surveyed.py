# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes scan.e57, scan.las, scan.laz into a folder. usage: surveyed.py POINTS FOLDER, in the environment that `make deps` makes.

POINTS: x y z on each line. The E57 has two scans, one of scaled integers with a pose and states of validity, one spherical in doubles with normals."""
import sys

import laspy
import numpy
from pye57 import E57, libe57


def structure(image, **members):
    node = libe57.StructureNode(image)
    for name, value in members.items():
        node.set(name, libe57.FloatNode(image, float(value)))
    return node


def write_scan(file, columns, fields, pose):
    image = file.image_file
    node = libe57.StructureNode(image)
    node.set("guid", libe57.StringNode(image, f"{{{len(file.data3d)}}}"))
    node.set("pose", pose)
    prototype = libe57.StructureNode(image)
    for name, field in fields.items():
        prototype.set(name, field)
    points = libe57.CompressedVectorNode(image, prototype, libe57.VectorNode(image, True))
    node.set("points", points)
    file.data3d.append(node)
    buffers = libe57.VectorSourceDestBuffer()
    kept = [numpy.ascontiguousarray(values, float) for values in columns]
    for name, values in zip(fields, kept):
        buffers.append(libe57.SourceDestBuffer(image, name, values, len(values), True, True))
    writer = points.writer(buffers)
    writer.write(len(kept[0]))
    writer.close()


def write_e57(path, points):
    file = E57(path, mode="w")
    image = file.image_file
    image.extensionsAdd("nor", "http://www.libe57.org/E57_NOR_surface_normals.txt")
    half = len(points) // 2
    pose = libe57.StructureNode(image)
    pose.set("rotation", structure(image, w=0.8, x=0, y=0, z=0.6))
    pose.set("translation", structure(image, x=1, y=2, z=1.5))
    fields = {"cartesian" + axis: libe57.ScaledIntegerNode(image, 0, -1000000, 1000000, 0.0001, 0.0) for axis in "XYZ"}
    fields["cartesianInvalidState"] = libe57.IntegerNode(image, 0, 0, 2)
    fields["intensity"] = libe57.FloatNode(image, 0.0, libe57.E57_SINGLE, 0.0, 0.0)
    local = (points[:half] - (1, 2, 1.5)) @ numpy.array([[0.28, -0.96, 0], [0.96, 0.28, 0], [0, 0, 1]])
    write_scan(file, [*local.T, numpy.arange(half) % 50 == 0, numpy.zeros(half)], fields, pose)
    rest = points[half:] - (2.5, 3, 1.6)
    distance = numpy.linalg.norm(rest, axis=1)
    fields = {name: libe57.FloatNode(image, 0.0, libe57.E57_DOUBLE, -1e6, 1e6)
              for name in ("sphericalRange", "sphericalAzimuth", "sphericalElevation", "nor:normalX", "nor:normalY", "nor:normalZ")}
    pose = libe57.StructureNode(image)
    pose.set("translation", structure(image, x=2.5, y=3, z=1.6))
    angles = [distance, numpy.arctan2(rest[:, 1], rest[:, 0]), numpy.arcsin(rest[:, 2] / distance)]
    write_scan(file, [*angles, *numpy.zeros((3, len(rest)))], fields, pose)
    file.close()


def write_las(path, points, version, point_format):
    las = laspy.LasData(laspy.LasHeader(version=version, point_format=point_format))
    las.header.scales, las.header.offsets = [0.0005] * 3, [0.1, 0, -3]
    las.header.vlrs.append(laspy.VLR("LASF_Projection", 2112, "", b'LOCAL_CS["site",UNIT["metre",1]]\0'))
    las.x, las.y, las.z = points.T
    las.withheld = numpy.arange(len(points)) % 40 == 0
    las.point_source_id = numpy.arange(len(points)) % 3
    las.write(path)


if __name__ == "__main__":
    scan, folder = numpy.loadtxt(sys.argv[1]), sys.argv[2]
    write_e57(folder + "/scan.e57", scan)
    write_las(folder + "/scan.las", scan, "1.2", 3)
    write_las(folder + "/scan.laz", scan, "1.2", 1)
    write_las(folder + "/scan14.laz", scan, "1.4", 7)
