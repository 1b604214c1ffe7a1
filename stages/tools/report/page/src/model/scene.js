// SPDX-License-Identifier: GPL-3.0-or-later
// The 3D view: draws a coloured surface, its outlines and points; orbit, storeys, a cut at a height. It draws only when asked.

import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  ColorManagement,
  DirectionalLight,
  DoubleSide,
  HemisphereLight,
  LinearSRGBColorSpace,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Plane,
  Points,
  PointsMaterial,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Outlines } from "./outlines.js";

// Colours are given as they are to be seen.
ColorManagement.enabled = false;

const kUp = new Vector3(0, 0, 1);
const kInside = 0.005; // [m]
const kFilled = 0.94; // share of the view that the building fills
const kKeyZoom = 1.15;

export class ModelScene {
  /** @param {HTMLElement} host @param {number[]} box low and high corner, local metres */
  constructor(host, box) {
    this.host = host;
    this.low = new Vector3(...box.slice(0, 3));
    this.high = new Vector3(...box.slice(3));
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.setClearColor(0xffffff);
    this.cut = new Plane(new Vector3(0, 0, -1), this.high.z + 1);
    this.renderer.clippingPlanes = [this.cut];
    host.append(this.renderer.domElement);
    this.renderer.domElement.tabIndex = 0;
    this.renderer.domElement.setAttribute("aria-label", "The model in 3D. Drag or shift and arrow keys turn, wheel or plus and minus zoom, arrow keys move, enter says why.");

    this.scene = new Scene();
    this.camera = new PerspectiveCamera(35, 1, 0.1, 10000);
    this.camera.up.copy(kUp);
    this.scene.add(new HemisphereLight(0xffffff, 0xb8b0a6, 2.6), this.camera);
    const lamp = new DirectionalLight(0xffffff, 1.0);
    lamp.position.set(-0.4, 0.6, 1);
    this.camera.add(lamp);
    this.surface = new Mesh(
      new BufferGeometry(),
      new MeshLambertMaterial({ vertexColors: true, side: BackSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
    );
    this.outlines = new Outlines();
    this.cloud = new Points(new BufferGeometry(), new PointsMaterial({ size: 1.6, sizeAttenuation: false, vertexColors: true }));
    this.cloud.visible = false;
    this.scene.add(this.surface, this.outlines.object, this.cloud);

    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.listenToKeyEvents(this.renderer.domElement);
    this.controls.addEventListener("change", () => this.redraw());
    this.controls.addEventListener("start", () => {
      this.fitted = false;
    });
    this.renderer.domElement.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(host);
    this.look(-0.6, -1, 0.9);
  }

  /** Looks at the whole building from a direction. */
  look(x, y, z) {
    const centre = this.low.clone().add(this.high).multiplyScalar(0.5);
    const radius = 0.5 * this.high.distanceTo(this.low);
    const distance = (0.92 * radius) / Math.sin((0.5 * this.camera.fov * Math.PI) / 180);
    this.camera.position.copy(new Vector3(x, y, z).normalize().multiplyScalar(distance).add(centre));
    this.camera.near = distance / 500;
    this.camera.far = 10 * distance;
    this.controls.target.copy(centre);
    this.controls.update();
    this.fitted = true;
    this.fit();
  }

  /** Moves back, to and fro and aside until the box of the building just fills the view. */
  fit() {
    this.camera.updateProjectionMatrix();
    const { position, projectionMatrix: projection } = this.camera;
    const away = position.clone().sub(this.controls.target);
    for (let i = 0; i < 4; ++i) {
      this.camera.updateMatrixWorld();
      const [low, high] = this.shownBox();
      const distance = away.length();
      const aside = new Vector3(((low.x + high.x) / 2 / projection.elements[0]) * distance, ((low.y + high.y) / 2 / projection.elements[5]) * distance, 0);
      this.controls.target.add(aside.applyQuaternion(this.camera.quaternion));
      away.multiplyScalar(Math.max(high.x - low.x, high.y - low.y) / (2 * kFilled));
      position.copy(this.controls.target).add(away);
    }
    this.controls.update();
    this.redraw();
  }

  /** The corners of the building's box as the camera sees them, each axis -1 … 1 within the view. */
  shownBox() {
    const low = new Vector2(Infinity, Infinity);
    const high = new Vector2(-Infinity, -Infinity);
    for (let corner = 0; corner < 8; ++corner) {
      const from = [corner & 1, corner & 2, corner & 4].map((bit) => (bit ? this.high : this.low));
      const seen = new Vector3(from[0].x, from[1].y, from[2].z).project(this.camera);
      low.min(seen);
      high.max(seen);
    }
    return [low, high];
  }

  key(event) {
    this.fitted = false;
    const factor = { "+": 1 / kKeyZoom, "=": 1 / kKeyZoom, "-": kKeyZoom }[event.key];
    if (factor && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      const away = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
      this.camera.position.copy(this.controls.target).add(away);
      this.controls.update();
    }
  }

  /**
   * Shows a surface, of one storey or of all (-1). `colourOf(triangle)` gives [r, g, b], 0 … 255.
   * @param {import("./surfaces.js").Surface} surface
   */
  show(surface, storey, colourOf) {
    const kept = [];
    for (let t = 0; t < surface.kind.length; ++t) {
      if (storey < 0 || surface.storey[t] === storey) {
        kept.push(t);
      }
    }
    const positions = new Float32Array(9 * kept.length);
    const colours = new Uint8Array(9 * kept.length);
    kept.forEach((t, i) => {
      positions.set(surface.positions.subarray(9 * t, 9 * t + 9), 9 * i);
      const colour = colourOf(t);
      for (let c = 0; c < 3; ++c) {
        colours.set(colour, 9 * i + 3 * c);
      }
    });
    this.shown = { surface, kept };
    replaceGeometry(this.surface, positions, colours).computeVertexNormals();
    this.outlines.show(surface, storey);
    this.redraw();
  }

  /** Points of the scan: xyz and [r, g, b] of each; null takes them away. */
  showCloud(positions, colours) {
    this.cloud.visible = positions !== null;
    if (positions) {
      replaceGeometry(this.cloud, positions, colours);
    }
    this.redraw();
  }

  cutAt(z) {
    this.cut.constant = z;
    this.redraw();
  }

  /** Walls seen from both sides, or from inside the rooms only. */
  bothSides(on) {
    this.surface.material.side = on ? DoubleSide : BackSide;
    this.surface.material.needsUpdate = true;
    this.outlines.onlyInside.value = !on;
    this.redraw();
  }

  /** What is in the middle of the view, as pick(). */
  pickMiddle() {
    const box = this.renderer.domElement.getBoundingClientRect();
    return this.pick(box.left + box.width / 2, box.top + box.height / 2);
  }

  /** What is under a point of the window: {triangle of the shown surface, point inside the room behind it}, or null. */
  pick(clientX, clientY) {
    const box = this.renderer.domElement.getBoundingClientRect();
    const at = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const hit = ray.intersectObject(this.surface).find((found) => this.cut.distanceToPoint(found.point) >= 0);
    // Normals point out of the rooms: a little against the normal lies the room.
    return hit ? { triangle: this.shown.kept[hit.faceIndex], inside: hit.point.clone().addScaledVector(hit.face.normal, -kInside) } : null;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width > 0 && height > 0) {
      this.renderer.setPixelRatio(window.devicePixelRatio);
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      if (this.fitted) {
        this.fit(); // nobody has turned or moved it yet
      }
      this.camera.updateProjectionMatrix();
      this.renderer.render(this.scene, this.camera); // a new size clears the canvas
    }
  }

  redraw() {
    if (!this.asked) {
      this.asked = true;
      requestAnimationFrame(() => {
        this.asked = false;
        this.renderer.render(this.scene, this.camera);
      });
    }
  }
}

function replaceGeometry(object, positions, colours) {
  object.geometry.dispose();
  object.geometry = new BufferGeometry();
  object.geometry.setAttribute("position", new BufferAttribute(positions, 3));
  object.geometry.setAttribute("color", new BufferAttribute(colours, 3, true));
  return object.geometry;
}
