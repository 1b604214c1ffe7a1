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

/** Number and area of each room, in the middle of its largest cell of this layer. */
export function paintRooms(context, view) {
  const { complex, storeys } = view.run;
  const { layer } = view.state.slice;
  const largest = new Map();
  for (let f = 0; layer >= 0 && f < complex.faces; ++f) {
    const room = storeys.room[complex.cell(f, layer)];
    if (room >= 0 && !(complex.areas[f] <= (largest.has(room) ? complex.areas[largest.get(room)] : 0))) {
      largest.set(room, f);
    }
  }
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const [room, face] of largest) {
    const corners = complex.corners(face);
    const middle = [0, 1].map((axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length);
    const [x, y] = view.viewport.toPixels(middle);
    const words = `room ${room}: ${storeys.rooms[room].area.toFixed(1)} m²`;
    context.fillStyle = "#ffffffc8";
    const width = context.measureText(words).width + 8;
    context.fillRect(x - width / 2, y - 10, width, 17);
    context.fillStyle = kWords;
    context.fillText(words, x, y + 3);
  }
  context.textAlign = "start";
}
