# SPDX-License-Identifier: GPL-3.0-or-later
"""Means of groups, the table of `make accuracy`, and what changed since an earlier one."""
import collections
import itertools

# key, head, width, decimals; counts are summed over a group, shares averaged.
SHARES = (("iou", "IoU", 7, 4), ("bound", "bound", 7, 4), ("seen", "seen", 7, 4), ("recall", "recall", 7, 4), ("precision", "precis.", 7, 4))
COUNTS = ("rooms", "found", "merged", "missed", "missed_scanned", "unentered_found", "unentered_unknown", "unentered_denied")
MORE_SHARES = (("denied", "denied", 6, 3), ("invented", "invent.", 7, 4), ("thin_kept", "thin", 6, 3), ("walls", "walls", 6, 3), ("walls_loose", "4 cm", 6, 3), ("horizontals", "horiz.", 6, 3), ("horizontals_fine", "5 mm", 6, 3), ("hausdorff_pct", "Hausd.%", 8, 3))
AVERAGED = [column[0] for column in SHARES + MORE_SHARES] + ["cpu_s"]
# A scene that gave no model counts as this, so that it cannot vanish from the means.
OF_FAILED = {"iou": 0.0, "seen": 0.0, "bound": None, "denied": None, "invented": None, "recall": 0.0, "precision": 0.0, "thin_kept": 0.0, "walls": 0.0, "walls_loose": 0.0, "horizontals": 0.0, "horizontals_fine": 0.0}


def mean(values):
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def group_rows(rows):
    """One row per group: means of the shares, sums of the counts, how many models are valid."""
    groups = []
    for group in dict.fromkeys(row["group"] for row in rows):
        members = [row for row in rows if row["group"] == group]
        complete = [{**OF_FAILED, **row} if "error" in row else row for row in members]
        summary = {"name": group, "scenes": len(members), "failed": sum("error" in row for row in members)}
        summary.update({key: mean([row.get(key) for row in complete]) for key in AVERAGED})
        summary.update({key: sum(row.get(key, 0) for row in members) for key in COUNTS})
        entered = [row for row in members if row.get("unentered_m3")]
        if entered:  # by volume, not by scene: a share of little says little
            volume = summary["unentered_m3"] = sum(row["unentered_m3"] for row in entered)
            summary["denied"] = sum(row["denied"] * row["unentered_m3"] for row in entered) / volume
        summary["elements"] = group_elements([row["elements"] for row in members if "elements" in row])
        summary["spread"] = spread(members) if group == "moved" else None
        summary["valid"] = sum(bool(row.get("valid")) for row in members)
        summary["worst_iou"] = min(row["iou"] for row in complete)
        for kind in ("lost", "extra"):
            known = [row[kind] for row in members if row.get(kind)]
            summary[kind] = {cause: mean([shares[cause] for shares in known]) for cause in known[0]} if known else None
        groups.append(summary)
    return groups


# Of the elements: sums over a group; means; the rest are means weighted by the slopes' area.
ELEMENT_SUMS = ("slopes_m2", "columns", "columns_found", "columns_false", "floor_m2", "niches", "niches_m2", "niches_near_m2", "heights", "heights_1mm",
                "columns_25cm", "columns_25cm_found", "niches_10cm_m2", "niches_10cm_near_m2",
                "arcs", "arcs_found", "arcs_false", "arcs_close")
GROUPS_OF_ELEMENTS = ("heights", "round")  # have figures there, but none of those things
OF_SLOPES = ("angle_deg", "angle_p95_deg", "slopes_close")


def group_elements(members):
    """The elements of a group: counts and areas summed, angles weighted by area, the volume error of the worst scene."""
    if not members:
        return None
    out = {key: sum(member[key] for member in members) for key in ELEMENT_SUMS}
    sloped = [member for member in members if member["slopes_m2"] > 0]
    for key in OF_SLOPES:
        out[key] = sum(member[key] * member["slopes_m2"] for member in sloped) / out["slopes_m2"] if sloped else None
    out["height_worst_m"] = max((member["height_worst_m"] for member in members if member["height_worst_m"] is not None), default=None)
    out["volume_error"] = max((member["volume_error"] for member in members if member["volume_error"] is not None), key=abs, default=None)
    return out


def has_elements(row):
    elements, group = row.get("elements"), row.get("group", row["name"])
    return bool(elements) and (group in GROUPS_OF_ELEMENTS or any(elements[key] > 0 for key in ("slopes_m2", "columns", "niches", "arcs")))


