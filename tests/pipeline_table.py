# SPDX-License-Identifier: GPL-3.0-or-later
"""stages/pipeline.table for tests and benchmarks (what it means: common/pipeline/README.md)."""
import os
import re
from dataclasses import dataclass

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "stages", "pipeline.table")


@dataclass
class Run:
    """One line: options and paths in the table's order; a file without an option has the option ""."""
    name: str
    program: str
    reads: list
    writes: list

    def paths(self, side):
        return [path for _, path in getattr(self, side)]


def read_table(path=TABLE):
    """The lines, those beside the pipeline ("-") too, and where each artefact lies."""
    runs, places = [], {}

    def file_of(item):
        if item == "scan" or ("/" in item and "=" not in item):
            return "", item
        option, name, where = re.fullmatch(r"(?:([^:=]+):)?([^:=]+)(?:=(.+))?", item).groups()
        if where:
            places[name] = where
        return option or name, places[name]

    with open(path, encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                name, program, reads, writes = (column.strip() for column in line.split("|"))
                runs.append(Run(name, program, [file_of(i) for i in reads.split()], [file_of(i) for i in writes.split()]))
    return runs, places


LINES, PLACES = read_table()
RUNS = [run for run in LINES if run.name != "-"]


def other_options(run):
    """The options that a run needs because its files are not those of its program's first run."""
    first = next(line for line in LINES if line.program == run.program)
    usual = dict(first.reads + first.writes)
    return [word for option, path in run.reads + run.writes if option and usual.get(option) != path for word in (f"--{option}", path)]
