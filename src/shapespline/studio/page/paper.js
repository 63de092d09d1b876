// The published method on the drawing: H, frames, the initial curve, iterates as a film, methods side by side.

import { colors } from "./colors.js";
import { capital, choice, element, fill, input, short, time } from "./words.js";

/** @typedef {import("./types.js").PaperStart} PaperStart */
/** @typedef {import("./types.js").Film} Film */

const STEPS = [["points", "Points"], ["maxima", "Maxima"], ["frames", "Frames"], ["initial", "Initial"], ["film", "Film"]];
const FRAME_MS = 140;

export class Paper {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    this.on = false;
    /** @type {PaperStart | null} */
    this.start = null;
    /** @type {Object<string, Film>} */
    this.films = {};
    this.filmOf = "";
    this.frame = 0;
    this.step = "film";
    this.generation = 0;
    this.timer = 0;
    element("steps").replaceChildren(...STEPS.map(([value, text]) => {
      const label = document.createElement("label");
      label.innerHTML = `<input type="radio" name="step" value="${value}"><span>${text}</span>`;
      return label;
    }));
    element("steps").addEventListener("change", (event) => {
      this.step = /** @type {HTMLInputElement} */ (event.target).value;
      this.app.scene.draw();
    });
    for (const id of ["length", "literal"]) input(id).addEventListener("input", () => this.ask());
    element("methods").addEventListener("change", () => this.ask());
    input("frame").addEventListener("input", () => this.turnTo(+input("frame").value));
    choice("film-of").addEventListener("change", () => this.choose(choice("film-of").value));
    element("play").addEventListener("click", () => this.play());
  }

  /** @param {string[]} methods */
  offer(methods) {
    element("methods").replaceChildren(...methods.map((name, k) => {
      const label = document.createElement("label");
      label.className = "check";
      label.innerHTML = `<input type="checkbox" value="${name}" ${k === 0 ? "checked" : ""}> ${name}`;
      return label;
    }));
  }

  /** @param {boolean} on */
  turn(on) {
    this.on = on;
    element("paper").setAttribute("aria-pressed", String(on));
    element("paper-panel").hidden = !on;
    element("fit-panel").hidden = on;
    this.app.scene.plain = on;
    this.app.panel.layersOffered();
    this.stop();
    if (on) {
      this.showStep("film");
      this.ask();
      this.app.graph.show("h");
    } else {
      this.app.wire.send({ type: "cancel", slot: "paper" });
      this.app.graph.show("error");
    }
    this.app.refresh();
  }

  /** @param {string} step */
  showStep(step) {
    this.step = step;
    for (const one of document.getElementsByName("step")) {
      const radio = /** @type {HTMLInputElement} */ (one);
      radio.checked = radio.value === step;
    }
  }

  ask() {
    if (!this.on) return;
    const length = +input("length").value;
    element("length-out").textContent = `${length}`;
    this.generation += 1;
    this.films = {};
    const methods = [...document.querySelectorAll("#methods input:checked")].map((one) => /** @type {HTMLInputElement} */ (one).value);
    this.app.wire.send({ type: "paper", generation: this.generation, outline: this.app.scene.outline,
      length, literal: input("literal").checked, methods });
  }

  /** @param {PaperStart & {generation: number}} message */
  hear(message) {
    if (message.generation !== this.generation) return;
    this.start = message;
    this.figures();
    this.app.refresh();
  }

  /** @param {Film & {generation: number}} message */
  hearFilm(message) {
    if (message.generation !== this.generation) return;
    this.films[message.asked] = message;
    fill(choice("film-of"), Object.values(this.films).map((one) => /** @type {[string, string]} */ ([one.asked, one.method])));
    this.choose(this.films[this.filmOf] ? this.filmOf : message.asked);
  }

  /** @param {string} asked */
  choose(asked) {
    this.filmOf = asked;
    choice("film-of").value = asked;
    const last = (this.films[asked]?.iterations.length ?? 1) - 1;
    input("frame").max = `${last}`;
    this.turnTo(last);
    this.figures();
  }

  /** @param {number} frame */
  turnTo(frame) {
    this.frame = frame;
    input("frame").value = `${frame}`;
    element("frame-out").textContent = `${this.films[this.filmOf]?.iterations[frame] ?? 0}`;
    this.app.refresh();
  }

  play() {
    if (this.timer) {
      this.stop();
      return;
    }
    const film = this.films[this.filmOf];
    if (!film) return;
    this.showStep("film");
    this.app.graph.show("convergence");
    let frame = 0;
    element("play").setAttribute("aria-pressed", "true");
    element("play").textContent = "Stop";
    this.turnTo(0);
    // Less motion is wanted: the film goes in few steps.
    const stride = matchMedia("(prefers-reduced-motion: reduce)").matches ? 10 : 1;
    this.timer = setInterval(() => {
      const last = film.iterations.length - 1;
      frame = Math.min(last, frame + stride);
      this.turnTo(frame);
      if (frame === last) this.stop();
    }, FRAME_MS * Math.min(stride, 4));
  }

  stop() {
    clearInterval(this.timer);
    this.timer = 0;
    element("play").setAttribute("aria-pressed", "false");
    element("play").textContent = "Play";
  }

  figures() {
    const { start } = this;
    if (!start) return;
    const film = this.films[this.filmOf];
    const rows = [["Maxima of H", start.maxima.length], ["Control points", start.n_control_points],
      ["E at the start", short(start.error)], ["Time of the start", time(start.seconds)]];
    if (film) rows.push(["E at the end", short(film.error)], ["Iterations", film.n_iterations],
      ["Time of the run", time(film.seconds)], ["Distance, both ways", short(film.hausdorff_distance)]);
    element("paper-figures").innerHTML = rows.map(([name, value]) => `<dt>${name}</dt><dd>${value}</dd>`).join("");
  }

  /** @returns {string} the sentence under the drawing */
  sentence() {
    const film = this.films[this.filmOf];
    const { start } = this;
    if (!start) return "Finding the maxima of H.";
    const first = `${start.maxima.length} maxima of H at L = ${start.length} give ${start.n_control_points} control points; E begins at ${short(start.error)}`;
    return film ? `${first} and ends at ${short(film.error)} after ${film.n_iterations} iterations of ${film.method}. ${capital(film.sentence)}.` : `${first}.`;
  }

  /** @param {import("./scene.js").Scene} scene @param {CanvasRenderingContext2D} c */
  draw(scene, c) {
    const { start } = this;
    if (!this.on || !start || this.step === "points" || start.outline !== scene.outline) return;
    const palette = colors();
    const { scale } = scene.view;
    const r = 4 / scale;
    c.lineJoin = "round";
    if (this.step === "maxima" || this.step === "frames") {
      c.fillStyle = palette.corner;
      for (const i of this.step === "maxima" ? start.maxima : start.stations) {
        c.beginPath();
        c.arc(start.places[2 * i], start.places[2 * i + 1], r, 0, 2 * Math.PI);
        c.fill();
      }
    }
    if (this.step === "frames") {
      const long = 26 / scale;
      c.lineWidth = 1.8 / scale;
      start.stations.forEach((i, k) => {
        const [x, y] = [start.places[2 * i], start.places[2 * i + 1]];
        for (const [vectors, color] of /** @type {[Float32Array, string][]} */ ([[start.tangents, palette.line], [start.normals, palette.corner]])) {
          c.strokeStyle = color;
          c.beginPath();
          c.moveTo(x, y);
          c.lineTo(x + long * vectors[2 * k], y + long * vectors[2 * k + 1]);
          c.stroke();
        }
      });
    }
    const film = this.films[this.filmOf];
    if (this.step === "initial" || (this.step === "film" && !film)) this.curve(scene, c, start.control, start.cubics, palette.line);
    if (this.step === "film" && film) {
      const [, m] = film.shapes.control;
      const [, s] = film.shapes.cubics;
      const k = Math.min(this.frame, film.iterations.length - 1);
      c.globalAlpha = 0.35;
      this.curve(scene, c, start.control, start.cubics, palette.soft, false);
      c.globalAlpha = 1;
      this.curve(scene, c, film.control.subarray(2 * m * k, 2 * m * (k + 1)), film.cubics.subarray(8 * s * k, 8 * s * (k + 1)), palette.line);
    }
  }

  /** @param {import("./scene.js").Scene} scene @param {CanvasRenderingContext2D} c @param {Float32Array} control @param {Float32Array} cubics @param {string} color @param {boolean} [polygon] */
  curve(scene, c, control, cubics, color, polygon = true) {
    const { scale } = scene.view;
    c.lineWidth = 2 / scale;
    c.strokeStyle = color;
    c.beginPath();
    c.moveTo(cubics[0], cubics[1]);
    for (let o = 0; o < cubics.length; o += 8) c.bezierCurveTo(cubics[o + 2], cubics[o + 3], cubics[o + 4], cubics[o + 5], cubics[o + 6], cubics[o + 7]);
    c.stroke();
    if (!polygon) return;
    c.lineWidth = 1 / scale;
    c.strokeStyle = colors().soft;
    c.beginPath();
    for (let i = 0; i < control.length; i += 2) c.lineTo(control[i], control[i + 1]);
    if (this.start?.closed) c.closePath();
    c.stroke();
    c.fillStyle = colors().paper;
    for (let i = 0; i < control.length; i += 2) {
      c.beginPath();
      c.arc(control[i], control[i + 1], 3 / scale, 0, 2 * Math.PI);
      c.fill();
      c.stroke();
    }
  }
}