def element_line(row, width):
    values = row["elements"]
    percent = lambda part, whole: number(100 * part / whole if whole else None, 7, 1)  # noqa: E731
    return " ".join([f"{row['name']:<{width}}", number(None if values["volume_error"] is None else 100 * values["volume_error"], 8, 3),
                     number(values["angle_deg"], 7, 2), number(values["angle_p95_deg"], 7, 2),
                     number(None if values["slopes_close"] is None else 100 * values["slopes_close"], 7, 1),
                     f"{values['columns_found']:>5}/{values['columns']:<5}", percent(values["columns_25cm_found"], values["columns_25cm"]), f"{values['columns_false']:>5}",
                     number(1000 * values["columns_false"] / values["floor_m2"] if values["floor_m2"] else None, 7, 2),
                     f"{values['niches']:>6}", percent(values["niches_near_m2"], values["niches_m2"]), percent(values["niches_10cm_near_m2"], values["niches_10cm_m2"]),
                     percent(values["heights_1mm"], values["heights"]),
                     number(None if values["height_worst_m"] is None else 1000 * values["height_worst_m"], 8, 1),
                     f"{values['arcs_found']:>5}/{values['arcs']:<5}", f"{values['arcs_false']:>5}",
                     percent(2 * values["arcs_found"], values["arcs"] + values["arcs_found"] + values["arcs_false"]), percent(values["arcs_close"], values["arcs_found"])])


def element_lines(rows, groups):
    """Slopes, columns, niches and curved walls: what the first table does not show of them. Of a group the worst volume, and the rest of all together."""
    some = [row for row in rows if has_elements(row) and shown(row)]
    if not some:
        return []
    width = max(len(row["name"]) for row in some)
    head_line = " ".join([f"{'elements':<{width}}", f"{'volume %':>8}", f"{'angle°':>7}", f"{'95 %':>7}", f"{'close%':>7}", f"{'columns':<11}", f"{'>25cm %':>7}", f"{'false':>5}",
                          f"{'/1000m²':>7}", f"{'niches':>6}", f"{'2 cm %':>7}", f"{'>10cm %':>7}", f"{'1 mm %':>7}", f"{'worst mm':>8}",
                          f"{'arcs':<11}", f"{'false':>5}", f"{'F1 %':>7}", f"{'close %':>7}"])
    return ["", head_line, *(element_line(row, width) for row in some), "", *(element_line(group, width) for group in groups if has_elements(group))]


def number(value, width, decimals):
    return f"{'–' if value is None else format(value, f'.{decimals}f'):>{width}}"


def line(row, width):
    cells = [f"{row['name']:<{width}}"]
    if "error" in row:
        return f"{cells[0]}  FAILED: {row['error']}"
    cells += [number(row[key], w, d) for key, _, w, d in SHARES]
    cells += [f"{row['found']:>4}/{row['rooms']:<4}", f"{row['merged']:>6}", f"{row['missed']:>6}", f"{row['missed_scanned']:>7}",
              f"{row['unentered_found']:>5}/{row['unentered_unknown']}/{row['unentered_denied']:<5}"]
    cells += [number(row[key], w, d) for key, _, w, d in MORE_SHARES]
    valid = f"{row['valid']}/{row['scenes']}" if "scenes" in row else ("yes" if row["valid"] else "NO")
    return " ".join(cells + [f"{valid:>6}", number(row["cpu_s"], 6, 2)])


def head(width):
    names = [f"{'scene':<{width}}"] + [f"{name:>{w}}" for _, name, w, _ in SHARES]
    names += [f"{'rooms':<9}", "merged", "missed", "scanned", f"{'f/unkn./d':>11}"] + [f"{name:>{w}}" for _, name, w, _ in MORE_SHARES]
    return " ".join(names + [f"{'valid':>6}", f"{'cpu s':>6}"])


def spread(rows):
    """How much the models of one building differ over its poses: over all pairs of poses that gave a model, the shares with as many rooms,
    as many openings, and volumes within 0.3 %; `volume`: the largest relative difference."""
    pairs = []
    for kind in dict.fromkeys(row["kind"] for row in rows):
        models = [row["model"] for row in rows if row["kind"] == kind and "model" in row]
        pairs += itertools.combinations(models, 2)
    if not pairs:
        return None
    differences_m3 = [abs(a["volume_m3"] - b["volume_m3"]) / max(a["volume_m3"], b["volume_m3"]) for a, b in pairs]
    same = {f"{key}_same": sum(a[key] == b[key] for a, b in pairs) / len(pairs) for key in ("rooms", "openings")}
    return {"pairs": len(pairs), **same, "volume_same": sum(d <= 0.003 for d in differences_m3) / len(pairs), "volume": max(differences_m3)}


