// SPDX-License-Identifier: GPL-3.0-or-later
// Colours as the colour-blind see them, and what must hold of those of the page.
import assert from "node:assert/strict";

/** A colour as protanopes, deuteranopes and tritanopes see it (Machado, Oliveira, Fernandes 2009), in CIELAB. */
const kSight = {
  all: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  protanopia: [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
  deuteranopia: [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.01182, 0.04294, 0.968881],
  tritanopia: [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.3039],
};

function seen(rgb, sight) {
  const linear = rgb.map((value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4));
  const row = (matrix, i, vector) => vector.reduce((sum, value, k) => sum + matrix[3 * i + k] * value, 0);
  const shown = [0, 1, 2].map((i) => Math.min(1, Math.max(0, row(kSight[sight], i, linear))));
  const xyz = [0, 1, 2].map((i) => row([0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505], i, shown));
  const [x, y, z] = xyz.map((value, i) => value / [0.9505, 1, 1.089][i]).map((t) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116));
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** The least distance of two colours of a list for any sight. */
function leastApart(list) {
  let least = Infinity;
  for (const sight of Object.keys(kSight)) {
    const lab = list.map((rgb) => seen(rgb, sight));
    lab.forEach((a, i) => lab.slice(i + 1).forEach((b) => (least = Math.min(least, Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])))));
  }
  return least;
}

/** Colours that mean different things stay apart. `colours`: the page's module, with the colour maps of a run. */
export function areToldApart({ categorical, diverging, kKind, named, rgbOf, sequential }) {
  const [blue, orange, green, red, pink] = ["blue", "orange", "green", "vermilion", "pink"].map((name) => rgbOf(named(name)));
  assert.ok(leastApart(Array.from({ length: 8 }, (_, i) => rgbOf(categorical(i)))) > 5, "the row");
  assert.ok(leastApart([blue, orange]) > 40, "walls and clutter");
  assert.ok(leastApart([red, [255, 255, 255], [0, 0, 0], green, blue]) > 15, "selected, paper, walls, openings, lines");
  assert.ok(leastApart([...["#a9d3ee", "#e1e1e1"].map(rgbOf), pink]) > 12, "empty, solid, hardly observed");
  assert.ok(leastApart([diverging(-0.85), diverging(0), diverging(0.85)]) > 30, "surely empty, undecided, surely solid");
  assert.ok(leastApart(kKind.slice(0, 3).map(rgbOf)) > 7, "floor, ceiling, wall");
  assert.ok(leastApart([0, 0.25, 0.5, 0.75, 1].map(sequential)) > 12, "steps of the scale");
}

/** The scale grows lighter all the way, for every sight. */
export function growsLighter({ sequential }) {
  for (const sight of Object.keys(kSight)) {
    const light = Array.from({ length: 21 }, (_, i) => seen(sequential(i / 20), sight)[0]);
    light.slice(1).forEach((value, i) => assert.ok(value > light[i], `${sight} at ${i / 20}`));
  }
}
