// The regularities of a shape as it was drawn: a switch for each kind, what was found under it.

import { counted, element, short } from "./words.js";

const MOST_NAMED = 6;
// What is off by less, degrees or units, is so up to rounding.
const EXACT = 1e-8;

/** @typedef {import("./types.js").Regularity} Regularity */

export class Regular {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    /** @type {string[]} */
    this.names = [];
    /** @type {Regularity[]} those that are pointed at */
    this.marked = [];
    this.shown = "";
    element("regularities").addEventListener("change", (event) => {
      const { value, checked } = /** @type {HTMLInputElement} */ (event.target);
      this.turn(value, checked);
    });
  }

  /** @param {string} name @param {boolean} on */
  turn(name, on) {
    const { store } = this.app;
    const kept = (store.now.regularities ?? this.names).filter((one) => one !== name);
    const names = on ? this.names.filter((one) => one === name || kept.includes(one)) : kept;
    store.change({ regularities: names.length === this.names.length ? null : names });
  }

  /** Kinds that were found or are switched off, with what was found of them. */
  show() {
    const { app } = this;
    const fit = app.fitter.fits[app.scene.outline];
    // A draft looks for none: what the fit before it had stays until the next whole one.
    if (fit?.draft && app.panel.isDrawn() && this.shown) return;
    const found = [...(fit?.regularities ?? []), ...(app.fitter.done?.regularities ?? [])];
    const kept = app.store.now.regularities ?? this.names;
    const kinds = this.names.filter((name) => !kept.includes(name) || found.some((one) => one.name === name));
    element("regular").hidden = !kinds.length || !app.panel.isDrawn();
    const shown = JSON.stringify([kinds, kept, found]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.mark([]);
    const held = document.activeElement?.id ?? "";
    element("regularities").replaceChildren(...kinds.map((name) => this.kind(name, kept.includes(name), found.filter((one) => one.name === name))));
    if (held.startsWith("regular-")) document.getElementById(held)?.focus();
  }

  /** @param {string} name @param {boolean} on @param {Regularity[]} found */
  kind(name, on, found) {
    const item = document.createElement("li");
    const label = document.createElement("label");
    label.className = "check";
    const box = document.createElement("input");
    Object.assign(box, { type: "checkbox", value: name, checked: on, id: `regular-${name}` });
    label.append(box, ` ${name}`);
    item.append(label);
    if (found.length) item.append(this.details(found));
    // What a kind is about is marked on the drawing while its switch has the focus, too.
    box.addEventListener("focus", () => this.mark(found));
    box.addEventListener("blur", () => this.mark([]));
    label.addEventListener("pointerenter", () => this.mark(found));
    label.addEventListener("pointerleave", () => this.mark([]));
    return item;
  }

  /** How many there are, and each of them on request. @param {Regularity[]} found */
  details(found) {
    const [details, summary, list] = [document.createElement("details"), document.createElement("summary"), document.createElement("ul")];
    summary.textContent = `${found.length} found, ${off(Math.max(...found.map((one) => Math.abs(one.off))))}`;
    list.append(...found.map((regularity) => {
      const { noun, pieces, order, off: by } = regularity;
      const one = document.createElement("li");
      const named = pieces.slice(0, MOST_NAMED).map((piece) => piece + 1).join(", ");
      const fold = order > 1 ? `${order}-fold ` : "";
      one.textContent = `${fold}${counted(pieces.length, noun)}: ${named}${pieces.length > MOST_NAMED ? " …" : ""}; ${off(Math.abs(by))}`;
      one.addEventListener("pointerenter", () => this.mark([regularity]));
      one.addEventListener("pointerleave", () => this.mark([]));
      return one;
    }));
    details.append(summary, list);
    return details;
  }

  /** @param {Regularity[]} regularities */
  mark(regularities) {
    this.marked = regularities;
    this.app.scene.draw();
  }
}

/** How far the data were from it. @param {number} value */
function off(value) {
  return value < EXACT ? "exact before" : `off by ${short(value)} before`;
}
