// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the plan of one slice: evidence, cells, wall lines. What is drawn is decided by `state`; panel.js changes it.

import { kOkabeIto } from "../colours.js";
import { Viewport } from "./viewport.js";

const kWallEdge = "#141414";
const kThinEdge = "#b4b4b4";
const kOpening = "#009e73";
const kQuiet = "#3a444b";
// Not the colour of what is selected or moved.
const kLineColours = kOkabeIto.slice(0, 5);
const kSelected = "#d55e00";

export class PlanView {
  /** @param run @param {object} state {slice, block, raster, fill, show, lines, selected} */
  constructor(host, run, state) {
    this.run = run;
    this.state = state;
    this.overlays = []; // drawn last: functions of the context
    this.viewport = new Viewport(host, (context) => this.paint(context));
    const box = run.facts.bbox;
    this.viewport.fit(run.model ? [run.box[0], run.box[1], run.box[3], run.box[4]] : [box[0], box[1], box[3], box[4]]);
  }

  redraw() {
    this.viewport.redraw();
  }

  paint(context) {
    const { state } = this;
    if (state.raster) {
      this.paintRaster(context, state.raster);
    }
    if (this.run.complex && state.slice.layer >= 0) {
      this.paintCells(context);
    }
    if (state.show.points && state.block) {
      this.paintCentroids(context, state.block);
    }
    if (state.show.lines) {
      this.paintLines(context, state.lines, false);
    }
    if (state.show.refined) {
      this.paintLines(context, state.refined, true);
    }
    if (state.show.openings) {
      this.paintOpenings(context);
    }
    if (state.show.rooms && this.run.storeys) {
      this.paintRooms(context);
    }
    if (this.run.complex && state.selected) {
      this.paintSelection(context);
    }
    for (const overlay of this.overlays) {
      overlay(context);
    }
  }

  paintRaster(context, { canvas, low, high }) {
    const tau = this.run.facts.tau_m;
    const [left, top] = this.viewport.toPixels([low[0] * tau, high[1] * tau]);
    const [right, bottom] = this.viewport.toPixels([high[0] * tau, low[1] * tau]);
    context.imageSmoothingEnabled = false;
    context.drawImage(canvas, left, top, right - left, bottom - top);
  }

  tracePolygon(context, corners) {
    context.beginPath();
    corners.forEach((corner, i) => {
      const [x, y] = this.viewport.toPixels(corner);
      if (i === 0) {
        context.moveTo(x, y);
      } else {
        context.lineTo(x, y);
      }
    });
    context.closePath();
  }

  paintCells(context) {
    const { complex } = this.run;
    const { layer } = this.state.slice;
    const { fill, raster } = this.state;
    context.globalAlpha = raster ? 0.55 : 1;
    for (let f = 0; f < complex.faces; ++f) {
      const colour = fill.colourOf(complex.cell(f, layer));
      if (colour) {
        this.tracePolygon(context, complex.corners(f));
        context.fillStyle = colour;
        context.fill();
      }
    }
    context.globalAlpha = 1;
    if (fill.name !== "none" || this.state.show.edges) {
      for (let e = 0; e < complex.edges; ++e) {
        this.paintEdge(context, e, layer);
      }
    }
  }

  paintSelection(context) {
    const { complex } = this.run;
    const { selected } = this.state;
    const { layer } = this.state.slice;
    if (selected?.cell !== undefined && Math.floor(selected.cell / complex.faces) === layer) {
      this.tracePolygon(context, complex.corners(selected.cell % complex.faces));
      context.strokeStyle = kSelected;
      context.lineWidth = 3;
      context.stroke();
    }
    if (selected?.edge !== undefined && selected.layer === layer) {
      const { a, b } = complex.edge(selected.edge);
      this.paintSegment(context, a, b, kSelected, 5);
    }
  }

  paintEdge(context, e, layer) {
    const { complex } = this.run;
    const { a, b, left, right } = complex.edge(e);
    const wall = complex.isEmpty(left, layer) !== complex.isEmpty(right, layer);
    this.paintSegment(context, a, b, wall ? kWallEdge : kThinEdge, wall ? 2 : 0.5);
  }

  paintSegment(context, a, b, colour, width, dash = []) {
    const [ax, ay] = this.viewport.toPixels(a);
    const [bx, by] = this.viewport.toPixels(b);
    context.beginPath();
    context.moveTo(ax, ay);
    context.lineTo(bx, by);
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
  }

  /** Openings that reach into the slice: the wall is open between the two jambs. */
  paintOpenings(context) {
    const { slice, selected } = this.state;
    for (const { id, a, b, thickness, sill, head } of this.state.openings) {
      if (sill < slice.high && head > slice.low) {
        const colour = selected?.opening === id ? kSelected : kOpening;
        const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
        const across = [(-(b[1] - a[1]) / length) * (thickness / 2), ((b[0] - a[0]) / length) * (thickness / 2)];
        const shifted = ([x, y], side) => [x + side * across[0], y + side * across[1]];
        this.tracePolygon(context, [shifted(a, 1), shifted(b, 1), shifted(b, -1), shifted(a, -1)]);
        context.fillStyle = "#ffffff";
        context.fill();
        context.strokeStyle = colour;
        context.lineWidth = selected?.opening === id ? 3 : 2;
        context.stroke();
      }
    }
  }

  /** Number and area of each room, in the middle of its largest cell of this layer. */
  paintRooms(context) {
    const { complex, storeys } = this.run;
    const { layer } = this.state.slice;
    const largest = new Map();
    for (let f = 0; layer >= 0 && f < complex.faces; ++f) {
      const room = storeys.room[complex.cell(f, layer)];
      if (room >= 0 && !(complex.areas[f] <= (largest.has(room) ? complex.areas[largest.get(room)] : 0))) {
        largest.set(room, f);
      }
    }
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    for (const [room, face] of largest) {
      const corners = complex.corners(face);
      const middle = [0, 1].map((axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length);
      const [x, y] = this.viewport.toPixels(middle);
      const words = `room ${room}: ${storeys.rooms[room].area.toFixed(1)} m²`;
      context.fillStyle = "#ffffffc8";
      const width = context.measureText(words).width + 8;
      context.fillRect(x - width / 2, y - 10, width, 17);
      context.fillStyle = kQuiet;
      context.fillText(words, x, y + 3);
    }
    context.textAlign = "start";
  }

  paintCentroids(context, block) {
    const size = Math.max(1.2, Math.min(3, 0.01 * this.viewport.scale));
    context.fillStyle = "#1f2428";
    const { width, height } = this.viewport;
    for (let i = 0; i < block.x.length; ++i) {
      const [x, y] = this.viewport.toPixels([block.x[i], block.y[i]]);
      if (x > -2 && y > -2 && x < width + 2 && y < height + 2) {
        context.fillRect(x - size / 2, y - size / 2, size, size);
      }
    }
  }

  paintLines(context, lines, dashed) {
    const { slice, selected } = this.state;
    lines.forEach((line, i) => {
      const inSlice = !line.properties.levels || line.properties.levels.includes(slice.index);
      const isSelected = selected?.line === line.id;
      context.globalAlpha = inSlice ? 1 : 0.25;
      const colour = isSelected ? kSelected : dashed ? "#000000" : kLineColours[i % kLineColours.length];
      this.paintSegment(context, line.a, line.b, colour, isSelected ? 4 : dashed ? 1 : 2, dashed ? [6, 4] : []);
      context.globalAlpha = 1;
    });
  }
}
