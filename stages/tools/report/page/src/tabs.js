// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the page as tabs: click, or arrow keys as the pattern of WAI-ARIA has it.

import { byId } from "./dom.js";

const kParts = ["model", "plan", "levels", "rooms", "stages"];

export function openPart(part) {
  for (const name of kParts) {
    const tab = byId(`tab-${name}`);
    const open = name === part;
    tab.setAttribute("aria-selected", String(open));
    tab.tabIndex = open ? 0 : -1;
    byId(`part-${name}`).hidden = !open;
  }
}

export function startTabs() {
  kParts.forEach((part, i) => {
    const tab = byId(`tab-${part}`);
    tab.addEventListener("click", () => openPart(part));
    tab.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step) {
        const next = kParts[(i + step + kParts.length) % kParts.length];
        openPart(next);
        byId(`tab-${next}`).focus();
      }
    });
  });
}
