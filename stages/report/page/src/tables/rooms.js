// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys, rooms, totals and the checks of the mesh, from summary.json.

import { roomUncertainties } from "../data/uncertainty.js";
import { byId, make, number, short } from "../dom.js";

const kInterval = 1.96; // standard deviations of a 95 % interval

const kNames = {
  room: "Room",
  storey: "Storey",
  rooms: "Rooms",
  area_m2: "Area [m²]",
  perimeter_m: "Perimeter [m]",
  volume_m3: "Volume [m³]",
  height_m: "Height [m]",
  floor_z_m: "Floor [m]",
  ceiling_z_m: "Ceiling [m]",
  unobserved_m3: "Unobserved [m³]",
};
const kOrder = Object.keys(kNames);

/** Columns of a list of objects: the known ones first, in their order, then whatever else is a number or text. */
function columnsOf(list) {
  const keys = [...new Set(list.flatMap((item) => Object.keys(item)))].filter((key) => typeof list[0][key] !== "object");
  const rank = (key) => (kOrder.includes(key) ? kOrder.indexOf(key) : kOrder.length);
  return keys.filter((key) => !sigmaOf(key, keys)).sort((a, b) => rank(a) - rank(b));
}

/** The column that a column of standard deviations belongs to: "sigma_area_m2" and "area_sigma_m2" to "area_m2". */
function sigmaOf(key, keys) {
  return key.includes("sigma") ? keys.find((other) => !other.includes("sigma") && key.replace(/_?sigma_?/, "_").replace(/^_/, "") === other) : undefined;
}

function valueText(item, key, keys) {
  const value = item[key];
  if (typeof value !== "number") {
    return String(value ?? "–");
  }
  const text = Number.isInteger(value) ? String(value) : number(value, 2);
  const sigma = keys.find((other) => sigmaOf(other, keys) === key);
  return sigma !== undefined && Number.isFinite(item[sigma]) ? `${number(value, 3)} ± ${number(item[sigma], 3)}` : text;
}

function listTable(list, extra = []) {
  const all = [...new Set(list.flatMap((item) => Object.keys(item)))];
  const columns = columnsOf(list);
  return make(
    "table",
    {},
    make(
      "tr",
      {},
      ...columns.map((key) => make("th", { class: "number", text: kNames[key] ?? key.replaceAll("_", " ") })),
      ...extra.map(({ name }) => make("th", { class: "number", text: name })),
    ),
    ...list.map((item, i) =>
      make(
        "tr",
        {},
        ...columns.map((key) => make("td", { class: "number", text: valueText(item, key, all) })),
        ...extra.map(({ text }) => make("td", { class: "number", text: text(i) })),
      ),
    ),
  );
}

function pairs(object) {
  return make(
    "table",
    {},
    ...Object.entries(object).map(([key, value]) => make("tr", {}, make("td", { text: key.replaceAll("_", " ") }), make("td", { class: "number", text: typeof value === "boolean" ? (value ? "yes" : "NO") : short(value) }))),
  );
}

/** Columns that summary.json does not hold: the perimeter, and how well area, perimeter and volume are known. */
function uncertaintyColumns(known) {
  const interval = (sigma, { unknown }, digits) => `± ${number(kInterval * sigma, digits)}${unknown ? " ?" : ""}`;
  return [
    { name: "± area [m²]", text: (i) => interval(known[i].area, known[i], 3) },
    { name: "Perimeter [m]", text: (i) => number(known[i].perimeter, 2) },
    { name: "± perimeter [m]", text: (i) => interval(known[i].perimeterSigma, known[i], 3) },
    { name: "± volume [m³]", text: (i) => interval(known[i].volume, known[i], 3) },
  ];
}

export function showRooms(run) {
  const host = byId("rooms");
  const { summary } = run.facts;
  if (!summary) {
    host.append(make("p", { class: "quiet", text: "There is no model yet: make run goes on." }));
    return;
  }
  const known = run.complex && run.storeys.rooms.length === summary.rooms.length ? roomUncertainties(run.complex, run.storeys.rooms, run.lines.refined) : null;
  host.append(make("h3", { text: "Storeys" }), listTable(summary.storeys), make("h3", { text: "Rooms" }), listTable(summary.rooms, known ? uncertaintyColumns(known) : []));
  if (known) {
    host.append(
      make("p", {
        class: "quiet",
        text: "± is a 95 % interval from the standard deviations of the refined wall lines alone, taken as independent; heights of levels are taken as exact. “?”: a side of the room lies on a line whose deviation is not known (locked, drawn by hand, or the edge of the building).",
      }),
    );
  }
  for (const [title, key] of [["Totals", "totals"], ["Checks of the mesh", "mesh"], ["Counts", "counts"], ["Energy of the labelling", "energy"]]) {
    if (summary[key]) {
      host.append(make("h3", { text: title }), pairs(summary[key]));
    }
  }
}
