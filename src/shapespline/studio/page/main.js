// The page as a whole: who hears of what.

import { onScheme } from "./colors.js";
import { Compare } from "./compare.js";
import { Files } from "./files.js";
import { Fitter } from "./fitter.js";
import { onceAFrame } from "./frames.js";
import { Graph } from "./graph.js";
import { Keys } from "./keys.js";
import { drawCrop, drawHover, drawMeasure, drawOwn, drawRegular } from "./marks.js";
import { Panel, sentence } from "./panel.js";
import { Paper } from "./paper.js";
import { Picture } from "./picture.js";
import { Regular } from "./regular.js";
import { Scene } from "./scene.js";
import { Store, firstState } from "./store.js";
import { Tools } from "./tools.js";
import { Wire } from "./wire.js";
import { byId, capital, choice, element } from "./words.js";

/** @typedef {import("./types.js").Shape} Shape */

const HINTS = "shapespline-studio-hints";
const NUDGE = 1.02;

export class App {
  constructor() {
    this.store = new Store();
    this.scene = new Scene(byId("canvas", HTMLCanvasElement));
    this.wire = new Wire((message) => this.hear(message), (connected) => this.connection(connected));
    this.fitter = new Fitter(this.wire, "a", () => this.refresh());
    this.second = new Fitter(this.wire, "b", () => this.refresh());
    this.graph = new Graph(this);
    this.paper = new Paper(this);
    this.picture = new Picture(this);
    this.files = new Files(this);
    this.compare = new Compare(this);
    this.tools = new Tools(this);
    this.panel = new Panel(this);
    this.keys = new Keys(this);
    this.regular = new Regular(this);
    // What is on the screen was fitted before: the newest was ended.
    this.ended = false;
    this.settle = 0;
    this.ready = false;
    this.lastReading = "{}";
    this.scene.fits = () => this.fitter.fits;
    this.scene.tolerance = () => (this.store.now.goal === "tolerance" ? this.store.now.tolerance : this.fitter.fits[this.scene.outline]?.tolerance ?? null);
    this.scene.above.push(
      (scene, c) => this.paper.draw(scene, c),
      (scene, c) => { if (!this.paper.on) drawRegular(scene, c, this.regular.marked); },
      (scene, c) => { if (!this.paper.on) drawOwn(scene, c, this.store.now.own); },
      (scene, c) => drawHover(scene, c, this.tools.hover ?? this.graph.place),
      (scene, c) => { if (this.tools.mode === "measure") drawMeasure(scene, c, this.tools.ends); },
      (scene, c) => { if (this.tools.mode === "crop") drawCrop(scene, c, this.tools.ends); },
    );
    this.store.listeners.push((draft) => this.changed(draft));
    onScheme(() => this.refresh());
    this.buttons();
  }

  buttons() {
    /** @type {[string, () => void][]} */
    const acts = [["undo", () => this.store.undo()], ["redo", () => this.store.redo()],
      ["compare", () => this.compare.turn(!this.compare.on)], ["paper", () => this.paper.turn(!this.paper.on)],
      ["zoom-in", () => this.zoom(1.25)], ["zoom-out", () => this.zoom(0.8)], ["zoom-fit", () => this.fitView()],
      ["measure", () => this.tools.turn("measure")], ["cancel", () => this.cancel()],
      ["hints-away", () => {
        element("hints").hidden = true;
        localStorage.setItem(HINTS, "seen");
      }]];
    for (const [id, act] of acts) element(id).addEventListener("click", act);
    for (const sheet of document.querySelectorAll("#sheets button")) {
      const name = /** @type {HTMLElement} */ (sheet).dataset.sheet ?? "";
      sheet.setAttribute("aria-pressed", "false");
      sheet.addEventListener("click", () => this.sheet(name));
    }
  }

