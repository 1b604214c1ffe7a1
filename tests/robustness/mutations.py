# SPDX-License-Identifier: GPL-3.0-or-later
"""Damage to files, drawn from a random.Random: equal seeds give equal files.

damage(data, flavour, draw) -> (bytes, words that say what was done). Flavours: "binary", "text", "json", "yaml", "hdf5".
"""
import json
import re
import struct

HOSTILE_NUMBERS = ["nan", "inf", "-inf", "1e308", "-1e308", "1e999", "1e-320", "-1", "0", "-0.0", "1e6", "1e9", "-1e12", "4294967296",
                   "2147483647", "-2147483648", "9223372036854775807", "18446744073709551616", "-9223372036854775808", "9" * 400, "0x10",
                   "1,5", "NaN", "Infinity", "-Infinity", "1e400"]
HOSTILE_DOUBLES = [float("nan"), float("inf"), -float("inf"), 1e308, -1e308, 1e18, -1e9, 1e6, -1.0, 0.0, 5e-324]
HOSTILE_INTEGERS = [-1, 0, 1, 127, 255, 2**31 - 1, -2**31, 2**32 - 1, 2**62, 2**63 - 1, -2**63, 10**9]
NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
DEPTHS = [70, 1000, 20000, 100000]


def _place(data, draw):
    return draw.randrange(len(data)) if data else 0


def flip_bits(data, draw):
    out = bytearray(data)
    for _ in range(draw.choice([1, 1, 1, 2, 4, 16]) if out else 0):
        out[_place(out, draw)] ^= 1 << draw.randrange(8)
    return bytes(out)


def cut_end(data, draw):
    return data[:_place(data, draw)]


def cut_out(data, draw):
    at = _place(data, draw)
    return data[:at] + data[at + draw.choice([1, 4, 16, 100, 5000]):]


def splice(data, draw):
    """A piece of the file at another place, put in between or written over what is there."""
    start, at = _place(data, draw), _place(data, draw)
    piece = data[start:start + draw.choice([4, 8, 64, 1000, 20000])]
    return data[:at] + piece + data[at + (len(piece) if draw.random() < 0.6 else 0):]


def nul_bytes(data, draw):
    at = _place(data, draw)
    zeros = bytes(draw.choice([1, 8, 64, 4096]))
    return data[:at] + zeros + data[at + (len(zeros) if draw.random() < 0.5 else 0):]


def noise(data, draw):
    at = _place(data, draw)
    some = bytes(draw.randrange(256) for _ in range(draw.choice([1, 4, 32])))
    return data[:at] + some + data[at + len(some):]


def binary_number(data, draw):
    """A hostile number where one may stand; the items of a file lie at multiples of their size, or anywhere after a header."""
    code = draw.choice("fdiqhB")
    if code in "fd":
        value = draw.choice(HOSTILE_DOUBLES)
        raw = struct.pack("<" + code, value if code == "d" or abs(value) < 3e38 or value != value else float("inf"))
    else:
        size = struct.calcsize("<" + code)
        raw = (draw.choice(HOSTILE_INTEGERS) & (2**(8 * size) - 1)).to_bytes(size, "little")
    at = _place(data, draw)
    if draw.random() < 0.7:
        at -= at % len(raw)
    return data[:at] + raw + data[at + len(raw):]


def text_number(data, draw):
    """One number of the text becomes another one."""
    found = list(NUMBER.finditer(data)) if len(data) < 1 << 16 else list(NUMBER.finditer(data, _place(data, draw)))[:200]
    if not found:
        return noise(data, draw)
    hit = draw.choice(found)
    return data[:hit.start()] + draw.choice(HOSTILE_NUMBERS).encode() + data[hit.end():]


def line_change(data, draw):
    lines = data.split(b"\n")
    at = draw.randrange(len(lines))
    how = draw.randrange(4)
    if how == 0:
        del lines[at]
    elif how == 1:
        lines.insert(at, lines[at])
    elif how == 2:
        other = draw.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    else:
        lines[at] = b" ".join(lines[at].split()[:-1])
    return b"\n".join(lines)


def long_line(data, draw):
    at = _place(data, draw)
    return data[:at] + draw.choice([b"1 ", b"x", b"\t", b"9", b"\"", b"[1,", b"- "]) * draw.choice([1000, 100000, 1000000]) + data[at:]