def spread_lines(rows):
    """Per building that was moved, what each pose made of it."""
    moved = [row for row in rows if row["group"] == "moved"]
    lines = []
    for kind in dict.fromkeys(row["kind"] for row in moved):
        members = [row for row in moved if row["kind"] == kind]
        values = spread(members)
        if values:
            models = [row["model"] for row in members if "model" in row]
            lines.append(f"{kind}: rooms {tally(models, 'rooms')}, the same in {100 * values['rooms_same']:.1f} % of {values['pairs']} pairs; openings "
                         f"{tally(models, 'openings')}, {100 * values['openings_same']:.1f} %; volume within 0.3 % in {100 * values['volume_same']:.1f} %, "
                         f"differs by up to {100 * values['volume']:.2f} %")
    return ["", "spread over poses"] + lines if lines else []


def tally(models, key):
    counts = collections.Counter(model[key] for model in models)
    return " ".join(f"{value} ({count})" for value, count in sorted(counts.items()))


def warning_lines(rows):
    """What the stages said of each case: a fault that is named is half a fault."""
    lines = [f"{row['name']}: {text}" for row in rows if row["group"] == "cases" for text in row.get("warnings", [])]
    return ["", "warnings of the cases"] + lines if lines else []


def shown(row):
    """Of the many random buildings only those that fail have a row."""
    return not row["group"].startswith("random") or not row.get("valid")


def table(rows, groups):
    width = max(len(row["name"]) for row in rows + groups)
    rule = "-" * len(head(width))
    lines = [head(width), rule] + [line(row, width) for row in rows if shown(row)] + [rule, "means (rooms: sums)"]
    lines += [line(group, width) for group in groups]
    causes = [group for group in groups if group["lost"]]
    if causes:
        names = list(causes[0]["lost"])
        lines += ["", "wrong because of (lost + extra, % of the truth's volume)",
                  " ".join([" " * width] + [f"{name:>16}" for name in names])]
        lines += [" ".join([f"{group['name']:<{width}}"] + [cause_cell(group, name) for name in names]) for group in causes]
    return "\n".join(lines + element_lines(rows, groups) + spread_lines(rows) + warning_lines(rows))


def cause_cell(group, name):
    return f"{100 * group['lost'][name]:>7.3f} +{100 * group['extra'][name]:>7.3f}"


def beside(rows, default_rows, name):
    """The means of a preset beside those of the defaults, over the scenes that both have."""
    common = {row["name"] for row in rows} & {row["name"] for row in default_rows}
    ours, theirs = ({group["name"]: group for group in group_rows([row for row in some if row["name"] in common])}
                    for some in (default_rows, rows))
    width = max([len("beside the defaults"), *map(len, ours)])
    lines = ["", f"{'beside the defaults':<{width}} scenes  IoU default {name:>14}   missed default {name:>14}   merged default {name:>14}"]
    for group, own in ours.items():
        other = theirs[group]
        lines.append(f"{group:<{width}} {own['scenes']:>6} {own['iou']:>12.4f} {other['iou']:>14.4f} "
                     f"{own['missed']:>16} {other['missed']:>14} {own['merged']:>16} {other['merged']:>14}")
    return "\n".join(lines)


def changes(rows, groups, base):
    """Lines that name what differs from an earlier result, for groups over the scenes that both have, and for each scene."""
    before = {row["name"]: row for row in base["scenes"]}
    common = {row["name"] for row in rows} & set(before)
    lines = [f"against the base: {len(common)} scenes in common"]
    old_groups = {group["name"]: group for group in group_rows([before[name] for name in before if name in common])}
    new_groups = group_rows([row for row in rows if row["name"] in common])
    lines += [f"  mean {text}" for group in new_groups for text in differences(old_groups[group["name"]], group)]
    lines += [f"  {text}" for row in rows if row["name"] in common for text in differences(before[row["name"]], row)]
    return "\n".join(lines if len(lines) > 1 else lines + ["  nothing differs"])


def differences(old, new):
    if "error" in new or "error" in old:
        return [] if old.get("error") == new.get("error") else [f"{new['name']}: {old.get('error', 'a model')} -> {new.get('error', 'a model')}"]
    parts = []
    for key, _, _, decimals in SHARES + MORE_SHARES:
        a, b = old.get(key), new.get(key)
        if a is None or b is None or round(a, decimals) == round(b, decimals):
            continue
        parts.append(f"{key} {a:.{decimals}f} -> {b:.{decimals}f} ({b - a:+.{decimals}f})")
    parts += [f"{key} {old[key]} -> {new[key]}" for key in (*COUNTS, "valid") if key in old and old[key] != new.get(key)]
    return [f"{new['name']}: " + ", ".join(parts)] if parts else []
