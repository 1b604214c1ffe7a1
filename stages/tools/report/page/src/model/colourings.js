// SPDX-License-Identifier: GPL-3.0-or-later
// What the surface can be coloured by. Each colouring names the surface it is drawn on, a colour per triangle and its legend.

import { categorical, css, kKind, kKindName, kUnknown, rgbOf, sequential } from "../colours.js";
import { kWall } from "./surfaces.js";

const kKindRgb = kKind.map(rgbOf);
const kUnknownRgb = rgbOf(kUnknown);

/** A scale from low to high; values that are no number are grey. */
function scaled(low, high, unit, valueOf) {
  return {
    colourOf: (t) => {
      const value = valueOf(t);
      return Number.isFinite(value) ? sequential((value - low) / (high - low)) : kUnknownRgb;
    },
    legend: { scale: [low, high], unit },
  };
}

function rangeOf(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (Number.isFinite(value)) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  return low < high ? [low, high] : [low - 0.5, low + 0.5];
}

/** Colourings of the model alone. `model` = {block, surface}. */
export function modelColourings(model) {
  const { block, surface } = model;
  const storeys = [...new Set(block.storey)].sort((a, b) => a - b);
  const list = [
    {
      name: "Floor, ceiling, wall",
      surface,
      colourOf: (t) => kKindRgb[surface.kind[t]],
      legend: { swatches: [0, 1, 2].map((kind) => [kKind[kind], kKindName[kind]]) },
    },
    {
      name: "Storey",
      surface,
      colourOf: (t) => rgbOf(categorical(surface.storey[t])),
      legend: { swatches: storeys.map((s) => [categorical(s), `storey ${s}`]) },
    },
  ];
  if (block.region_distance) {
    list.push({
      name: "Distance of the points",
      surface,
      ...scaled(0, 0.02, "m, root mean square per surface; grey: no points", (t) => block.region_distance[surface.part[t]]),
    });
  }
  return list;
}

/** Colourings by what the cells and faces hold. `faces` = faceSurface(). */
export function faceColourings(complex, faces) {
  const { block } = complex;
  const face = (t) => faces.faces[faces.part[t]];
  const omega = (t) => (face(t).kind === kWall ? block.wall_omega : block.level_omega)[face(t).index];
  const list = [
    { name: "Coverage ω of the face", surface: faces, ...scaled(0, 1, "covered share", omega) },
    {
      name: "Margin of the decision",
      surface: faces,
      ...scaled(0, 1, "energy that flipping the room's cell would cost, per volume", (t) => block.margin[face(t).cell] / complex.volume(face(t).cell)),
    },
  ];
  for (const { name, unit, description } of block.evidence) {
    const values = block[`evidence_${name}`];
    const [low, high] = rangeOf(faces.faces.map(({ cell }) => values[cell]));
    list.push({
      name: `Evidence: ${name}`,
      surface: faces,
      ...scaled(low, high, `${unit === "1" ? "" : `${unit}; `}${description}`, (t) => values[face(t).cell]),
    });
  }
  return list;
}

/** Ways to show the scan: which points, and what colours them. `keep(i)` and `value(i)` of point i. */
export function cloudViews(cloud) {
  const height = (i) => cloud.xyz[3 * i + 2] / 65535;
  const views = [{ name: "by height", keep: () => true, value: height }];
  if (cloud.distance.length > 0) {
    const metres = (i) => cloud.distance[i] * cloud.distance_step_m;
    views.push(
      { name: "by distance from the model, 0 … 10 cm", keep: () => true, value: (i) => metres(i) / 0.1 },
      { name: "what the model leaves out (over 5 cm away)", keep: (i) => metres(i) > 0.05, value: height },
    );
  }
  return views;
}

/** The points of a view: {positions, colours}, 3 numbers each. */
export function cloudPoints(cloud, view) {
  const kept = [];
  for (let i = 0; i < cloud.xyz.length / 3; ++i) {
    if (view.keep(i)) {
      kept.push(i);
    }
  }
  const positions = new Float32Array(3 * kept.length);
  const colours = new Uint8Array(3 * kept.length);
  kept.forEach((i, k) => {
    for (let axis = 0; axis < 3; ++axis) {
      positions[3 * k + axis] = cloud.low[axis] + cloud.xyz[3 * i + axis] * cloud.step[axis];
    }
    colours.set(sequential(view.value(i)), 3 * k);
  });
  return { positions, colours };
}

/** Fills an element with a legend. */
export function drawLegend(element, legend) {
  element.replaceChildren();
  for (const [colour, name] of legend.swatches ?? []) {
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = colour;
    const row = document.createElement("div");
    row.append(swatch, name);
    element.append(row);
  }
  if (legend.scale) {
    const strip = document.createElement("canvas");
    strip.width = 128;
    strip.height = 1;
    const context = strip.getContext("2d");
    for (let x = 0; x < strip.width; ++x) {
      context.fillStyle = css(sequential(x / (strip.width - 1)));
      context.fillRect(x, 0, 1, 1);
    }
    const [low, high] = legend.scale.map((value) => Number(value.toPrecision(3)));
    const row = document.createElement("div");
    row.append(`${low} `, strip, ` ${high}`);
    const unit = document.createElement("div");
    unit.className = "quiet";
    unit.textContent = legend.unit;
    element.append(row, unit);
  }
}
