// SPDX-License-Identifier: GPL-3.0-or-later
// What every report must show, whatever the building.
import assert from "node:assert/strict";
import { join } from "node:path";
import { colours, json, look, screenshot, settled, step, windowOf } from "./browser.mjs";
import { areToldApart, growsLighter } from "./sight.mjs";

const kModel = "#model-canvas > canvas";
const kPlan = "#plan-canvas > canvas";

export async function looksAtModel(page, name) {
  await step("the model is drawn, each storey another picture", async () => {
    const whole = await look(page, kModel);
    assert.ok(whole.ink > 0.1 && whole.colours > 20, JSON.stringify(whole));
    await screenshot(page, `${name}_model`);
    const seen = new Set([whole.hash]);
    const storeys = await page.$$eval("[data-storey]", (buttons) => buttons.map((button) => button.dataset.storey));
    for (const storey of storeys.filter((number) => number !== "-1")) {
      await page.click(`[data-storey="${storey}"]`);
      const picture = await look(page, kModel);
      assert.ok(picture.ink > 0.02, `storey ${storey}: ${JSON.stringify(picture)}`);
      assert.ok(!seen.has(picture.hash), `storey ${storey} looks like another`);
      seen.add(picture.hash);
      await screenshot(page, `${name}_storey_${storey}`);
    }
    await page.click('[data-storey="-1"]');
  });

  await step("a cut takes the upper half away", async () => {
    const whole = await look(page, kModel);
    await page.$eval("#model-cut", (slider) => {
      slider.value = String((Number(slider.min) + Number(slider.max)) / 2);
      slider.dispatchEvent(new Event("input"));
    });
    const half = await look(page, kModel);
    assert.ok(half.hash !== whole.hash && half.ink > 0.02);
    await screenshot(page, `${name}_cut`);
    await page.$eval("#model-cut", (slider) => {
      slider.value = slider.max;
      slider.dispatchEvent(new Event("input"));
    });
    assert.equal((await look(page, kModel)).hash, whole.hash);
  });

  await step("every colouring gives another picture, with a legend", async () => {
    const names = await page.$$eval("#model-colour option", (options) => options.map((option) => option.textContent));
    assert.ok(names.length >= 6, names.join());
    const kinds = new Set();
    for (const colouring of names) {
      await page.selectOption("#model-colour", colouring);
      kinds.add((await look(page, kModel)).hash);
      assert.notEqual(await page.textContent("#model-legend"), "", colouring);
      if (/ω|Distance/.test(colouring)) {
        await screenshot(page, `${name}_by_${colouring.startsWith("D") ? "distance" : "omega"}`);
      }
    }
    // Evidences may be alike everywhere (all of a building unobserved by the sky); most differ.
    assert.ok(kinds.size > names.length / 2, `${kinds.size} of ${names.length}`);
  });

  await step("the scan appears beneath the model", async () => {
    const without = await look(page, kModel);
    await page.selectOption("#model-cloud", { index: 3 });
    const withCloud = await look(page, kModel);
    assert.notEqual(withCloud.hash, without.hash);
    await screenshot(page, `${name}_cloud`);
    await page.selectOption("#model-cloud", { index: 0 });
  });

  await step("a click on a face says why", async () => {
    await page.selectOption("#model-colour", { label: "Coverage ω of the face" });
    const box = await page.locator(kModel).boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    const why = await page.textContent("#model-why");
    assert.match(why, /Cell \d+: empty/);
    assert.match(why, /Flipping this cell alone would cost/);
  });
}