def odd_text(data, draw):
    how = draw.randrange(5)
    if how == 0:
        return b"\xef\xbb\xbf" + data
    if how == 1:
        return data.replace(b"\n", b"\r")
    if how == 2:
        return data.replace(b"\n", b" ")
    if how == 3:
        return data.decode("latin-1").encode("utf-16")
    at = _place(data, draw)
    return data[:at] + draw.choice([b"\xff\xfe", b"\xc3\x28", b"\xed\xa0\x80", b"\x1b[2J", b"\x00"]) + data[at:]


def _all_nodes(node, path=()):
    yield path
    if isinstance(node, (dict, list)):
        for key in node if isinstance(node, dict) else range(len(node)):
            yield from _all_nodes(node[key], path + (key,))


def deep_text(draw, opening="[", closing="]"):
    depth = draw.choice(DEPTHS)
    kind = draw.randrange(3)
    if kind == 0:
        return opening * depth + closing * depth
    if kind == 1:
        return opening * depth  # never closed
    return '{"a":' * depth + "1" + "}" * depth


MARK = "@@roomcut-mutation@@"


def json_node(data, draw):
    """One node of the tree becomes something else: another type, number, depth, key, or nothing."""
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return flip_bits(data, draw)
    paths = [path for path in _all_nodes(tree) if path]
    if not paths:
        return noise(data, draw)
    path = draw.choice(paths)
    home = tree
    for key in path[:-1]:
        home = home[key]
    old = home[path[-1]]
    how = draw.randrange(9)
    if how == 0:
        del home[path[-1]]
        return json.dumps(tree).encode()
    if how == 1 and isinstance(home, dict):  # the key stands twice
        home[MARK] = old
        return json.dumps(tree).replace(json.dumps(MARK), json.dumps(path[-1])).encode()
    if how == 2 and isinstance(home, dict):
        home[draw.choice(["", "x" * 100000, "constructor", path[-1] + " ", "\u0000"])] = home.pop(path[-1])
        return json.dumps(tree).encode()
    if how == 3 and isinstance(home, list):
        home.extend([old] * draw.choice([1, 10, 5000]))
        return json.dumps(tree).encode()
    new = draw.choice(["null", "true", "\"\"", "\"word\"", "[]", "{}", "[null]", json.dumps("x" * draw.choice([300, 1000000])), "[1,2,3]"])
    if how in (4, 5, 6):
        new = draw.choice([n for n in HOSTILE_NUMBERS if re.fullmatch(r"-?\d+(\.\d+)?(e-?\d+)?", n)])
    elif how == 7:
        new = deep_text(draw)
    home[path[-1]] = MARK
    return json.dumps(tree).replace(json.dumps(MARK), new).encode()


def deep_text_anywhere(data, draw):
    at = _place(data, draw)
    return data[:at] + deep_text(draw, *draw.choice([("[", "]"), ("{", "}"), ("- ", ""), ("? ", ""), ("(", ")")])).encode() + data[at:]


ANY = [flip_bits, flip_bits, cut_end, cut_out, splice, splice, nul_bytes, noise]
FLAVOURS = {
    "binary": ANY + [binary_number] * 6,
    "text": ANY + [text_number] * 6 + [line_change] * 2 + [long_line, odd_text],
    "json": ANY + [text_number] * 4 + [json_node] * 8 + [long_line, odd_text, deep_text_anywhere],
    "yaml": ANY + [text_number] * 4 + [line_change] * 2 + [long_line, odd_text] + [deep_text_anywhere] * 2,
    "hdf5": ANY + [binary_number] * 6,
}


def damage(data, flavour, draw, extra=()):
    """`extra`: further mutations of this file alone (h5_mutations.py). Mostly one change, now and then a few."""
    choices = FLAVOURS[flavour] + list(extra)
    names = []
    before = data
    for _ in range(draw.choice([1, 1, 1, 1, 2, 4])):
        change = draw.choice(choices)
        names.append(change.__name__)
        data = change(data, draw)
    if data == before:
        names.append("cut_end")
        data = cut_end(data, draw)
    return data, "+".join(names)
