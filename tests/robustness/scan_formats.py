# SPDX-License-Identifier: GPL-3.0-or-later
"""Scans as PTX, PTS and PCD; E57 files taken apart and put together, so that damage lies behind right checksums."""
import struct

PAGE, CHECKSUM = 1024, 4  # bytes of an E57 page, and of its checksum at the page's end
XML_OFFSET, XML_LENGTH, FILE_LENGTH = 24, 32, 16  # places in the file header


def lines(points, more=""):
    return "".join(f"{x:.3f} {y:.3f} {z:.3f}{more}\n" for x, y, z in points)


def ptx(points):
    """Two scans, the second one turned by a quarter."""
    half = len(points) // 2
    first = f"{half}\n1\n1 2 1.5\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 1.5 1\n"
    second = f"{(len(points) - half) // 2}\n2\n3 4 1.6\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n3 4 1.6 1\n"
    moved = [(x - 1, y - 2, z - 1.5) for x, y, z in points[:half]]
    turned = [(y - 4, 3 - x, z - 1.6) for x, y, z in points[half:half + (len(points) - half) // 2 * 2]]
    moved[5] = (0, 0, 0)
    return (first + lines(moved, " 0.5") + second + lines(turned, " 0.5")).encode()


def pts(points):
    return (f"{len(points)}\n" + lines(points, " -1024 10 20 30")).encode()


def pcd_head(points, data):
    return ("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
            f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 1 2 1.5 1 0 0 0\nPOINTS {len(points)}\nDATA {data}\n").encode()


def pcd_ascii(points):
    return pcd_head(points, "ascii") + lines(points, " 0").encode()


def pcd_binary(points):
    return pcd_head(points, "binary") + b"".join(struct.pack("<4f", *point, 0) for point in points)


def compress_lzf(data):
    """LZF: runs of one byte as references, all else as literals."""
    out, at, literal = bytearray(), 0, 0

    def flush(end):
        for begin in range(literal, end, 32):
            piece = data[begin:min(begin + 32, end)]
            out.extend(bytes([len(piece) - 1]) + piece)

    while at < len(data):
        run = 0
        while at > 0 and run < 264 and at + run < len(data) and data[at + run] == data[at - 1]:
            run += 1
        if run < 9:
            at += max(run, 1)
            continue
        flush(at)
        out.extend((0xE0, run - 9, 0))
        at += run
        literal = at
    flush(len(data))
    return bytes(out)


def pcd_compressed(points):
    columns = b"".join(struct.pack(f"<{len(points)}f", *column) for column in zip(*points)) + bytes(4 * len(points))
    packed = compress_lzf(columns)
    return pcd_head(points, "binary_compressed") + struct.pack("<2I", len(packed), len(columns)) + packed


def _table():
    table = []
    for value in range(256):
        for _ in range(8):
            value = value >> 1 ^ (0x82F63B78 if value & 1 else 0)
        table.append(value)
    return table


TABLE = _table()


def crc32c(data):
    value = 0xFFFFFFFF
    for byte in data:
        value = value >> 8 ^ TABLE[(value ^ byte) & 255]
    return value ^ 0xFFFFFFFF


def e57_content(file):
    """The bytes without the pages' checksums."""
    return b"".join(file[begin:begin + PAGE - CHECKSUM] for begin in range(0, len(file), PAGE))


def e57_file(content):
    """Pages with right checksums; the length of the file in its header is made right too."""
    size = PAGE - CHECKSUM
    content += bytes(-len(content) % size)
    pages = [content[begin:begin + size] for begin in range(0, len(content), size)]
    if len(pages[0]) == size:
        pages[0] = pages[0][:FILE_LENGTH] + struct.pack("<Q", len(pages) * PAGE) + pages[0][FILE_LENGTH + 8:]
    return b"".join(page + struct.pack(">I", crc32c(page)) for page in pages)


def _xml_place(file):
    offset, length = struct.unpack_from("<2Q", file, XML_OFFSET)
    return offset - offset // PAGE * CHECKSUM, length


def e57_xml(file):
    begin, length = _xml_place(file)
    return e57_content(file)[begin:begin + length]


def e57_with_xml(file, xml):
    """The file with another XML part, which is its last one."""
    begin, _ = _xml_place(file)
    content = bytearray(e57_content(file)[:begin])
    content[XML_LENGTH:XML_LENGTH + 8] = struct.pack("<Q", len(xml))
    return e57_file(bytes(content) + xml)
