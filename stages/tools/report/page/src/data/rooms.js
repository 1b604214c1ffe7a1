// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys and rooms of the cells, as extract wrote them (schemas/rooms.md), with their entries of summary.json.

/**
 * @returns {{storey: Int16Array, room: Int32Array, rooms: {storey: number, area: number, cells: number[], plan: Set<number>}[]}}
 *   storey and room per cell (-1: none); of each room its cells, and their faces in the plan
 */
export function roomsOfCells(complex, summary) {
  const { storey } = complex.block;
  const rooms = (summary?.rooms ?? []).map((entry) => ({ storey: entry.storey, area: entry.area_m2, cells: [], plan: new Set() }));
  const room = complex.block.room.map((number) => (number < rooms.length ? number : -1));
  room.forEach((number, cell) => {
    if (number >= 0) {
      rooms[number].cells.push(cell);
      rooms[number].plan.add(complex.faceOf(cell));
    }
  });
  return { storey, room, rooms };
}
