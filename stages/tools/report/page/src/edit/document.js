// SPDX-License-Identifier: GPL-3.0-or-later
// The wall lines being edited: a list that is replaced, never changed, so that undo is a step back. What is written keeps what
// schemas/wall_lines.md asks for: ids, unknown properties, the member `roomcut` with the digest of the detection it began from.

import { inLocal, inScan, ScanCoordinates } from "../data/coordinates.js";

const kSame = 2e-6; // [m] accept_lines takes ends this near for unmoved

/**
 * @typedef {object} EditLine
 * @property {string} key      its wall_id, or "new 1" … for a line drawn here
 * @property {number[]} a      ends, local metres
 * @property {number[]} b
 * @property {boolean} locked
 * @property {?object} feature as it was read; null for a new line
 */

/** The lines of a GeoJSON. A polyline is split as accept_lines splits it: w0007.1, w0007.2 … */
function linesOf(geojson) {
  const lines = [];
  for (const feature of geojson.features ?? []) {
    const parts = feature.geometry?.type === "MultiLineString" ? feature.geometry.coordinates : [feature.geometry?.coordinates ?? []];
    const segments = parts.flatMap((points) => points.slice(1).map((point, i) => [points[i], point]));
    segments.forEach(([a, b], i) => {
      const properties = { ...feature.properties };
      const id = properties.wall_id ?? `unnamed ${lines.length + 1}`;
      if (segments.length > 1) {
        properties.wall_id = `${id}.${i + 1}`;
      }
      lines.push({
        key: segments.length > 1 ? `${id}.${i + 1}` : String(id),
        a: a.slice(0, 2),
        b: b.slice(0, 2),
        locked: isTrue(properties.locked),
        feature: { ...feature, properties },
      });
    });
  }
  return lines;
}

const isTrue = (value) => value === true || ["true", "yes", "1"].includes(String(value).toLowerCase());
const near = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]) <= kSame;
const sameEnds = (l, m) => (near(l.a, m.a) && near(l.b, m.b)) || (near(l.a, m.b) && near(l.b, m.a));

/** Signed offset of a line's middle from another line, along the other's normal [m]. */
export function offsetBetween(from, to) {
  const [dx, dy] = [from.b[0] - from.a[0], from.b[1] - from.a[1]];
  const length = Math.hypot(dx, dy);
  const middle = [(to.a[0] + to.b[0]) / 2 - from.a[0], (to.a[1] + to.b[1]) / 2 - from.a[1]];
  return (-dy * middle[0] + dx * middle[1]) / length;
}

export class LineDocument {
  /** @param geojson a file of lines @param scan of the run @param known its lines' features, local: see inLocal() */
  constructor(geojson, scan = new ScanCoordinates(null), known = []) {
    this.scan = scan;
    this.base = inLocal(geojson, scan, known);
    this.original = linesOf(this.base);
    this.lines = this.original;
    this.past = [];
    this.future = [];
    this.saved = this.lines;
    this.drawn = 0;
  }

  find(key) {
    return this.lines.find((line) => line.key === key) ?? null;
  }

  /** One step of editing: what was before can be had again with undo(). */
  commit(lines) {
    if (lines !== this.lines) {
      this.past.push(this.lines);
      this.future = [];
      this.lines = lines;
    }
  }
  undo() {
    if (this.past.length > 0) {
      this.future.push(this.lines);
      this.lines = this.past.pop();
    }
  }
  redo() {
    if (this.future.length > 0) {
      this.past.push(this.lines);
      this.lines = this.future.pop();
    }
  }

  /** The lines with one replaced; not yet a step. */
  with(key, changes) {
    return this.lines.map((line) => (line.key === key ? { ...line, ...changes } : line));
  }
  /** Adds a line and returns its key. */
  add(a, b) {
    const key = `new ${++this.drawn}`;
    this.commit([...this.lines, { key, a, b, locked: false, feature: null }]);
    return key;
  }
  remove(key) {
    this.commit(this.lines.filter((line) => line.key !== key));
  }
  /** Moves a line along its normal (its direction turned to the left) [m]. */
  shift(key, offset) {
    const line = this.find(key);
    const { a, b } = shifted(line, offset);
    this.commit(this.with(key, { a, b }));
  }
  setLocked(key, locked) {
    this.commit(this.with(key, { locked }));
  }

  get isSaved() {
    return this.lines === this.saved;
  }

  /** What differs from the lines that the editing began from, one text a line. */
  changes() {
    const list = [];
    const now = new Map(this.lines.map((line) => [line.key, line]));
    for (const before of this.original) {
      const after = now.get(before.key);
      if (!after) {
        list.push(`${before.key} deleted`);
        continue;
      }
      if (!sameEnds(before, after)) {
        list.push(`${before.key} ${describeMove(before, after)}`);
      }
      if (before.locked !== after.locked) {
        list.push(`${before.key} ${after.locked ? "locked" : "unlocked"}`);
      }
    }
    const known = new Set(this.original.map((line) => line.key));
    for (const line of this.lines.filter(({ key }) => !known.has(key))) {
      list.push(`${line.key} added, ${lengthOf(line).toFixed(2)} m${line.locked ? ", locked" : ""}`);
    }
    return list;
  }

  /** The text of wall_lines.geojson, in the scan's own coordinates: one feature a line, six decimals. */
  toText() {
    const { features, ...members } = inScan({ ...this.base, features: this.lines.map((line) => this.featureOf(line)) }, this.scan);
    const head = Object.entries(members).map(([name, value]) => `${JSON.stringify(name)}: ${JSON.stringify(value)}`);
    const rows = features.map((feature) => JSON.stringify(feature));
    return `{\n${[...head, `"features": [\n${rows.join(",\n")}\n]`].join(",\n")}\n}\n`;
  }

  featureOf(line) {
    const coordinates = [line.a, line.b].map((point) => point.map((value) => Number(value.toFixed(6))));
    if (!line.feature) {
      // No wall_id: accept_lines gives it one.
      return { type: "Feature", properties: { locked: line.locked }, geometry: { type: "LineString", coordinates } };
    }
    const properties = { ...line.feature.properties };
    if (isTrue(properties.locked) !== line.locked) {
      properties.locked = line.locked;
    }
    return { ...line.feature, properties, geometry: { type: "LineString", coordinates } };
  }
}

export function lengthOf({ a, b }) {
  return Math.hypot(b[0] - a[0], b[1] - a[1]);
}

/** The ends of a line moved along its normal [m]. */
export function shifted({ a, b }, offset) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const move = [(-(b[1] - a[1]) / length) * offset, ((b[0] - a[0]) / length) * offset];
  return { a: [a[0] + move[0], a[1] + move[1]], b: [b[0] + move[0], b[1] + move[1]] };
}

function describeMove(before, after) {
  const turn = Math.abs(angleOf(after) - angleOf(before)) % Math.PI;
  const degrees = (Math.min(turn, Math.PI - turn) * 180) / Math.PI;
  const parts = [`moved ${(1e3 * Math.abs(offsetBetween(before, after))).toFixed(0)} mm`];
  if (degrees > 0.005) {
    parts.push(`turned ${degrees.toFixed(2)}°`);
  }
  const longer = lengthOf(after) - lengthOf(before);
  if (Math.abs(longer) > 0.0005) {
    parts.push(`${Math.abs(longer).toFixed(3)} m ${longer > 0 ? "longer" : "shorter"}`);
  }
  return parts.join(", ");
}

export function angleOf({ a, b }) {
  return Math.atan2(b[1] - a[1], b[0] - a[0]);
}
