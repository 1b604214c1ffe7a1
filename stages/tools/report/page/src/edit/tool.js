// SPDX-License-Identifier: GPL-3.0-or-later
// Editing with the pointer and the keyboard, in the canvas of the plan.

import { nearestLine } from "../plan/pick.js";
import { lengthOf, shifted } from "./document.js";
import { fitOf, snapDirection, snapLength, snapOffset } from "./snap.js";

const kEndPixels = 10;
const kLinePixels = 7;
const kSnapPixels = 8;
const kStep = 0.001; // [m] a wall is moved by whole millimetres
const kFitBand = 0.03; // [m] points this near to a line count as its own
const kShortest = 0.05; // [m] a line shorter than this is a slip of the hand

const round = (value) => Math.round(value / kStep) * kStep;

export class EditTool {
  /**
   * @param panel the plan's panel
   * @param {import("./document.js").LineDocument} document
   * @param {() => void} onChange called after each step, and while dragging
   */
  constructor(panel, document, onChange) {
    this.panel = panel;
    this.document = document;
    this.onChange = onChange;
    this.selected = null;
    this.adding = false;
    this.drag = null;
  }

  get viewport() {
    return this.panel.view.viewport;
  }
  /** The lines as they are to be drawn: with what is being dragged. */
  get lines() {
    return this.drag?.lines ?? this.document.lines;
  }
  line() {
    return this.lines.find(({ key }) => key === this.selected) ?? null;
  }
  others(key) {
    return this.document.lines.filter((line) => line.key !== key);
  }

  down(event) {
    if (event.button !== 0) {
      return false;
    }
    const point = this.viewport.toPlan(this.viewport.pixelsOf(event));
    if (this.adding) {
      this.begin(event, { kind: "add", from: point });
      return true;
    }
    const end = this.endUnder(point);
    if (end) {
      this.begin(event, { kind: "end", end });
      return true;
    }
    const line = nearestLine(this.document.lines, point, kLinePixels / this.viewport.scale);
    if (!line) {
      this.select(null);
      return false;
    }
    this.select(line.key);
    this.begin(event, { kind: "body", from: point });
    return true;
  }

  begin(event, drag) {
    this.drag = { ...drag, start: [event.clientX, event.clientY], lines: this.document.lines, said: "" };
    this.viewport.canvas.setPointerCapture(event.pointerId);
  }

  endUnder(point) {
    const line = this.document.find(this.selected);
    const limit = kEndPixels / this.viewport.scale;
    return line ? (["a", "b"].find((end) => Math.hypot(line[end][0] - point[0], line[end][1] - point[1]) <= limit) ?? null) : null;
  }

  move(event) {
    if (!this.drag) {
      return false;
    }
    if (Math.hypot(event.clientX - this.drag.start[0], event.clientY - this.drag.start[1]) > 3) {
      this.drag.begun = true; // less is a click, not a drag
    }
    if (this.drag.begun) {
      const point = this.viewport.toPlan(this.viewport.pixelsOf(event));
      this.drag.at = this.viewport.pixelsOf(event);
      this[{ body: "dragBody", end: "dragEnd", add: "dragNew" }[this.drag.kind]](point, !event.altKey);
      this.onChange();
    }
    return true;
  }

  dragBody(point, snapping) {
    const line = this.document.find(this.selected);
    const length = lengthOf(line);
    const normal = [-(line.b[1] - line.a[1]) / length, (line.b[0] - line.a[0]) / length];
    const { from } = this.drag;
    let offset = round(normal[0] * (point[0] - from[0]) + normal[1] * (point[1] - from[1]));
    const snap = snapping ? snapOffset(line, offset, this.others(line.key), kSnapPixels / this.viewport.scale) : null;
    offset = snap?.offset ?? offset;
    this.drag.lines = this.document.with(line.key, shifted(line, offset));
    this.drag.said = `${offset >= 0 ? "+" : "−"}${Math.abs(offset).toFixed(3)} m${snap ? `, in one row with ${snap.to}` : ""}`;
  }

  dragEnd(point, snapping) {
    const line = this.document.find(this.selected);
    const fixed = this.drag.end === "a" ? line.b : line.a;
    const { to, said } = this.rayTo(fixed, point, snapping, line.key);
    this.drag.lines = this.document.with(line.key, { [this.drag.end]: to });
    this.drag.said = said;
  }

  dragNew(point, snapping) {
    const { to, said } = this.rayTo(this.drag.from, point, snapping, null);
    this.drag.to = to;
    this.drag.said = said;
  }

