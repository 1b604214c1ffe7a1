// SPDX-License-Identifier: GPL-3.0-or-later

import { loadRun } from "./data/run.js";
import { byId, make } from "./dom.js";
import { worstMargin } from "./data/energy.js";
import { EditPanel } from "./edit/panel.js";
import { findPlace } from "./edit/place.js";
import { findServer } from "./edit/server.js";
import { showModelPanel } from "./model/panel.js";
import { PlanPanel, roomOf, unknownSpaceOf } from "./plan/panel.js";
import { whyCell, whyWallFace } from "./plan/why.js";
import { showHistogram } from "./tables/histogram.js";
import { showRooms } from "./tables/rooms.js";
import { showStages } from "./tables/stages.js";
import { openPart, startTabs } from "./tabs.js";
import { kWall } from "./model/surfaces.js";

/** The name of the work folder, as the address tells it. */
function workName() {
  const parts = decodeURIComponent(window.location.pathname).split("/");
  return parts[parts.length - 2] ?? "";
}

function showName(name) {
  byId("work").textContent = name;
  document.title = `${name} – roomcut report`;
}

/** Why a face of the model came out so: beside the 3D view, with a way to the plan. */
function showFace(run, plan, cell, face) {
  const host = byId("model-why");
  if (cell === null) {
    host.replaceChildren(make("p", { class: "quiet", text: "Click a face: here it says why the room behind it came out empty. Coloured by coverage, margin or an evidence, also what covers the face." }));
    return;
  }
  const { complex } = run;
  const layer = complex.layerOf(cell);
  host.replaceChildren(
    make("button", {
      type: "button",
      text: "Show in the plan",
      onclick: async () => {
        const slice = plan.slices.find((candidate) => candidate.layer === layer);
        openPart("plan");
        if (slice) {
          await plan.choose(slice);
        }
        plan.select({ cell });
      },
    }),
    ...(face?.kind === kWall ? whyWallFace(complex, face.index - complex.wallFace(0, layer), layer) : []),
    ...whyCell(complex, cell, roomOf(run, cell), unknownSpaceOf(run, cell)),
  );
}

/** Editing begins from the edit in the work folder when it can be had, else from the lines that were accepted. */
async function startEditing(run, plan) {
  const server = await findServer();
  const lines = (await server?.edit()) ?? run.lines.lines ?? run.lines.detected;
  return lines ? new EditPanel(plan, server, lines, run) : null;
}

async function start() {
  startTabs();
  const run = await loadRun();
  showHistogram(run);
  showRooms(run);
  showStages(run);
  const plan = new PlanPanel(run);
  const scene = showModelPanel(run, (cell, face) => showFace(run, plan, cell, face));
  showFace(run, plan, null, null);
  const edit = plan.view ? await startEditing(run, plan) : null;
  showName(edit?.server?.status.work ?? workName());
  const said = edit ? await findPlace(plan) : null;
  if (said) {
    edit.show(true);
    edit.say(said);
  }
  // For tests and for the browser's console.
  window.roomcut = { run, plan, scene, edit, worstMargin: () => worstMargin(run.complex) };
  document.documentElement.dataset.ready = "yes";
}

start();
