// SPDX-License-Identifier: GPL-3.0-or-later
// Editing as a person does it: with the pointer, in the page; saved as a file; rerun.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { coordinatesOf, json, make, modelVertices, openReport, screenshot, settled, step, verticesOn, windowOf } from "./browser.mjs";

const kPlan = "#plan-canvas > canvas";

/** The longest wall line that bounds the building on one side: all of the model lies on its other side. */
function outerLine(page) {
  return page.evaluate(() => {
    const { run, edit } = window.roomcut;
    const carried = new Set(run.complex.block.line_ids);
    const { vertices } = run.model;
    let best = null;
    for (const line of edit.document.lines.filter(({ key }) => carried.has(key))) {
      const length = Math.hypot(line.b[0] - line.a[0], line.b[1] - line.a[1]);
      const normal = [-(line.b[1] - line.a[1]) / length, (line.b[0] - line.a[0]) / length];
      let [low, high] = [Infinity, -Infinity];
      for (let i = 0; i < vertices.length; i += 3) {
        const side = normal[0] * (vertices[i] - line.a[0]) + normal[1] * (vertices[i + 1] - line.a[1]);
        [low, high] = [Math.min(low, side), Math.max(high, side)];
      }
      const outward = high < 0.05 ? 1 : low > -0.05 ? -1 : 0;
      if (outward !== 0 && (!best || length > best.length)) {
        best = { key: line.key, a: line.a, b: line.b, length, normal: normal.map((value) => outward * value) };
      }
    }
    return best;
  });
}

/** Shows the slice that has the most points on a line. */
function showSliceOf(page, key) {
  return page.evaluate(async (wanted) => {
    const { plan, edit } = window.roomcut;
    edit.tool.select(wanted);
    let best = { count: -1, slice: null };
    for (const slice of plan.slices) {
      await plan.choose(slice);
      const { count } = edit.tool.fit();
      best = count > best.count ? { count, slice } : best;
    }
    await plan.choose(best.slice);
    return best.count;
  }, key);
}

const document_ = (page) => page.evaluate(() => window.roomcut.edit.document.lines.map(({ key, a, b, locked }) => ({ key, a, b, locked })));
const changes = (page) => page.evaluate(() => window.roomcut.edit.document.changes());

/** Drags from one point of the plan by so many pixels, without snapping. */
async function drag(page, from, pixels) {
  const [x, y] = await windowOf(page, from);
  await page.keyboard.down("Alt");
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (const share of [0.2, 0.6, 1]) {
    await page.mouse.move(x + share * pixels[0], y + share * pixels[1]);
  }
  return async () => {
    await page.mouse.up();
    await page.keyboard.up("Alt");
    await settled(page);
  };
}

/** Saves with the page's button, puts the file where the README says, and runs the pipeline. */
async function saveAndRun(page, scan, work) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#edit-download")]);
  assert.equal(download.suggestedFilename(), "wall_lines.geojson");
  mkdirSync(join(work, "edits"), { recursive: true });
  await download.saveAs(join(work, "edits", "wall_lines.geojson"));
  make("run", scan, work);
}

const accepted = (work) => new Map(json(join(work, "40_accept_lines", "wall_lines.geojson")).features.map((feature) => [feature.properties.wall_id, feature]));

/**
 * Drags an outer wall outwards and locks it; undoes, redoes; saves, runs; the wall has moved in model.ply by as much.
 * @param metres about how far
 */
export async function movesWall(page, scan, work, name, metres) {
  await page.click("#tab-plan");
  await page.click("#edit-toggle");
  const line = await outerLine(page);
  assert.ok(line, "no outer wall line");
  const middle = [(line.a[0] + line.b[0]) / 2, (line.a[1] + line.b[1]) / 2];
  const carried = verticesOn(modelVertices(work), line.a, line.b, 0.03);
  let moved = 0;

  await step("a wall is dragged by a known distance, with its points in sight", async () => {
    assert.ok((await showSliceOf(page, line.key)) > 10, "no slice has points on the line");
    await page.mouse.move(...(await windowOf(page, middle)));
    await page.mouse.wheel(0, -900);
    await settled(page);
    const scale = await page.evaluate(() => window.roomcut.plan.view.viewport.scale);
    const pixels = [line.normal[0] * metres * scale, -line.normal[1] * metres * scale].map(Math.round);
    const release = await drag(page, middle, pixels);
    await screenshot(page, `${name}_drag`);
    await release();
    const now = (await document_(page)).find(({ key }) => key === line.key);
    moved = line.normal[0] * (now.a[0] - line.a[0]) + line.normal[1] * (now.a[1] - line.a[1]);
    const wanted = (line.normal[0] * pixels[0] - line.normal[1] * pixels[1]) / scale;
    assert.ok(Math.abs(moved - wanted) < 0.5 / scale + 0.001, `${moved} instead of ${wanted}`);
    assert.match((await changes(page)).join(), new RegExp(`^${line.key.replace(".", "\\.")} moved ${Math.round(1000 * moved)} mm$`));
  });

  await step("undo takes it back, redo brings it again", async () => {
    await page.keyboard.press("Control+z");
    assert.deepEqual(await changes(page), []);
    assert.ok(await page.isDisabled("#edit-undo"));
    await page.click("#edit-redo");
    assert.equal((await changes(page)).length, 1);
  });

  await step("locked, saved and rerun: the wall of the model has moved by that distance", async () => {
    await page.click("#edit-lock");
    await saveAndRun(page, scan, work);
    const feature = accepted(work).get(line.key);
    assert.equal(feature.properties.source, "edited");
    assert.equal(feature.properties.locked, true);
    const away = ([x, y], offset) => [x + line.normal[0] * offset, y + line.normal[1] * offset];
    const vertices = modelVertices(work);
    const there = verticesOn(vertices, away(line.a, moved), away(line.b, moved), 0.002);
    const left = verticesOn(vertices, line.a, line.b, 0.03);
    console.log(`        ${line.key} moved ${moved.toFixed(3)} m: ${carried} vertices at the old place, now ${left}; ${there} at the new one`);
    assert.ok(there >= 4, `${there} vertices at the new place`);
    assert.ok(left < carried, `${left} of ${carried} vertices still at the old place`);
  });

  await step("the new report begins from the edit", async () => {
    await openReport(page, work);
    await page.click("#tab-plan");
    const now = (await document_(page)).find(({ key }) => key === line.key);
    assert.ok(now.locked);
    await screenshot(page, `${name}_moved`);
  });
}

