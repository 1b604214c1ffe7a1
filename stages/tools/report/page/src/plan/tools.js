// SPDX-License-Identifier: GPL-3.0-or-later
// The tools above the plan: which slice, what is drawn.

import { byId, make } from "../dom.js";
import { selection } from "../model/panel.js";

/** Fills the row of tools above the plan. */
export function buildTools(panel) {
  const check = (name, key) =>
    make(
      "label",
      {},
      make("input", {
        type: "checkbox",
        id: `plan-${key}`,
        ...(panel.state.show[key] ? { checked: true } : {}),
        onchange: (event) => {
          panel.state.show[key] = event.target.checked;
          panel.view.redraw();
        },
      }),
      name,
    );
  const evidence = [["occupancy", "occupancy"], ["walls and clutter", "walls"], ["none", null]];
  panel.sliceSelect = selection("plan-slice", panel.slices.map(({ name }) => name), (i) => panel.choose(panel.slices[i]));
  byId("plan-tools").append(
    make(
      "span",
      { class: "group" },
      make("label", {}, "Slice", panel.sliceSelect),
      make("button", { type: "button", text: "▲", "aria-label": "Slice above", id: "plan-up", onclick: () => panel.step(1) }),
      make("button", { type: "button", text: "▼", "aria-label": "Slice below", id: "plan-down", onclick: () => panel.step(-1) }),
    ),
    make("label", {}, "Evidence", selection("plan-evidence", evidence.map(([name]) => name), (i) => {
      panel.state.evidence = evidence[i][1];
      panel.updateRaster();
    })),
    make("label", {}, "Cells", fillSelect(panel)),
    check("wall lines", "lines"),
    check("refined lines", "refined"),
    check("points", "points"),
    check("openings", "openings"),
    check("rooms", "rooms"),
    make("button", { type: "button", text: "Fit", onclick: () => panel.view.viewport.fit(panel.view.viewport.box) }),
  );
}

function fillSelect(panel) {
  const select = selection("plan-fill", panel.fills.map(({ name }) => name), (i) => {
    panel.state.fill = panel.fills[i];
    panel.updateLegend();
    panel.view.redraw();
  });
  select.selectedIndex = panel.fills.indexOf(panel.state.fill);
  return select;
}
