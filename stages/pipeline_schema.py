#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""usage: pipeline_schema.py BUILD: prints the JSON Schema of pipeline.yaml, for editors, as the programs describe themselves."""
import json
import os
import subprocess
import sys

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")


def programs():
    """Each program of the table once, in its order."""
    with open(os.path.join(SOURCE, "stages", "pipeline.table"), encoding="utf-8") as table:
        rows = [line.split("|") for line in table if line.strip() and not line.startswith("#")]
    return list(dict.fromkeys(row[1].strip() for row in rows))


def value_schema(parameter):
    if parameter["type"] == "boolean":
        return {"type": "boolean"}
    if parameter["type"] == "choice":
        return {"enum": parameter["choices"]}
    number = {"type": parameter["type"], "minimum": parameter["lowest"], "maximum": parameter["highest"]}
    return {"anyOf": [number, {"const": "auto"}]} if parameter["auto"] else number


def parameter_schema(parameter):
    unit = "" if parameter["unit"] in ("1", "") else f" [{parameter['unit']}]"
    formula = f"; auto: {parameter['formula']}" if "formula" in parameter else ""
    return {"description": parameter["description"].rstrip(".") + unit + formula, "default": parameter["default"], **value_schema(parameter)}


def block_schema(program):
    properties = {p["name"]: parameter_schema(p) for p in program["parameters"]}
    return {"description": program["summary"], "type": ["object", "null"], "additionalProperties": False, "properties": properties}


def described_programs(build):
    """What each program says of itself: {"name", "summary", "parameters", …} (common/cli/describe.h)."""
    return [json.loads(subprocess.run([os.path.join(build, "bin", name), "--describe"], check=True, capture_output=True).stdout)
            for name in programs()]


def main(build):
    schema = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "pipeline.yaml of roomcut", "type": ["object", "null"],
              "additionalProperties": False, "properties": {program["name"]: block_schema(program) for program in described_programs(build)}}
    print(json.dumps(schema, indent=2, ensure_ascii=False))


if __name__ == "__main__":
    main(sys.argv[1])
