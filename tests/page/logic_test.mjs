// SPDX-License-Identifier: GPL-3.0-or-later
// The page's logic without a browser: what editing does to the lines, snapping, the blocks. Run by node --test.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

const page = (file) => import(pathToFileURL(join(process.env.ROOMCUT_SOURCE, "stages/tools/report/page/src", file)).href);
const { LineDocument, offsetBetween, shifted } = await page("edit/document.js");
const { inLocal, inScan, ScanCoordinates } = await page("data/coordinates.js");
const { fitOf, snapDirection, snapLength, snapOffset } = await page("edit/snap.js");
const { parseBlock } = await page("data/blocks.js");
const { Complex } = await page("data/complex.js");
const { roomUncertainties } = await page("data/uncertainty.js");
const { roomsOfCells } = await page("data/rooms.js");

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

const kUtm = { origin: [691234.123456, 5334567.654321, 512.5], unit: "m", up: "z" };
const kLean = { ...kUtm, level: [0.03, 0.04, Math.sqrt(1 - 0.0025)] };
const close = (a, b, limit = 1e-6) => a.flat(9).forEach((value, i) => assert.ok(Math.abs(value - b.flat(9)[i]) < limit, `${a} instead of ${b}`));

for (const frame of [kUtm, kLean]) {
  test(`editing is local, what is written is in the scan's own coordinates, ${frame.level ? "levelled" : "level"}`, () => {
    const scan = new ScanCoordinates(frame);
    const file = inScan({ ...lines(), roomcut: { ...lines().roomcut, bbox: [0, 0, 4, 3] } }, scan);
    close(file.features[0].geometry.coordinates[1], scan.planToScan([4, 0]));
    assert.equal(file.roomcut.coordinates, "scan");
    const document = new LineDocument(file, scan);
    close(document.find("w0001").b, [4, 0]);
    assert.deepEqual(JSON.parse(document.toText()), file, "what is not edited is written as it was read");
    document.shift("w0001", 0.25);
    close(JSON.parse(document.toText()).features[0].geometry.coordinates, [scan.planToScan([0, 0.25]), scan.planToScan([4, 0.25])]);
  });

  test(`a local edit of before becomes one in the scan's own, ${frame.level ? "levelled" : "level"}`, () => {
    const scan = new ScanCoordinates(frame);
    const before = lines();
    before.roomcut.frame = frame;
    const document = new LineDocument(before, scan);
    assert.deepEqual(document.find("w0002").b, [4, 3]);
    const written = JSON.parse(document.toText());
    assert.equal(written.roomcut.coordinates, "scan");
    assert.equal(written.roomcut.schema_version, "1.1");
    close(written.features[1].geometry.coordinates[1], scan.planToScan([4, 3]));
  });

  test(`a file without the member is what its unmoved lines say, ${frame.level ? "levelled" : "level"}`, () => {
    const scan = new ScanCoordinates(frame);
    const { roomcut: _, ...local } = lines();
    const { roomcut: __, ...far } = inScan(lines(), scan);
    for (const file of [local, far]) {
      close(new LineDocument(file, scan, lines().features).find("w0001").b, [4, 0]);
    }
  });

  test(`heights of openings are local in the page, ${frame.level ? "levelled" : "level"}`, () => {
    const scan = new ScanCoordinates(frame);
    const sill = scan.toScan([3, 1, 0.5])[2];
    const opening = { properties: { sill_z_m: sill, head_z_m: sill + 2 }, geometry: { type: "LineString", coordinates: [scan.planToScan([2, 1]), scan.planToScan([4, 1])] } };
    const [found] = inLocal({ roomcut: { coordinates: "scan" }, features: [opening] }, scan).features;
    close([found.properties.sill_z_m, found.properties.head_z_m], [0.5, 0.5 + 2 / (frame.level?.[2] ?? 1)]);
    close(scan.toLocal(scan.toScan([1, 2, 3])), [1, 2, 3]);
  });
}

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

test("a room's area, perimeter and volume are as uncertain as its walls let them be", () => {
  // One room of 4 m by 3 m, 2.5 m high; its four lines known to 1 mm, their directions exactly. The lines run either way.
  const corners = [[0, 0], [4, 0], [4, 3], [0, 3]];
  const block = {
    levels: [0, 2.5],
    vertices: new Float32Array(corners.flat()),
    face_offset: new Int32Array([0, 4]),
    face_vertex: new Int32Array([0, 1, 2, 3]),
    face_edge: new Int32Array([0, 1, 2, 3]),
    edges: new Int32Array([0, 1, 0, -1, 0, 1, 2, 0, -1, 1, 3, 2, -1, 0, 2, 3, 0, 0, -1, 3]),
    line_ids: ["w1", "w2", "w3", "w4"],
    label: new Uint8Array([1]),
  };
  const sides = [[0, 1], [2, 1], [3, 2], [3, 0]];
  const known = { sigma_offset_m: 0.001, sigma_angle_deg: 0 };
  const refined = { features: sides.map(([from, to], i) => line(`w${i + 1}`, corners[from], corners[to], known)) };
  const complex = new Complex(block);
  const rooms = [{ cells: [0], plan: new Set([0]) }];
  const [room] = roomUncertainties(complex, rooms, refined);
  assert.equal(room.perimeter, 14);
  assert.equal(room.unknown, false);
  assert.ok(Math.abs(room.area - 0.001 * Math.hypot(4, 4, 3, 3)) < 1e-9);
  assert.ok(Math.abs(room.volume - 2.5 * room.area) < 1e-9);
  // A wall that moves out makes the two beside it longer.
  assert.ok(Math.abs(room.perimeterSigma - 0.001 * 2 * 2) < 1e-9);

  // A wall that turns about its middle leaves the area as it is, one about its end does not.
  refined.features.forEach(({ properties }) => Object.assign(properties, { sigma_offset_m: 1e-12, sigma_angle_deg: 180 / Math.PI / 1000 }));
  assert.ok(roomUncertainties(complex, rooms, refined)[0].area < 1e-9);
  refined.features[0].geometry.coordinates = [[0, 0], [8, 0]];
  assert.ok(Math.abs(roomUncertainties(complex, rooms, refined)[0].area - 0.001 * 4 * 2) < 1e-9);

  refined.features.pop();
  assert.equal(roomUncertainties(complex, rooms, refined)[0].unknown, true);
});

test("rooms have the cells that extract gave them; a number that the summary does not know is no room", () => {
  const block = { levels: [0, 1, 2], face_offset: [0, 0, 0], edges: [], vertices: [], face_vertex: new Int32Array(), label: [1, 1, 1, 0] };
  const complex = new Complex({ ...block, storey: Int16Array.of(0, 0, 0, -1), room: Int32Array.of(1, 0, 7, -1) });
  const { room, rooms } = roomsOfCells(complex, { rooms: [{ storey: 0, area_m2: 4 }, { storey: 0, area_m2: 3 }] });
  assert.deepEqual([...room], [1, 0, -1, -1]);
  assert.deepEqual(rooms, [
    { storey: 0, area: 4, cells: [1], plan: new Set([1]) },
    { storey: 0, area: 3, cells: [0], plan: new Set([0]) },
  ]);
  assert.deepEqual(roomsOfCells(complex, undefined).rooms, []);
});
