// SPDX-License-Identifier: GPL-3.0-or-later
// How well a room's area, perimeter and volume are known, by propagation of the refined lines' standard deviations (offset at the
// middle of the line, direction). Lines are taken as independent and levels as exact.

/** Standard deviations per line of the complex: {offset [m], angle [rad], middle [x, y], normal}; null where a line has none. */
function lineDeviations(complex, refined) {
  const byId = new Map((refined?.features ?? []).map((feature) => [feature.properties.wall_id, feature]));
  return complex.block.line_ids.map((id) => {
    const feature = byId.get(id);
    const offset = feature?.properties.sigma_offset_m ?? 0;
    if (!(offset > 0)) {
      return null;
    }
    const [[ax, ay], [bx, by]] = feature.geometry.coordinates;
    const length = Math.hypot(bx - ax, by - ay);
    return {
      offset,
      angle: ((feature.properties.sigma_angle_deg ?? 0) * Math.PI) / 180,
      middle: [(ax + bx) / 2, (ay + by) / 2],
      direction: [(bx - ax) / length, (by - ay) / length],
    };
  });
}

/** The border of a set of plan faces: {from, to, line} with the set on the left. */
export function borderOf(complex, faces) {
  const border = [];
  for (let e = 0; e < complex.edges; ++e) {
    const { v0, v1, left, right, line } = complex.edge(e);
    const [isLeft, isRight] = [faces.has(left), faces.has(right)];
    if (isLeft !== isRight) {
      border.push(isLeft ? { from: v0, to: v1, line } : { from: v1, to: v0, line });
    }
  }
  return border;
}

/** What each line does to area and perimeter when it moves by one metre to the left of its direction, or turns by one radian. */
function derivatives(complex, faces, deviations) {
  const border = borderOf(complex, faces);
  const next = new Map(border.map((side) => [side.from, side]));
  const before = new Map(border.map((side) => [side.to, side]));
  const effect = deviations.map(() => ({ area: 0, turn: 0, perimeter: 0 }));
  let perimeter = 0;
  let unknown = false;
  for (const side of border) {
    const [a, b] = [complex.vertex(side.from), complex.vertex(side.to)];
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    perimeter += length;
    const line = side.line < 0 ? null : deviations[side.line];
    if (!line) {
      unknown = true;
      continue;
    }
    const [ux, uy] = line.direction;
    // The outside lies to the right of the side: moving the line to its own left grows the set when the two run against each other.
    const outward = ux * (b[0] - a[0]) + uy * (b[1] - a[1]) > 0 ? -1 : 1;
    const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    const arm = ux * (middle[0] - line.middle[0]) + uy * (middle[1] - line.middle[1]);
    effect[side.line].area += outward * length;
    effect[side.line].turn += outward * length * arm;
    effect[side.line].perimeter += outward * (cornerGrowth(complex, before.get(side.from), side) + cornerGrowth(complex, side, next.get(side.to)));
  }
  return { effect, perimeter, unknown };
}

/** How much the border grows at a corner when one of its sides moves out by one metre: tan(turn / 2). */
function cornerGrowth(complex, first, second) {
  if (!first || !second || first.line === second.line) {
    return 0;
  }
  const [a, b, c] = [complex.vertex(first.from), complex.vertex(first.to), complex.vertex(second.to)];
  const [ux, uy, vx, vy] = [b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]];
  const turn = Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy);
  return Math.tan(Math.min(1.4, Math.max(-1.4, turn / 2))); // nearly turning back: no more than a sixfold growth
}

function rootSum(effect, deviations, valueOf) {
  return Math.sqrt(effect.reduce((sum, one, i) => (deviations[i] ? sum + valueOf(one, deviations[i]) ** 2 : sum), 0));
}

/**
 * Perimeter [m] of each room, and the standard deviations of area, perimeter and volume; `unknown` when a side of the room lies on a
 * line without standard deviation.
 * @param {{cells: number[], plan: Set<number>}[]} rooms of data/rooms.js
 */
export function roomUncertainties(complex, rooms, refined) {
  const deviations = lineDeviations(complex, refined);
  return rooms.map(({ cells, plan }) => {
    const { effect, perimeter, unknown } = derivatives(complex, plan, deviations);
    const layers = new Map();
    for (const cell of cells) {
      const layer = complex.layerOf(cell);
      layers.set(layer, (layers.get(layer) ?? new Set()).add(complex.faceOf(cell)));
    }
    const volume = deviations.map(() => ({ area: 0, turn: 0 }));
    for (const [layer, faces] of layers) {
      derivatives(complex, faces, deviations).effect.forEach(({ area, turn }, i) => {
        volume[i].area += complex.height(layer) * area;
        volume[i].turn += complex.height(layer) * turn;
      });
    }
    const together = (one, sigma) => Math.hypot(one.area * sigma.offset, one.turn * sigma.angle);
    return {
      perimeter,
      unknown,
      area: rootSum(effect, deviations, together),
      volume: rootSum(volume, deviations, together),
      perimeterSigma: rootSum(effect, deviations, (one, sigma) => one.perimeter * sigma.offset),
    };
  });
}
