// SPDX-License-Identifier: GPL-3.0-or-later
// The report of the demo: looked at, asked why, and edited.
import { join } from "node:path";
import { make, need, openBrowser, openReport, run, source, build, temporaryFolder } from "./browser.mjs";
import { editsLines, movesWall } from "./edits.mjs";
import { agreesWithTheRun, asksAboutAnOpening, isSeenByAll, looksAtModel, looksAtPlan, looksAtTables, nothingWrong, printsDecently, worksWithTheKeyboard } from "./looks.mjs";

need();
const folder = temporaryFolder();
const scan = join(folder, "scan.ply");
const work = join(folder, "work");
run(join(build, "bin", "synthesize"), ["-q", "--scene", join(source, "tests/data/scenes/paper_two_storeys.json"), "--scan-out", scan, "--truth-out", join(folder, "truth.off"), "--truth-json", join(folder, "truth.json")]);
make("run", scan, work);
const { browser, page } = await openBrowser();
await openReport(page, work);
await isSeenByAll(page);
await printsDecently(page);
await worksWithTheKeyboard(page);
await looksAtModel(page, "demo");
await looksAtPlan(page, "demo");
await asksAboutAnOpening(page, work);
await looksAtTables(page, "demo");
await agreesWithTheRun(page, work);
await movesWall(page, scan, work, "demo", 0.25);
await editsLines(page, scan, work, "demo");
nothingWrong(page);
await browser.close();
