// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a building of five storeys: small, and soon there.
import assert from "node:assert/strict";
import { existsSync, statSync } from "node:fs";
import { join } from "node:path";
import { look, make, need, openBrowser, openReport, screenshot, skip, source, step, temporaryFolder } from "./browser.mjs";
import { agreesWithTheRun, nothingWrong } from "./looks.mjs";

const kMostBytes = 25e6;
const kLongest = 3000; // [ms] from asking for the page until all of it is drawn

need();
const scan = join(source, "../shared/data/virtual/institute_var2/cloud.ply");
if (!existsSync(scan)) {
  skip("no ../shared/data");
}
const work = join(temporaryFolder(), "work");
make("run", scan, work);
const { browser, page } = await openBrowser();
await step("the page is under 25 MB", async () => {
  const { size } = statSync(join(work, "report.html"));
  console.log(`        ${(size / 1e6).toFixed(1)} MB`);
  assert.ok(size < kMostBytes);
});
await step("it opens in under 3 s", async () => {
  const times = [];
  // Again when the machine was busy with something else.
  for (let i = 0; i < 3 || (i < 8 && Math.min(...times) >= kLongest); ++i) {
    const begin = Date.now();
    await openReport(page, work);
    times.push(Date.now() - begin);
  }
  console.log(`        ${times.join(", ")} ms`);
  assert.ok(Math.min(...times) < kLongest, times.join());
});
await step("it shows five storeys", async () => {
  const picture = await look(page, "#model-canvas > canvas");
  assert.ok(picture.ink > 0.1 && picture.colours > 20, JSON.stringify(picture));
  await screenshot(page, "institute_model");
});
await agreesWithTheRun(page, work);
nothingWrong(page);
await browser.close();
