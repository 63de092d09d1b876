// The graphs below the drawing: error, H, convergence, pieces; what is under the pointer is marked in both.

import { colors } from "./colors.js";
import { onceAFrame } from "./frames.js";
import { Plot } from "./plot.js";
import { byId, counted, element, short } from "./words.js";

/** @typedef {import("./types.js").Fit} Fit */

const TABS = [["error", "Error along the outline"], ["h", "H and maxima"],
  ["convergence", "Convergence"], ["pieces", "Pieces"]];
const MOST_ROWS = 400;
const FILM_DASHES = [[], [7, 3], [2, 3], [9, 3, 2, 3]];

export class Graph {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    this.tab = "error";
    this.plot = new Plot(byId("graph", HTMLCanvasElement));
    /** @type {number | null} arc length that is marked */
    this.mark = null;
    /** @type {{x: number, y: number} | null} the same on the drawing */
    this.place = null;
    const list = element("tabs");
    list.replaceChildren(...TABS.map(([name, title]) => {
      const tab = document.createElement("button");
      Object.assign(tab, { id: `tab-${name}`, textContent: title, type: "button" });
      tab.setAttribute("role", "tab");
      tab.setAttribute("aria-controls", "graph-panel");
      tab.addEventListener("click", () => this.show(name));
      return tab;
    }));
    list.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      event.stopPropagation();
      const k = TABS.findIndex(([name]) => name === this.tab);
      this.show(TABS[(k + step + TABS.length) % TABS.length][0]);
      element(`tab-${this.tab}`).focus();
    });
    const panel = element("graph-panel");
    this.plot.canvas.addEventListener("pointermove", (event) => {
      this.markAt(this.plot.xAt(event.clientX - panel.getBoundingClientRect().left));
    });
    this.plot.canvas.addEventListener("pointerleave", () => this.markAt(null));
    panel.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step || this.tab === "pieces") return;
      event.preventDefault();
      event.stopPropagation();
      const [low, high] = this.plot.range;
      this.markAt(Math.min(high, Math.max(low, (this.mark ?? low) + (step * (high - low)) / (event.shiftKey ? 20 : 200))));
    });
    new ResizeObserver(() => this.draw()).observe(panel);
    this.show("error");
  }

  /** @param {string} tab */
  show(tab) {
    this.tab = tab;
    for (const [name] of TABS) {
      const one = element(`tab-${name}`);
      one.setAttribute("aria-selected", String(name === tab));
      one.tabIndex = name === tab ? 0 : -1;
    }
    element("graph-panel").setAttribute("aria-labelledby", `tab-${tab}`);
    element("table").hidden = tab !== "pieces";
    this.plot.canvas.hidden = tab === "pieces";
    this.mark = null;
    this.draw();
  }

  draw = onceAFrame(() => this.paint());

  paint() {
    const { scene } = this.app;
    const fit = scene.fits()[scene.outline];
    if (this.tab === "error") this.paintError(fit);
    if (this.tab === "h") this.paintH();
    if (this.tab === "convergence") this.paintConvergence();
    if (this.tab === "pieces") this.paintPieces(fit);
  }

  /** @param {Fit | undefined} fit */
  paintError(fit) {
    const { scene } = this.app;
    const { plot } = this;
    if (!fit || !scene.shape) {
      plot.begin([0, 1, -1, 1]);
      return;
    }
    const { length, first } = scene.shape.outlines[scene.outline];
    const { errors, tolerance } = fit;
    const high = 1.25 * Math.max(tolerance, fit.hausdorff_distance) || 1;
    const unit = scene.shape.unit ? `, ${scene.shape.unit}` : "";
    const name = () => plot.names(`along the outline${unit}`, `off${unit}`);
    plot.begin([0, length, -high, high]);
    const palette = colors();
    for (const side of [-tolerance, tolerance]) plot.line([[0, side], [length, side]], palette.held, 1.2, [6, 4]);
    const { at } = scene.shape;
    if (errors.length === scene.shape.outlines[scene.outline].n_drawn) {
      plot.line(function* () {
        for (let i = 0; i < errors.length; i++) yield /** @type {[number, number]} */ ([at[first + i], errors[i]]);
      }(), palette.line, 1.4);
    }
    name();
    if (this.mark !== null) this.markLine(high);
    plot.canvas.setAttribute("aria-label", `Distance of ${counted(errors.length, "point")} to the curve along the outline; ` +
      `at most ${short(fit.max_distance)}, tolerance ${short(tolerance)}.`);
  }

  /** @param {number} high */
  markLine(high) {
    const x = /** @type {number} */ (this.mark);
    this.plot.line([[x, -high], [x, high]], colors().ink, 1);
  }

  paintH() {
    const { start } = this.app.paper;
    const { plot } = this;
    if (!start) {
      plot.begin([0, 1, 0, 1]);
      plot.says("Press Paper to see H and its maxima.");
      return;
    }
    const { h, maxima } = start;
    let high = 0;
    for (let i = 1; i < h.length; i += 2) high = Math.max(high, h[i]);
    plot.begin([0, h[h.length - 2], 0, 1.15 * high || 1]);
    plot.line(function* () {
      for (let i = 0; i < h.length; i += 2) yield /** @type {[number, number]} */ ([h[i], h[i + 1]]);
    }(), colors().line, 1.4);
    plot.names("along the outline", `H, L = ${start.length}`);
    for (const i of maxima) plot.dot(h[2 * i], h[2 * i + 1], colors().corner, 3.4);
    if (this.mark !== null) this.plot.line([[this.mark, 0], [this.mark, high]], colors().ink, 1);
    plot.canvas.setAttribute("aria-label", `H along the outline with ${counted(maxima.length, "maximum").replace("maximums", "maxima")}`);
  }

  paintConvergence() {
    const { films, filmOf, frame } = this.app.paper;
    const { plot } = this;
    const all = Object.values(films);
    if (!all.length) {
      plot.begin([0, 1, 0, 1]);
      plot.says("Press Paper and tick methods to see them converge.");
      return;
    }
    let [most, low, high] = [1, Infinity, 0];
    for (const { history } of all) {
      for (let i = 0; i < history.length; i += 3) {
        if (history[i + 1] > 0) low = Math.min(low, history[i + 1]);
        high = Math.max(high, history[i + 1]);
      }
      most = Math.max(most, history[history.length - 3]);
    }
    plot.begin([0, most, low * 0.8, high * 1.25], true);
    const palette = [colors().line, colors().corner, colors().bezier, colors().spline, colors().held, colors().soft];
    all.forEach(({ history, method, asked, iterations }, k) => {
      plot.line(function* () {
        for (let i = 0; i < history.length; i += 3) yield /** @type {[number, number]} */ ([history[i], history[i + 1]]);
      }(), palette[k % palette.length], 1.8, FILM_DASHES[k % FILM_DASHES.length]);
      const c = plot.context;
      c.fillStyle = palette[k % palette.length];
      c.textAlign = "right";
      c.fillText(method, plot.width - 18, 20 + 15 * k);
      if (asked === filmOf) {
        const at = iterations[Math.min(frame, iterations.length - 1)];
        plot.dot(at, history[3 * Math.min(at, history.length / 3 - 1) + 1], palette[k % palette.length], 4.5);
      }
    });
    plot.names("iteration", "the paper's E");
    plot.canvas.setAttribute("aria-label", "Error over the iterations: " +
      all.map((one) => `${one.method} ends at ${short(one.error)} after ${counted(one.n_iterations, "iteration")}`).join("; "));
  }

  /** @param {Fit | undefined} fit */
  paintPieces(fit) {
    const table = document.createElement("table");
    table.innerHTML = "<thead><tr><th>#</th><th>kind</th><th>points</th><th>from</th><th>joint</th></tr></thead>";
    const body = table.createTBody();
    const shape = this.app.scene.shape;
    for (let p = 0; fit && shape && p < Math.min(fit.kinds.length, MOST_ROWS); p++) {
      const row = body.insertRow();
      const [x, y] = [fit.nodes[2 * p], fit.nodes[2 * p + 1]];
      const cells = [p + 1, fit.kinds[p], fit.polygons[p], `${short(x + shape.origin[0], 5)}, ${short(y + shape.origin[1], 5)}`,
        fit.turns[p] ? "corner" : "smooth"];
      for (const cell of cells) row.insertCell().textContent = `${cell}`;
      row.addEventListener("pointerenter", () => this.markPlace({ x, y }));
      row.addEventListener("pointerleave", () => this.markPlace(null));
    }
    if (fit && fit.kinds.length > MOST_ROWS) {
      body.insertRow().insertCell().textContent = `and ${fit.kinds.length - MOST_ROWS} more`;
    }
    element("table").replaceChildren(table);
  }

  /** @param {number | null} x arc length */
  markAt(x) {
    this.mark = x;
    const { scene, paper } = this.app;
    let place = null;
    if (x !== null && this.tab === "error" && scene.shape) {
      const { first, n_drawn } = scene.shape.outlines[scene.outline];
      let best = first;
      for (let i = first; i < first + n_drawn; i++) {
        if (Math.abs(scene.shape.at[i] - x) < Math.abs(scene.shape.at[best] - x)) best = i;
      }
      place = { x: scene.shape.points[2 * best], y: scene.shape.points[2 * best + 1] };
      const error = scene.fits()[scene.outline]?.errors[best - first];
      element("under").textContent = error === undefined ? "" : `Point ${scene.shape.indices[best] + 1}: ${short(Math.abs(error))} off`;
    } else if (x !== null && this.tab === "h" && paper.start) {
      const { h, places } = paper.start;
      let best = 0;
      for (let i = 0; i < h.length / 2; i++) if (Math.abs(h[2 * i] - x) < Math.abs(h[2 * best] - x)) best = i;
      place = { x: places[2 * best], y: places[2 * best + 1] };
      element("under").textContent = `H = ${short(h[2 * best + 1])}`;
    } else if (x === null) {
      element("under").textContent = "";
    }
    this.markPlace(place);
  }

  /** @param {{x: number, y: number} | null} place */
  markPlace(place) {
    this.place = place;
    this.app.scene.draw();
    if (this.tab !== "pieces") this.draw();
  }

  /** A point of the drawing is under the pointer. @param {number} outline @param {number} point */
  atPoint(outline, point) {
    const { scene } = this.app;
    if (outline !== scene.outline || !scene.shape) return;
    this.mark = scene.shape.at[scene.pointPlace(outline, point).drawn];
    if (this.tab !== "pieces") this.draw();
  }

  /** The pointer is somewhere on the drawing: what is nearest of the outline is marked. @param {number} x @param {number} y */
  nearCanvas(x, y) {
    const { scene } = this.app;
    const i = scene.pointGrid?.nearest(x, y, 40 / scene.view.scale) ?? -1;
    const mark = i >= 0 && scene.shape && scene.outlineOf(i) === scene.outline ? scene.shape.at[i] : null;
    if (mark === this.mark) return;
    this.mark = mark;
    if (this.tab !== "pieces") this.draw();
  }
}
