# SPDX-License-Identifier: GPL-3.0-or-later
"""What the data term weighs (stages/raycast/raycast.cpp, empty_log_odds): its terms per cell, from the artefacts of a finished run."""
import json
import os

import h5py
import numpy

# Every term with the weight that raycast gives it. That both are still what raycast sums is checked on every file: read_terms().
SHIPPED = {"constant": 1.1, "own fronts": 0.5, "own backs, thin": -2.5, "own backs, wide": 1.5, "around, fronts": 2.0, "behind": -1.75,
           "in_slab": -3.5, "open": -3.0, "outdoors": -2.5, "sky": -0.8, "line of sight": 3.0}
SURFACE_M2, SURFACE_SHARE = 0.5, 0.03  # of a cell's surface, against which its own covered faces count
STOREY_M, INSIDE, RIM = 1.0, 0.3, 0.8  # looked_through() of cell_evidence.cpp
BETA_TOLERANCE = 1e-4  # evidences are stored with seven digits


class Unusable(Exception):
    """An artefact that cannot be used: file, cause and remedy."""

    def __init__(self, path, cause, remedy):
        super().__init__(f"{path}: {cause}")
        self.remedy = remedy


def shipped_weights():
    return numpy.array(list(SHIPPED.values()))


def log_odds(terms, weights):
    return terms @ weights


def probability(odds):
    return 0.5 * (1 + numpy.tanh(0.5 * odds))


def corner_sums(values, offset):
    return numpy.add.reduceat(values, offset[:-1])


def plan(cells):
    """Area and circumference of every face of the plan, and the heights of the layers."""
    xy, offset, corner = cells["vertices/xy"][:], cells["faces/offset"][:], cells["faces/vertex"][:]
    following = numpy.arange(len(corner)) + 1
    following[offset[1:] - 1] = offset[:-1]
    begin, end = xy[corner], xy[corner[following]]
    first = numpy.repeat(begin[offset[:-1]], numpy.diff(offset), axis=0)  # near by, so that no digits are lost
    u, v = begin - first, end - first
    area = 0.5 * corner_sums(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], offset)
    return area, corner_sums(numpy.linalg.norm(end - begin, axis=1), offset), numpy.diff(cells["levels/z"][:])


def term_matrix(cells, weights, data, depth_m):
    """One row per cell, one column per term of SHIPPED."""
    area, around, height = plan(cells)
    faces, layers = len(area), len(height)
    volume = numpy.outer(height, area).ravel()
    total_m2 = (numpy.outer(height, around) + 2 * area).ravel()
    cell = {name: data["cell/" + name][:].astype(float) for name in data["cell"]}
    both_m2 = (cell["d_empty"] + cell["d_solid"] - volume) / depth_m
    front_m2, back_m2 = 0.5 * (both_m2 + cell["surface"]), 0.5 * (both_m2 - cell["surface"])
    surface = both_m2 + SURFACE_M2 + SURFACE_SHARE * total_m2
    floor, ceiling = (weights["level/" + name][:].astype(float).reshape(layers + 1, faces) for name in ("floor", "ceiling"))
    flat = numpy.maximum(floor[:-1], ceiling[1:]).ravel()
    thin = cell["thin"]
    upright = thin * numpy.repeat(height >= STOREY_M, faces)
    rim = numpy.clip((cell["line_of_sight"] - INSIDE) / (RIM - INSIDE), 0, 1)
    columns = {"constant": numpy.ones(len(volume)), "own fronts": front_m2 / surface, "own backs, thin": thin * back_m2 / surface,
               "own backs, wide": (1 - thin) * back_m2 / surface, "around, fronts": 0.5 * (cell["observed"] + cell["around"]),
               "behind": (1 + thin * (1 - flat)) * cell["behind"], "in_slab": cell["in_slab"], "open": cell["open"],
               "outdoors": cell["outdoors"], "sky": cell["sky"],
               "line of sight": (1 - cell["outdoors"]) * (1 - cell["sky"]) * ((1 - thin) * cell["line_of_sight"] + upright * rim)}
    return numpy.column_stack([columns[name] for name in SHIPPED])


def open_artefact(path, cells=None):
    try:
        file = h5py.File(path, "r")
    except OSError as problem:
        raise Unusable(path, f"cannot be read: {problem}", "make accuracy for this scene again") from problem
    if cells is not None and file.attrs["cells_payload_sha256"] != cells["provenance"].attrs["payload_sha256"]:
        raise Unusable(path, "was made for another cells.h5", "make accuracy for this scene again")
    return file


def read_terms(work):
    """The terms of the final pass of a work folder, the volume of every cell as evaluate sampled it, and what of it is empty in the truth.

    Raises Unusable when the files do not belong together, or when the shipped weights do not give the beta that raycast wrote.
    """
    path = {name: os.path.join(work, "90_final", name + ".h5") for name in ("cells", "weights", "data_terms")}
    truth_path = os.path.join(work, "evaluate", "truth_cells.h5")
    with open_artefact(path["cells"]) as cells, open_artefact(path["weights"], cells) as weights, \
            open_artefact(path["data_terms"], cells) as data, open_artefact(truth_path, cells) as truth:
        if data["provenance/inputs/weights"].attrs["payload_sha256"] != weights["provenance"].attrs["payload_sha256"]:
            raise Unusable(path["data_terms"], "was made from another weights.h5", "make accuracy for this scene again")
        params = json.loads(data["provenance"].attrs["params_json"])
        if params["evidence"] != "combined" or params["surface_depth_m"] <= 0:
            raise Unusable(path["data_terms"], "was made with raycast.evidence: parity or surface_depth_m: 0", "use the default parameters")
        terms = term_matrix(cells, weights, data, params["surface_depth_m"])
        off = numpy.abs(probability(log_odds(terms, shipped_weights())) - data["cell/beta"][:]).max(initial=0)
        if off > BETA_TOLERANCE:
            raise Unusable(path["data_terms"], f"its beta is not what SHIPPED in tests/accuracy/weight_terms.py gives (off by {off:.2g})",
                           "make accuracy again after a change of raycast; when its sum was changed, change weight_terms.py as well")
        return terms, truth["cell/sampled"][:], truth["cell/empty"][:]
