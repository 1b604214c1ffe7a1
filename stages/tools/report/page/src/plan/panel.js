// SPDX-License-Identifier: GPL-3.0-or-later
// The part "Plan": one slice from above, with its tools, and why what was clicked came out so.

import { named } from "../colours.js";
import { byId, make } from "../dom.js";
import { loadSlice, openingsOf, slicesOf, wallLines } from "../data/run.js";
import { drawLegend } from "../model/colourings.js";
import { cellFills } from "./fills.js";
import { distanceToSegment, nearestLine, nearestWallFace } from "./pick.js";
import { rasterOf } from "./rasters.js";
import { buildTools } from "./tools.js";
import { PlanView } from "./view.js";
import { whyCell, whyLine, whyOpening, whyWallFace } from "./why.js";

const kPickPixels = 6;

export class PlanPanel {
  constructor(run) {
    this.run = run;
    this.slices = slicesOf(run);
    this.why = byId("plan-why");
    if (this.slices.length === 0) {
      byId("plan-canvas").append(make("p", { class: "quiet", text: "There are no slices yet: make run goes on." }));
      return;
    }
    this.fills = run.complex ? cellFills(run.complex) : [{ name: "none", legend: {}, colourOf: () => null }];
    this.state = {
      slice: this.slices[0],
      block: null,
      evidence: "occupancy",
      raster: null,
      fill: this.fills[Math.min(1, this.fills.length - 1)],
      show: { lines: true, refined: false, points: false, openings: true, rooms: true },
      lines: wallLines(run.lines.lines ?? run.lines.detected),
      refined: wallLines(run.lines.refined),
      openings: openingsOf(run.lines.openings),
      selected: null,
    };
    this.view = new PlanView(byId("plan-canvas"), run, this.state);
    this.legend = byId("plan-legend");
    buildTools(this);
    this.listen();
    this.select(null);
    this.choose(this.bestSlice());
  }

  /** The highest slice of the lowest storey: the first that is worth looking at. */
  bestSlice() {
    const { complex } = this.run;
    const filled = (slice) => {
      let volume = 0;
      for (let f = 0; complex && slice.layer >= 0 && f < complex.faces; ++f) {
        volume += complex.isEmpty(f, slice.layer) ? complex.areas[f] * (slice.high - slice.low) : 0;
      }
      return volume;
    };
    return this.slices.reduce((best, slice) => (filled(slice) > filled(best) ? slice : best), this.slices[0]);
  }

  async choose(slice) {
    this.state.slice = slice;
    this.sliceSelect.selectedIndex = slice.index;
    this.state.block = await loadSlice(this.run, slice.index);
    this.updateRaster();
  }

  step(by) {
    const next = this.slices[this.state.slice.index + by];
    return next ? this.choose(next) : Promise.resolve();
  }

  updateRaster() {
    const { evidence, block } = this.state;
    this.state.raster = evidence && block ? rasterOf(block, evidence) : null;
    this.updateLegend();
    this.view.redraw();
  }

  updateLegend() {
    const swatches = [...(this.state.fill.legend.swatches ?? [])];
    if (this.state.evidence === "walls") {
      swatches.push([named("blue"), "piece of a wall"], [named("orange"), "clutter"]);
    } else if (this.state.evidence === "occupancy") {
      swatches.push(["#1e1e1e", "points over all of the height"], ["#e1e1e1", "over little of it"]);
    }
    if (this.state.show.openings && this.state.openings.length > 0) {
      swatches.push([named("green"), "opening"]);
    }
    drawLegend(this.legend, { ...this.state.fill.legend, swatches });
  }

