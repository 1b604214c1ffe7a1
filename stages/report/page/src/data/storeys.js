// SPDX-License-Identifier: GPL-3.0-or-later
// Which storey and which room of summary.json a cell belongs to: the rule of stages/extract (its README, "Storeys"), from the
// storeys' floors. A run is a stack of empty cells without a gap; it belongs as a whole to one storey.

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
    const area = [...plan].reduce((sum, f) => sum + complex.areas[f], 0);
    rooms.push({ storey: storey[start], cells, plan, area });
  }
  return { room, rooms };
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
 * Storeys and rooms of the cells, numbered as in summary.json (rooms by storey, largest first).
 * @returns {{storey: Int16Array, room: Int32Array, rooms: object[]}}
 */
export function findStoreys(complex, summary) {
  const origin = summary?.frame?.origin?.[2] ?? 0;
  const floors = (summary?.storeys ?? []).map((s) => s.floor_z_m - origin);
  let gap = kDefaultGap;
  try {
    gap = JSON.parse(summary.provenance.params_json).storey_gap_m ?? gap;
  } catch {
    // A summary of another writer: the default holds.
  }
  const storey = storeyOfCells(complex, floors, gap);
  const found = roomsOf(complex, storey);
  const order = found.rooms.map((_, i) => i);
  order.sort((a, b) => found.rooms[a].storey - found.rooms[b].storey || found.rooms[b].area - found.rooms[a].area);
  const rank = new Int32Array(order.length);
  order.forEach((old, i) => {
    rank[old] = i;
  });
  return { storey, room: found.room.map((r) => (r < 0 ? -1 : rank[r])), rooms: order.map((i) => found.rooms[i]) };
}
