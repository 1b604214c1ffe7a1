#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A wall line moved by hand moves the wall in the model, and nothing before accept_lines runs again."""
import json
import os
import sys
import tempfile
import unittest

import pipeline

MOVE_M = 0.25


def vertex_range(path):
    """Lowest and highest x of a model.ply (binary, double coordinates first)."""
    import struct
    with open(path, "rb") as data:
        content = data.read()
    end = content.index(b"end_header\n") + len(b"end_header\n")
    head = content[:end].decode()
    count = int(head.split("element vertex ")[1].split()[0])
    vertex = head.split("element vertex")[1].split("element")[0]
    stride = 8 * vertex.count("property double")
    values = [struct.unpack_from("<d", content, end + i * stride)[0] for i in range(count)]
    return min(values), max(values)


class MovedWall(unittest.TestCase):
    def test_the_wall_moves_by_what_the_line_was_moved(self):
        with tempfile.TemporaryDirectory() as folder:
            scan, _, _ = pipeline.synthesize("one_room", folder)
            pipeline.make("run", scan, folder)
            model = os.path.join(folder, "model.ply")
            before = vertex_range(model)
            pipeline.make("edit-lines", scan, folder)
            edit = os.path.join(folder, "edits", "wall_lines.geojson")
            with open(edit, encoding="utf-8") as text:
                lines = json.load(text)
            # the wall with the largest x, moved out and locked: the points do not pull it back
            wall = max(lines["features"], key=lambda f: min(p[0] for p in f["geometry"]["coordinates"]))
            for point in wall["geometry"]["coordinates"]:
                point[0] += MOVE_M
            wall["properties"]["locked"] = True
            with open(edit, "w", encoding="utf-8") as text:
                json.dump(lines, text)
            early = {name: os.stat(os.path.join(folder, name)).st_mtime_ns
                     for name in ("10_ingest/cloud.h5", "20_slice/slices.h5", "30_detect_lines/wall_lines.geojson")}
            pipeline.make("run", scan, folder)
            after = vertex_range(model)
            self.assertAlmostEqual(after[1] - before[1], MOVE_M, delta=0.005)
            self.assertAlmostEqual(after[0], before[0], delta=0.005)
            for name, time in early.items():
                self.assertEqual(os.stat(os.path.join(folder, name)).st_mtime_ns, time, name)
            pipeline.make("drop-edit", scan, folder)
            pipeline.make("run", scan, folder)
            self.assertAlmostEqual(vertex_range(model)[1], before[1], delta=1e-9)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
