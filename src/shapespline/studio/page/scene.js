// The scene: what is seen, and when it is drawn again; one frame draws all layers once.

import { colors } from "./colors.js";
import { onceAFrame } from "./frames.js";
import { Grid } from "./grid.js";
import { LAYERS } from "./layers.js";
import { View } from "./view.js";

/** @typedef {import("./types.js").Shape} Shape */
/** @typedef {import("./types.js").Fit} Fit */
/** @typedef {import("./types.js").Hit} Hit */

const NEAR = 9;

export class Scene {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.view = new View();
    /** @type {Shape | null} */
    this.shape = null;
    /** @type {ImageBitmap | null} */
    this.image = null;
    this.outline = 0;
    /** @type {Object<string, boolean>} */
    this.shown = Object.fromEntries(LAYERS.map(([name, , on]) => [name, on]));
    /** @type {() => (Fit | undefined)[]} */
    this.fits = () => [];
    /** @type {(() => (Fit | undefined)[]) | null} left and right of the divider */
    this.second = null;
    this.split = 0.5;
    /** @type {() => number | null} */
    this.tolerance = () => null;
    /** @type {((scene: Scene, c: CanvasRenderingContext2D) => void)[]} drawn above all, in data units */
    this.above = [];
    this.plain = false;
    this.frames = /** @type {number[]} */ ([]);
    this.box = [0, 0, 1, 1];
    /** @type {Grid | null} */
    this.pointGrid = null;
    new ResizeObserver(() => this.resized()).observe(canvas);
  }

  resized() {
    const { view, canvas } = this;
    const box = canvas.getBoundingClientRect();
    if (!box.width || !box.height) return;
    view.ratio = devicePixelRatio || 1;
    const touched = view.touched;
    [view.width, view.height] = [box.width, box.height];
    canvas.width = Math.round(box.width * view.ratio);
    canvas.height = Math.round(box.height * view.ratio);
    if (!touched) view.fit(this.box);
    this.paint();
  }

  /** @param {Shape} shape @param {boolean} stay whether the view stays where it is */
  show(shape, stay) {
    this.shape = shape;
    const [x, y] = shape.origin;
    const f = shape.frame;
    const b = f ? [f[0], f[1], f[0] + f[2], f[1] + f[3]] : shape.box;
    this.box = [b[0] - x, b[1] - y, b[2] - x, b[3] - y];
    this.pointGrid = new Grid(shape.points, shape.diagonal / 300);
    if (!stay) {
      this.outline = 0;
      this.view.fit(this.box);
    }
    this.outline = Math.min(this.outline, shape.outlines.length - 1);
    this.draw();
  }

  /** Draw soon, once. */
  draw = onceAFrame(() => this.paint());

  paint() {
    const began = performance.now();
    const { context: c, view } = this;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.fillStyle = colors().ground;
    c.fillRect(0, 0, this.canvas.width, this.canvas.height);
    if (!this.shape) return;
    if (this.second) {
      const at = Math.round(this.split * this.canvas.width);
      this.layers(0, at, this.fits);
      this.layers(at, this.canvas.width - at, this.second);
    } else {
      this.layers(0, this.canvas.width, this.fits);
    }
    view.apply(c);
    for (const drawing of this.above) drawing(this, c);
    this.frames.push(performance.now() - began);
    if (this.frames.length > 500) this.frames.shift();
  }

  /** Whether a layer is drawn if it is wanted: beside the paper's method only what is fitted. @param {string} name */
  shows(name) {
    return !this.plain || name === "source" || name === "points";
  }

  /** @param {number} left @param {number} width device pixels @param {() => (Fit | undefined)[]} fits */
  layers(left, width, fits) {
    const { context: c, fits: held } = this;
    this.fits = fits;
    c.save();
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.beginPath();
    c.rect(left, 0, width, this.canvas.height);
    c.clip();
    for (const [name, , , drawing] of LAYERS) {
      if (!this.shown[name] || !this.shows(name)) continue;
      c.save();
      this.view.apply(c);
      drawing(this, c);
      c.restore();
    }
    c.restore();
    this.fits = held;
  }

  /** Index of the outline that a drawn point belongs to. @param {number} i */
  outlineOf(i) {
    const outlines = this.shape?.outlines ?? [];
    let k = 0;
    while (k + 1 < outlines.length && outlines[k + 1].first <= i) k += 1;
    return k;
  }

  /** Place of a point of an outline, by its index among all its points. @param {number} k @param {number} point */
  pointPlace(k, point) {
    const shape = /** @type {Shape} */ (this.shape);
    const { first, n_drawn } = shape.outlines[k];
    let [low, high] = [first, first + n_drawn - 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (shape.indices[middle] < point) low = middle + 1;
      else high = middle;
    }
    return { x: shape.points[2 * low], y: shape.points[2 * low + 1], drawn: low };
  }

  /** What lies under a place of the canvas, nodes before points. @param {number} px @param {number} py @returns {Hit | null} */
  hit(px, py) {
    const [x, y] = this.view.toData(px, py);
    const radius = NEAR / this.view.scale;
    /** @type {Hit | null} */
    let found = null;
    let least = radius * radius;
    this.fits().forEach((fit, outline) => {
      if (!fit) return;
      for (let i = 0; i < fit.turns.length; i++) {
        const d = (fit.nodes[2 * i] - x) ** 2 + (fit.nodes[2 * i + 1] - y) ** 2;
        if (d <= least) {
          least = d;
          found = { kind: fit.turns[i] ? "corner" : "node", outline, x: fit.nodes[2 * i],
            y: fit.nodes[2 * i + 1], node: i, point: fit.points[i] };
        }
      }
    });
    if (found || !this.shape || !this.pointGrid) return found;
    const i = this.pointGrid.nearest(x, y, radius);
    if (i < 0) return null;
    return { kind: "point", outline: this.outlineOf(i), x: this.shape.points[2 * i],
      y: this.shape.points[2 * i + 1], node: -1, point: this.shape.indices[i] };
  }
}
