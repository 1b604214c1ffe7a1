// SPDX-License-Identifier: GPL-3.0-or-later
// The vertical histogram with its peaks and slices (the paper's Figure 1), as SVG, and the table of levels.

import { named } from "../colours.js";
import { byId, make, number } from "../dom.js";

const kNamespace = "http://www.w3.org/2000/svg";
const kHeight = 620;
const kBars = 520;
const kLeft = 60;
const kTop = 16;

function svg(tag, attributes, text) {
  const element = document.createElementNS(kNamespace, tag);
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, value);
  }
  if (text !== undefined) {
    element.textContent = text;
  }
  return element;
}

export function showHistogram(run) {
  const host = byId("histogram");
  const { levels, histogram } = run.facts;
  if (!levels) {
    host.append(make("p", { class: "quiet", text: "There are no slices yet: make run goes on." }));
    return;
  }
  host.append(
    make("p", {
      text: "Area of level surface per height. Orange marks: the peaks, heights of floors and ceilings. Blue: the structure slice around each. Yellow: the wall slices between.",
    }),
    picture(levels, histogram, run.facts.histogram_area, run.scan),
    levelTable(levels, (z) => run.scan.captionHeight(z)),
  );
}

/** The drawing; what it says are heights of the scan. */
function picture(levels, { z0, bin_m: bin }, bins, scan) {
  const top = z0 + bin * bins.length;
  const most = Math.max(1e-9, ...bins);
  const y = (z) => kTop + ((top - z) / (top - z0)) * kHeight;
  const x = (area) => kLeft + (area / most) * kBars;
  const drawing = svg("svg", { width: 860, height: kHeight + 60, viewBox: `0 0 860 ${kHeight + 60}`, role: "img", "aria-label": "Vertical histogram" });
  const box = (low, high, fill, opacity, right = kLeft + kBars) =>
    drawing.append(svg("rect", { x: kLeft, y: y(high), width: right - kLeft, height: Math.max(0.5, y(low) - y(high)), fill, "fill-opacity": opacity }));
  levels.slice(0, -1).forEach((level, i) => box(level.hi, levels[i + 1].lo, named("yellow"), 0.25));
  levels.forEach((level) => box(level.lo, level.hi, named("sky"), 0.5));
  const path = bins.reduce((d, area, i) => (area > 0 ? `${d}M${kLeft} ${y(z0 + (i + 1) * bin)}H${x(area)}V${y(z0 + i * bin)}H${kLeft}Z` : d), "");
  drawing.append(svg("path", { d: path, fill: "#282828", stroke: "#282828", "stroke-width": 0.7 }));
  let last = Infinity;
  for (const level of levels) {
    drawing.append(svg("line", { x1: kLeft + kBars - 40, x2: kLeft + kBars, y1: y(level.z), y2: y(level.z), stroke: named("vermilion"), "stroke-width": 2 }));
    const at = Math.min(y(level.z) + 4, last - 13); // labels of close peaks do not overlap
    last = at;
    drawing.append(svg("text", { x: kLeft + kBars + 8, y: at, fill: "#b34700" }, `${number(scan.captionHeight(level.z), 3)} m: ${level.cap ? "cap" : level.step ? "step" : `${number(level.area_m2, 0)} m²`}`));
  }
  drawing.append(svg("text", { x: kLeft, y: kTop + kHeight + 20 }, `0`), svg("text", { x: kLeft + kBars - 40, y: kTop + kHeight + 20 }, `${number(most, 0)} m² per ${number(1e3 * bin, 0)} mm`));
  const step = top - z0 > 30 ? 5 : 1;
  const ground = scan.captionHeight(0);
  for (let height = Math.ceil((z0 + ground) / step) * step; height <= top + ground; height += step) {
    const at = y(height - ground);
    drawing.append(svg("text", { x: kLeft - 8, y: at + 4, "text-anchor": "end" }, `${height} m`), svg("line", { x1: kLeft - 5, x2: kLeft, y1: at, y2: at, stroke: "#5b6770" }));
  }
  return drawing;
}

function levelTable(levels, heightOf) {
  const head = ["Level", "Height in the scan [m]", "Structure slice [m]", "Level surface [m²]", "Largest piece [m²]", "Wall slice above"];
  const rows = levels.map((level, i) => [
    String(i),
    number(heightOf(level.z), 3),
    `${number(heightOf(level.lo), 3)} … ${number(heightOf(level.hi), 3)}`,
    level.cap ? "cap: none seen" : level.step ? "step of a slope" : number(level.area_m2, 1),
    number(level.component_m2, 1),
    i + 1 < levels.length ? `${number(levels[i + 1].z - level.z)} m` : "",
  ]);
  return make(
    "table",
    {},
    make("tr", {}, ...head.map((text) => make("th", { text, class: "number" }))),
    ...rows.map((row) => make("tr", {}, ...row.map((text) => make("td", { text, class: "number" })))),
  );
}