export async function looksAtPlan(page, name) {
  await page.click("#tab-plan");
  await step("each slice has its plan", async () => {
    const count = await page.$$eval("#plan-slice option", (options) => options.length);
    const seen = new Set();
    for (let k = 0; k < count; ++k) {
      await page.evaluate((i) => window.roomcut.plan.choose(window.roomcut.plan.slices[i]), k);
      const picture = await look(page, kPlan);
      assert.ok(picture.ink > 0.01, `slice ${k}`);
      seen.add(picture.hash);
    }
    assert.equal(seen.size, count);
    await page.evaluate(() => window.roomcut.plan.choose(window.roomcut.plan.bestSlice()));
  });

  await step("the keyboard goes from slice to slice, moves and zooms", async () => {
    await page.evaluate(() => window.roomcut.plan.choose(window.roomcut.plan.slices.at(-1)));
    await page.focus(kPlan);
    const at = () => page.evaluate(() => window.roomcut.plan.state.slice.index);
    const begin = await at();
    await page.keyboard.press("PageDown");
    await settled(page);
    assert.equal(await at(), begin - 1);
    await page.keyboard.press("PageUp");
    await settled(page);
    assert.equal(await at(), begin);
    const scale = () => page.evaluate(() => window.roomcut.plan.view.viewport.scale);
    const before = await scale();
    await page.keyboard.press("+");
    assert.ok((await scale()) > before);
    await page.click("text=Fit");
  });

  await step("walls and clutter, margin and evidence are pictures of their own", async () => {
    const label = await look(page, kPlan);
    await screenshot(page, `${name}_plan`);
    await page.selectOption("#plan-evidence", { label: "walls and clutter" });
    await page.selectOption("#plan-fill", { label: "none" });
    const walls = await look(page, kPlan);
    await screenshot(page, `${name}_walls_and_clutter`);
    await page.selectOption("#plan-evidence", { label: "none" });
    await page.selectOption("#plan-fill", { label: "margin of the decision" });
    const margin = await look(page, kPlan);
    await screenshot(page, `${name}_margin`);
    assert.equal(new Set([label.hash, walls.hash, margin.hash]).size, 3);
    await page.selectOption("#plan-evidence", { label: "occupancy" });
    await page.selectOption("#plan-fill", { label: "label" });
  });

  await step("a click on a cell says why, with every evidence of the file", async () => {
    const target = await page.evaluate(() => {
      const { run, plan } = window.roomcut;
      const { layer } = plan.state.slice;
      let best = -1;
      for (let f = 0; f < run.complex.faces; ++f) {
        if (run.complex.isEmpty(f, layer) && (best < 0 || run.complex.areas[f] > run.complex.areas[best])) {
          best = f;
        }
      }
      const corners = run.complex.corners(best);
      const middle = [0, 1].map((axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length);
      return { middle, cell: run.complex.cell(best, layer), evidence: run.complex.block.evidence };
    });
    await page.mouse.click(...(await windowOf(page, target.middle)));
    const why = await page.textContent("#plan-why");
    assert.match(why, new RegExp(`Cell ${target.cell}: empty`));
    for (const { name: evidence, description } of target.evidence) {
      if (!["beta", "d_empty", "d_solid"].includes(evidence)) {
        assert.ok(why.includes(evidence) && why.includes(description), evidence);
      }
    }
    for (const words of [/points inside/, /would cost [\d.]+ m³/, /as empty/, /surface term/, /beyond/, /Part of room \d+/]) {
      assert.match(why, words);
    }
    await screenshot(page, `${name}_why`);
  });

  await step("a click on a wall says what covers it", async () => {
    await page.uncheck("#plan-lines");
    const middle = await page.evaluate(() => {
      const { run, plan } = window.roomcut;
      const { layer } = plan.state.slice;
      let best = null;
      for (let e = 0; e < run.complex.edges; ++e) {
        const { a, b, left, right } = run.complex.edge(e);
        const length = Math.hypot(a[0] - b[0], a[1] - b[1]);
        if (run.complex.isEmpty(left, layer) !== run.complex.isEmpty(right, layer) && (!best || length > best.length)) {
          best = { length, middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
        }
      }
      return best.middle;
    });
    await page.mouse.click(...(await windowOf(page, middle)));
    const why = await page.textContent("#plan-why");
    assert.match(why, /Wall face/);
    assert.match(why, /A wall of the model/);
    assert.match(why, /points\d+/);
    await page.check("#plan-lines");
  });
}

/** A door of the demo: which rooms it joins, and what proves it. */
export async function asksAboutAnOpening(page, work) {
  await step("a click on an opening says what proves it and which rooms it joins", async () => {
    const [first] = json(join(work, "summary.json")).openings;
    const middle = await page.evaluate(async (id) => {
      const { plan } = window.roomcut;
      const { a, b, sill, head } = plan.state.openings.find((opening) => opening.id === id);
      await plan.choose(plan.slices.find(({ low, high }) => low < (sill + head) / 2 && (sill + head) / 2 < high));
      return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    }, first.opening_id);
    await page.mouse.click(...(await windowOf(page, middle)));
    const why = await page.textContent("#plan-why");
    assert.ok(why.includes(`Opening ${first.opening_id}`) && why.includes(`joins room ${first.rooms[0]} and room ${first.rooms[1]}`), why);
    assert.ok(why.includes(`${first.width_m.toFixed(2)} m wide, ${first.height_m.toFixed(2)} m high`), why);
    await page.evaluate(() => window.roomcut.plan.choose(window.roomcut.plan.bestSlice()));
  });
}

/** The printer gets every part, also those that were never on the screen: call it before the plan is opened. */
export async function printsDecently(page) {
  await step("it prints: every part on a page of its own, the model and the plan drawn", async () => {
    assert.equal(await page.getAttribute("#tab-model", "aria-selected"), "true");
    const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
    const pages = (pdf.match(/\/Type\s*\/Page\b(?!s)/g) ?? []).length;
    assert.ok(pages >= 5, `${pages} pages`);
    assert.ok((await look(page, kPlan)).ink > 0.3, "the plan that was never shown");
    await page.emulateMedia({ media: "print" });
    const shown = await page.$$eval("main > section, nav, .tools", (parts) => parts.map((part) => [part.id || part.tagName, part.getClientRects().length > 0]));
    await page.emulateMedia({ media: "screen" });
    assert.deepEqual(shown.filter(([id]) => id.startsWith("part-")).map(([, is]) => is), [true, true, true, true, true]);
    assert.ok(shown.every(([id, is]) => id.startsWith("part-") || !is), JSON.stringify(shown));
  });
}

/** Everything that the pointer does has its key. */
export async function worksWithTheKeyboard(page) {
  await step("tabs, the model and the plan work with the keyboard alone", async () => {
    await page.focus("#tab-model");
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.getAttribute("#tab-plan", "aria-selected"), "true");
    assert.ok(await page.isVisible("#plan-canvas"));
    await page.keyboard.press("ArrowLeft");
    await page.focus(kModel);
    const before = await look(page, kModel);
    await page.keyboard.press("+");
    const nearer = await look(page, kModel);
    assert.notEqual(nearer.hash, before.hash);
    await page.keyboard.press("-");
    await page.keyboard.press("Enter");
    assert.match(await page.textContent("#model-why"), /Cell \d+: empty/);
    await page.click("#model-tools >> text=Slanted");
    await page.click("#tab-plan");
    await page.focus(kPlan);
    await page.click("text=Fit");
    await page.focus(kPlan);
    await page.keyboard.press("Enter");
    assert.match(await page.textContent("#plan-why"), /Cell \d+:|Wall (face|line)/);
    await page.keyboard.press("Tab");
    assert.notEqual(await page.evaluate(() => document.activeElement.tagName), "CANVAS", "the canvas keeps the focus");
    await page.click("#tab-model");
  });
}

/** Its colours are those of the pictures (common/picture/colour_map.h). */
export async function isSeenByAll(page) {
  await step("colours that mean different things stay apart for the colour-blind", async () => {
    colours.useColours(await page.evaluate(() => window.roomcut.run.facts.colours));
    areToldApart(colours);
    growsLighter(colours);
  });
}

/** What the page works out for itself must agree with what the stages wrote. */
export async function agreesWithTheRun(page, work) {
  const summary = json(join(work, "summary.json"));
  await step("the page's energy of a flip is the margin that graphcut wrote, for every cell", async () => {
    const worst = await page.evaluate(() => window.roomcut.worstMargin());
    assert.ok(worst.difference < 1e-3, JSON.stringify(worst));
    assert.ok(worst.cells > 100);
  });
  await step("storeys and rooms of the cells are those of summary.json", async () => {
    const rooms = await page.evaluate(() => {
      const { complex, storeys } = window.roomcut.run;
      return storeys.rooms.map(({ storey, plan }) => ({ storey, area: [...plan].reduce((sum, face) => sum + complex.areas[face], 0) }));
    });
    assert.equal(rooms.length, summary.rooms.length);
    // Creases of slopes move in the model to where the fitted planes meet, and with them what lies over and under them; in the cells they stay.
    const slopes = summary.rooms.some((room) => room.highest_ceiling_z_m - room.lowest_ceiling_z_m > 0.01);
    summary.rooms.forEach((room, i) => {
      assert.equal(rooms[i].storey, room.storey);
      assert.ok(Math.abs(rooms[i].area - room.area_m2) < (slopes ? 0.02 * room.area_m2 : 1e-3), `room ${room.room}`);
    });
  });
  await step("the tables hold every room, every stage, and the checks of the mesh", async () => {
    const rooms = await page.textContent("#rooms");
    for (const { area_m2: area } of summary.rooms) {
      assert.ok(rooms.includes(`${area.toFixed(3)} ± `), String(area));
    }
    for (const { opening_id: id, rooms: joined } of summary.openings) {
      assert.ok(rooms.includes(id) && rooms.includes(joined.join(" – ")), id);
    }
    assert.match(rooms, /self intersections0/);
    assert.match(rooms, /closedyes/);
    const stages = await page.textContent("#stages");
    for (const stage of ["ingest", "slice", "detect_lines", "final_graphcut", "extract"]) {
      assert.ok(stages.includes(stage), stage);
    }
    assert.match(stages, /graphcut\.mu_m0\.3default/);
    assert.match(stages, /slice\.tau_mauto[\d.]+: /);
    const bars = await page.$eval("#histogram path", (path) => path.getAttribute("d").length);
    assert.ok(bars > 500);
  });
}

export async function looksAtTables(page, name) {
  for (const part of ["levels", "rooms", "stages"]) {
    await page.click(`#tab-${part}`);
    await settled(page);
    await screenshot(page, `${name}_${part}`);
  }
}

/** No complaint of the browser, and no request to anywhere but `server`, if there is one. */
export function nothingWrong(page, server = "file:") {
  assert.deepEqual(page.complaints, []);
  const outside = page.asked.filter((url) => !/^(file|blob|data):/.test(url) && !url.startsWith(`${server}/`));
  assert.deepEqual(outside, [], "the page asked the net");
}