  /** On a phone one panel is open at a time. @param {string} name */
  sheet(name) {
    const { dataset } = document.body;
    if (dataset.sheet === name) delete dataset.sheet;
    else dataset.sheet = name;
    for (const one of document.querySelectorAll("#sheets button")) {
      one.setAttribute("aria-pressed", String(/** @type {HTMLElement} */ (one).dataset.sheet === dataset.sheet));
    }
    if (dataset.sheet) element(name).focus();
    this.graph.draw();
  }

  /** @param {any} message */
  hear(message) {
    const of = message.slot === "b" ? this.second : this.fitter;
    if (message.type === "hello") this.hello(message);
    else if (message.type === "shape") this.shape(message);
    else if (message.type === "fit") of.hearFit(message);
    else if (message.type === "done") of.hearDone(message);
    else if (message.type === "paper") this.paper.hear(message);
    else if (message.type === "film") this.paper.hearFilm(message);
    else if (message.type === "file") this.files.hearFile(message);
    else if (message.type === "text") this.files.hearText(message);
    else if (message.type === "progress") this.progress(message);
    else if (message.type === "error") this.error(message, of);
  }

  /** @param {any} hello */
  hello(hello) {
    if (!this.ready) {
      this.files.offer(hello);
      this.panel.offer(hello.choices, hello.defaults);
      this.regular.names = hello.regularities;
      this.paper.offer(hello.methods);
      element("hints").hidden = localStorage.getItem(HINTS) !== null;
      this.ready = true;
      if (!hello.has_document) this.files.example(hello.examples[0].id);
    } else {
      this.files.again();
    }
  }

  /** @param {Shape & {file?: Uint8Array, shapes: any}} message */
  shape(message) {
    let first = 0;
    for (const one of message.outlines) {
      one.first = first;
      first += one.n_drawn;
    }
    const before = this.scene.shape;
    const again = before?.name === message.name && JSON.stringify(message.options) !== "{}" || this.reopening === message.generation;
    const own = this.files.after;
    this.files.arrived(message);
    this.files.after = null;
    this.fitter.clear();
    this.second.clear();
    if (this.compare.on && !again) this.compare.turn(false);
    if (this.paper.on && !again) this.paper.turn(false);
    this.paper.start = null;
    this.paper.films = {};
    this.tools.hover = null;
    this.graph.mark = this.graph.place = null;
    const scale = before?.diagonal && again ? message.diagonal / before.diagonal : 1;
    this.scene.show(message, again && Math.abs(scale - 1) < 0.02);
    this.lastReading = JSON.stringify(message.options);
    document.title = `${message.name} · shapespline studio`;
    this.trouble("");
    this.files.decode().then(() => this.picture.show());
    if (own) this.store.begin({ ...firstState(), ...own });
    else if (again) this.changed(false);
    else this.store.begin({ ...firstState(), tolerance: message.tolerance, reading: message.options });
    if (this.compare.on) this.compare.ask();
    if (this.paper.on) this.paper.ask();
  }

  /** @type {number} */
  reopening = -1;

  /** @param {boolean} draft */
  changed(draft) {
    this.panel.show();
    this.picture.show();
    if (!this.scene.shape) return;
    const reading = JSON.stringify(this.store.now.reading);
    if (reading !== this.lastReading) {
      this.lastReading = reading;
      this.files.reread(this.store.now.reading);
      this.reopening = this.files.generation;
      return;
    }
    this.trouble("");
    this.ended = false;
    // Of a new document something is seen at once: a draft goes before the whole.
    const isNew = !this.fitter.fits.length;
    if (isNew) this.fitter.ask(this.store.now, this.scene.outline, true);
    this.fitter.ask(this.store.now, this.scene.outline, draft, isNew);
    if (!draft) this.compare.follow();
  }

  /** @param {number} steps */
  nudge(steps) {
    const { tolerance, goal } = this.store.now;
    if (goal !== "tolerance") return;
    this.store.change({ tolerance: Number((tolerance * NUDGE ** (steps * 5)).toPrecision(4)) }, true);
    clearTimeout(this.settle);
    this.settle = setTimeout(() => this.store.change({}), 350);
  }

