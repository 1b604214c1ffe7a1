# SPDX-License-Identifier: GPL-3.0-or-later
"""What encoders share: the records on standard input that `synthesize` writes (encoded_writer.cpp).

Each record is a byte that names its kind, a little-endian uint64 with the bytes that follow, and these: S a set-up begins (its pose as
7 float64: unit quaternion w x y z, position; or nothing), P points of it (x, y, z as float32 in the scene's coordinates), E the end.
Input without E is no scan, and what was written of it is worth nothing."""
import struct
import sys

import numpy

HEAD = struct.Struct("<cQ")


def exactly(count):
    data = sys.stdin.buffer.read(count)
    if len(data) < count:
        raise EOFError("the points broke off")
    return data


def records():
    """("S", pose or None) and ("P", n × 3 float64), up to the end."""
    while True:
        kind, size = HEAD.unpack(exactly(HEAD.size))
        payload = exactly(size)
        if kind == b"E":
            return
        if kind == b"S":
            yield "S", struct.unpack("<7d", payload) if payload else None
        elif kind == b"P":
            yield "P", numpy.frombuffer(payload, "<f4").reshape(-1, 3).astype(float)
        else:
            raise ValueError(f"a record of unknown kind {kind}")


def run(encode):
    """encode(path, option) as the command line says; what fails is one line on standard error and exit code 5."""
    try:
        encode(sys.argv[1], sys.argv[2])
    except BaseException as error:  # pylint: disable=broad-except  lazrs panics with a BaseException
        text = " ".join(str(error).split())
        print(f"{type(error).__name__}: {text}"[:200], file=sys.stderr)
        sys.exit(5)
