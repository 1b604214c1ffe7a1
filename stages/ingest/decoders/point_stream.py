# SPDX-License-Identifier: GPL-3.0-or-later
"""What decoders share: the stream of records on standard output that `ingest` reads (decoded_scan.h).

Each record is a byte that names its kind, a little-endian uint64 with the bytes that follow, and these: P points (x, y, z as float64),
S a scanner position (3 float64), D dropped points (uint64: beams without return, points marked as invalid), N a note, W a warning,
X an error ("C04\\nwhat\\nhint"), E the end (uint64: points in all). A stream without E is no scan."""
import os
import resource
import struct
import sys

import numpy

MEMORY = 3 << 30  # address space of a decoder: what a damaged header asks for beyond is an error of the scan
EXPORT_AGAIN = "export or copy the scan again"


class ScanError(Exception):
    def __init__(self, code, what, hint=EXPORT_AGAIN):
        super().__init__(what)
        self.code, self.what, self.hint = code, what, hint


class PointStream:
    def __init__(self, out):
        self.out = out
        self.points = self.no_returns = self.invalid = 0

    def record(self, kind, payload):
        self.out.write(kind + struct.pack("<Q", len(payload)))
        self.out.write(payload)

    def add(self, points):
        """n × 3 coordinates, without those that are not finite (they are counted as invalid)."""
        if not numpy.isfinite(points).all():
            finite = numpy.isfinite(points).all(axis=1)
            self.invalid += int(len(points) - finite.sum())
            points = points[finite]
        if len(points) > 0:
            self.points += len(points)
            self.record(b"P", memoryview(numpy.ascontiguousarray(points, "<f8")).cast("B"))

    def station(self, position):
        self.record(b"S", struct.pack("<3d", *position))

    def note(self, text):
        self.record(b"N", text.encode())

    def warn(self, text):
        self.record(b"W", text.encode())

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
