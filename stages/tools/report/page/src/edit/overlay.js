// SPDX-License-Identifier: GPL-3.0-or-later
// What editing draws over the plan: where lines were, handles, locks, the points near the selected line.

import { named } from "../colours.js";

const kBefore = "#5b6770";
const kHandle = 5; // pixels

/** Draws with the plan's view; `tool` is the EditTool. */
export function paintEditing(context, view, tool) {
  const { viewport } = view;
  const before = new Map(tool.document.original.map((line) => [line.key, line]));
  for (const line of tool.lines) {
    const old = before.get(line.key);
    if (!old || old.a !== line.a || old.b !== line.b) {
      if (old) {
        view.paintSegment(context, old.a, old.b, kBefore, 1.5, [4, 3]);
      }
      view.paintSegment(context, line.a, line.b, named("vermilion"), 3);
    }
    if (line.locked) {
      paintLock(context, viewport.toPixels([(line.a[0] + line.b[0]) / 2, (line.a[1] + line.b[1]) / 2]));
    }
  }
  for (const [key, old] of before) {
    if (!tool.lines.some((line) => line.key === key)) {
      view.paintSegment(context, old.a, old.b, kBefore, 1.5, [2, 4]);
    }
  }
  const fit = tool.fit();
  if (fit) {
    paintPoints(context, view, fit.shown);
    paintSelected(context, view, fit.line);
  }
  if (tool.drag?.said) {
    paintWords(context, tool.drag.at, tool.drag.said);
  }
}

function paintPoints(context, view, shown) {
  const { block } = view.state;
  context.fillStyle = "#000000";
  for (const i of shown) {
    const [x, y] = view.viewport.toPixels([block.x[i], block.y[i]]);
    context.fillRect(x - 1, y - 1, 2, 2);
  }
}

function paintSelected(context, view, line) {
  view.paintSegment(context, line.a, line.b, named("vermilion"), 3);
  for (const end of [line.a, line.b]) {
    const [x, y] = view.viewport.toPixels(end);
    context.fillStyle = "#ffffff";
    context.strokeStyle = named("vermilion");
    context.lineWidth = 2;
    context.fillRect(x - kHandle, y - kHandle, 2 * kHandle, 2 * kHandle);
    context.strokeRect(x - kHandle, y - kHandle, 2 * kHandle, 2 * kHandle);
  }
}

function paintLock(context, [x, y]) {
  context.fillStyle = "#1f2428";
  context.fillRect(x - 5, y - 2, 10, 8);
  context.strokeStyle = "#1f2428";
  context.lineWidth = 1.8;
  context.beginPath();
  context.arc(x, y - 2, 3.2, Math.PI, 0);
  context.stroke();
}

function paintWords(context, [x, y], words) {
  context.font = "13px system-ui, sans-serif";
  const width = context.measureText(words).width;
  context.fillStyle = "#ffffffee";
  context.fillRect(x + 10, y - 24, width + 10, 20);
  context.fillStyle = "#1f2428";
  context.fillText(words, x + 15, y - 10);
}
