# SPDX-License-Identifier: GPL-3.0-or-later
"""What `make accuracy-weights` shows and writes of the weights that were learned.

`found`: {name: {"weights": {feature: weight}, "lessons": [{"scene", "building", "final", "iou", "bound", "loss"}]}} of "shipped", "prior", "all" and, for each
building that was left out, "without BUILDING". Scores are those of the final passes.
"""
KINDS = ("shipped", "prior", "all")
TO_PRIOR = 0.25
WITHOUT = "without "


def mean(values):
    return sum(values) / len(values)


def of_building(result, building, figure):
    return mean([lesson[figure] for lesson in result["lessons"] if lesson["final"] and lesson["building"] == building])


def rows_of(found, made_up):
    """A row per building or family: bound, IoU and loss, means over its scans. `made_up`: {building: whether it is synthetic}."""
    rows = []
    for building in made_up:
        results = {**{kind: found[kind] for kind in KINDS}, "without": found.get(WITHOUT + building)}
        iou, loss = ({kind: result and of_building(result, building, figure) for kind, result in results.items()} for figure in ("iou", "loss"))
        scans = sum(lesson["final"] and lesson["building"] == building for lesson in found["shipped"]["lessons"])
        rows.append({"name": building, "made_up": made_up[building], "scenes": scans,
                     "bound": of_building(found["shipped"], building, "bound"), "iou": iou, "loss": loss})
    return rows


def mean_row(name, rows):
    return {"name": name, "scenes": sum(row["scenes"] for row in rows), "bound": mean([row["bound"] for row in rows]),
            **{figure: {kind: mean([row[figure][kind] for row in rows]) for kind in rows[0]["iou"] if all(row[figure][kind] is not None for row in rows)}
               for figure in ("iou", "loss")}}


def mean_rows(rows):
    """Of the real buildings, of the families, and of those that were left out; `without` only where all were."""
    kinds = {"real": [row for row in rows if not row["made_up"]], "made_up": [row for row in rows if row["made_up"]],
             "left_out": [row for row in rows if row["iou"]["without"] is not None]}
    return {kind: mean_row("mean, " + kind.replace("_", " "), of_kind) for kind, of_kind in kinds.items() if of_kind}


def scores(values):
    return " ".join(f"{'–' if values.get(kind) is None else format(values[kind], '.4f'):>10}" for kind in (*KINDS, "without"))


def score_table(rows):
    all_rows = rows + list(mean_rows(rows).values())
    width = max(len(row["name"]) for row in all_rows)
    lines = [f"{'':<{width}} {'':>6} {'IoU':>43} {'':>10} {'loss':>43}",
             f"{'':<{width}} {'scenes':>6} {'bound':>10} " + 2 * f"{'shipped':>10} {'prior':>10} {'with all':>10} {'without it':>10} "]
    lines += [f"{row['name']:<{width}} {row['scenes']:>6} {row['bound']:>10.4f} {scores(row['iou'])} {scores(row['loss'])}" for row in all_rows]
    return "\n".join(lines)


def weight_table(found):
    folds = [result["weights"] for name, result in found.items() if name.startswith(WITHOUT)]
    lines = [f"{'weight':<18} {'shipped':>8} {'prior':>8} {'with all':>9}" + (f" {'smallest':>9} {'largest':>9}  (over what was left out)" if folds else "")]
    for name in found["shipped"]["weights"]:
        values = [weights[name] for weights in folds]
        line = f"{name:<18} {found['shipped']['weights'][name]:>8.2f} {found['prior']['weights'][name]:>8.2f} {found['all']['weights'][name]:>9.2f}"
        lines.append(line + (f" {min(values):>9.2f} {max(values):>9.2f}" if folds else ""))
    return "\n".join(lines)


def as_json(found, rows, generations):
    weights = {kind: found[kind]["weights"] for kind in KINDS}
    weights["without"] = {name.removeprefix(WITHOUT): result["weights"] for name, result in found.items() if name.startswith(WITHOUT)}
    return {"artefact": "left_out", "schema_version": "2.0", "generations": generations, "weights": weights, "buildings": rows, "mean": mean_rows(rows)}


def robust_weights(found):
    """The mean of the weights learned with all and without each building, a quarter of the way to the prior. The optimum is flat: single
    weights differ twofold between trainings that are equally right, and what is chance in them goes out in the mean. The quarter is
    worth 0.001 of IoU on buildings left out (stages/raycast/EXPERIMENTS.md)."""
    learned = [result["weights"] for name, result in found.items() if name == "all" or name.startswith(WITHOUT)]
    prior = found["prior"]["weights"]
    return {name: (1 - TO_PRIOR) * mean([weights[name] for weights in learned]) + TO_PRIOR * prior[name] for name in prior}


def with_weights(table, weights):
    """The text of a weights.table with other weights."""
    lines = []
    for line in table.splitlines():
        name = line.split("|")[0].strip()
        if name in weights and not line.startswith("#"):
            column, _, meaning = line.split("|", 2)
            line = f"{column}| {weights[name]:5.2f} |{meaning}"
        lines.append(line + "\n")
    return "".join(lines)
