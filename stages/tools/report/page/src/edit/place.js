// SPDX-License-Identifier: GPL-3.0-or-later
// Where the user was in the plan, kept over the reload that follows a run.

import { openPart } from "../tabs.js";

const kKey = "roomcut-place";

/** Remembers slice and view for the page that is about to be loaded anew. */
export function keepPlace(plan, said) {
  const { centre, scale } = plan.view.viewport;
  window.sessionStorage.setItem(kKey, JSON.stringify({ slice: plan.state.slice.index, centre, scale, said }));
}

/** Goes back there, once. @returns {Promise<?string>} what was to be said, or null when nothing was kept */
export async function findPlace(plan) {
  const kept = JSON.parse(window.sessionStorage.getItem(kKey) ?? "null");
  window.sessionStorage.removeItem(kKey);
  if (!kept) {
    return null;
  }
  openPart("plan");
  await plan.choose(plan.slices[kept.slice] ?? plan.bestSlice());
  const { viewport } = plan.view;
  Object.assign(viewport, { centre: kept.centre, scale: kept.scale, fitted: true });
  viewport.redraw();
  return kept.said;
}
