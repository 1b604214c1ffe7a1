// SPDX-License-Identifier: GPL-3.0-or-later
// Colours that colour-blind readers can tell apart. Those that the stages' pictures have too come with the page's data
// (common/picture/colour_map.h).

export const kKind = ["#decba4", "#b0c4de", "#cdd6da", "#bbbbbb"]; // floor, ceiling, wall, other
export const kKindName = ["floor", "ceiling", "wall", "other"];
export const kUnknown = "#999999";

/** What the block `run` says of colours: {categorical: [[name, "#rrggbb"] …], sequential: [[r, g, b] …], diverging: [[r, g, b] …]}. */
let maps = { categorical: [], sequential: [[0, 0, 0], [255, 255, 255]], diverging: [[0, 0, 0], [255, 255, 255]] };
export function useColours(colours) {
  maps = colours ?? maps;
}

/** "#rrggbb": one of a row of colours that can be told apart; the row begins again after its last. */
export const categorical = (index) => maps.categorical[index % maps.categorical.length]?.[1] ?? kUnknown;
/** The one of them that has this name: blue, orange, green, vermilion … */
export const named = (name) => maps.categorical.find(([own]) => own === name)?.[1] ?? kUnknown;

function scale(stops, t) {
  const at = Math.min(1, Math.max(0, t)) * (stops.length - 1);
  const below = Math.min(Math.floor(at), stops.length - 2);
  return stops[below].map((value, i) => Math.round(value + (stops[below + 1][i] - value) * (at - below)));
}

/** Dark violet to yellow for t from 0 to 1: [r, g, b], 0 … 255. */
export const sequential = (t) => scale(maps.sequential, t);
/** Blue over white to orange for t from -1 to 1. */
export const diverging = (t) => scale(maps.diverging, 0.5 + 0.5 * t);
export const css = ([r, g, b]) => `rgb(${r},${g},${b})`;

export function rgbOf(hex) {
  const value = Number.parseInt(hex.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}
