// SPDX-License-Identifier: GPL-3.0-or-later
// What is written over the plan of a slice: openings, and the number and area of each room.

import { named } from "../colours.js";

const kWords = "#3a444b";

/** Openings that reach into the slice: the wall is open between the two jambs. */
export function paintOpenings(context, view) {
  const { slice, selected } = view.state;
  for (const { id, a, b, thickness, sill, head } of view.state.openings) {
    if (sill < slice.high && head > slice.low) {
      const colour = named(selected?.opening === id ? "vermilion" : "green");
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const across = [(-(b[1] - a[1]) / length) * (thickness / 2), ((b[0] - a[0]) / length) * (thickness / 2)];
      const shifted = ([x, y], side) => [x + side * across[0], y + side * across[1]];
      view.tracePolygon(context, [shifted(a, 1), shifted(b, 1), shifted(b, -1), shifted(a, -1)]);
      context.fillStyle = "#ffffff";
      context.fill();
      context.strokeStyle = colour;
      context.lineWidth = selected?.opening === id ? 3 : 2;
      context.stroke();
    }
  }
}

/** The largest face in this layer of each of the spaces that `ofCell` numbers. */
function largestFaces(complex, layer, ofCell) {
  const largest = new Map();
  for (let f = 0; layer >= 0 && f < complex.faces; ++f) {
    const space = ofCell[complex.cell(f, layer)];
    if (space >= 0 && !(complex.areas[f] <= (largest.has(space) ? complex.areas[largest.get(space)] : 0))) {
      largest.set(space, f);
    }
  }
  return largest;
}

/** Number and area of each room and each unknown space, in the middle of its largest cell of this layer. */
export function paintRooms(context, view) {
  const { complex, storeys } = view.run;
  const { layer } = view.state.slice;
  const unknown = view.run.facts.summary?.unknown_spaces ?? [];
  const places = [
    ...[...largestFaces(complex, layer, storeys.room)].map(([room, face]) => [`room ${room}: ${storeys.rooms[room].area.toFixed(1)} m²`, face]),
    ...[...largestFaces(complex, layer, complex.block.unknown_space ?? [])].map(([space, face]) => [`unknown ${space}: ${(unknown[space]?.area_m2 ?? 0).toFixed(1)} m²`, face]),
  ];
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const [words, face] of places) {
    const corners = complex.corners(face);
    const middle = [0, 1].map((axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length);
    const [x, y] = view.viewport.toPixels(middle);
    context.fillStyle = "#ffffffc8";
    const width = context.measureText(words).width + 8;
    context.fillRect(x - width / 2, y - 10, width, 17);
    context.fillStyle = kWords;
    context.fillText(words, x, y + 3);
  }
  context.textAlign = "start";
}
