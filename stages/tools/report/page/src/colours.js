// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that colour-blind readers can tell apart: Okabe and Ito (2008), and a scale shaped like viridis.

export const kOkabeIto = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#5a5a5a"];
export const kKind = ["#decba4", "#b0c4de", "#cdd6da", "#bbbbbb"]; // floor, ceiling, wall, other
export const kKindName = ["floor", "ceiling", "wall", "other"];
export const kUnknown = "#999999";

const kSequential = [
  [68, 1, 84],
  [65, 68, 135],
  [42, 120, 142],
  [34, 168, 132],
  [122, 209, 81],
  [253, 231, 37],
];
const kDiverging = [
  [0, 114, 178],
  [247, 247, 247],
  [213, 94, 0],
];

function scale(stops, t) {
  const at = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const below = Math.min(Math.floor(at), stops.length - 2);
  return stops[below].map((value, i) => Math.round(value + (stops[below + 1][i] - value) * (at - below)));
}

/** Dark violet to yellow for t from 0 to 1: [r, g, b], 0 … 255. */
export const sequential = (t) => scale(kSequential, t);
/** Blue over white to orange for t from -1 to 1. */
export const diverging = (t) => scale(kDiverging, 0.5 + 0.5 * t);
export const css = ([r, g, b]) => `rgb(${r},${g},${b})`;

export function rgbOf(hex) {
  const value = Number.parseInt(hex.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}
