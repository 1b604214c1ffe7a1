# SPDX-License-Identifier: GPL-3.0-or-later
"""Encodes a scan of `synthesize` as LAS 1.4, point format 6, in steps of 0.1 mm. usage: las.py FILE las|laz

The number of a set-up, from 1 on, is the point source id of its points. Nothing in the header is of today."""
import datetime

import laspy
import numpy

import scan_records

STEP = 1e-4  # [m]
MOST_SET_UPS = (1 << 16) - 1  # that a point source id can tell


def encode(path, ending):
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales, header.offsets = numpy.full(3, STEP), numpy.zeros(3)
    header.creation_date = datetime.date(2000, 1, 1)
    header.system_identifier, header.generating_software = "synthetic", "roomcut synthesize"
    number = 0
    with open(path, "wb") as file, laspy.open(file, mode="w", header=header, do_compress=ending == "laz", closefd=False,
                                              laz_backend=laspy.LazBackend.Lazrs) as writer:
        for kind, content in scan_records.records():
            if kind == "S":
                number += 1
                continue
            block = laspy.ScaleAwarePointRecord.zeros(len(content), header=header)
            block.x, block.y, block.z = content.T
            block["return_number"] = block["number_of_returns"] = numpy.ones(len(content), numpy.uint8)
            block["point_source_id"] = numpy.full(len(content), min(number, MOST_SET_UPS), numpy.uint16)
            writer.write_points(block)


if __name__ == "__main__":
    scan_records.run(encode)
