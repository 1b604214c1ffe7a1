// SPDX-License-Identifier: GPL-3.0-or-later
// What lies under the pointer in the plan: a wall line, a wall face, or a cell.

export function distanceToSegment([px, py], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const length2 = dx * dx + dy * dy;
  const t = length2 > 0 ? Math.min(1, Math.max(0, ((px - ax) * dx + (py - ay) * dy) / length2)) : 0;
  return Math.hypot(px - ax - t * dx, py - ay - t * dy);
}

/** The line nearest to a point within `limit` metres, or null. */
export function nearestLine(lines, point, limit) {
  let best = null;
  let least = limit;
  for (const line of lines) {
    const distance = distanceToSegment(point, line.a, line.b);
    if (distance <= least) {
      best = line;
      least = distance;
    }
  }
  return best;
}

/** The edge of the complex that carries a wall of the model nearest to a point within `limit` metres, or -1. */
export function nearestWallFace(complex, layer, point, limit) {
  let best = -1;
  let least = limit;
  for (let e = 0; e < complex.edges; ++e) {
    const { a, b, left, right } = complex.edge(e);
    if (complex.isEmpty(left, layer) === complex.isEmpty(right, layer)) {
      continue;
    }
    const distance = distanceToSegment(point, a, b);
    if (distance <= least) {
      best = e;
      least = distance;
    }
  }
  return best;
}
