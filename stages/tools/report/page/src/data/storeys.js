// SPDX-License-Identifier: GPL-3.0-or-later
// Which storey and which room of summary.json a cell belongs to: the rule of stages/extract (its README, "Storeys"), from the
// storeys' floors. A run is a stack of empty cells without a gap; it belongs as a whole to one storey.

import { polygonCentre } from "./complex.js";

const kDefaultGap = 1.8; // [m], of extract.storey_gap_m, where the summary does not tell

/** The storey of each cell (-1: solid), from the floors of the summary (local heights, ascending). */
function storeyOfCells(complex, floors, gap) {
  const storey = new Int16Array(complex.cells).fill(-1);
  const slack = 1e-6;
  for (let f = 0; f < complex.faces; ++f) {
    for (let k = 0; k < complex.layers; ++k) {
      if (!complex.isEmpty(f, k)) {
        continue;
      }
      let top = k;
      while (complex.isEmpty(f, top + 1)) {
        ++top;
      }
      let found = 0;
      floors.forEach((z, s) => {
        if (z <= complex.levels[k] + 0.5 * gap + slack && z < complex.levels[top + 1] - slack) {
          found = s;
        }
      });
      for (; k <= top; ++k) {
        storey[complex.cell(f, k)] = found;
      }
    }
  }
  return storey;
}

/** Pieces of one storey that are connected through faces: {room: Int32Array per cell, rooms: [{storey, faces}]}. */
function roomsOf(complex, storey) {
  const room = new Int32Array(complex.cells).fill(-1);
  const rooms = [];
  for (let start = 0; start < complex.cells; ++start) {
    if (storey[start] < 0 || room[start] >= 0) {
      continue;
    }
    const cells = [start];
    room[start] = rooms.length;
    for (let i = 0; i < cells.length; ++i) {
      for (const next of neighbours(complex, cells[i])) {
        if (storey[next] === storey[start] && room[next] < 0) {
          room[next] = rooms.length;
          cells.push(next);
        }
      }
    }
    const plan = new Set(cells.map((c) => c % complex.faces));
    rooms.push({ storey: storey[start], cells, plan, ...placeOf(complex, plan) });
  }
  return { room, rooms };
}

/** Area and centre of a set of plan faces. */
function placeOf(complex, plan) {
  let area = 0;
  const centre = [0, 0];
  for (const f of plan) {
    const [x, y] = polygonCentre(complex.corners(f));
    area += complex.areas[f];
    centre[0] += complex.areas[f] * x;
    centre[1] += complex.areas[f] * y;
  }
  return { area, centre: centre.map((value) => value / area) };
}

/** The number of each room in the summary: the room of the same storey with the nearest centre; -1 for none. */
function numbersOf(rooms, summary, scan) {
  const left = new Map((summary?.rooms ?? []).map((entry, i) => [i, entry]));
  return rooms.map(({ storey, centre }) => {
    let best = -1;
    let least = Infinity;
    for (const [i, entry] of left) {
      const [x, y] = scan.toLocal([...entry.centre_m, entry.floor_z_m]);
      const distance = Math.hypot(x - centre[0], y - centre[1]);
      if (entry.storey === storey && distance < least) {
        [best, least] = [i, distance];
      }
    }
    left.delete(best);
    return best;
  });
}

function neighbours(complex, cell) {
  const face = cell % complex.faces;
  const layer = Math.floor(cell / complex.faces);
  const list = [];
  for (const e of complex.edgesOf(face)) {
    const { left, right } = complex.edge(e);
    const other = left === face ? right : left;
    if (other >= 0) {
      list.push(complex.cell(other, layer));
    }
  }
  if (layer > 0) {
    list.push(cell - complex.faces);
  }
  if (layer + 1 < complex.layers) {
    list.push(cell + complex.faces);
  }
  return list;
}

/**
 * Storeys and rooms of the cells, numbered as in summary.json; no rooms when the two do not agree.
 * @returns {{storey: Int16Array, room: Int32Array, rooms: object[]}}
 */
export function findStoreys(complex, summary, scan) {
  const floors = (summary?.storeys ?? []).map((s) => scan.toLocal([...s.centre_m, s.floor_z_m])[2]);
  let gap = kDefaultGap;
  try {
    gap = JSON.parse(summary.provenance.params_json).storey_gap_m ?? gap;
  } catch {
    // A summary of another writer: the default holds.
  }
  const storey = storeyOfCells(complex, floors, gap);
  const found = roomsOf(complex, storey);
  const numbers = numbersOf(found.rooms, summary, scan);
  if (numbers.includes(-1) || numbers.length !== summary?.rooms?.length) {
    return { storey, room: found.room.fill(-1), rooms: [] };
  }
  const rooms = [];
  numbers.forEach((number, i) => {
    rooms[number] = found.rooms[i];
  });
  return { storey, room: found.room.map((r) => (r < 0 ? -1 : numbers[r])), rooms };
}
