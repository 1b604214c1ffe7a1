// SPDX-License-Identifier: GPL-3.0-or-later
// The part "Model": the 3D view with its tools.

import { byId, make, number } from "../dom.js";
import { cloudPoints, cloudViews, drawLegend, faceColourings, modelColourings } from "./colourings.js";
import { ModelScene } from "./scene.js";
import { faceSurface, modelSurface } from "./surfaces.js";

/**
 * @param run the loaded data (data/run.js)
 * @param {(cell: number, face: ?object) => void} onPick called when a face is clicked; its evidence where the colouring shows faces
 * @returns {?ModelScene} null when there is no model
 */
export function showModelPanel(run, onPick) {
  const host = byId("model-canvas");
  if (!run.model) {
    host.append(make("p", { class: "quiet", text: "There is no model yet: make run goes on." }));
    return null;
  }
  const scene = new ModelScene(host, run.box);
  const legend = byId("model-legend");

  const model = { block: run.model, surface: modelSurface(run.model) };
  const faces = run.complex ? faceSurface(run.complex, run.storeys.storey) : null;
  const colourings = [...modelColourings(model), ...(faces ? faceColourings(run.complex, faces) : [])];
  const state = { colouring: colourings[0], storey: -1 };
  const update = () => {
    scene.show(state.colouring.surface, state.storey, state.colouring.colourOf);
    drawLegend(legend, state.colouring.legend);
  };

  byId("model-tools").append(
    storeyButtons(run, (storey) => {
      state.storey = storey;
      update();
    }),
    make(
      "label",
      {},
      "Colour",
      selection("model-colour", colourings.map(({ name }) => name), (i) => {
        state.colouring = colourings[i];
        update();
      }),
    ),
    cutSlider(run, scene),
    run.cloud ? cloudSelection(run, scene) : null,
    make(
      "label",
      {},
      make("input", { type: "checkbox", id: "model-sides", onchange: (event) => scene.bothSides(event.target.checked) }),
      "walls from outside too",
    ),
    make(
      "span",
      { class: "group" },
      make("button", { type: "button", text: "From above", onclick: () => scene.look(0, -0.001, 1) }),
      make("button", { type: "button", text: "Slanted", onclick: () => scene.look(-0.6, -1, 0.9) }),
    ),
  );
  onPicks(scene, (hit) => {
    if (hit && run.complex) {
      const face = scene.shown.surface === faces ? faces.faces[faces.part[hit.triangle]] : null;
      const cell = face ? face.cell : cellAt(run.complex, hit.inside);
      if (cell >= 0) {
        onPick(cell, face);
      }
    }
  });
  update();
  return scene;
}

function storeyButtons(run, choose) {
  const group = make("span", { class: "group", role: "group", "aria-label": "Storey" });
  const storeys = [...new Set(run.model.storey)].sort((a, b) => a - b);
  for (const storey of [-1, ...storeys]) {
    const button = make("button", {
      type: "button",
      "data-storey": String(storey),
      "aria-pressed": String(storey < 0),
      text: storey < 0 ? "All storeys" : `Storey ${storey}`,
      onclick: () => {
        for (const other of group.children) {
          other.setAttribute("aria-pressed", String(other === button));
        }
        choose(storey);
      },
    });
    group.append(button);
  }
  return group;
}

export function selection(id, names, choose) {
  return make(
    "select",
    { id, onchange: (event) => choose(event.target.selectedIndex) },
    ...names.map((text) => make("option", { text })),
  );
}

function cutSlider(run, scene) {
  const [low, high] = [run.box[2], run.box[5]];
  const value = make("output", { text: "off" });
  const slider = make("input", {
    type: "range",
    id: "model-cut",
    min: String(low),
    max: String(high + 0.01),
    step: "0.01",
    value: String(high + 0.01),
    oninput: () => {
      const z = Number(slider.value);
      value.textContent = z >= high ? "off" : `${number(z)} m`;
      scene.cutAt(z >= high ? high + 1 : z);
    },
  });
  return make("label", {}, "Cut at", slider, value);
}

function cloudSelection(run, scene) {
  const views = [null, ...cloudViews(run.cloud)];
  return make(
    "label",
    {},
    "Scan",
    selection("model-cloud", views.map((view) => view?.name ?? "off"), (i) => {
      const { positions, colours } = views[i] ? cloudPoints(run.cloud, views[i]) : { positions: null, colours: null };
      scene.showCloud(positions, colours);
    }),
  );
}

function cellAt(complex, { x, y, z }) {
  const face = complex.faceAt(x, y);
  const layer = complex.levels.findIndex((level, k) => k < complex.layers && z >= level && z < complex.levels[k + 1]);
  return face < 0 || layer < 0 ? -1 : complex.cell(face, layer);
}

/** Calls back for clicks, not for the ends of drags, and for the middle of the view with the enter key. */
function onPicks(scene, pick) {
  const canvas = scene.renderer.domElement;
  let down = null;
  canvas.addEventListener("pointerdown", (event) => {
    down = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointerup", (event) => {
    if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) {
      pick(scene.pick(event.clientX, event.clientY));
    }
  });
  canvas.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      pick(scene.pickMiddle());
    }
  });
}
