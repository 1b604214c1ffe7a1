// SPDX-License-Identifier: GPL-3.0-or-later
// A slice's occupancy grid as pictures, one pixel a cell.

import { named, rgbOf } from "../colours.js";

/**
 * @param slice the block of the slice
 * @param {"occupancy"|"walls"} what grey by coverage, or walls blue and clutter orange (the paper's Figure 2)
 * @returns {?{canvas: HTMLCanvasElement, low: number[], high: number[]}} with its corners in cells
 */
export function rasterOf(slice, what) {
  if (slice.ix.length === 0 || (what === "walls" && !slice.boundary)) {
    return null;
  }
  const [lowX, highX] = extent(slice.ix);
  const [lowY, highY] = extent(slice.iy);
  const canvas = document.createElement("canvas");
  canvas.width = highX - lowX + 1;
  canvas.height = highY - lowY + 1;
  const context = canvas.getContext("2d");
  const [wall, clutter] = [rgbOf(named("blue")), rgbOf(named("orange"))];
  const image = context.createImageData(canvas.width, canvas.height);
  slice.ix.forEach((ix, i) => {
    const at = 4 * ((highY - slice.iy[i]) * canvas.width + (ix - lowX));
    const light = Math.round(225 - (195 * slice.coverage[i]) / 255);
    const colour = what === "walls" ? (slice.boundary[i] ? wall : clutter) : [light, light, light];
    image.data.set([...colour, 255], at);
  });
  context.putImageData(image, 0, 0);
  return { canvas, low: [lowX, lowY], high: [highX + 1, highY + 1] };
}

function extent(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return [low, high];
}
