#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""usage: parameter_tables.py BUILD [--check]: writes the table of parameters into the README of each program, between its two marks, as
the programs describe themselves. With --check nothing is written: prints what differs, exit code 1."""
import difflib
import os
import re
import sys

from pipeline_schema import SOURCE, described_programs

BEGIN, END = "<!-- parameters: made by make parameters -->", "<!-- end of parameters -->"


def typeset(text):
    """Text of a program, in ASCII, as the READMEs write it."""
    text = text.rstrip(".").replace(" ... ", " … ").replace(" x ", " × ").replace("lambda2 / lambda1", "λ₂/λ₁").replace("m^2", "m²")
    return text.replace("|", "\\|")


def range_of(parameter):
    if parameter["type"] == "boolean":
        return "true, false"
    if parameter["type"] == "choice":
        return ", ".join(parameter["choices"])
    unit = {"1": "", "deg": "°"}.get(parameter["unit"], " " + parameter["unit"])
    return typeset(f"{parameter['lowest']:,g} ... {parameter['highest']:,g}{unit}")


def default_of(parameter):
    value = parameter["default"]
    if value == "auto":
        return "auto: " + typeset(parameter["formula"])
    return str(value).lower() if isinstance(value, bool) else f"{value:,}" if isinstance(value, int) else str(value)


def table(parameters):
    rows = [("parameter", "default", "range", "meaning"), ("---",) * 4]
    rows += [(f"`{p['name']}`", default_of(p), range_of(p), typeset(p["description"])) for p in parameters]
    return "".join(f"| {' | '.join(row)} |\n" if row[0] != "---" else "|---|---|---|---|\n" for row in rows)


def readme_of(program):
    folders = (os.path.join("stages", program), os.path.join("stages", "tools", program))
    return next(os.path.join(folder, "README.md") for folder in folders if os.path.isdir(os.path.join(SOURCE, folder)))


def with_table(text, path, parameters):
    if not parameters:
        return text
    new, found = re.subn(f"{BEGIN}\n.*?{END}", lambda _: f"{BEGIN}\n{table(parameters)}{END}", text, flags=re.DOTALL)
    if found != 1:
        sys.exit(f"{path}: has {found} places for the table of parameters; put these two lines where it belongs:\n{BEGIN}\n{END}")
    return new


def main(build, check=""):
    differs = False
    for program in described_programs(build):
        path = readme_of(program["name"])
        with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
            old = file.read()
        new = with_table(old, path, program["parameters"])
        if new == old:
            continue
        differs = True
        if check:
            sys.stdout.writelines(difflib.unified_diff(old.splitlines(True), new.splitlines(True), path, "as the program says"))
        else:
            with open(os.path.join(SOURCE, path), "w", encoding="utf-8") as file:
                file.write(new)
    return 1 if check and differs else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
