// SPDX-License-Identifier: GPL-3.0-or-later
// The tools of editing: what can be done, what has been done, and where it is saved to.

import { byId, make, number } from "../dom.js";
import { LineDocument } from "./document.js";
import { paintEditing } from "./overlay.js";
import { keepPlace } from "./place.js";
import { EditTool } from "./tool.js";

const kPoll_ms = 400;
const kKeep_ms = 60000; // a browser may take its time to begin a download

export class EditPanel {
  /** @param plan the plan's panel @param server the Server, or null @param geojson the lines to begin from @param run what the page shows */
  constructor(plan, server, geojson, run) {
    this.plan = plan;
    this.server = server;
    this.document = new LineDocument(geojson, run.scan, (run.lines.lines ?? run.lines.detected)?.features);
    this.tool = new EditTool(plan, this.document, () => this.update());
    this.buttons = {};
    this.build();
    plan.view.overlays.push((context) => {
      if (this.on) {
        paintEditing(context, plan.view, this.tool);
      }
    });
    window.addEventListener("beforeunload", (event) => {
      if (!this.document.isSaved && !this.leaving) {
        event.preventDefault();
      }
    });
    this.update();
  }

  button(id, text, title, action) {
    this.buttons[id] = make("button", { type: "button", id: `edit-${id}`, text, title, onclick: action });
    return this.buttons[id];
  }

  build() {
    this.said = make("output", { id: "edit-said", class: "quiet" });
    this.by = make("input", { type: "number", id: "edit-by", step: "0.001", value: "0.100", size: "7", "aria-label": "metres to move the wall" });
    const { tool, server } = this;
    this.tools = make(
      "span",
      { class: "group", hidden: true },
      this.button("add", "Add", "Draw a new line (A)", () => tool.startAdding()),
      this.button("delete", "Delete", "Delete the selected line (Del)", () => tool.remove()),
      this.button("lock", "Lock", "Keep refinement from moving the selected line (L)", () => tool.toggleLock()),
      make("label", {}, "move", this.by, "m"),
      this.button("move", "Move", "Move the selected line along its normal", () => tool.moveBy(Number(this.by.value))),
      this.button("undo", "Undo", "Control Z", () => tool.step(false)),
      this.button("redo", "Redo", "Control shift Z", () => tool.step(true)),
      server ? this.button("save", "Save", "Save into the work folder", () => this.save()) : null,
      this.button("download", server ? "Download" : "Save as file", "wall_lines.geojson, for the folder edits/ of the work folder", () => this.download()),
      server ? this.button("run", "Save and run", "Save, run what follows from it, show the result", () => this.run()) : null,
      server ? this.button("drop", "Drop edit", "Move the edit aside and begin from the detected lines", () => this.drop()) : null,
    );
    this.progress = make("progress", { hidden: true, max: "1", value: "0" });
    byId("edit-tools").append(
      this.button("toggle", "Edit lines", "Move, add, delete wall lines", () => this.show(!this.on)),
      this.tools,
      this.progress,
      this.said,
    );
  }

  /** Turns editing on or off; what was edited stays. */
  show(on) {
    this.on = on;
    this.tools.hidden = !on;
    this.buttons.toggle.setAttribute("aria-pressed", String(on));
    this.plan.tool = on ? this.tool : null;
    if (on) {
      this.plan.view.viewport.canvas.focus();
    }
    this.update();
  }

  update() {
    const { document, tool } = this;
    // The plan draws and picks the lines as they are now.
    this.plan.state.lines = tool.lines.map((line) => ({
      id: line.key,
      a: line.a,
      b: line.b,
      properties: { source: "added", ...line.feature?.properties, locked: line.locked },
    }));
    const line = tool.line();
    for (const name of ["delete", "lock", "move"]) {
      this.buttons[name].disabled = !line;
    }
    this.buttons.lock.textContent = line?.locked ? "Unlock" : "Lock";
    this.buttons.undo.disabled = document.past.length === 0;
    this.buttons.redo.disabled = document.future.length === 0;
    this.buttons.add.setAttribute("aria-pressed", String(tool.adding));
    if (this.on && !this.busy) {
      this.say(this.summary());
    }
    this.listChanges();
    if (line && this.plan.state.selected?.line === line.key) {
      this.plan.select({ line: line.key }); // its length, its lock
    }
    this.plan.view.redraw();
  }

  summary() {
    const { tool } = this;
    const fit = tool.fit();
    const changes = this.document.changes().length;
    if (tool.adding) {
      return "drag from one end to the other";
    }
    if (fit) {
      const name = tool.selected ?? "new line";
      return `${name}: ${fit.count > 0 ? `${fit.count} cells within 3 cm, ${number(1e3 * fit.mean, 1)} mm off` : "no points within 3 cm here"}`;
    }
    return changes === 0 ? "nothing changed" : `${changes} change${changes > 1 ? "s" : ""}${this.document.isSaved ? ", saved" : ""}`;
  }

  /** What differs from the lines that the editing began from, beside the plan. */
  listChanges() {
    const changes = this.on ? this.document.changes() : [];
    byId("edit-changes").replaceChildren(
      ...(changes.length === 0 ? [] : [make("h3", { text: "Your changes" }), make("ul", {}, ...changes.map((text) => make("li", { text })))]),
    );
  }

  say(text, isProblem = false) {
    this.said.textContent = text;
    this.said.title = text;
    this.said.classList.toggle("warn", isProblem);
  }

  download() {
    const url = URL.createObjectURL(new Blob([this.document.toText()], { type: "application/geo+json" }));
    make("a", { href: url, download: "wall_lines.geojson" }).click();
    setTimeout(() => URL.revokeObjectURL(url), kKeep_ms);
    this.document.saved = this.document.lines;
    this.say("Saved as wall_lines.geojson: move it into the work folder's edits/ and run make run.");
  }

  /** @returns {Promise<boolean>} whether the work folder took it */
  async save() {
    const answer = await this.server.save(this.document.toText());
    if (answer.problems) {
      this.say(answer.problems.join(" · "), true);
      return false;
    }
    this.document.saved = this.document.lines;
    this.say(`Saved. ${(answer.changes ?? []).join(" · ")}`);
    return true;
  }

  async drop() {
    const answer = await this.server.drop();
    if (answer.problems) {
      this.say(answer.problems.join(" · "), true);
      return;
    }
    await this.follow();
  }

  async run() {
    if (await this.save()) {
      await this.follow();
    }
  }

  /** Runs the pipeline, shows how far it is, and loads the page anew when it is done. */
  async follow() {
    const answer = await this.server.run();
    if (answer.problems) {
      this.say(answer.problems.join(" · "), true);
      return;
    }
    this.busy = true;
    this.begun = Date.now();
    this.progress.hidden = false;
    for (;;) {
      const state = await this.server.progress();
      this.progress.value = state.of > 0 ? state.done / state.of : 0;
      this.say(state.running ? `${state.stage ?? "starting"} (${state.done} of ${state.of})` : "");
      if (!state.running) {
        this.finish(state);
        return;
      }
      await new Promise((resolve) => setTimeout(resolve, kPoll_ms));
    }
  }

  finish(state) {
    this.busy = false;
    this.progress.hidden = true;
    if (state.exit === 0) {
      this.leaving = true;
      keepPlace(this.plan, `The run is done (${((Date.now() - this.begun) / 1000).toFixed(1)} s): this is its result.`);
      window.location.reload();
    } else {
      this.say(`make run ended with ${state.exit}: ${(state.log ?? []).slice(-3).join(" · ")}`, true);
    }
  }
}
