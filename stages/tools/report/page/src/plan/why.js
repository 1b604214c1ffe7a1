// SPDX-License-Identifier: GPL-3.0-or-later
// Why a cell came out empty or solid, in words and numbers.

import { kUnknownLabel } from "../data/complex.js";
import { boundaryCost, facesOf, flipCost, priceOf } from "../data/energy.js";
import { make, number, short } from "../dom.js";

const kCosts = new Set(["beta", "d_empty", "d_solid"]);
const kPlace = { wall: "wall face", below: "face below", above: "face above" };

/** A table of rows; cells that are numbers stand to the right. */
function table(head, rows) {
  const cell = (tag) => (value) =>
    make(tag, typeof value === "number" || (typeof value === "string" && /^[-+–\d]/.test(value)) ? { class: "number" } : {}, String(value));
  return make("table", {}, make("tr", {}, ...head.map(cell("th"))), ...rows.map((row) => make("tr", {}, ...row.map(cell("td")))));
}

const labelName = (label) => (label === 1 ? "empty" : label === kUnknownLabel ? "unknown" : "solid");

/** @returns {Element[]} what is known of a cell; `room` and `unknownSpace` are its entries of the summary, or null */
export function whyCell(complex, cell, room, unknownSpace = null) {
  const { block } = complex;
  const layer = complex.layerOf(cell);
  const beta = block.evidence_beta?.[cell];
  const flip = flipCost(complex, cell);
  const parts = [
    make("h3", { text: `Cell ${cell}: ${labelName(block.label[cell])}` }),
    make("p", {
      class: "quiet",
      text: `${number(complex.areas[complex.faceOf(cell)])} m² of the plan, ${complex.heightsOf(layer)} m, ${number(complex.volume(cell))} m³, ${block.cell_points[cell]} points inside.`,
    }),
    make("p", {
      text: `The evidence gives ${number(100 * beta, 1)} % for empty. Flipping this cell alone would cost ${number(block.margin[cell], 3)} m³ of energy.`,
    }),
  ];
  if (block.label[cell] === kUnknownLabel) {
    parts.push(make("p", { class: "warn", text: "Unknown: nobody saw enough of it to call it a room or to deny it. It is no part of the model; graphcut.unknown: rooms makes it one." }));
  }
  if (unknownSpace) {
    parts.push(make("p", { text: `Part of unknown space ${unknownSpace.unknown_space} (${number(unknownSpace.area_m2)} m²): ${unknownSpace.why}. To know: ${unknownSpace.to_know}.` }));
  }
  if (block.unobserved[cell] === 1) {
    parts.push(make("p", { class: "warn", text: "Unobserved: too little evidence. It has a label, but the label is not to be trusted." }));
  }
  if (block.margin[cell] < 0 && block.label[cell] !== kUnknownLabel) {
    parts.push(make("p", { class: "warn", text: "The margin is negative: the repair to a closed surface overruled the cut here." }));
  }
  if (room) {
    parts.push(make("p", { text: `Part of room ${room.room} on storey ${room.storey} (${number(room.area_m2)} m²).` }));
  }
  return [...parts, ...evidenceOf(block, cell), ...energyOf(complex, cell, flip), ...beyondOf(complex, cell)];
}

function evidenceOf(block, cell) {
  const rows = block.evidence
    .filter(({ name }) => !kCosts.has(name))
    .map(({ name, unit, description, weight }) =>
      make(
        "tr",
        {},
        make("td", {}, name, make("small", { text: description })),
        make("td", { class: "number", text: short(block[`evidence_${name}`][cell]) + (unit === "1" ? "" : ` ${unit.replace("^2", "²").replace("^3", "³")}`) }),
        weight === undefined ? null : make("td", { class: "number", text: `× ${short(weight)}` }),
      ),
    );
  return [make("h3", { text: "Evidence" }), make("table", { class: "evidence" }, ...rows)];
}

function energyOf(complex, cell, flip) {
  const { block } = complex;
  const rows = [
    ["as empty", number(block.evidence_d_empty[cell], 3)],
    ["as solid", number(block.evidence_d_solid[cell], 3)],
    ["flip: data term", signed(flip.data)],
    ["flip: surface term", signed(flip.boundary)],
    ["flip: together", signed(flip.total)],
  ];
  return [make("h3", { text: "Energy [m³]" }), table(["", "m³"], rows)];
}