/** Adds, deletes, locks and undoes in one sitting; what was saved is what accept_lines finds. */
export async function editsLines(page, scan, work, name) {
  const before = accepted(work);
  const last = await page.evaluate(() => window.roomcut.edit.document.lines.at(-1).key);
  const first = await page.evaluate(() => window.roomcut.edit.document.lines[0].key);
  let drawn = null;

  await step("a new line is drawn, parallel or perpendicular to a wall", async () => {
    await page.click("#tab-plan");
    await page.click("#edit-toggle");
    await page.click("#plan-tools >> text=Fit");
    await page.click("#edit-add");
    const { width, height, x, y } = await page.locator(kPlan).boundingBox();
    // Half a degree off the longest wall: the page puts it right.
    const angle = 0.009 + (await page.evaluate(() => {
      const { lines } = window.roomcut.edit.document;
      const [dx, dy] = lines.map(({ a, b }) => [b[0] - a[0], b[1] - a[1]]).sort((l, m) => Math.hypot(...m) - Math.hypot(...l))[0];
      return Math.atan2(dy, dx);
    }));
    const at = (pixels) => [x + 0.42 * width + pixels * Math.cos(angle), y + 0.5 * height - pixels * Math.sin(angle)];
    await page.mouse.move(...at(-75));
    await page.mouse.down();
    await page.mouse.move(...at(-30));
    await page.mouse.move(...at(75));
    await screenshot(page, `${name}_add`);
    await page.mouse.up();
    drawn = (await document_(page)).at(-1);
    assert.match(drawn.key, /^new/);
    const turn = await page.evaluate(() => {
      const { lines } = window.roomcut.edit.document;
      const angle = ({ a, b }) => Math.atan2(b[1] - a[1], b[0] - a[0]);
      const quarter = (value) => Math.abs(Math.sin(2 * value)) / 2; // 0 when parallel or perpendicular
      return Math.min(...lines.slice(0, -1).map((line) => quarter(angle(line) - angle(lines.at(-1)))));
    });
    assert.ok(turn < 1e-9, `turned by ${turn}`);
  });

  await step("an end of it is dragged, the other one stays; undone", async () => {
    const scale = await page.evaluate(() => window.roomcut.plan.view.viewport.scale);
    const release = await drag(page, drawn.b, [40, 25]);
    await release();
    const { a, b } = (await document_(page)).at(-1);
    assert.deepEqual(a, drawn.a);
    assert.ok(Math.abs(b[0] - drawn.b[0] - 40 / scale) < 1 / scale, `${b[0] - drawn.b[0]} m`);
    assert.ok(Math.abs(b[1] - drawn.b[1] + 25 / scale) < 1 / scale, `${b[1] - drawn.b[1]} m`);
    await page.keyboard.press("Control+z");
    assert.deepEqual((await document_(page)).at(-1).b, drawn.b);
  });

  await step("lines are deleted and locked with the keyboard, and undone", async () => {
    await page.focus(kPlan);
    await page.evaluate((key) => window.roomcut.edit.tool.select(key), last);
    await page.keyboard.press("Delete");
    assert.ok((await changes(page)).includes(`${last} deleted`));
    await page.keyboard.press("Control+z");
    assert.ok(!(await changes(page)).includes(`${last} deleted`));
    await page.keyboard.press("Control+Shift+z");
    assert.ok((await changes(page)).includes(`${last} deleted`));
    await page.evaluate((key) => window.roomcut.edit.tool.select(key), first);
    const wasLocked = before.get(first).properties.locked;
    await page.keyboard.press("l");
    assert.ok((await changes(page)).includes(`${first} ${wasLocked ? "unlocked" : "locked"}`));
    await screenshot(page, `${name}_changes`);
  });

  await step("what was saved is what accept_lines takes", async () => {
    await saveAndRun(page, scan, work);
    const after = accepted(work);
    assert.ok(!after.has(last), `${last} is still there`);
    assert.equal(after.get(first).properties.locked, !before.get(first).properties.locked);
    const added = [...after.values()].filter(({ properties }) => properties.source === "added");
    assert.equal(added.length, 1);
    const ends = added[0].geometry.coordinates.flat();
    const wanted = [drawn.a, drawn.b].flatMap((end) => coordinatesOf(work).planToScan(end));
    const same = (order) => order.every((k, i) => Math.abs(ends[i] - wanted[k]) < 2e-6);
    assert.ok(same([0, 1, 2, 3]) || same([2, 3, 0, 1]), `${ends} instead of ${wanted}`);
    for (const [id, feature] of before) {
      if (id !== last && feature.properties.source !== "added") {
        assert.deepEqual(after.get(id).geometry, feature.geometry, id);
      }
    }
    const written = readFileSync(join(work, "edits", "wall_lines.geojson"), "utf8");
    assert.equal(written.split("\n").filter((text) => text.includes('"type":"Feature"')).length, after.size);
  });
}
