// The regularities of a shape as it was drawn: a switch for each kind, what was found under it.

import { element } from "./words.js";

/** @typedef {import("./types.js").Regularity} Regularity */

export class Regular {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    /** @type {string[]} */
    this.names = [];
    /** @type {number[]} pieces of the one that is pointed at */
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
    const found = fit?.regularities ?? [];
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
    const list = document.createElement("ul");
    list.append(...found.map(({ text, pieces }) => {
      const one = document.createElement("li");
      one.textContent = name === "rotation" ? text : text.slice(name.length + 2);
      one.addEventListener("pointerenter", () => this.mark(pieces));
      one.addEventListener("pointerleave", () => this.mark([]));
      return one;
    }));
    item.append(label, list);
    // What a kind is about is marked on the drawing while its switch has the focus, too.
    box.addEventListener("focus", () => this.mark(found.flatMap((one) => one.pieces)));
    box.addEventListener("blur", () => this.mark([]));
    label.addEventListener("pointerenter", () => this.mark(found.flatMap((one) => one.pieces)));
    label.addEventListener("pointerleave", () => this.mark([]));
    return item;
  }

  /** @param {number[]} pieces */
  mark(pieces) {
    this.marked = pieces;
    this.app.scene.draw();
  }
}
