# SPDX-License-Identifier: GPL-3.0-or-later
"""What the data term weighs: its features per cell with their weights, as raycast wrote them, from the artefacts of a finished run."""
import os

import h5py
import numpy

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "stages", "raycast", "weights.table")
BETA_TOLERANCE = 1e-4  # features are stored with seven digits


class Unusable(Exception):
    """An artefact that cannot be used: file, cause and remedy."""

    def __init__(self, path, cause, remedy):
        super().__init__(f"{path}: {cause}")
        self.remedy = remedy


def read_table(path=TABLE):
    """Feature to weight, in the table's order; the constant comes first."""
    with open(path, encoding="utf-8") as text:
        rows = [line.split("|") for line in text if "|" in line and not line.startswith("#")]
    return {name.strip(): float(weight) for name, weight, _ in rows}


SHIPPED = read_table()


def shipped_weights():
    return numpy.array(list(SHIPPED.values()))


def log_odds(terms, weights):
    return terms @ weights


def probability(odds):
    return 0.5 * (1 + numpy.tanh(0.5 * odds))


def term_matrix(data):
    """One row per cell, one column per term of SHIPPED; and the weights with which raycast summed them."""
    cell = data["cell"]
    features = [name for name in SHIPPED if name != "constant"]
    columns = [numpy.ones(len(cell["beta"])), *(cell[name][:].astype(float) for name in features)]
    return numpy.column_stack(columns), numpy.array([cell.attrs["constant"], *(cell[name].attrs["weight"] for name in features)])


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

    Raises Unusable when the files do not belong together, or when features and weights do not give the beta that raycast wrote.
    """
    path = {name: os.path.join(work, "90_final", name + ".h5") for name in ("cells", "data_terms")}
    truth_path = os.path.join(work, "evaluate", "truth_cells.h5")
    with open_artefact(path["cells"]) as cells, open_artefact(path["data_terms"], cells) as data, open_artefact(truth_path, cells) as truth:
        terms, weights = term_matrix(data)
        off = numpy.abs(probability(log_odds(terms, weights)) - data["cell/beta"][:]).max(initial=0)
        if off > BETA_TOLERANCE:
            raise Unusable(path["data_terms"], f"its beta is not what its features and weights give (off by {off:.2g})",
                           "make accuracy for this scene again; with raycast.evidence: parity there is nothing to fit")
        return terms, truth["cell/sampled"][:], truth["cell/empty"][:]
