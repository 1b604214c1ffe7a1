// SPDX-License-Identifier: GPL-3.0-or-later
// What the cells of a layer can be filled with.

import { css, diverging, named, sequential } from "../colours.js";

import { kUnknownLabel } from "../data/complex.js";

const kSolid = "#e1e1e1";
const kEmpty = "#a9d3ee";

/** @returns {{name: string, legend: object, colourOf: (cell: number) => ?string}[]} */
export function cellFills(complex) {
  const { block } = complex;
  const hardlySeen = named("pink");
  const unknown = named("yellow");
  const unobserved = (cell) => block.unobserved[cell] === 1 && block.label[cell] === 1;
  const list = [
    { name: "none", legend: {}, colourOf: () => null },
    {
      name: "label",
      legend: { swatches: [[kEmpty, "empty"], [kSolid, "solid or outside"], [hardlySeen, "empty, hardly observed"], [unknown, "unknown: a room or open air"]] },
      colourOf: (cell) => (block.label[cell] === kUnknownLabel ? unknown : unobserved(cell) ? hardlySeen : block.label[cell] === 1 ? kEmpty : kSolid),
    },
    {
      name: "margin of the decision",
      legend: { swatches: [[css(diverging(-0.85)), "surely empty"], [css(diverging(-0.1)), "barely empty"], [css(diverging(0.1)), "barely solid"], [css(diverging(0.85)), "surely solid"], [unknown, "unknown"]] },
      colourOf: (cell) => {
        if (block.label[cell] === kUnknownLabel) return unknown;
        const sure = Math.min(1, Math.max(0, block.margin[cell] / complex.volume(cell)));
        return css(diverging((block.label[cell] === 1 ? -1 : 1) * (0.1 + 0.75 * sure)));
      },
    },
  ];
  for (const { name, unit, description } of block.evidence) {
    const values = block[`evidence_${name}`];
    const top = values.reduce((most, value) => Math.max(most, Math.abs(value)), 1e-9);
    const signed = values.some((value) => value < 0);
    list.push({
      name: `evidence: ${name}`,
      legend: { scale: [signed ? -top : 0, top], unit: `${unit === "1" ? "" : `${unit}; `}${description}` },
      colourOf: (cell) => css(sequential(signed ? 0.5 + (0.5 * values[cell]) / top : values[cell] / top)),
    });
  }
  return list;
}
