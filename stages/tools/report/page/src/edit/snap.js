// SPDX-License-Identifier: GPL-3.0-or-later
// Snapping: directions to those of other lines and across them, offsets to lines that lie in one row, ends to lines they meet.

import { angleOf, lengthOf, offsetBetween } from "./document.js";

const kTurn = (2 * Math.PI) / 180; // how far a direction is pulled
const kParallel = (0.5 * Math.PI) / 180;
const kShortest = 0.3; // [m] a line this short has no say

/** angle - other, brought to (-pi/2, pi/2]: lines have no ends. */
function turnBetween(angle, other) {
  const turn = (angle - other) % Math.PI;
  return turn > Math.PI / 2 ? turn - Math.PI : turn <= -Math.PI / 2 ? turn + Math.PI : turn;
}

/**
 * The direction nearest to `angle` that is parallel or perpendicular to one of `others`; the longer a line and the less
 * the turn, the more it pulls.
 * @returns {?{angle: number, to: string, how: "parallel"|"perpendicular"}}
 */
export function snapDirection(angle, others) {
  let best = null;
  let most = 0;
  for (const line of others) {
    const length = lengthOf(line);
    if (length < kShortest) {
      continue;
    }
    for (const [how, quarter] of [["parallel", 0], ["perpendicular", Math.PI / 2]]) {
      const turn = turnBetween(angle, angleOf(line) + quarter);
      const pull = length * (1 - Math.abs(turn) / kTurn);
      if (pull > most) {
        most = pull;
        best = { angle: angle - turn, to: line.key, how };
      }
    }
  }
  return best;
}

/**
 * The offset near `offset` at which `line` lies in one row with another one, within `limit` metres.
 * @returns {?{offset: number, to: string}}
 */
export function snapOffset(line, offset, others, limit) {
  let best = null;
  let least = limit;
  for (const other of others) {
    if (Math.abs(turnBetween(angleOf(line), angleOf(other))) > kParallel) {
      continue;
    }
    const distance = offsetBetween(line, other) - offset;
    if (Math.abs(distance) < least) {
      least = Math.abs(distance);
      best = { offset: offset + distance, to: other.key };
    }
  }
  return best;
}

/**
 * The length at which a ray from `from` in direction `angle` meets another line (or its continuation by `limit`), within
 * `limit` metres of `length`.
 * @returns {?{length: number, to: string}}
 */
export function snapLength(from, angle, length, others, limit) {
  const [ux, uy] = [Math.cos(angle), Math.sin(angle)];
  let best = null;
  let least = limit;
  for (const { key, a, b } of others) {
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const cross = ux * dy - uy * dx;
    const size = Math.hypot(dx, dy);
    if (Math.abs(cross) < 0.1 * size) {
      continue;
    }
    const [wx, wy] = [a[0] - from[0], a[1] - from[1]];
    const t = (wx * dy - wy * dx) / cross;
    const along = (wx * uy - wy * ux) / cross;
    const beyond = Math.max(-along, along - 1, 0) * size;
    if (beyond <= limit && Math.abs(t - length) < least) {
      least = Math.abs(t - length);
      best = { length: t, to: key };
    }
  }
  return best;
}

/** How a line fits the points near it: of those within `band` metres the number and the mean offset [m]. */
export function fitOf(line, block, band) {
  const length = lengthOf(line);
  const [ux, uy] = [(line.b[0] - line.a[0]) / length, (line.b[1] - line.a[1]) / length];
  let count = 0;
  let sum = 0;
  const shown = [];
  for (let i = 0; i < block.x.length; ++i) {
    const [x, y] = [block.x[i] - line.a[0], block.y[i] - line.a[1]];
    const along = ux * x + uy * y;
    const across = ux * y - uy * x;
    if (along < -0.2 || along > length + 0.2 || Math.abs(across) > 0.6) {
      continue;
    }
    shown.push(i);
    if (along >= 0 && along <= length && Math.abs(across) < band) {
      ++count;
      sum += across;
    }
  }
  return { count, mean: count > 0 ? sum / count : Number.NaN, shown };
}

