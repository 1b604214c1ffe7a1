// SPDX-License-Identifier: GPL-3.0-or-later
// The outlines of faces. Those of a face that is left out, because it turns its front to the eye, are left out with it.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";

// A face is plane: all of its points see the eye on the same side, so that both ends of a segment agree.
const kFacing = `
if (onlyInside && dot(lineNormal, cameraPosition - position) > 0.0) {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

export class Outlines {
  constructor() {
    this.onlyInside = { value: true };
    const material = new LineBasicMaterial({ color: 0x333a40, transparent: true, opacity: 0.55 });
    material.onBeforeCompile = (shader) => {
      shader.uniforms.onlyInside = this.onlyInside;
      shader.vertexShader = shader.vertexShader
        .replace("void main() {", "attribute vec3 lineNormal;\nuniform bool onlyInside;\nvoid main() {")
        .replace(/}\s*$/, `${kFacing}}`);
    };
    this.object = new LineSegments(new BufferGeometry(), material);
  }

  /** @param {import("./surfaces.js").Surface} surface @param {number} storey or -1 for all */
  show(surface, storey) {
    const lines = [];
    const normals = [];
    for (let s = 0; s < surface.lineStorey.length; ++s) {
      if (storey < 0 || surface.lineStorey[s] === storey) {
        const normal = surface.lineNormals.subarray(3 * s, 3 * s + 3);
        lines.push(...surface.lines.subarray(6 * s, 6 * s + 6));
        normals.push(...normal, ...normal);
      }
    }
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry();
    this.object.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(lines), 3));
    this.object.geometry.setAttribute("lineNormal", new BufferAttribute(Float32Array.from(normals), 3));
  }
}