function beyondOf(complex, cell) {
  const { block } = complex;
  const price = priceOf(block);
  const rows = facesOf(complex, cell).map((face) => [
    face.wall ?? kPlace[face.kind],
    number(face.area),
    number(face.omega),
    number(face.implied),
    face.points,
    face.beyond < 0 ? "outside" : labelName(block.label[face.beyond]),
    number(boundaryCost(face, price), 3),
  ]);
  return [
    make("h3", { text: "Its faces" }),
    table(["", "m²", "ω", "implied", "points", "beyond", "m³"], rows),
    make("p", { class: "quiet", text: `ω is the share of a face that points cover. Implied: the unseen other side of a wall or slab that was seen. A face costs μ (1 − ω / ${short(price.freeFrom)}) (1 − implied) area, nothing when ω is larger, μ = ${short(price.mu)} m, when its two sides have different labels.` }),
  ];
}

const signed = (value) => (value >= 0 ? "+" : "−") + number(Math.abs(value), 3);

/** @returns {Element[]} what is known of a wall face of the plan */
export function whyWallFace(complex, edge, layer) {
  const { block } = complex;
  const { a, b, left, right } = complex.edge(edge);
  const index = complex.wallFace(edge, layer);
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const omega = block.wall_omega[index];
  const implied = block.wall_implied[index];
  const [isLeft, isRight] = [complex.isEmpty(left, layer), complex.isEmpty(right, layer)];
  const wall = complex.wallId(edge);
  return [
    make("h3", { text: `Wall face${wall ? ` on ${wall}` : ""}` }),
    make("p", {
      text: `${number(length)} m long, ${number(length * complex.height(layer))} m². ${isLeft === isRight ? (isLeft ? "Open: both sides are empty." : "Inside: neither side is empty.") : "A wall of the model."}`,
    }),
    table(["", "value"], [
      ["ω, share covered by points", number(omega, 3)],
      ["implied by a wall seen from its other side", number(implied, 3)],
      ["points", block.wall_points[index]],
      ["speaks for empty on the left", number(block.wall_left[index], 3)],
      ["speaks for empty on the right", number(block.wall_right[index], 3)],
      ["cost of a wall here", `${number(boundaryCost({ omega, implied, area: length * complex.height(layer) }, priceOf(block)), 3)} m³`],
    ]),
  ];
}

/** @returns {Element[]} what is known of a wall line */
export function whyLine(line, refined) {
  const { properties: p } = line;
  const length = Math.hypot(line.b[0] - line.a[0], line.b[1] - line.a[1]);
  const rows = [
    ["length", `${number(length, 3)} m`],
    ["covered by points", `${number(p.support_m, 2)} m`],
    ["rms of the points", p.rms_m ? `${number(1e3 * p.rms_m, 1)} mm` : "–"],
    ["offset known to", p.sigma_offset_m ? `± ${number(1e3 * p.sigma_offset_m, 2)} mm` : "–"],
    ["angle known to", p.sigma_angle_deg ? `± ${number(p.sigma_angle_deg, 4)}°` : "–"],
    ["source", p.source],
    ["wall slices", p.levels ? p.levels.join(", ") : "all"],
    ["locked", p.locked ? "yes" : "no"],
  ];
  const parts = [make("h3", { text: `Wall line ${line.id}` }), table(["", ""], rows)];
  if (p.note) {
    parts.push(make("p", { text: p.note }));
  }
  if (refined?.properties.locked) {
    parts.push(make("p", { class: "quiet", text: "Locked: refinement left it where it is." }));
  } else if (refined) {
    parts.push(make("p", { class: "quiet", text: `After refinement: offset ± ${number(1e3 * refined.properties.sigma_offset_m, 2)} mm, rms ${number(1e3 * refined.properties.rms_m, 1)} mm.` }));
  } else if (refined === null) {
    parts.push(make("p", { class: "quiet", text: "It carries no wall of the first cut, so refinement dropped it." }));
  }
  return parts;
}

/** @returns {Element[]} what is known of an opening; `joined` is its entry of the summary, or undefined */
export function whyOpening({ id, a, b, thickness, sill, head, properties }, joined) {
  const width = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const proof = (name, key) => [name, properties[key].points, `${number(100 * properties[key].spread, 0)} %`, `± ${number(1e3 * properties[key].sigma_m, 1)} mm`];
  return [
    make("h3", { text: `Opening ${id}` }),
    make("p", { text: `${number(width)} m wide, ${number(head - sill)} m high, through ${number(thickness, 3)} m of wall between ${properties.walls.join(" and ")}.` }),
    joined ? make("p", { text: `It joins room ${joined.rooms[0]} and room ${joined.rooms[1]}.` }) : null,
    table(["proven by", "points", "spread", "place"], [proof("one jamb", "jamb_a"), proof("other jamb", "jamb_b"), proof("head", "head")]),
    make("p", { class: "quiet", text: "Spread: the share of the jamb's height, or the head's width, that has points on it." }),
  ].filter((part) => part !== null);
}
