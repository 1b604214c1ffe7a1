// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a real scan of two storeys, walls in many directions: looked at, asked why, and edited.
import { existsSync } from "node:fs";
import { join } from "node:path";
import { make, need, openBrowser, openReport, skip, source, temporaryFolder } from "./browser.mjs";
import { editsLines } from "./edits.mjs";
import { agreesWithTheRun, looksAtModel, looksAtPlan, looksAtTables, nothingWrong, printsDecently, worksWithTheKeyboard } from "./looks.mjs";

need();
const scan = join(source, "../shared/data/scans/indoor_office_2storey.ply");
if (!existsSync(scan)) {
  skip("no ../shared/data");
}
const work = join(temporaryFolder(), "work");
make("run", scan, work);
const { browser, page } = await openBrowser();
await openReport(page, work);
await printsDecently(page);
await worksWithTheKeyboard(page);
await looksAtModel(page, "office");
await looksAtPlan(page, "office");
await looksAtTables(page, "office");
await agreesWithTheRun(page, work);
// No wall of it bounds the building alone in both storeys, to be moved by itself: demo_test and served_test move walls.
await editsLines(page, scan, work, "office");
nothingWrong(page);
await browser.close();
