// Two settings on one drawing: a divider between them, and a sentence for each.

import { sentence } from "./panel.js";
import { choice, element } from "./words.js";

export class Compare {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    this.on = false;
    /** @type {import("./types.js").State | null} */
    this.pinned = null;
    choice("second").addEventListener("change", () => this.ask());
    const divider = element("divider");
    divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener("pointermove", (event) => {
      if (!divider.hasPointerCapture(event.pointerId)) return;
      const box = app.scene.canvas.getBoundingClientRect();
      this.moveTo((event.clientX - box.left) / box.width);
    });
    divider.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02 }[event.key];
      if (!step) return;
      event.preventDefault();
      event.stopPropagation();
      this.moveTo(app.scene.split + step);
    });
  }

  /** @param {number} split */
  moveTo(split) {
    this.app.scene.split = Math.min(0.97, Math.max(0.03, split));
    const percent = 100 * this.app.scene.split;
    element("divider").style.left = `${percent}%`;
    element("divider").setAttribute("aria-valuenow", `${Math.round(percent)}`);
    this.app.scene.draw();
  }

  /** @param {boolean} on */
  turn(on) {
    this.on = on;
    this.pinned = on ? this.app.store.now : null;
    element("compare").setAttribute("aria-pressed", String(on));
    for (const id of ["divider", "compare-panel", "sentence-b"]) element(id).hidden = !on;
    this.app.second.clear();
    this.app.scene.second = on ? () => this.app.second.fits : null;
    if (on) {
      this.moveTo(0.5);
      this.ask();
    } else {
      this.app.wire.send({ type: "cancel", slot: "b" });
    }
    this.app.refresh();
  }

  ask() {
    const { app } = this;
    if (!this.on || !this.pinned || !app.scene.shape) return;
    app.second.clear();
    if (choice("second").value === "splprep") {
      const { tolerance } = app.store.now;
      app.second.send({ peer: "splprep", tolerance, outline: app.scene.outline }, false);
    } else {
      app.second.ask(this.pinned, app.scene.outline, false);
    }
  }

  /** The left side was changed: splprep keeps the same tolerance. */
  follow() {
    if (this.on && choice("second").value === "splprep") this.ask();
  }

  show() {
    const line = element("sentence-b");
    if (!this.on) return;
    const text = sentence(this.app.second.fits, this.app.scene.outline);
    line.textContent = text ? `B: ${text}` : "B: fitting.";
    line.classList.toggle("busy", this.app.second.busy);
  }
}