  /** Where a line from `from` to the pointer ends: direction and length snapped. */
  rayTo(from, point, snapping, key) {
    let angle = Math.atan2(point[1] - from[1], point[0] - from[0]);
    const others = this.others(key);
    const direction = snapping ? snapDirection(angle, others) : null;
    const pulled = direction?.angle ?? angle;
    let length = Math.hypot(point[0] - from[0], point[1] - from[1]) * Math.cos(angle - pulled);
    angle = pulled;
    const meets = snapping ? snapLength(from, angle, length, others, kSnapPixels / this.viewport.scale) : null;
    length = meets?.length ?? length;
    const words = [`${length.toFixed(3)} m`, direction ? `${direction.how} to ${direction.to}` : "", meets ? `meets ${meets.to}` : ""];
    return { to: [from[0] + length * Math.cos(angle), from[1] + length * Math.sin(angle)], said: words.filter(Boolean).join(", ") };
  }

  up() {
    const { drag } = this;
    if (!drag) {
      return false;
    }
    this.drag = null;
    if (drag.begun && drag.kind === "add") {
      if (drag.to && lengthOf({ a: drag.from, b: drag.to }) >= kShortest) {
        this.select(this.document.add(drag.from, drag.to));
      }
      this.adding = false;
    } else if (drag.begun) {
      const line = drag.lines.find(({ key }) => key === this.selected);
      if (lengthOf(line) >= kShortest) {
        this.document.commit(drag.lines);
      }
    }
    this.onChange();
    return true;
  }

  select(key) {
    this.selected = key;
    this.onChange(); // first: the plan must know a line that has just been drawn
    this.panel.select(key === null ? null : { line: key });
  }

  /** @returns {boolean} whether the key meant something here */
  key(event) {
    const command = event.ctrlKey || event.metaKey;
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (command && (name === "z" || name === "y")) {
      this.step(name === "y" || event.shiftKey);
      return true;
    }
    if (command || event.altKey) {
      return this.selected !== null && this.nudge(event, name);
    }
    const actions = {
      Escape: () => this.escape(),
      a: () => this.startAdding(),
      n: () => this.selectNext(1),
      p: () => this.selectNext(-1),
      Delete: () => this.remove(),
      Backspace: () => this.remove(),
      l: () => this.toggleLock(),
    };
    if (actions[name]) {
      actions[name]();
      return true;
    }
    return this.selected !== null && this.nudge(event, name);
  }

  /** Arrow keys move the selected wall: 1 cm, with shift 10 cm, with control 1 mm. */
  nudge(event, name) {
    const way = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowRight: [1, 0], ArrowLeft: [-1, 0] }[name];
    const line = this.document.find(this.selected);
    if (!way || !line) {
      return false;
    }
    const across = -(line.b[1] - line.a[1]) * way[0] + (line.b[0] - line.a[0]) * way[1];
    const size = event.shiftKey ? 0.1 : event.ctrlKey ? 0.001 : 0.01;
    if (Math.abs(across) > 0.1 * lengthOf(line)) {
      this.document.shift(line.key, Math.sign(across) * size);
      this.onChange();
    }
    return true;
  }

  escape() {
    this.drag = null;
    this.adding = false;
    this.select(null);
  }
  startAdding() {
    this.adding = true;
    this.select(null);
  }
  selectNext(by) {
    const { lines } = this.document;
    const at = lines.findIndex(({ key }) => key === this.selected);
    this.select(lines[(at + by + lines.length) % lines.length]?.key ?? null);
  }
  remove() {
    if (this.selected !== null) {
      this.document.remove(this.selected);
      this.select(null);
    }
  }
  toggleLock() {
    const line = this.document.find(this.selected);
    if (line) {
      this.document.setLocked(line.key, !line.locked);
      this.onChange();
    }
  }
  moveBy(metres) {
    if (this.selected !== null && Number.isFinite(metres) && metres !== 0) {
      this.document.shift(this.selected, metres);
      this.onChange();
    }
  }
  step(forward) {
    if (forward) {
      this.document.redo();
    } else {
      this.document.undo();
    }
    if (this.selected !== null && !this.document.find(this.selected)) {
      this.select(null);
    }
    this.onChange();
  }

  /** How the selected line fits the points of the slice shown, or null. */
  fit() {
    const { block } = this.panel.state;
    const line = this.drag?.kind === "add" && this.drag.to ? { a: this.drag.from, b: this.drag.to } : this.line();
    return line && block ? { line, ...fitOf(line, block, kFitBand) } : null;
  }
}
