// The controls beside the drawing, both ways: what is set there is the state, and they show it.

import { KINDS, colors } from "./colors.js";
import { LAYERS } from "./layers.js";
import { capital, choice, counted, element, fill, input, say, short, size, time } from "./words.js";

/** @typedef {import("./types.js").State} State */

// The slider goes from this part of the diagonal to that, logarithmically.
const [LEAST, MOST, STEPS] = [1e-6, 0.1, 1000];
// Words that have a place of their own on the page.
/** @type {Object<string, string>} */
const FORMS = { pieces: "lines and curves", spline: "one spline", arcs: "lines and arcs" };
const PLACED = new Set(["form", "effort", "ends", "knots", "loss"]);
// What is done where nothing is said.
const BY_ITSELF = "drawn, where it acts";

export class Panel {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    this.unit = "data";
    this.legendShown = "";
    /** @type {Object<string, string>} */
    this.defaults = {};
    const { store } = app;
    for (const radio of document.getElementsByName("goal")) {
      radio.addEventListener("change", () => store.change({ goal: /** @type {HTMLInputElement} */ (radio).value }));
    }
    const slider = input("tolerance");
    slider.addEventListener("input", () => store.change({ tolerance: this.atSlider(+slider.value) }, true));
    slider.addEventListener("change", () => store.change({}, false));
    input("tolerance-number").addEventListener("change", () => {
      const value = +input("tolerance-number").value * this.factor();
      if (value > 0) store.change({ tolerance: value });
      else this.show();
    });
    choice("tolerance-unit").addEventListener("change", () => {
      this.unit = choice("tolerance-unit").value;
      this.show();
    });
    const points = input("points-range");
    points.addEventListener("input", () => store.change({ points: +points.value }, true));
    points.addEventListener("change", () => store.change({}, false));
    input("points-number").addEventListener("change", () => store.change({ points: Math.round(+input("points-number").value) }));
    for (const name of ["corners", "form", "effort", "ends"]) {
      choice(name).addEventListener("change", () => store.change({ [name]: choice(name).value }));
    }
    input("degree").addEventListener("change", () => store.change({ degree: Math.round(+input("degree").value) }));
    for (const name of ["symmetric", "outliers"]) {
      input(name).addEventListener("change", () => store.change({ [name]: input(name).checked }));
    }
    for (const end of [0, 1]) {
      input(`tangent-${end}`).addEventListener("change", () => this.tangents());
    }
    element("own-away").addEventListener("click", () => store.changeOwn(app.scene.outline, {}));
    this.layers();
    this.outlines();
    const narrow = matchMedia("(max-width: 760px)");
    narrow.addEventListener("change", () => this.place(narrow.matches));
    this.place(narrow.matches);
  }

  /** On a phone the tolerance stands under the drawing, always. @param {boolean} narrow */
  place(narrow) {
    const block = element("goal-tolerance");
    if (narrow) document.querySelector("footer")?.prepend(block);
    else element("figures").before(block);
  }

  /** @param {Object<string, string[]>} choices @param {Object<string, string>} defaults */
  offer(choices, defaults) {
    this.defaults = defaults;
    fill(choice("form"), choices.form.map((one) => /** @type {[string, string]} */ ([one, FORMS[one] ?? one])));
    fill(choice("effort"), choices.effort);
    element("more-words").replaceChildren(...Object.entries(choices).filter(([name]) => !PLACED.has(name)).map(([name, words]) => {
      const label = document.createElement("label");
      const list = document.createElement("select");
      fill(list, [.../** @type {[string, string][]} */ (defaults[name] ? [] : [["", BY_ITSELF]]), ...words]);
      list.id = `word-${name}`;
      list.addEventListener("change", () => this.app.store.change({ regularities: null,
        words: { ...this.app.store.now.words, [name]: list.value } }));
      const text = document.createElement("span");
      text.textContent = capital(name);
      label.append(text, list);
      return label;
    }));
  }

  layers() {
    const { scene } = this.app;
    element("layers").replaceChildren(...LAYERS.map(([name, title]) => {
      const label = document.createElement("label");
      label.className = "check";
      const box = document.createElement("input");
      Object.assign(box, { type: "checkbox", checked: scene.shown[name], id: `layer-${name}` });
      box.addEventListener("change", () => {
        scene.shown[name] = box.checked;
        scene.draw();
      });
      label.append(box, ` ${title}`);
      return label;
    }));
    const legend = document.createElement("div");
    legend.id = "legend";
    element("layers").append(legend);
  }

  /** Layers that would show nothing are not offered. */
  layersOffered() {
    const { scene } = this.app;
    for (const [name] of LAYERS) {
      input(`layer-${name}`).disabled = !scene.shows(name) || (name === "source" && !scene.shape?.picture);
    }
  }

  /** All kinds of pieces with their lines, those that are not there pale: nothing moves when one comes. */
  legend() {
    const palette = colors();
    const there = new Set(this.app.fitter.fits.flatMap((fit) => fit?.kinds ?? []));
    const shown = JSON.stringify([palette.line, ...there]);
    if (shown === this.legendShown) return;
    this.legendShown = shown;
    element("legend").replaceChildren(...Object.entries(KINDS).map(([kind, { dash, width }]) => {
      const row = document.createElement("label");
      const line = document.createElement("span");
      line.className = "swatch";
      line.style.borderTopColor = there.has(kind) ? palette[kind] : palette.faint;
      line.style.borderTopStyle = dash.length ? (dash.length > 2 ? "dotted" : "dashed") : "solid";
      line.style.borderTopWidth = `${Math.round(width)}px`;
      row.className = there.has(kind) ? "check" : "check absent";
      row.append(line, kind === "bezier" ? "Bezier" : kind);
      return row;
    }));
  }

  outlines() {
    const list = element("outlines");
    list.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1, Home: -Infinity, End: Infinity }[event.key];
      if (step === undefined || !this.app.scene.shape) return;
      event.preventDefault();
      event.stopPropagation();
      const last = this.app.scene.shape.outlines.length - 1;
      this.app.select(Math.max(0, Math.min(last, this.app.scene.outline + step)));
    });
  }

  /** The list of outlines, with the points of each fit. */
  list() {
    const { scene, fitter } = this.app;
    const outlines = scene.shape?.outlines ?? [];
    const list = element("outlines");
    if (list.children.length !== Math.min(outlines.length, 500)) {
      list.replaceChildren(...outlines.slice(0, 500).map((_, k) => {
        const item = document.createElement("li");
        item.id = `outline-${k}`;
        item.setAttribute("role", "option");
        item.append(...[0, 1, 2].map(() => document.createElement("span")));
        item.addEventListener("click", () => this.app.select(k));
        return item;
      }));
    }
    [...list.children].forEach((item, k) => {
      const one = outlines[k];
      const fit = fitter.fits[k];
      const words = [`${k + 1}`, one.hole ? "hole" : one.closed ? "outline" : "open",
        fit ? `${one.n_points.toLocaleString("en")} → ${fit.n_stored_points.toLocaleString("en")}` : one.n_points.toLocaleString("en")];
      [...item.children].forEach((cell, i) => { if (cell.textContent !== words[i]) cell.textContent = words[i]; });
      item.setAttribute("aria-selected", String(k === scene.outline));
    });
    list.setAttribute("aria-activedescendant", `outline-${scene.outline}`);
  }

  /** Whether the shape is wanted as it was drawn. */
  isDrawn() {
    const { words, goal } = this.app.store.now;
    return goal !== "points" && (words.character ?? this.defaults.character) !== "fewest";
  }

  factor() {
    if (this.unit === "px") return this.app.store.now.reading.scale;
    return this.unit === "%" ? (this.app.scene.shape?.diagonal ?? 1) / 100 : 1;
  }

  /** @param {number} step */
  atSlider(step) {
    const diagonal = this.app.scene.shape?.diagonal ?? 1;
    const part = LEAST * (MOST / LEAST) ** (step / STEPS);
    return Number((diagonal * part).toPrecision(3));
  }

  /** @param {number} tolerance */
  toSlider(tolerance) {
    const part = tolerance / (this.app.scene.shape?.diagonal ?? 1);
    return Math.round((STEPS * Math.log(part / LEAST)) / Math.log(MOST / LEAST));
  }

  tangents() {
    const { store, scene } = this.app;
    const given = [0, 1].map((end) => {
      const text = input(`tangent-${end}`).value;
      const angle = (+text * Math.PI) / 180;
      return text === "" ? null : [Math.cos(angle), Math.sin(angle)];
    });
    store.changeOwn(scene.outline, { ...store.now.own[scene.outline], end_tangents: given.some(Boolean) ? given : undefined });
  }

  /** Show the state. */
  show() {
    const { store, scene } = this.app;
    const { now } = store;
    for (const radio of document.getElementsByName("goal")) {
      const one = /** @type {HTMLInputElement} */ (radio);
      one.checked = one.value === now.goal;
    }
    for (const goal of ["tolerance", "points", "auto"]) element(`goal-${goal}`).hidden = now.goal !== goal;
    const unit = scene.shape?.unit ?? "units";
    const pixels = now.reading.scale && scene.shape?.picture;
    if (this.unit === "px" && !pixels) this.unit = "data";
    fill(choice("tolerance-unit"), [["data", unit], ["%", "% of size"], .../** @type {[string, string][]} */ (pixels ? [["px", "pixels"]] : [])]);
    choice("tolerance-unit").value = this.unit;
    const slider = input("tolerance");
    slider.value = `${this.toSlider(now.tolerance)}`;
    slider.setAttribute("aria-valuetext", `${short(now.tolerance)} ${unit}`);
    const number = input("tolerance-number");
    if (document.activeElement !== number || !store.before) number.value = `${Number((now.tolerance / this.factor()).toPrecision(4))}`;
    input("points-number").value = input("points-range").value = `${now.points}`;
    for (const name of /** @type {const} */ (["corners", "form", "effort", "ends"])) choice(name).value = now[name];
    input("degree").value = `${now.degree}`;
    input("symmetric").checked = now.symmetric;
    input("outliers").checked = now.outliers;
    for (const list of element("more-words").querySelectorAll("select")) {
      const name = list.id.slice("word-".length);
      list.value = now.words[name] ?? this.defaults[name];
    }
    this.showOwn(now);
    this.layersOffered();
    element("undo").toggleAttribute("disabled", !store.past.length);
    element("redo").toggleAttribute("disabled", !store.future.length);
  }

  /** @param {State} now */
  showOwn(now) {
    const { scene } = this.app;
    const own = now.own[scene.outline] ?? {};
    const words = [];
    if (own.corners) words.push(`${counted(own.corners.length, "corner")} by hand`);
    if (own.through) words.push(`${counted(own.through.length, "point")} held`);
    for (const [, dx, dy] of own.moved ?? []) words.push(`a point moved by hand by ${short(Math.hypot(dx, dy), 2)}`);
    if (own.end_tangents) words.push("tangents held at the ends");
    element("own").textContent = words.length ? `Outline ${scene.outline + 1}: ${words.join(", ")}.`
      : "Click a point of the drawing to make or unmake a corner.";
    element("own-away").toggleAttribute("disabled", !words.length);
    element("ends-block").hidden = !scene.shape || scene.shape.outlines[scene.outline]?.closed !== false;
    [0, 1].forEach((end) => {
      const tangent = own.end_tangents?.[end];
      input(`tangent-${end}`).value = tangent ? `${Number(((Math.atan2(tangent[1], tangent[0]) * 180) / Math.PI).toFixed(2))}` : "";
    });
  }

  /** What the fits are: figures, sentence, regularities. */
  figures() {
    const { fitter } = this.app;
    const fits = fitter.fits.filter((fit) => fit !== undefined);
    if (!fits.length) {
      element("figures").replaceChildren();
      say("remarks", []);
      return;
    }
    const sum = (/** @type {(f: import("./types.js").Fit) => number} */ of) => fits.reduce((all, fit) => all + of(fit), 0);
    const done = fitter.done;
    const rows = [["Points to store", sum((fit) => fit.n_stored_points).toLocaleString("en")],
      ["Pieces", sum((fit) => fit.kinds.length).toLocaleString("en")],
      ["Points to curve", short(Math.max(...fits.map((fit) => fit.max_distance)))],
      ["Both ways", short(Math.max(...fits.map((fit) => fit.hausdorff_distance)))],
      ["As SVG", done?.n_bytes ? size(done.n_bytes) : "–"], ["Time", done ? time(done.seconds) : "–"]];
    say("remarks", done?.remarks.map(capital) ?? []);
    const list = element("figures");
    if (list.children.length !== 2 * rows.length) {
      list.innerHTML = rows.map(() => "<dt></dt><dd></dd>").join("");
    }
    rows.forEach(([name, value], k) => {
      list.children[2 * k].textContent = `${name}`;
      list.children[2 * k + 1].textContent = `${value}`;
    });
    this.app.regular.show();
    this.legend();
  }
}

