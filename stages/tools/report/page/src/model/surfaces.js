// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces to be drawn, as triangle soups with facts per triangle. Normals point out of the rooms, as in model.ply.

export const kFloor = 0;
export const kCeiling = 1;
export const kWall = 2;

/**
 * @typedef {object} Surface
 * @property {Float32Array} positions  9 per triangle
 * @property {Float32Array} lines      6 per segment of its outlines
 * @property {Int16Array} storey       per triangle
 * @property {Int16Array} lineStorey   per segment
 * @property {Float32Array} lineNormals 3 per segment: normal of the face that it outlines
 * @property {Uint8Array} kind         per triangle
 * @property {Int32Array} part         per triangle: region of the model, or index into `faces`
 */

/** The model itself (block `model`): outlines where two regions meet, once for each of the two. */
export function modelSurface(block) {
  const { vertices, triangles, region } = block;
  const count = triangles.length / 3;
  const positions = new Float32Array(9 * count);
  const sides = new Map();
  for (let t = 0; t < count; ++t) {
    for (let c = 0; c < 3; ++c) {
      const v = triangles[3 * t + c];
      positions.set(vertices.subarray(3 * v, 3 * v + 3), 9 * t + 3 * c);
      const next = triangles[3 * t + ((c + 1) % 3)];
      const key = v < next ? `${v} ${next}` : `${next} ${v}`;
      const side = sides.get(key) ?? { v, next, parts: new Map(), storey: block.storey[t] };
      side.parts.set(region[t], t);
      sides.set(key, side);
    }
  }
  const outlines = [...sides.values()].filter(({ parts }) => parts.size > 1).flatMap((side) => [...side.parts.values()].map((triangle) => ({ ...side, triangle })));
  const lines = new Float32Array(6 * outlines.length);
  const lineNormals = new Float32Array(3 * outlines.length);
  outlines.forEach(({ v, next, triangle }, i) => {
    lines.set(vertices.subarray(3 * v, 3 * v + 3), 6 * i);
    lines.set(vertices.subarray(3 * next, 3 * next + 3), 6 * i + 3);
    const corner = (c) => positions.subarray(9 * triangle + 3 * c, 9 * triangle + 3 * c + 3);
    lineNormals.set(normalOf([0, 1, 2].map(corner)), 3 * i);
  });
  return {
    positions,
    lines,
    storey: block.storey,
    lineStorey: Int16Array.from(outlines, (side) => side.storey),
    lineNormals,
    kind: block.kind,
    part: region,
  };
}

/** The normal of a plane polygon (Newell), some corners in one row or not; its length means nothing. */
function normalOf(corners) {
  const normal = [0, 0, 0];
  corners.forEach((a, i) => {
    const b = corners[(i + 1) % corners.length];
    normal[0] += (a[1] - b[1]) * (a[2] + b[2]);
    normal[1] += (a[2] - b[2]) * (a[0] + b[0]);
    normal[2] += (a[0] - b[0]) * (a[1] + b[1]);
  });
  return normal;
}

/**
 * The faces of the complex between empty and solid: the same surface, face by face, each with its evidence.
 * `faces[part]`: {kind, index, cell, beyond} with the empty cell and the solid one (-1: outside).
 */
export function faceSurface(complex, storeyOfCell) {
  const build = new Builder(storeyOfCell);
  for (let k = 0; k < complex.layers; ++k) {
    const [low, high] = [complex.levels[k], complex.levels[k + 1]];
    for (let e = 0; e < complex.edges; ++e) {
      const { a, b, left, right } = complex.edge(e);
      const isLeft = complex.isEmpty(left, k);
      if (isLeft === complex.isEmpty(right, k)) {
        continue;
      }
      const quad = [[...a, low], [...b, low], [...b, high], [...a, high]];
      const [inside, outside] = isLeft ? [left, right] : [right, left];
      build.add(isLeft ? quad : quad.reverse(), {
        kind: kWall,
        index: complex.wallFace(e, k),
        cell: complex.cell(inside, k),
        beyond: outside < 0 ? -1 : complex.cell(outside, k),
      });
    }
  }
  for (let l = 0; l <= complex.layers; ++l) {
    for (let f = 0; f < complex.faces; ++f) {
      const above = complex.isEmpty(f, l);
      if (above === complex.isEmpty(f, l - 1)) {
        continue;
      }
      const corners = complex.corners(f).map(([x, y]) => [x, y, complex.levels[l]]);
      const [inside, outside] = above ? [l, l - 1] : [l - 1, l];
      build.add(above ? corners.reverse() : corners, {
        kind: above ? kFloor : kCeiling,
        index: complex.levelFace(f, l),
        cell: complex.cell(f, inside),
        beyond: outside < 0 || outside >= complex.layers ? -1 : complex.cell(f, outside),
      });
    }
  }
  return build.surface();
}

class Builder {
  constructor(storeyOfCell) {
    this.storeyOfCell = storeyOfCell;
    Object.assign(this, { positions: [], lines: [], storey: [], lineStorey: [], lineNormals: [], kind: [], part: [], faces: [] });
  }

  /** A convex face, counter-clockwise seen from its normal's tip. */
  add(corners, face) {
    const storey = this.storeyOfCell[face.cell];
    const normal = normalOf(corners);
    for (let i = 1; i + 1 < corners.length; ++i) {
      this.positions.push(...corners[0], ...corners[i], ...corners[i + 1]);
      this.storey.push(storey);
      this.kind.push(face.kind);
      this.part.push(this.faces.length);
    }
    corners.forEach((corner, i) => {
      this.lines.push(...corner, ...corners[(i + 1) % corners.length]);
      this.lineStorey.push(storey);
      this.lineNormals.push(...normal);
    });
    this.faces.push(face);
  }

  surface() {
    return {
      positions: Float32Array.from(this.positions),
      lines: Float32Array.from(this.lines),
      storey: Int16Array.from(this.storey),
      lineStorey: Int16Array.from(this.lineStorey),
      lineNormals: Float32Array.from(this.lineNormals),
      kind: Uint8Array.from(this.kind),
      part: Int32Array.from(this.part),
      faces: this.faces,
    };
  }
}
