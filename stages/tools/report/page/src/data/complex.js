// SPDX-License-Identifier: GPL-3.0-or-later
// The cell complex (schemas/cells.md): a plan of convex faces, the same in every layer between neighbouring levels.

import { ScanCoordinates } from "./coordinates.js";

/** The label of cells that are neither called a room nor denied (schemas/labels.md). */
export const kUnknownLabel = 2;

export class Complex {
  /** @param block the block `cells` @param scan where it lies in the scan's own coordinates */
  constructor(block, scan = new ScanCoordinates(null)) {
    this.block = block;
    this.scan = scan;
    this.levels = block.levels;
    this.layers = block.levels.length - 1;
    this.faces = block.face_offset.length - 1;
    this.edges = block.edges.length / 5;
    this.cells = this.faces * this.layers;
    this.areas = new Float64Array(this.faces);
    for (let f = 0; f < this.faces; ++f) {
      this.areas[f] = polygonArea(this.corners(f));
    }
  }

  /** "0.00 … 2.60 m", heights of the scan. */
  heightsOf(layer) {
    return [layer, layer + 1].map((k) => this.scan.captionHeight(this.levels[k]).toFixed(2)).join(" … ");
  }
  height(layer) {
    return this.levels[layer + 1] - this.levels[layer];
  }
  cell(face, layer) {
    return layer * this.faces + face;
  }
  faceOf(cell) {
    return cell % this.faces;
  }
  layerOf(cell) {
    return Math.floor(cell / this.faces);
  }
  wallFace(edge, layer) {
    return layer * this.edges + edge;
  }
  levelFace(face, level) {
    return level * this.faces + face;
  }
  volume(cell) {
    return this.areas[this.faceOf(cell)] * this.height(this.layerOf(cell));
  }
  vertex(v) {
    return [this.block.vertices[2 * v], this.block.vertices[2 * v + 1]];
  }
  /** Corners of a plan face, counter-clockwise: [[x, y] …]. */
  corners(face) {
    const { face_offset: offset, face_vertex: vertex } = this.block;
    return Array.from(vertex.subarray(offset[face], offset[face + 1]), (v) => this.vertex(v));
  }
  edgesOf(face) {
    const { face_offset: offset, face_edge: edge } = this.block;
    return edge.subarray(offset[face], offset[face + 1]);
  }
  edge(e) {
    const [v0, v1, left, right, line] = this.block.edges.subarray(5 * e, 5 * e + 5);
    return { v0, v1, left, right, line, a: this.vertex(v0), b: this.vertex(v1) };
  }
  /** The wall id of the line an edge lies on; null on the border of the complex. */
  wallId(e) {
    const line = this.block.edges[5 * e + 4];
    return line < 0 ? null : this.block.line_ids[line];
  }
  isEmpty(face, layer) {
    return face >= 0 && layer >= 0 && layer < this.layers && this.block.label[this.cell(face, layer)] === 1;
  }
  /** The face at a point of the plan, or -1. */
  faceAt(x, y) {
    for (let f = 0; f < this.faces; ++f) {
      if (insideConvex(this.corners(f), x, y)) {
        return f;
      }
    }
    return -1;
  }
  /** The layer whose middle lies between two heights; -1 for none. */
  layerBetween(low, high) {
    for (let k = 0; k < this.layers; ++k) {
      const middle = 0.5 * (this.levels[k] + this.levels[k + 1]);
      if (middle > low && middle < high) {
        return k;
      }
    }
    return -1;
  }
}

function polygonArea(corners) {
  let twice = 0;
  corners.forEach(([x, y], i) => {
    const [nextX, nextY] = corners[(i + 1) % corners.length];
    twice += x * nextY - nextX * y;
  });
  return 0.5 * twice;
}

function insideConvex(corners, x, y) {
  return corners.every(([ax, ay], i) => {
    const [bx, by] = corners[(i + 1) % corners.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0;
  });
}