/** The sentence of some fits. @param {(import("./types.js").Fit | undefined)[]} all @param {number} outline
 * @param {Object<string, import("./types.js").Own>} [own] */
export function sentence(all, outline, own = {}) {
  const fits = all.filter((fit) => fit !== undefined);
  if (!fits.length) return "";
  const one = all[outline];
  const kinds = /** @type {Object<string, number>} */ ({});
  for (const fit of fits) for (const [kind, n] of Object.entries(fit.n_kinds)) kinds[kind] = (kinds[kind] ?? 0) + n;
  const pieces = Object.entries(kinds).sort().map(([kind, n]) => counted(n, kind === "bezier" ? "Bezier" : kind)).join(", ");
  const stored = counted(fits.reduce((sum, fit) => sum + fit.n_stored_points, 0), "point");
  const kept = fits.filter((fit) => fit.kept).length;
  const left = fits.reduce((sum, fit) => sum + fit.n_outliers, 0);
  const moves = Object.values(own).flatMap((one) => one.moved ?? []).map(([, dx, dy]) => Math.hypot(dx, dy));
  const moved = moves.length ? ` Measured to the points as moved by hand, by up to ${short(Math.max(...moves), 2)}.` : "";
  const met = fits.reduce((sum, fit) => sum + (fit.crossings?.length ?? 0), 0);
  const tail = `${stored} in ${pieces}${met ? `, ${counted(met, "crossing")}` : ""}${left ? `; ${counted(left, "outlier")} left out` : ""}.${moved}`;
  if (fits.length === 1) return `${capital(fits[0].sentence)}. ${tail}`;
  const worst = fits.reduce((a, b) => (b.hausdorff_distance > a.hausdorff_distance ? b : a));
  const first = kept === fits.length ? `All ${fits.length} outlines are kept, the farthest within ${short(worst.hausdorff_distance)} both ways`
    : `${kept} of ${fits.length} outlines are kept`;
  return `${first}: ${tail} Outline ${outline + 1}: ${one?.sentence ?? "not fitted yet"}.`;
}
