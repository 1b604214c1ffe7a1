// SPDX-License-Identifier: GPL-3.0-or-later
// Local coordinates, in which the page draws, and the scan's own, in which files are written for people
// (common/geometry/scan_coordinates.h).

const kSame = 1e-3; // [m] an unmoved line, whatever program saved it
const kDecimals = 6;

/** The rotation that brings the unit vector `level` onto z, by rows. */
function levelTurn([x, y, z]) {
  const f = 1 / (1 + z);
  return [[1 - f * x * x, -f * x * y, -x], [-f * x * y, 1 - f * y * y, -y], [x, y, z]];
}

export class ScanCoordinates {
  /** @param frame the member `frame` of an artefact */
  constructor(frame) {
    this.frame = frame;
    this.origin = frame?.origin ?? [0, 0, 0];
    this.turn = levelTurn(frame?.level ?? [0, 0, 1]);
  }
  toScan(local) {
    return this.origin.map((o, k) => this.turn.reduce((sum, row, i) => sum + row[k] * local[i], o));
  }
  toLocal(scan) {
    const moved = scan.map((value, k) => value - this.origin[k]);
    return this.turn.map((row) => row.reduce((sum, value, k) => sum + value * moved[k], 0));
  }
  /** A place of the plan: of the local point at the height of the origin. */
  planToScan([x, y]) {
    return this.toScan([x, y, 0]).slice(0, 2);
  }
  planToLocal([x, y]) {
    const [[a, b], [c, d]] = [0, 1].map((k) => [this.turn[0][k], this.turn[1][k]]);
    const [u, v] = [x - this.origin[0], y - this.origin[1]];
    const determinant = a * d - b * c;
    return [(d * u - b * v) / determinant, (a * v - c * u) / determinant];
  }
  /** A height of the scan as the page says it: at the origin of the plan. */
  captionHeight(local) {
    return this.toScan([0, 0, local])[2];
  }
  /** A height at a place of the plan, given locally. */
  heightToLocal([x, y], scan) {
    return (scan - this.origin[2] - this.turn[0][2] * x - this.turn[1][2] * y) / this.turn[2][2];
  }
}

const mapPoints = (value, change) => (typeof value[0] === "number" ? change(value) : value.map((part) => mapPoints(part, change)));
const mapLines = (features, change) =>
  features.map((feature) => (feature.geometry?.coordinates ? { ...feature, geometry: { ...feature.geometry, coordinates: mapPoints(feature.geometry.coordinates, change) } } : feature));
const mapBox = (box, change) => box && [...change(box.slice(0, 2)), ...change(box.slice(2))];

/** How many lines of a file lie on `known` ones when its points are taken as `toLocal` says. */
function unmoved(geojson, known, toLocal) {
  const near = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]) <= kSame;
  const ends = (feature) => [feature.geometry?.coordinates?.[0], feature.geometry?.coordinates?.at(-1)];
  const lines = known.map(ends);
  return geojson.features.filter((feature) => {
    const [a, b] = ends(feature);
    const [p, q] = a && b && typeof a[0] === "number" ? [toLocal(a), toLocal(b)] : [null, null];
    return p && lines.some(([c, d]) => (near(p, c) && near(q, d)) || (near(p, d) && near(q, c)));
  }).length;
}

/** From the points of a file of lines to local ones. A file without the member `roomcut` does not say which it has: `known` lines decide. */
function toLocalOf(geojson, scan, known) {
  const member = geojson.roomcut;
  const fromScan = (point) => scan.planToLocal(point);
  if (member?.coordinates === "scan") {
    return fromScan;
  }
  if (!member) {
    return unmoved(geojson, known, fromScan) > unmoved(geojson, known, (point) => point) ? fromScan : (point) => point.slice(0, 2);
  }
  const own = new ScanCoordinates(member.frame ?? scan.frame);
  const same = JSON.stringify([own.origin, own.turn]) === JSON.stringify([scan.origin, scan.turn]);
  return same ? (point) => point.slice(0, 2) : (point) => scan.planToLocal(own.planToScan(point));
}

/** A GeoJSON of lines or openings with local coordinates. `known`: features of lines, local. */
export function inLocal(geojson, scan, known = []) {
  if (!geojson || !scan.frame) {
    return geojson;
  }
  const toLocal = toLocalOf(geojson, scan, known);
  const features = mapLines(geojson.features, toLocal).map((feature) => {
    const { sill_z_m: sill, head_z_m: head } = feature.properties ?? {};
    if (sill === undefined || geojson.roomcut?.coordinates !== "scan") {
      return feature;
    }
    const [a, b] = feature.geometry.coordinates;
    const middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    return { ...feature, properties: { ...feature.properties, sill_z_m: scan.heightToLocal(middle, sill), head_z_m: scan.heightToLocal(middle, head) } };
  });
  const member = geojson.roomcut && { ...geojson.roomcut, coordinates: "local", frame: scan.frame, ...(geojson.roomcut.bbox && { bbox: mapBox(geojson.roomcut.bbox, toLocal) }) };
  return { ...geojson, ...(member && { roomcut: member }), features };
}

/** The other way, for files: the scan's own coordinates, six decimals. Of lines. */
export function inScan(geojson, scan) {
  if (!scan.frame) {
    return geojson;
  }
  const toFile = (point) => scan.planToScan(point).map((value) => Number(value.toFixed(kDecimals)));
  const member = { artefact: "wall_lines", length_unit: "m", ...geojson.roomcut, schema_version: "1.1", coordinates: "scan", frame: scan.frame };
  if (member.bbox) {
    member.bbox = mapBox(member.bbox, toFile);
  }
  return { ...geojson, roomcut: member, features: mapLines(geojson.features, toFile) };
}
