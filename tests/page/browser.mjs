// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of the page share: the pipeline, the browser, and looking at what it shows. Every test is called as
// node <name>_test.mjs SOURCE BUILD PACKAGES (the folder with node_modules). Screenshots go to BUILD/page_screenshots/.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

export const [source, build, packages] = process.argv.slice(2, 5).map((path) => resolve(path));
const page = (file) => import(pathToFileURL(join(source, "stages/tools/report/page/src", file)).href);
const { ScanCoordinates } = await page("data/coordinates.js");
/** The page's colours, here without the page's data. */
export const colours = await page("colours.js");
const kSkipped = 77;
const kBrowsers = ["/usr/bin/chromium", "/usr/bin/chromium-browser"];
const kSlow = 300000; // [ms] a machine that builds beside the test is slow
// Software rendering: no machine that tests has a graphics card. The others keep the browser from asking the net.
const kFlags = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--no-proxy-server",
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-accelerated-2d-canvas",
];

export function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(kSkipped);
}

/** What the tests need from outside; ends the test as skipped when it is not there. */
export function need() {
  const browser = kBrowsers.find((path) => existsSync(path)) ?? skip("no chromium (apt-get install chromium)");
  if (!existsSync(join(packages, "node_modules", "playwright-core"))) {
    skip("no playwright-core: npm's registry could not be reached when this was built");
  }
  if (!existsSync(join(build, "bin", "report_page.html"))) {
    skip("the page was not bundled: npm's registry could not be reached when this was built");
  }
  return browser;
}

export function run(command, args, env = {}) {
  const clean = { ...process.env, ...env };
  for (const name of ["MAKEFLAGS", "MFLAGS", "MAKELEVEL"]) {
    delete clean[name];
  }
  const done = spawnSync(command, args, { encoding: "utf8", env: clean, maxBuffer: 1e8 });
  assert.equal(done.status, 0, `${command} ${args.join(" ")}: exit ${done.status}\n${done.stdout}\n${done.stderr}`);
  return done.stdout;
}

/** The pipeline on a work folder: make(["run"], {SCAN, WORK}). */
export function make(target, scan, work) {
  return run("make", ["--no-print-directory", "-C", source, target, `SCAN=${scan}`, `WORK=${work}`, `BUILD=${build}`]);
}

export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), "roomcut page "));
  process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
  return folder;
}

export function json(path) {
  return JSON.parse(readFileSync(path, "utf8"));
}

/** Steps one after the other; the first that fails ends the test. */
export async function step(name, action) {
  const begin = Date.now();
  try {
    await action();
  } catch (error) {
    console.log(`NOT OK  ${name}\n${error.stack}`);
    process.exit(1);
  }
  console.log(`ok      ${name} (${Date.now() - begin} ms)`);
}

/** A page that keeps what the browser complains of in `complaints`. */
export async function openBrowser() {
  const executablePath = need();
  const { chromium } = createRequire(join(packages, "package.json"))("playwright-core");
  const browser = await chromium.launch({ executablePath, headless: true, args: kFlags, timeout: kSlow });
  const page = await browser.newPage({ viewport: { width: 1300, height: 850 }, acceptDownloads: true });
  page.setDefaultTimeout(kSlow);
  page.complaints = [];
  page.asked = [];
  page.on("console", (message) => {
    if (message.type() === "error") {
      page.complaints.push(message.text());
    }
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("request", (request) => page.asked.push(request.url()));
  return { browser, page };
}

/** Opens a work folder's report from disk and waits until all of it is there. */
export async function openReport(page, work) {
  await page.goto(pathToFileURL(join(work, "report.html")).href, { waitUntil: "commit" });
  await page.waitForFunction(() => document.documentElement.dataset.ready === "yes");
  await settled(page);
}

/** After the next two frames: what was asked for has been drawn. */
export async function settled(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

export async function screenshot(page, name) {
  const folder = join(build, "page_screenshots");
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`) });
}

/** The share of a canvas' pixels that are not white, how many colours it has, and a number that tells pictures apart. */
export async function look(page, selector) {
  await settled(page);
  return page.evaluate((chosen) => {
    const canvas = document.querySelector(chosen);
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [Math.ceil(canvas.width / 2), Math.ceil(canvas.height / 2)];
    const context = copy.getContext("2d", { willReadFrequently: true });
    context.imageSmoothingEnabled = false;
    context.drawImage(canvas, 0, 0, copy.width, copy.height);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    const colours = new Set();
    let ink = 0;
    let hash = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colours.add(colour);
      ink += colour === 0xffffff ? 0 : 1;
      hash = (hash * 31 + colour) | 0;
    }
    return { ink: ink / (data.length / 4), colours: colours.size, hash };
  }, selector);
}

/** Where a point of the plan is in the window. */
export function windowOf(page, point) {
  return page.evaluate((at) => {
    const { viewport } = window.roomcut.plan.view;
    const box = viewport.canvas.getBoundingClientRect();
    const [x, y] = viewport.toPixels(at);
    return [box.left + x, box.top + y];
  }, point);
}

/** Between the page's local coordinates and the scan's own, which all files hold. */
export const coordinatesOf = (work) => new ScanCoordinates(json(join(work, "summary.json")).frame);

/** The vertices of a model.ply (binary, double coordinates), in local metres. */
export function modelVertices(work) {
  const bytes = readFileSync(join(work, "model.ply"));
  const end = bytes.indexOf("end_header\n") + "end_header\n".length;
  const head = bytes.subarray(0, end).toString();
  const count = Number(/element vertex (\d+)/.exec(head)[1]);
  const scan = coordinatesOf(work); // the model stands where the scan does, the page's lines are local
  return Array.from({ length: count }, (_, i) => scan.toLocal([0, 8, 16].map((byte) => bytes.readDoubleLE(end + 24 * i + byte))));
}

/** How many vertices lie within `limit` metres of a line of the plan, between its ends. */
export function verticesOn(vertices, [ax, ay], [bx, by], limit) {
  const length = Math.hypot(bx - ax, by - ay);
  const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
  return vertices.filter(([x, y]) => {
    const along = ux * (x - ax) + uy * (y - ay);
    return along > -0.5 && along < length + 0.5 && Math.abs(ux * (y - ay) - uy * (x - ax)) <= limit;
  }).length;
}