  listen() {
    const { viewport } = this.view;
    const { canvas } = viewport;
    canvas.setAttribute("aria-label", "Plan. Arrow keys move, plus and minus zoom, page up and down change the slice, enter says why of what lies in the middle.");
    let last = null;
    let moved = 0;
    canvas.addEventListener("pointerdown", (event) => {
      if (this.tool?.down(event)) {
        return;
      }
      last = [event.clientX, event.clientY];
      moved = 0;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (this.tool?.move(event) || !last) {
        return;
      }
      const [dx, dy] = [event.clientX - last[0], event.clientY - last[1]];
      moved += Math.hypot(dx, dy);
      last = [event.clientX, event.clientY];
      viewport.pan(dx, dy);
    });
    canvas.addEventListener("pointerup", (event) => {
      if (this.tool?.up(event)) {
        return;
      }
      if (last && moved < 4) {
        this.pick(viewport.toPlan(viewport.pixelsOf(event)));
      }
      last = null;
    });
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    if (this.tool?.key(event)) {
      event.preventDefault();
      return;
    }
    const { viewport } = this.view;
    const keys = {
      ArrowLeft: () => viewport.pan(60, 0),
      ArrowRight: () => viewport.pan(-60, 0),
      ArrowUp: () => viewport.pan(0, 60),
      ArrowDown: () => viewport.pan(0, -60),
      "+": () => viewport.zoom(1.25),
      "=": () => viewport.zoom(1.25),
      "-": () => viewport.zoom(0.8),
      PageUp: () => this.step(1),
      PageDown: () => this.step(-1),
      Enter: () => this.pick(viewport.centre),
    };
    if (keys[event.key] && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      keys[event.key]();
    }
  }

  pick(point) {
    const limit = kPickPixels / this.view.viewport.scale;
    const { complex } = this.run;
    const { slice, show, lines } = this.state;
    const opening = show.openings ? this.openingAt(point) : null;
    if (opening) {
      this.select({ opening: opening.id });
      return;
    }
    const line = show.lines ? nearestLine(lines, point, limit) : null;
    if (line) {
      this.select({ line: line.id });
      return;
    }
    if (!complex || slice.layer < 0) {
      this.select(null);
      return;
    }
    const edge = nearestWallFace(complex, slice.layer, point, limit);
    if (edge >= 0) {
      this.select({ edge, layer: slice.layer });
      return;
    }
    const face = complex.faceAt(...point);
    this.select(face < 0 ? null : { cell: complex.cell(face, slice.layer) });
  }

  openingAt(point) {
    const { slice, openings } = this.state;
    const inside = openings.filter(({ a, b, thickness, sill, head }) => sill < slice.high && head > slice.low && distanceToSegment(point, a, b) <= thickness / 2);
    return inside[0] ?? null;
  }

  /** Shows why: `what` is {line}, {edge, layer}, {cell}, {opening} or null. */
  select(what) {
    this.state.selected = what;
    this.view.redraw();
    this.why.replaceChildren(...this.words(what));
  }

  words(what) {
    const { complex } = this.run;
    if (what?.line !== undefined) {
      const line = this.state.lines.find(({ id }) => id === what.line);
      const known = this.run.lines.refined ? (this.state.refined.find(({ id }) => id === what.line) ?? null) : undefined;
      return whyLine(line, known);
    }
    if (what?.opening !== undefined) {
      const joined = (this.run.facts.summary?.openings ?? []).find((entry) => entry.opening_id === what.opening);
      return whyOpening(this.state.openings.find(({ id }) => id === what.opening), joined);
    }
    if (what?.edge !== undefined) {
      return whyWallFace(complex, what.edge, what.layer);
    }
    if (what?.cell !== undefined) {
      return whyCell(complex, what.cell, roomOf(this.run, what.cell), unknownSpaceOf(this.run, what.cell));
    }
    return [make("p", { class: "quiet", text: "Click a cell, a wall or a line: here it says why it came out so." })];
  }
}

/** The unknown space of the summary that a cell belongs to, or null. */
export function unknownSpaceOf(run, cell) {
  const space = run.complex?.block.unknown_space?.[cell] ?? -1;
  return run.facts.summary?.unknown_spaces?.[space] ?? null;
}

/** The room of the summary that a cell belongs to, or null. */
export function roomOf(run, cell) {
  const room = run.storeys?.room[cell] ?? -1;
  const rooms = run.facts.summary?.rooms ?? [];
  return rooms[room] ?? null;
}
