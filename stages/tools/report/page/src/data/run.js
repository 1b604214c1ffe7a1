// SPDX-License-Identifier: GPL-3.0-or-later
// Everything the page knows of one run. What the run had not made yet is null.

import { useColours } from "../colours.js";
import { loadBlock } from "./blocks.js";
import { Complex } from "./complex.js";
import { inLocal, ScanCoordinates } from "./coordinates.js";
import { roomsOfCells } from "./rooms.js";

/**
 * @typedef {object} Run
 * @property {object} facts      block `run`: levels, histogram, noise, density, frame, summary, colours
 * @property {ScanCoordinates} scan  where local coordinates lie in the scan's own
 * @property {object} lines      block `lines`: detected, lines (accepted), refined, openings; GeoJSON in local coordinates
 * @property {object[]} stages   block `logs`
 * @property {?object} model     block `model`
 * @property {?object} cloud     block `cloud`
 * @property {?Complex} complex  block `cells`
 * @property {?object} storeys   storey and room of each cell
 * @property {number[]} box      low and high corner of what is shown, local metres
 */

/** @returns {Promise<Run>} */
export async function loadRun() {
  const [facts, lines, logs, model, cloud, cells] = await Promise.all(
    ["run", "lines", "logs", "model", "cloud", "cells"].map(loadBlock),
  );
  useColours(facts?.colours);
  const scan = new ScanCoordinates(facts?.frame ?? facts?.summary?.frame ?? lines?.detected?.roomcut?.frame);
  const complex = cells ? new Complex(cells, scan) : null;
  return {
    facts: facts ?? {},
    scan,
    lines: Object.fromEntries(["detected", "lines", "refined", "openings"].map((name) => [name, inLocal(lines?.[name], scan)])),
    stages: logs?.stages ?? [],
    model,
    cloud,
    complex,
    storeys: complex ? roomsOfCells(complex, facts?.summary) : null,
    box: model ? boxOf(model.vertices) : (facts?.bbox ?? [0, 0, 0, 1, 1, 1]),
  };
}

function boxOf(vertices) {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  vertices.forEach((value, i) => {
    box[i % 3] = Math.min(box[i % 3], value);
    box[3 + (i % 3)] = Math.max(box[3 + (i % 3)], value);
  });
  return box;
}

/** Wall slices: {index, low, high, name, layer of the complex} from below. */
export function slicesOf(run) {
  const levels = run.facts.levels ?? [];
  return levels.slice(0, -1).map((level, index) => {
    const [low, high] = [level.z, levels[index + 1].z];
    return {
      index,
      low,
      high,
      name: `${index}: ${[low, high].map((z) => run.scan.captionHeight(z).toFixed(2)).join(" … ")} m`,
      layer: run.complex ? run.complex.layerBetween(low, high) : -1,
    };
  });
}

/** The cells of a slice's occupancy grid with their points' centroids, or null. */
export async function loadSlice(run, index) {
  const block = await loadBlock(`slice-${index}`);
  if (block && !block.x) {
    const count = block.ix.length;
    block.x = new Float32Array(count);
    block.y = new Float32Array(count);
    for (let i = 0; i < count; ++i) {
      block.x[i] = (block.ix[i] + block.inside[2 * i] / 255) * run.facts.tau_m;
      block.y[i] = (block.iy[i] + block.inside[2 * i + 1] / 255) * run.facts.tau_m;
    }
  }
  return block;
}

/** Doors and other openings of a GeoJSON as {id, a, b, thickness, sill, head, properties}. */
export function openingsOf(geojson) {
  return (geojson?.features ?? []).map(({ properties, geometry }) => ({
    id: properties.opening_id,
    a: geometry.coordinates[0],
    b: geometry.coordinates[1],
    thickness: properties.thickness_m,
    sill: properties.sill_z_m,
    head: properties.head_z_m,
    properties,
  }));
}

/** Wall lines of a GeoJSON as {id, a, b, properties}. */
export function wallLines(geojson) {
  return (geojson?.features ?? []).map(({ properties, geometry }) => ({
    id: properties.wall_id,
    a: geometry.coordinates[0],
    b: geometry.coordinates[1],
    properties,
  }));
}
