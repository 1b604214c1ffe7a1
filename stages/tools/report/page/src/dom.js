// SPDX-License-Identifier: GPL-3.0-or-later

/** An element with attributes (`on…` = listener, `class`, `text`) and children. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) {
      element.addEventListener(name.slice(2), value);
    } else if (name === "text") {
      element.textContent = value;
    } else if (typeof value === "boolean") {
      element.toggleAttribute(name, value);
    } else {
      element.setAttribute(name, value);
    }
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

export const byId = (id) => document.getElementById(id);

/** A number with its digits after the point; "–" for what is not there. */
export function number(value, digits = 2) {
  const text = Number.isFinite(value) ? value.toFixed(digits) : "–";
  return /^-0\.?0*$/.test(text) ? text.slice(1) : text;
}

/** A few significant digits, for values of any size. */
export function short(value) {
  if (!Number.isFinite(value)) {
    return String(value ?? "–");
  }
  return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(4)));
}
