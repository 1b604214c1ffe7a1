// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the plan of one slice: evidence, cells, wall lines. What is drawn is decided by `state`; panel.js changes it.

import { categorical, named } from "../colours.js";
import { paintOpenings, paintRooms } from "./annotations.js";
import { Viewport } from "./viewport.js";

const kWallEdge = "#141414";
const kThinEdge = "#b4b4b4";
const kLineColours = 5; // of the row; the next one is that of what is selected or moved

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
      paintOpenings(context, this);
    }
    if (state.show.rooms && this.run.storeys) {
      paintRooms(context, this);
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
    if (selected?.cell !== undefined && complex.layerOf(selected.cell) === layer) {
      this.tracePolygon(context, complex.corners(complex.faceOf(selected.cell)));
      context.strokeStyle = named("vermilion");
      context.lineWidth = 3;
      context.stroke();
    }
    if (selected?.edge !== undefined && selected.layer === layer) {
      const { a, b } = complex.edge(selected.edge);
      this.paintSegment(context, a, b, named("vermilion"), 5);
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
      const colour = isSelected ? named("vermilion") : dashed ? "#000000" : categorical(i % kLineColours);
      this.paintSegment(context, line.a, line.b, colour, isSelected ? 4 : dashed ? 1 : 2, dashed ? [6, 4] : []);
      context.globalAlpha = 1;
    });
  }
}
