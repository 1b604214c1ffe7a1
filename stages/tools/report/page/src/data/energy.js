// SPDX-License-Identifier: GPL-3.0-or-later
// The energy that graphcut minimised, taken apart for one cell: E = sum of D(label) + mu * sum of
// unseen(omega) * (1 - implied) * A over the faces between different labels (stages/graphcut/README.md).

/**
 * The faces of a cell: where, what covers them, and the cell beyond (-1: outside, solid).
 * @returns {{kind: string, index: number, area: number, omega: number, implied: number, points: number, beyond: number, wall: ?string}[]}
 */
export function facesOf(complex, cell) {
  const { block } = complex;
  const face = complex.faceOf(cell);
  const layer = complex.layerOf(cell);
  const list = Array.from(complex.edgesOf(face), (e) => {
    const edge = complex.edge(e);
    const other = edge.left === face ? edge.right : edge.left;
    const index = complex.wallFace(e, layer);
    return {
      kind: "wall",
      index,
      edge: e,
      wall: complex.wallId(e),
      area: Math.hypot(edge.b[0] - edge.a[0], edge.b[1] - edge.a[1]) * complex.height(layer),
      omega: block.wall_omega[index],
      implied: block.wall_implied[index],
      points: block.wall_points[index],
      beyond: other < 0 ? -1 : complex.cell(other, layer),
    };
  });
  for (const [kind, level, beyond] of [
    ["below", layer, layer - 1],
    ["above", layer + 1, layer + 1],
  ]) {
    const index = complex.levelFace(face, level);
    list.push({
      kind,
      index,
      wall: null,
      area: complex.areas[face],
      omega: block.level_omega[index],
      implied: block.level_implied[index],
      points: block.level_points[index],
      beyond: beyond < 0 || beyond >= complex.layers ? -1 : complex.cell(face, beyond),
    });
  }
  return list;
}

/** What a face costs when the labels on its two sides differ [m^3]. */
export function boundaryCost(face, price) {
  return price.mu * Math.max(0, 1 - face.omega / price.freeFrom) * (1 - face.implied) * face.area;
}

/** What a surface costs: the length mu [m], and the share of a face from which on it is free; NaN when the labels do not tell. */
export function priceOf(block) {
  return { mu: block.graphcut?.mu_m ?? Number.NaN, freeFrom: block.graphcut?.free_from ?? Number.NaN };
}

/** 1 for empty, 0 for the rest: in the model's energy unknown cells are solid. */
const sideOf = (block, cell) => (block.label[cell] === 1 ? 1 : 0);

/** What flipping a cell alone would change: {data, boundary, total} [m^3], as graphcut's margin. */
export function flipCost(complex, cell) {
  const { block } = complex;
  const price = priceOf(block);
  const label = sideOf(block, cell);
  const empty = block.evidence_d_empty[cell];
  const solid = block.evidence_d_solid[cell];
  const data = label === 1 ? solid - empty : empty - solid;
  let boundary = 0;
  for (const face of facesOf(complex, cell)) {
    const other = face.beyond < 0 ? 0 : sideOf(block, face.beyond);
    boundary += (other === label ? 1 : -1) * boundaryCost(face, price);
  }
  return { data, boundary, total: data + boundary };
}

/** The largest difference between flipCost() and the margin that graphcut wrote [m^3]: the two must agree. */
export function worstMargin(complex) {
  let worst = { difference: 0, cell: -1, cells: complex.cells };
  for (let cell = 0; cell < complex.cells; ++cell) {
    const difference = Math.abs(flipCost(complex, cell).total - complex.block.margin[cell]);
    if (difference > worst.difference) {
      worst = { ...worst, difference, cell };
    }
  }
  return worst;
}
