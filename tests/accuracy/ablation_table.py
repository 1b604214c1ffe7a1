# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of `make ablation`, in Markdown: a row per switch, the worthiest addition first; a column per group of scenes."""

DEFAULT, ALL = "default", "all"  # variants that are no single switch


def figures(rows):
    """Mean IoU, rooms missed and merged, scenes that failed (their IoU counts 0)."""
    return {"iou": sum(row.get("iou", 0) for row in rows) / len(rows), "failed": sum("error" in row for row in rows),
            **{key: sum(row.get(key, 0) for row in rows) for key in ("missed", "merged")}}


def group_figures(variant, default, members):
    """Figures of every group of which all scenes are known, else None; a failed scene misses all of its rooms."""
    known = {name: {**row, "missed": default[name].get("rooms", 0)} if "error" in row else row for name, row in variant.items()}
    return {group: figures([known[name] for name in names]) if all(name in known for name in names) else None
            for group, names in members.items()}


def default_cell(row):
    return f"{row['iou']:.4f}, {row['missed']} missed, {row['merged']} merged" if row else "–"


def cell(row, default):
    """Difference of IoU in thousandths, and the rooms more or fewer that are missed and merged."""
    if not row or not default:
        return "–"
    parts = [f"{1000 * (row['iou'] - default['iou']):+.1f}"]
    parts += [f"{row[key] - default[key]:+d} {key}" for key in ("missed", "merged") if row[key] != default[key]]
    return ", ".join(parts + ([f"{row['failed']} failed"] if row["failed"] else []))


def label(name, parameters):
    stage, first = parameters.splitlines()[:2] if parameters else ("", "")
    return "**all of them: the paper**" if name == ALL else f"`{stage} {first.strip()}`"


def markdown(chosen, content, names):
    """`content`: {variant: {"parameters": text, "scenes": {scene: figures}}}; the last column is over all of `chosen`."""
    members = {}
    for scene in chosen:
        members.setdefault(scene["group"], []).append(scene["name"])
    if len(members) > 1:
        members["together"] = [scene["name"] for scene in chosen]
    default = content[DEFAULT]["scenes"]
    rows = {name: group_figures(content[name]["scenes"], default, members) for name in names if name in content}
    last = list(members)[-1]
    base = rows.pop(DEFAULT)
    order = sorted(rows, key=lambda name: rows[name][last]["iou"] if rows[name][last] else 1)
    lines = ["| | " + " | ".join(f"{group} ({len(scenes)})" for group, scenes in members.items()) + " |", "|---" * (len(members) + 1) + "|",
             "| **default** | " + " | ".join(map(default_cell, base.values())) + " |"]
    lines += [f"| {label(name, content[name]['parameters'])} | " + " | ".join(cell(rows[name][group], base[group]) for group in members) + " |"
              for name in order]
    return "\n".join(lines)
