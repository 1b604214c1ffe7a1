// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of the run: times, parameters with where each value came from, figures, warnings.

import { byId, make, number, short } from "../dom.js";

/* global PARAMETER_DEFAULTS: put in by bundle.js, {stage: {parameter: {value, about}}} */
const kDefaults = PARAMETER_DEFAULTS;

export function showStages(run) {
  const host = byId("stages");
  if (run.stages.length === 0) {
    host.append(make("p", { class: "quiet", text: "There are no logs in the work folder." }));
    return;
  }
  const warnings = run.stages.flatMap((stage) => (stage.warnings ?? []).map((text) => ({ stage: stage.run, text })));
  host.append(
    make("h3", { text: "Warnings" }),
    warnings.length === 0
      ? make("p", { text: "None." })
      : make("ul", {}, ...warnings.map(({ stage, text }) => make("li", { class: "warn", text: `${stage}: ${text}` }))),
    make("h3", { text: "Times" }),
    timeTable(run.stages),
    make("h3", { text: "Parameters" }),
    make("p", { class: "quiet", text: "“auto” was derived from the scan; what it came to, and why, stands beside it." }),
    parameterTable(run.stages),
    make("h3", { text: "Figures" }),
    ...run.stages.map(figures),
  );
}

function row(tag, values) {
  return make("tr", {}, ...values.map(([text, isNumber]) => make(tag, isNumber ? { class: "number", text } : { text })));
}

function timeTable(stages) {
  const total = stages.reduce((sum, stage) => sum + stage.wall_s, 0);
  return make(
    "table",
    { id: "times" },
    row("th", [["Stage"], ["Time [s]", true], ["Processor [s]", true], ["Memory [MB]", true], ["Threads", true], ["Revision", true]]),
    ...stages.map((stage) =>
      row("td", [[stage.run], [number(stage.wall_s), true], [number(stage.cpu_s), true], [number(stage.peak_memory_mb, 0), true], [short(stage.threads), true], [short(stage.revision), true]]),
    ),
    row("td", [["together"], [number(total), true], [number(stages.reduce((sum, stage) => sum + stage.cpu_s, 0)), true], [""], [""], [""]]),
  );
}

/** Where a parameter's value came from, in words. */
export function originOf(stage, name, value, chosen) {
  const choice = (chosen ?? []).find(({ parameter }) => parameter === name);
  if (choice) {
    return `${short(choice.value)}: ${choice.why}`;
  }
  const known = kDefaults[stage]?.[name];
  if (!known) {
    return "";
  }
  const same = known.value === String(value) || Number(known.value) === value;
  return same ? "default" : `set by you (default ${known.value})`;
}

function parameterTable(stages) {
  const rows = stages.filter((stage) => !stage.run.startsWith("final_")).flatMap((stage) =>
    Object.entries(stage.params ?? {}).map(([name, value]) =>
      row("td", [[`${stage.stage}.${name}`], [String(value), true], [originOf(stage.stage, name, value, stage.chosen)], [kDefaults[stage.stage]?.[name]?.about ?? ""]]),
    ),
  );
  return make("table", { id: "parameters" }, row("th", [["Parameter"], ["Value", true], ["Where it comes from"], ["What it is"]]), ...rows);
}

function figures(stage) {
  const text = (stage.counts ?? []).map(({ what, value, unit }) => `${what} ${short(value)}${unit ? ` ${unit.replace("^2", "²").replace("^3", "³")}` : ""}`).join(", ");
  return make("p", {}, make("b", { text: stage.run }), ` ${text}`);
}
