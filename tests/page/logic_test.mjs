// SPDX-License-Identifier: GPL-3.0-or-later
// The page's logic without a browser: what editing does to the lines, snapping, the blocks. Run by node --test.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

const page = (file) => import(pathToFileURL(join(process.env.ROOMCUT_SOURCE, "stages/report/page/src", file)).href);
const { LineDocument, offsetBetween, shifted } = await page("edit/document.js");
const { fitOf, snapDirection, snapLength, snapOffset } = await page("edit/snap.js");
const { parseBlock } = await page("data/blocks.js");

const line = (id, a, b, more = {}) => ({
  type: "Feature",
  id,
  properties: { wall_id: id, locked: false, ...more },
  geometry: { type: "LineString", coordinates: [a, b] },
});
const lines = () => ({
  type: "FeatureCollection",
  roomcut: { artefact: "wall_lines", schema_version: "1.0", base_sha256: "abc" },
  features: [line("w0001", [0, 0], [4, 0], { colour: "mine", levels: [0, 2] }), line("w0002", [4, 0], [4, 3])],
});

test("what is not edited is written as it was read", () => {
  assert.deepEqual(JSON.parse(new LineDocument(lines()).toText()), lines());
});

test("a moved line keeps its id, unknown properties and the member roomcut", () => {
  const document = new LineDocument(lines());
  document.shift("w0001", 0.25);
  const written = JSON.parse(document.toText());
  assert.deepEqual(written.features[0].geometry.coordinates, [[0, 0.25], [4, 0.25]]);
  assert.deepEqual(written.features[0].properties, lines().features[0].properties);
  assert.deepEqual(written.roomcut, lines().roomcut);
  assert.deepEqual(document.changes(), ["w0001 moved 250 mm"]);
});

test("one feature a line, six decimals", () => {
  const document = new LineDocument(lines());
  document.shift("w0002", 1 / 3);
  const rows = document.toText().split("\n").filter((text) => text.includes('"Feature"'));
  assert.equal(rows.length, 2);
  assert.match(rows[1], /3\.666667,0/);
});

test("undo goes back step by step, redo forward, a new step forgets what was undone", () => {
  const document = new LineDocument(lines());
  document.shift("w0001", 0.1);
  document.remove("w0002");
  const key = document.add([1, 1], [2, 1]);
  document.setLocked(key, true);
  assert.equal(document.changes().length, 3);
  for (let i = 0; i < 4; ++i) {
    document.undo();
  }
  assert.deepEqual(document.changes(), []);
  assert.equal(document.lines, document.original);
  document.redo();
  assert.deepEqual(document.changes(), ["w0001 moved 100 mm"]);
  document.remove("w0001");
  document.redo();
  assert.deepEqual(document.changes(), ["w0001 deleted"]);
});

test("a new line is written without wall_id: accept_lines gives it one", () => {
  const document = new LineDocument(lines());
  document.add([1, 1], [2, 1]);
  const added = JSON.parse(document.toText()).features[2];
  assert.deepEqual(added, { type: "Feature", properties: { locked: false }, geometry: { type: "LineString", coordinates: [[1, 1], [2, 1]] } });
});

test("a polyline becomes lines as accept_lines splits it", () => {
  const geojson = lines();
  geojson.features[0].geometry.coordinates.push([4, 5]);
  const document = new LineDocument(geojson);
  assert.deepEqual(document.lines.map(({ key }) => key), ["w0001.1", "w0001.2", "w0002"]);
  assert.equal(JSON.parse(document.toText()).features[1].properties.wall_id, "w0001.2");
});

test("offsets are signed, to the left of a line's direction", () => {
  const base = { a: [1, 1], b: [4, 5] };
  assert.ok(Math.abs(offsetBetween(base, shifted(base, 0.2)) - 0.2) < 1e-12);
  assert.ok(Math.abs(offsetBetween(base, shifted(base, -0.3)) + 0.3) < 1e-12);
});

test("directions snap within two degrees, to the long line rather than the short one", () => {
  const rad = Math.PI / 180;
  const at = (degrees, length, key) => ({ key, a: [0, 0], b: [length * Math.cos(degrees * rad), length * Math.sin(degrees * rad)] });
  const others = [at(30, 5, "long"), at(31, 0.5, "short")];
  const parallel = snapDirection(30.7 * rad, others);
  assert.equal(parallel.to, "long");
  assert.equal(parallel.how, "parallel");
  assert.ok(Math.abs(parallel.angle - 30 * rad) < 1e-12);
  const across = snapDirection(-61.2 * rad, others);
  assert.equal(across.how, "perpendicular");
  assert.ok(Math.abs(across.angle + 60 * rad) < 1e-12);
  assert.equal(snapDirection(75 * rad, others), null);
});

test("offsets snap to lines in the same row, lengths to lines that are met", () => {
  const wall = { key: "w", a: [0, 0], b: [4, 0] };
  const others = [{ key: "row", a: [6, 0.5], b: [9, 0.5] }, { key: "across", a: [4.05, -1], b: [4.05, 1] }];
  assert.deepEqual(snapOffset(wall, 0.46, others, 0.1), { offset: 0.5, to: "row" });
  assert.equal(snapOffset(wall, 0.3, others, 0.1), null);
  const met = snapLength([0, 0], 0, 4, others, 0.1);
  assert.equal(met.to, "across");
  assert.ok(Math.abs(met.length - 4.05) < 1e-12);
  assert.equal(snapLength([0, 0], 0, 3, others, 0.1), null);
});

test("the fit counts the points near a line and their mean offset", () => {
  const block = { x: new Float32Array([1, 2, 3, 9]), y: new Float32Array([0.01, 0.02, 0.5, 0]) };
  const fit = fitOf({ a: [0, 0], b: [4, 0] }, block, 0.03);
  assert.equal(fit.count, 2);
  assert.ok(Math.abs(fit.mean - 0.015) < 1e-6);
  assert.deepEqual(fit.shown, [0, 1, 2]);
});

test("a block is read as it was laid out", () => {
  const text = JSON.stringify({ unit: "m", arrays: { x: ["f32", 2, 0], kind: ["u8", 3, 8] } });
  const begin = Math.ceil((4 + text.length) / 8) * 8;
  const buffer = new ArrayBuffer(begin + 16);
  new DataView(buffer).setUint32(0, text.length, true);
  new Uint8Array(buffer, 4).set(new TextEncoder().encode(text));
  new Float32Array(buffer, begin, 2).set([1.5, -2]);
  new Uint8Array(buffer, begin + 8, 3).set([7, 8, 9]);
  const block = parseBlock(buffer);
  assert.equal(block.unit, "m");
  assert.deepEqual([...block.x], [1.5, -2]);
  assert.deepEqual([...block.kind], [7, 8, 9]);
});
