// SPDX-License-Identifier: GPL-3.0-or-later
// The page as `make view` serves it: a wall is moved, saved and run with one button; the page shows how far the run is, comes back
// by itself and shows the result; the edit is dropped again. The scan lies in UTM: what is written does so, too.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build, make, modelVertices, need, openBrowser, run, screenshot, settled, source, step, temporaryFolder } from "./browser.mjs";
import { nothingWrong } from "./looks.mjs";

const kMoved_m = 0.2;
const kPlace = [691234.25, 5334567.5, 512];

need();
const folder = temporaryFolder();
const scan = join(folder, "scan.ply");
const work = join(folder, "work");
const scene = join(source, "tests/data/scenes/one_room.json");
run(join(build, "bin", "synthesize"), ["-q", "--scene", scene, "--scan-out", scan, "--truth-out", join(folder, "truth.off"), "--truth-json", join(folder, "truth.json")]);
moveTo(kPlace);
make("run", scan, work);

/** The scan's floats as doubles, moved to a place. */
function moveTo(place) {
  const content = readFileSync(scan);
  const head = content.indexOf("end_header\n") + "end_header\n".length;
  const count = (content.length - head) / 4;
  const moved = Buffer.alloc(8 * count);
  for (let i = 0; i < count; ++i) {
    moved.writeDoubleLE(content.readFloatLE(head + 4 * i) + place[i % 3], 8 * i);
  }
  writeFileSync(scan, Buffer.concat([Buffer.from(content.subarray(0, head).toString().replaceAll("float", "double")), moved]));
}

/** Starts make view; resolves to the address that it prints. */
function serve() {
  const env = { ...process.env };
  for (const name of ["MAKEFLAGS", "MFLAGS", "MAKELEVEL"]) {
    delete env[name];
  }
  const server = spawn("make", ["--no-print-directory", "-C", source, "view", `SCAN=${scan}`, `WORK=${work}`, `BUILD=${build}`], { env, detached: true });
  process.on("exit", () => {
    try {
      process.kill(-server.pid, "SIGTERM");
    } catch {
      // It has ended.
    }
  });
  return new Promise((resolve, reject) => {
    let said = "";
    server.stdout.on("data", (text) => {
      said += text;
      const address = /http:\/\/127\.0\.0\.1:\d+\//.exec(said);
      if (address) {
        resolve(address[0]);
      }
    });
    server.on("exit", (code) => reject(new Error(`make view ended with ${code}: ${said}`)));
  });
}

const east = () => Math.max(...modelVertices(work).map(([x]) => x));
const address = await serve();
const { browser, page } = await openBrowser();
const before = east();
const ready = () => page.waitForFunction(() => document.documentElement.dataset.ready === "yes");

await step("the served page offers to save and to run", async () => {
  await page.goto(address);
  await ready();
  await page.click("#tab-plan");
  await page.click("#edit-toggle");
  for (const name of ["save", "run", "drop", "download"]) {
    assert.ok(await page.isVisible(`#edit-${name}`), name);
  }
});

await step("an outer wall is moved by a number and locked", async () => {
  const key = await page.evaluate(() => {
    const { lines } = window.roomcut.edit.document;
    return lines.reduce((best, line) => (Math.min(line.a[0], line.b[0]) > Math.min(best.a[0], best.b[0]) ? line : best)).key;
  });
  await page.evaluate((wanted) => window.roomcut.edit.tool.select(wanted), key);
  const leftIsEast = await page.evaluate((wanted) => {
    const { a, b } = window.roomcut.edit.document.find(wanted);
    return a[1] > b[1];
  }, key);
  await page.fill("#edit-by", String(leftIsEast ? kMoved_m : -kMoved_m));
  await page.click("#edit-move");
  await page.click("#edit-lock");
  assert.match(await page.textContent("#edit-changes"), /moved 200 mm/);
  await screenshot(page, "served_edit");
});

await step("saved and run with one button: progress is shown, the page comes back where it was", async () => {
  // Every text is noted as it is shown: a run of a small room is over before a look now and then would see one.
  const stages = new Set();
  await page.exposeFunction("noteSaid", (text) => stages.add(text));
  await page.evaluate(() => {
    const said = document.querySelector("#edit-said");
    new MutationObserver(() => window.noteSaid(said.textContent)).observe(said, { childList: true, characterData: true, subtree: true });
  });
  await Promise.all([page.waitForEvent("load"), page.click("#edit-run")]);
  await ready();
  await settled(page);
  const progress = [...stages].filter((text) => /^[a-z_]+ \(\d+ of \d+\)$/.test(text));
  console.log(`        ${progress.join(", ")}`);
  assert.ok(progress.length > 0, [...stages].join());
  assert.equal(await page.getAttribute("#tab-plan", "aria-selected"), "true");
  assert.match(await page.textContent("#edit-said"), /The run is done \(\d+\.\d s\)/);
  await screenshot(page, "served_done");
});

await step("the wall has moved in model.ply by that distance", () => {
  assert.ok(Math.abs(east() - before - kMoved_m) < 0.002, `${east() - before} m`);
});

await step("the edit is written in the scan's own coordinates, one line of it moved", () => {
  const lines = (...names) => JSON.parse(readFileSync(join(work, ...names, "wall_lines.geojson"), "utf8"));
  const [edit, detected] = [lines("edits"), lines("30_detect_lines")];
  assert.equal(edit.roomcut.coordinates, "scan");
  const points = edit.features.flatMap(({ geometry }) => geometry.coordinates);
  assert.ok(points.every(([x, y]) => Math.hypot(x - kPlace[0], y - kPlace[1]) < 10), JSON.stringify(points));
  const found = new Map(detected.features.map((feature) => [feature.properties.wall_id, feature]));
  const moved = edit.features.filter((feature) => JSON.stringify(feature.geometry) !== JSON.stringify(found.get(feature.properties.wall_id).geometry));
  assert.equal(moved.length, 1);
});

await step("the page says where its origin lies", async () => {
  assert.match(await page.textContent("#frame"), /origin at \d{6}\S*, \d{7}/);
});

await step("what the door refuses is said, and nothing is written", async () => {
  const problems = await page.evaluate(async () => {
    const { server } = window.roomcut.edit;
    return (await server.save('{"type": "FeatureCollection", "features": []}')).problems;
  });
  assert.match(problems.join(), /error\[L\d+\] edits\/wall_lines\.geojson/);
  // The browser itself complains of the answer 422.
  page.complaints = page.complaints.filter((text) => !text.includes("422"));
  assert.ok(existsSync(join(work, "edits", "wall_lines.geojson")));
});

await step("the edit is dropped: kept aside, and the wall is back", async () => {
  await Promise.all([page.waitForEvent("load"), page.click("#edit-drop")]);
  await ready();
  assert.ok(Math.abs(east() - before) < 1e-9);
  assert.deepEqual(readdirSync(join(work, "edits", "old")), ["wall_lines.1.geojson"]);
  assert.ok(!existsSync(join(work, "edits", "wall_lines.geojson")));
});

nothingWrong(page, new URL(address).origin);
await browser.close();
process.exit(0);
