// SPDX-License-Identifier: GPL-3.0-or-later
// A canvas with metres: pan, zoom, and the way from the window to the plan and back. y is up in the plan, down on the canvas.

const kZoomPerPixel = 0.0015;
const kPrinted = [1200, 800]; // pixels of a plan that was never on the screen

export class Viewport {
  /** @param {HTMLElement} host @param {(context: CanvasRenderingContext2D) => void} paint draws, in pixels of the window */
  constructor(host, paint) {
    this.paint = paint;
    this.canvas = document.createElement("canvas");
    this.canvas.tabIndex = 0;
    host.append(this.canvas);
    this.scale = 50; // pixels per metre
    this.centre = [0, 0];
    this.host = host;
    new ResizeObserver(() => {
      // A part that is not shown has no size; its last picture stays, for the printer.
      if (host.clientWidth > 0) {
        this.resize();
      }
    }).observe(host);
    window.addEventListener("beforeprint", () => this.drawForPrint());
    this.canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  get width() {
    return this.printed?.[0] ?? this.host.clientWidth;
  }
  get height() {
    return this.printed?.[1] ?? this.host.clientHeight;
  }

  /** Pixels of the canvas of a point of the plan. */
  toPixels([x, y]) {
    return [this.width / 2 + (x - this.centre[0]) * this.scale, this.height / 2 - (y - this.centre[1]) * this.scale];
  }
  /** The point of the plan under pixels of the canvas. */
  toPlan([px, py]) {
    return [this.centre[0] + (px - this.width / 2) / this.scale, this.centre[1] - (py - this.height / 2) / this.scale];
  }
  pixelsOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** Shows a box of the plan whole. */
  fit([lowX, lowY, highX, highY]) {
    this.box = [lowX, lowY, highX, highY];
    this.centre = [(lowX + highX) / 2, (lowY + highY) / 2];
    if (this.width > 0) {
      this.scale = 0.92 * Math.min(this.width / (highX - lowX), this.height / (highY - lowY));
      this.fitted = true;
    }
    this.redraw();
  }

  pan(dx, dy) {
    this.centre = [this.centre[0] - dx / this.scale, this.centre[1] + dy / this.scale];
    this.redraw();
  }

  zoom(factor, pixels = [this.width / 2, this.height / 2]) {
    const fixed = this.toPlan(pixels);
    this.scale = Math.min(1e4, Math.max(0.5, this.scale * factor));
    const now = this.toPlan(pixels);
    this.centre = [this.centre[0] + fixed[0] - now[0], this.centre[1] + fixed[1] - now[1]];
    this.redraw();
  }

  wheel(event) {
    event.preventDefault();
    this.zoom(Math.exp(-event.deltaY * kZoomPerPixel), this.pixelsOf(event));
  }

  resize() {
    const ratio = window.devicePixelRatio;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(this.height * ratio);
    if (!this.fitted && this.box) {
      this.fit(this.box);
    }
    this.drawNow(); // a new size clears the canvas
  }

  drawForPrint() {
    if (!this.fitted) {
      this.printed = kPrinted;
      this.resize();
      this.printed = null;
      this.fitted = false;
    }
  }

  redraw() {
    if (!this.asked) {
      this.asked = true;
      requestAnimationFrame(() => {
        this.asked = false;
        this.drawNow();
      });
    }
  }

  drawNow() {
    const context = this.canvas.getContext("2d");
    const ratio = window.devicePixelRatio;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, this.width, this.height);
    this.paint(context);
  }
}