  /** @param {number} outline */
  select(outline) {
    this.scene.outline = outline;
    this.keys.node = -1;
    this.graph.mark = this.graph.place = null;
    this.panel.show();
    if (this.paper.on) this.paper.ask();
    element(`outline-${outline}`).scrollIntoView({ block: "nearest" });
    this.refresh();
  }

  /** @param {number} factor */
  zoom(factor) {
    const { view } = this.scene;
    view.zoom(factor, view.width / 2, view.height / 2);
    this.scene.draw();
  }

  fitView() {
    this.scene.view.fit(this.scene.box);
    this.scene.draw();
  }

  /** End what is under way: a file that is being read, or else the fits. */
  cancel() {
    if (this.files.reading) {
      this.wire.send({ type: "cancel", slot: "open" });
      this.files.stays();
    } else {
      this.wire.send({ type: "cancel" });
      this.ended = this.fitter.busy;
      for (const fitter of [this.fitter, this.second]) Object.assign(fitter, { flying: null, waiting: null });
    }
    this.paper.stop();
    if (this.tools.mode) this.tools.turn("");
    if (document.body.dataset.sheet) this.sheet(document.body.dataset.sheet);
    this.refresh();
  }

  /** Do something with a finished fit of the state. @param {() => void} act */
  whenDone(act) {
    if (this.ended) this.changed(false);
    const { done, busy } = this.fitter;
    if (done && !done.draft && !busy) act();
    else this.fitter.finished.push(act);
  }

  /** Show what is there, once a frame. */
  refresh() {
    this.scene.draw();
    this.beside();
  }

  beside = onceAFrame(() => {
    this.panel.list();
    this.panel.figures();
    this.compare.show();
    this.say();
    this.graph.draw();
  });

  say() {
    const line = element("sentence");
    const text = this.paper.on ? this.paper.sentence() : sentence(this.fitter.fits, this.scene.outline, this.store.now.own);
    const said = text && this.compare.on && !this.paper.on ? `A: ${text}` : text;
    if (said && line.textContent !== said) line.textContent = said;
    const busy = this.fitter.busy || !this.wire.connected;
    line.classList.toggle("busy", busy || this.ended);
    const words = element("progress");
    if (!busy && !this.files.reading) words.textContent = this.ended ? "Ended; this is the fit before." : "";
    const working = (busy || this.files.reading !== null) && words.textContent !== "";
    if (element("cancel").hidden === working) element("cancel").hidden = !working;
  }

  /** @param {{text: string, slot: string, generation: number}} message */
  progress({ text, slot, generation }) {
    if (slot === "a" && generation !== this.fitter.generation) return;
    if (slot === "open" && generation !== this.files.reading?.generation) return;
    const said = capital(text);
    if (!this.scene.shape) element("sentence").textContent = `${said}.`;
    element("progress").textContent = said;
    this.say();
  }

  /** @param {any} message @param {Fitter} of */
  error(message, of) {
    if (message.slot === "a" || message.slot === "b") of.failed(message.generation);
    if (message.slot === "open" && message.generation === this.files.reading?.generation) this.files.stays();
    this.trouble(message.sentence);
    this.refresh();
  }

  /** @param {string} text nothing takes it away */
  trouble(text) {
    const line = element("trouble");
    line.hidden = !text;
    line.textContent = text ? `${text[0].toUpperCase()}${text.slice(1)}${/[.!?]$/.test(text) ? "" : "."}` : "";
  }

  /** @param {boolean} connected */
  connection(connected) {
    if (!connected && this.ready) this.trouble("The program does not answer; the page waits and goes on when it is back");
    if (connected) this.trouble("");
    if (this.ready) for (const fitter of [this.fitter, this.second]) Object.assign(fitter, { flying: null, waiting: null });
  }
}

const app = new App();
// For measurements and for the curious.
Object.assign(window, { studio: app });
choice("examples").title = "Examples";
