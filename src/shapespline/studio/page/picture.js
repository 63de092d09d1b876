// How a picture is read: level, colours, specks, part, size; each change reads it again.

import { choice, element, input, say } from "./words.js";

// After the last move of the level so long is waited, milliseconds.
const PATIENCE = 120;

export class Picture {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    this.timer = 0;
    for (const id of ["p-colors", "p-specks", "p-invert", "p-auto", "p-width", "p-unordered"]) {
      input(id).addEventListener("change", () => this.changed());
    }
    choice("p-mode").addEventListener("change", () => this.changed());
    const level = input("p-level");
    level.addEventListener("input", () => {
      input("p-auto").checked = false;
      element("p-level-out").textContent = level.value;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.changed(), PATIENCE);
    });
    element("p-crop").addEventListener("click", () => app.tools.turn("crop"));
    element("p-whole").addEventListener("click", () => this.apply({ ...this.said(), crop: undefined }));
  }

  /** What the controls say, as options of reading. @returns {Object<string, any>} */
  said() {
    const { store, scene } = this.app;
    /** @type {Object<string, any>} */
    const said = {};
    if (!scene.shape?.picture) return input("p-unordered").checked ? { unordered: true } : {};
    const mode = choice("p-mode").value;
    if (mode === "colors") said.colors = Math.round(+input("p-colors").value) || 6;
    if (mode === "centerline") said.centerline = true;
    if (mode !== "colors") {
      if (!input("p-auto").checked) said.level = +input("p-level").value;
      if (input("p-invert").checked) said.invert = true;
    }
    if (input("p-specks").value !== "") said.min_area = +input("p-specks").value;
    const wide = +input("p-width").value;
    const pixels = this.app.files.pixels;
    if (wide > 0 && pixels) Object.assign(said, { scale: wide / pixels, unit: "mm" });
    if (store.now.reading.crop) said.crop = store.now.reading.crop;
    return said;
  }

  changed() {
    this.apply(this.said());
  }

  /** @param {Object<string, any>} reading */
  apply(reading) {
    const { store, scene } = this.app;
    const known = Object.fromEntries(Object.entries(reading).filter(([, value]) => value !== undefined));
    const before = store.now.reading.scale ?? 1;
    // The tolerance goes with the unit.
    const tolerance = Number((store.now.tolerance * ((known.scale ?? 1) / before)).toPrecision(3));
    if (scene.shape) store.change({ reading: known, own: {}, tolerance });
  }

  /** A part of the picture, from two places of the drawing. @param {[number, number][]} ends */
  cropTo(ends) {
    const { store, files } = this.app;
    const { shape } = this.app.scene;
    if (!shape?.frame || ends.length < 2) return;
    const per = store.now.reading.scale ?? 1;
    const [fx, fy, , fh] = shape.frame;
    const columns = ends.map(([x]) => (x + shape.origin[0] - fx) / per);
    const rows = ends.map(([, y]) => (fy + fh - y - shape.origin[1]) / per);
    const whole = [files.pixels || 1e9, files.rows || 1e9];
    const [left, top] = [Math.max(0, Math.floor(Math.min(...columns))), Math.max(0, Math.floor(Math.min(...rows)))];
    const [right, low] = [Math.min(whole[0], Math.ceil(Math.max(...columns))), Math.min(whole[1], Math.ceil(Math.max(...rows)))];
    this.app.tools.turn("");
    if (right - left > 2 && low - top > 2) this.apply({ ...this.said(), crop: `${left},${top},${right - left},${low - top}` });
  }

  /** Show how the document was read. */
  show() {
    const { scene, store } = this.app;
    const { reading } = store.now;
    element("picture").hidden = !scene.shape?.picture;
    element("points-in").hidden = !/\.(csv|txt|dat|xy|xyz|tsv|npy)$/i.test(scene.shape?.name ?? "");
    choice("p-mode").value = reading.colors ? "colors" : reading.centerline ? "centerline" : "ink";
    for (const one of document.querySelectorAll(".p-ink")) /** @type {HTMLElement} */ (one).hidden = Boolean(reading.colors);
    for (const one of document.querySelectorAll(".p-colors")) /** @type {HTMLElement} */ (one).hidden = !reading.colors;
    input("p-auto").checked = reading.level === undefined;
    if (reading.level !== undefined) input("p-level").value = `${reading.level}`;
    else input("p-level").value = "128";
    element("p-level-out").textContent = reading.level === undefined ? "auto" : `${reading.level}`;
    if (reading.colors) input("p-colors").value = `${reading.colors}`;
    input("p-specks").value = reading.min_area === undefined ? "" : `${reading.min_area}`;
    input("p-invert").checked = Boolean(reading.invert);
    input("p-unordered").checked = Boolean(reading.unordered);
    input("p-width").value = reading.scale ? `${Number((reading.scale * this.app.files.pixels).toPrecision(6))}` : "";
    element("p-whole").toggleAttribute("disabled", !reading.crop);
    say("notes", scene.shape?.sentences ?? []);
  }
}
