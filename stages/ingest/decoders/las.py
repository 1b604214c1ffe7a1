# SPDX-License-Identifier: GPL-3.0-or-later
"""Decodes a LAS or LAZ file for `ingest`, block by block. usage: las.py FILE

LAS 1.0 to 1.5, point formats 0 to 10, the number of points from the field that counts; numbers, scale and offset as they
stand; withheld points dropped and counted; the coordinate system as text."""
import os
import struct

import laspy
import numpy

import point_stream

BLOCK = 500_000  # points: ten of the usual chunks, so that all cores have some
MOST_IN_CHUNK = 1 << 24  # points of one LAZ chunk; writers use 50,000
SHORTEST_RECORD = 54  # bytes
VARIABLE = 0xFFFFFFFF


def record_of(header, user, number):
    return next((vlr.record_data_bytes() for vlr in header.vlrs if vlr.user_id.strip("\0") == user and vlr.record_id == number), None)


def coordinate_system(header):
    text = record_of(header, "LASF_Projection", 2112)
    if text:
        return text.rstrip(b"\0").decode("utf-8", "replace")
    keys = record_of(header, "LASF_Projection", 34735)
    if not keys:
        return None
    values = struct.unpack(f"<{len(keys) // 2}H", keys[:len(keys) // 2 * 2])
    codes = [values[i + 3] for i in range(4, len(values) - 3, 4) if values[i] in (2048, 3072) and values[i + 1] == 0]
    return "EPSG:" + "+".join(map(str, codes[-1:])) if codes else None


def check_records(path):
    """The records before the points against the room that they have: laspy reads on for as many as a header claims."""
    with open(path, "rb") as file:
        start = file.read(104)
    if len(start) < 104:
        raise point_stream.ScanError("C05", "the file ends within its header")
    size, points, records = struct.unpack_from("<HII", start, 94)
    if points > os.path.getsize(path) or size + SHORTEST_RECORD * records > points:
        raise point_stream.ScanError("C04", f"its header is damaged: {records} records before the points, which begin at byte {points}")


def check_plain(path, header):
    """The points of an uncompressed file against its size: neither fewer nor more than promised."""
    end = os.path.getsize(path)
    if header.number_of_evlrs:
        end = min(end, header.start_of_first_evlr) if header.start_of_first_evlr > header.offset_to_point_data else end
    size = header.point_format.size
    held = max(0, end - header.offset_to_point_data) // size
    if held < header.point_count:
        raise point_stream.ScanError("C05", f"the header promises {header.point_count} points, the file holds {held}")
    if held > header.point_count and end - header.offset_to_point_data - header.point_count * size >= size:
        raise point_stream.ScanError("C05", f"the header promises {header.point_count} points, the file holds {held}",
                                     "export the scan again, or correct the count in its header")


def check_chunks(header):
    """LAZ decoders allocate whole chunks of the size that a header claims."""
    laszip = record_of(header, "laszip encoded", 22204)
    if laszip is None or len(laszip) < 16:
        raise point_stream.ScanError("C04", "a compressed file without the record that says how")
    chunk = struct.unpack_from("<I", laszip, 12)[0]
    if chunk != VARIABLE and chunk > MOST_IN_CHUNK:
        raise point_stream.ScanError("C04", f"chunks of {chunk} points: the header is damaged")


def blocks(path):
    """The points of a file, a block at a time: lazrs on all cores, LASzip for the compression that only it knows (version 4)."""
    needed = laspy.DecompressionSelection.base().decompress_z().decompress_flags().decompress_point_source_id()  # formats 6 to 10 come in layers
    with laspy.open(path, laz_backend=laspy.LazBackend.LazrsParallel, decompression_selection=needed) as reader:
        try:
            yield from reader.chunk_iterator(BLOCK)
            return
        except Exception as error:
            if "is not supported" not in str(error):
                raise
    with laspy.open(path, laz_backend=laspy.LazBackend.Laszip) as reader:
        yield from reader.chunk_iterator(BLOCK)


class Box:
    """Of all points, against the one in the header: a damaged scale, offset or block of points lies beside it."""

    def __init__(self):
        self.low, self.high = numpy.full(3, numpy.iinfo("i8").max), numpy.full(3, numpy.iinfo("i8").min)

    def add(self, xyz):
        for axis in range(3):
            self.low[axis] = min(self.low[axis], xyz[:, axis].min())
            self.high[axis] = max(self.high[axis], xyz[:, axis].max())

    def warn(self, header, stream):
        stated = numpy.sort((header.mins, header.maxs), axis=0)
        ends = numpy.sort([end * header.scales + header.offsets for end in (self.low, self.high)], axis=0)
        size = max(0.0, *(ends[1] - ends[0]))
        beyond = max(*(stated[0] - ends[0]), *(ends[1] - stated[1]))
        if stated.any() and not beyond <= 0.01 * size + 2 * numpy.abs(header.scales).max():
            stream.warn(f"points lie {beyond:.6g} outside of the box that its header states: its scale, offset or points may be damaged")


def decode(path, stream):
    check_records(path)
    with laspy.open(path, read_evlrs=False) as reader:
        header = reader.header
    if header.are_points_compressed:
        check_chunks(header)
    else:
        check_plain(path, header)
    if header.point_count == 0:
        raise point_stream.ScanError("C06", "the header promises no point")
    if not (numpy.isfinite(header.scales).all() and numpy.isfinite(header.offsets).all() and numpy.all(header.scales)):
        raise point_stream.ScanError("C04", "its scale or offset is no number")
    crs = coordinate_system(header)
    if crs:
        stream.coordinate_system(crs)
    stream.begin(header.point_count, point_stream.SCALED, header.scales, header.offsets)
    read = 0
    sources = numpy.zeros(1 << 16, bool)
    box = Box()
    for block in blocks(path):
        read += len(block)
        ids = block.array["point_source_id"]
        sources[ids if (ids != ids[0]).any() else ids[0]] = True  # mostly they are all the same
        xyz = numpy.empty((len(block), 3), "<i4")
        for axis, name in enumerate("XYZ"):
            xyz[:, axis] = block.array[name]
        withheld = numpy.asarray(block.withheld, bool)
        if withheld.any():
            stream.invalid += int(withheld.sum())
            xyz = xyz[~withheld]
        if len(xyz) > 0:
            box.add(xyz)
        stream.add_records(xyz)
    box.warn(header, stream)
    if read != header.point_count:
        raise point_stream.ScanError("C05", f"the header promises {header.point_count} points, the file holds {read}")
    set_ups = numpy.flatnonzero(sources)
    if len(set_ups) > 1:
        stream.note(f"{len(set_ups)} set-ups by the points' source ids ({set_ups[0]} ... {set_ups[-1]}); LAS has no scanner positions: "
                    "give them in a file (make STATIONS=...)")


if __name__ == "__main__":
    point_stream.run(decode)
