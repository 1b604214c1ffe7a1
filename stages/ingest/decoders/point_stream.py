# SPDX-License-Identifier: GPL-3.0-or-later
"""What decoders share: the stream of records on standard output that `ingest` reads (decoded_scan.h).

Each record is a byte that names its kind, a little-endian uint64 with the bytes that follow, and these. Before the points: S a scanner
position (3 float64), N a note, C the coordinate system as text, B the head (uint64: how many points the file promises, uint64: their form,
3 float64: scales, 3 float64: offsets). Then P points: form 0: x, y, z as float64; 1: as int32, times scale plus offset; 2: x, y, z as
float64 and the normal as float32. After them N, W a warning, D dropped points (uint64: beams without return, points marked as invalid), E the end
(uint64: points in all). X is an error ("C04\\nwhat\\nhint"). A stream without E is no scan."""
import os
import re
import resource
import struct
import sys

import numpy

MEMORY = 3 << 30  # address space of a decoder: what a damaged header asks for beyond is an error of the scan
LONGEST_TEXT = 1 << 16
LONGEST_CRS = 1 << 14  # real ones have a few thousand bytes; an attribute of HDF5 holds 64 KiB
DOUBLES, SCALED, WITH_NORMALS = range(3)  # forms of points
EXPORT_AGAIN = "export or copy the scan again"


class ScanError(Exception):
    def __init__(self, code, what, hint=EXPORT_AGAIN):
        super().__init__(what)
        self.code, self.what, self.hint = code, what, hint


class PointStream:
    def __init__(self, out):
        self.out = out
        self.points = self.no_returns = self.invalid = 0
        self.form = DOUBLES

    def record(self, kind, payload):
        self.out.write(kind + struct.pack("<Q", len(payload)))
        self.out.write(payload)

    def station(self, position):
        self.record(b"S", struct.pack("<3d", *position))

    def note(self, text):
        self.record(b"N", text.encode()[:LONGEST_TEXT])

    def warn(self, text):
        self.record(b"W", text.encode()[:LONGEST_TEXT])

    def coordinate_system(self, text):
        """Well-known text or a name; what no coordinate system is so long as is left out."""
        text = "".join(letter for letter in text.strip() if letter.isprintable() or letter in "\n\t").encode("utf-8", "replace")
        if len(text) > LONGEST_CRS:
            self.note(f"the text of its coordinate system has {len(text)} bytes; it was left out")
        elif text:
            self.record(b"C", text)
            name = re.match(rb'\w+\s*\[\s*"([^"]{1,100})"', text)
            self.note("coordinate system: " + b" ".join((name.group(1) if name else text[:100]).split()).decode("utf-8", "replace"))

    def begin(self, most_points, form=DOUBLES, scales=(1, 1, 1), offsets=(0, 0, 0)):
        self.form = form
        self.record(b"B", struct.pack("<2Q6d", most_points, form, *scales, *offsets))
        self.out.flush()

    def add(self, points, normals=None):
        """n × 3 coordinates, without those that are not finite (they are counted as invalid)."""
        if not numpy.isfinite(points).all():
            finite = numpy.isfinite(points).all(axis=1)
            self.invalid += int(len(points) - finite.sum())
            points = points[finite]
            normals = normals[finite] if normals is not None else None
        if self.form == WITH_NORMALS:
            records = numpy.zeros(len(points), [("point", "<f8", 3), ("normal", "<f4", 3)])
            records["point"] = points
            if normals is not None:
                records["normal"] = normals
            points = records
        self.add_records(numpy.ascontiguousarray(points, None if self.form == WITH_NORMALS else "<f8"))

    def add_records(self, records):
        """Points as the head says, one a row."""
        if len(records) > 0:
            self.points += len(records)
            self.record(b"P", memoryview(records.view("u1").reshape(-1)))

    def end(self):
        self.record(b"D", struct.pack("<2Q", self.no_returns, self.invalid))
        self.record(b"E", struct.pack("<Q", self.points))


def run(decode):
    """decode(path, stream) for the path on the command line; errors become a record and exit code 3."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    stream = PointStream(sys.stdout.buffer)
    try:
        try:
            decode(sys.argv[1], stream)
            stream.end()
        except BrokenPipeError:
            raise
        except ScanError as error:
            fail(stream, error.code, error.what, error.hint)
        except MemoryError:
            fail(stream, "C04", "its headers ask for more memory than any scan needs: they are damaged", EXPORT_AGAIN)
        except BaseException as error:  # lazrs panics with a BaseException
            first = (str(error).splitlines() or [""])[0].split(" (LASzip")[0][:200]
            fail(stream, "C04", f"cannot be decoded: {first or type(error).__name__}", EXPORT_AGAIN)
        sys.stdout.buffer.flush()
    except BrokenPipeError:  # ingest is gone
        os._exit(1)
    os._exit(0)  # without what a damaged file may have left to be destructed


def fail(stream, code, what, hint):
    stream.record(b"X", f"{code}\n{what}\n{hint}".encode())
