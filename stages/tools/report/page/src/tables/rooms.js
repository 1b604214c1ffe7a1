// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys, rooms, totals and the checks of the mesh, from summary.json.

import { roomUncertainties } from "../data/uncertainty.js";
import { byId, make, number } from "../dom.js";

const kInterval = 1.96; // standard deviations of a 95 % interval

const kNames = {
  room: "Room",
  unknown_space: "Space",
  storey: "Storey",
  rooms: "Rooms",
  area_m2: "Area [m²]",
  perimeter_m: "Perimeter [m]",
  volume_m3: "Volume [m³]",
  height_m: "Height [m]",
  floor_z_m: "Floor [m]",
  ceiling_z_m: "Ceiling [m]",
  unobserved_m3: "Unobserved [m³]",
  opening_id: "Opening",
  width_m: "Width [m]",
  sill_z_m: "Sill [m]",
  thickness_m: "Thickness of the wall [m]",
  place_m: "Place [m]",
  beside: "Beside rooms",
  why: "Why",
  to_know: "To know",
};
const kSentences = new Set(["why", "to_know"]);
const kOrder = Object.keys(kNames);
const kUnits = [["_m2", " [m²]"], ["_m3", " [m³]"], ["_m", " [m]"]];

/** "wall_m2" as "wall [m²]". */
function nameOf(key) {
  const unit = kUnits.find(([ending]) => key.endsWith(ending));
  return kNames[key] ?? (unit ? key.slice(0, -unit[0].length) + unit[1] : key).replaceAll("_", " ");
}

/** A table of objects: a column for each number or text in them, in the order of kNames; `texts[key](i)` overrules a value. */
function listTable(list, texts = {}) {
  const keys = [...new Set([...list.flatMap((item) => Object.keys(item)), ...Object.keys(texts)])].filter((key) => texts[key] || typeof list[0][key] !== "object");
  const classOf = (key) => (kSentences.has(key) ? "sentence" : "number");
  const rank = (key) => (kOrder.includes(key) ? kOrder.indexOf(key) : kOrder.length);
  keys.sort((a, b) => rank(a) - rank(b));
  return make(
    "table",
    {},
    make("tr", {}, ...keys.map((key) => make("th", { class: classOf(key), text: nameOf(key) }))),
    ...list.map((item, i) => make("tr", {}, ...keys.map((key) => make("td", { class: classOf(key), text: texts[key]?.(i) ?? valueText(item[key]) })))),
  );
}

function valueText(value) {
  return typeof value !== "number" ? String(value ?? "–") : Number.isInteger(value) ? String(value) : number(value, 2);
}

function pairs(object) {
  return make(
    "table",
    {},
    ...Object.entries(object).map(([key, value]) => make("tr", {}, make("td", { text: nameOf(key) }), make("td", { class: "number", text: typeof value === "boolean" ? (value ? "yes" : "NO") : Number.isInteger(value) ? String(value) : number(value) }))),
  );
}

/** Area, perimeter and volume of each room with how well they are known. */
function uncertainTexts(rooms, known) {
  const interval = (sigma) => (sigma > 0 && sigma < 0.001 ? "0.001" : number(sigma, 3)); // rounded up: never better than it is
  const text = (value, sigma, { unknown }) => `${number(value, 3)} ± ${interval(kInterval * sigma)}${unknown ? " ?" : ""}`;
  return {
    area_m2: (i) => text(rooms[i].area_m2, known[i].area, known[i]),
    perimeter_m: (i) => text(known[i].perimeter, known[i].perimeterSigma, known[i]),
    volume_m3: (i) => text(rooms[i].volume_m3, known[i].volume, known[i]),
  };
}

/** Spaces that are neither rooms nor denied: where, how large, why, and what to scan to know. */
function unknownTable(spaces) {
  return listTable(
    spaces.map(({ unknown_space, storey, area_m2, volume_m3, height_m, place_m, beside, why, to_know }) => ({
      unknown_space,
      storey,
      area_m2,
      volume_m3,
      height_m,
      place_m: place_m.map((value) => number(value, 2)).join(", "),
      beside: beside.map(({ room }) => room).join(", ") || "–",
      why,
      to_know,
    })),
  );
}

/** Doors and passages between rooms. */
function openingTexts(openings) {
  return { rooms: (i) => openings[i].rooms.join(" – ") };
}

/** In which coordinates the figures of the summary and the files are. */
function frameText(frame) {
  const [x, y, z] = frame.origin;
  const level = Math.hypot(frame.level?.[0] ?? 0, frame.level?.[1] ?? 0);
  const parts = [`Heights, and the files of the work folder, are in the scan's own coordinates (metres${frame.unit === "m" ? "" : `; the scan is in ${frame.unit}`}).`];
  parts.push(`The plans and the model on this page have their origin at ${x}, ${y}, ${z}.`);
  if (level > 0) {
    parts.push(`The scan leans by ${number((Math.asin(level) * 180) / Math.PI, 2)}° and was levelled; what is written is turned back, heights hold at the centre of each room.`);
  }
  parts.push(frame.crs ? `Coordinate system of the scan: ${frame.crs}` : "The scan names no coordinate system.");
  return parts.join(" ");
}

export function showRooms(run) {
  const host = byId("rooms");
  const { summary } = run.facts;
  if (!summary) {
    host.append(make("p", { class: "quiet", text: "There is no model yet: make run goes on." }));
    return;
  }
  const known = run.storeys?.rooms.length > 0 ? roomUncertainties(run.complex, run.storeys.rooms, run.lines.refined) : null;
  host.append(make("h3", { text: "Storeys" }), listTable(summary.storeys));
  host.append(make("h3", { text: "Rooms" }), listTable(summary.rooms, known ? uncertainTexts(summary.rooms, known) : {}));
  if (known) {
    host.append(
      make("p", {
        class: "quiet",
        text: "± is a 95 % interval from the standard deviations of the refined wall lines alone, taken as independent; heights of levels are taken as exact. “?”: a side of the room lies on a line whose deviation is not known (locked, drawn by hand, or the edge of the building).",
      }),
    );
  }
  if (summary.unknown_spaces?.length > 0) {
    host.append(
      make("h3", { text: "Unknown spaces" }),
      make("p", { class: "quiet", text: "Nobody saw enough of them to call them rooms or open air. They are no part of the model; graphcut.unknown: rooms makes rooms of them." }),
      unknownTable(summary.unknown_spaces),
    );
  }
  if (summary.openings?.length > 0) {
    host.append(make("h3", { text: "Openings" }), listTable(summary.openings, openingTexts(summary.openings)));
  }
  if (summary.frame) {
    host.append(make("p", { class: "quiet", id: "frame", text: frameText(summary.frame) }));
  }
  for (const [title, key] of [["Totals", "totals"], ["Checks of the mesh", "mesh"], ["Counts", "counts"], ["Energy of the labelling", "energy"]]) {
    if (summary[key]) {
      host.append(make("h3", { text: title }), pairs(summary[key]));
    }
  }
}
