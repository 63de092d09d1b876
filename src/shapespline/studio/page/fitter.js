// Asks for fits: drafts one after the other while something is dragged, then the whole.

import { asked } from "./store.js";

/** @typedef {import("./types.js").Fit} Fit */
/** @typedef {import("./types.js").Done} Done */

export class Fitter {
  /**
   * @param {import("./wire.js").Wire} wire
   * @param {string} slot
   * @param {() => void} changed
   */
  constructor(wire, slot, changed) {
    this.wire = wire;
    this.slot = slot;
    this.changed = changed;
    /** @type {(Fit | undefined)[]} */
    this.fits = [];
    /** @type {Done | null} */
    this.done = null;
    this.generation = 0;
    this.newest = 0;
    /** @type {{draft: boolean, answered: boolean, at: number} | null} */
    this.flying = null;
    /** @type {{message: Object<string, any>, draft: boolean, patient: boolean} | null} */
    this.waiting = null;
    // Milliseconds from asking to the screen, and from the address to the first fit: for measurements.
    this.times = /** @type {number[]} */ ([]);
    /** @type {number | null} */
    this.first = null;
    /** @type {(() => void)[]} */
    this.finished = [];
  }

  /** Forget the fits of a document that is gone. */
  clear() {
    Object.assign(this, { fits: [], done: null, flying: null, waiting: null });
    // What still comes of it is older than this.
    this.generation += 1;
    this.newest = this.generation;
  }

  get busy() {
    return this.flying !== null;
  }

  /** @param {import("./types.js").State} state @param {number} outline @param {boolean} draft
   * @param {boolean} [patient] lets a draft under way show all of its outlines */
  ask(state, outline, draft, patient = false) {
    this.send({ ...asked(state), outline }, draft, patient);
  }

  /** @param {Object<string, any>} message @param {boolean} draft @param {boolean} [patient] */
  send(message, draft, patient = false) {
    // A draft under way is not cut off before it has shown something: dragging would show nothing.
    if (this.flying?.draft && (patient || !this.flying.answered)) {
      this.waiting = { message, draft, patient };
      return;
    }
    this.waiting = null;
    this.generation += 1;
    this.flying = { draft, answered: false, at: performance.now() };
    this.wire.send({ type: "fit", slot: this.slot, generation: this.generation, draft, ...message });
    this.changed();
  }

  /** @param {Fit} fit */
  hearFit(fit) {
    if (fit.generation < this.newest) return;
    this.newest = fit.generation;
    this.fits[fit.outline] = fit;
    if (fit.generation === this.generation && this.flying && !this.flying.answered) {
      const { at } = this.flying;
      this.flying.answered = true;
      if (!this.waiting?.patient) this.next();
      this.changed();
      requestAnimationFrame(() => this.painted(at));
      return;
    }
    this.changed();
  }

  /** A fit is on the screen that was asked for at a time. @param {number} at */
  painted(at) {
    this.first ??= performance.now();
    this.times.push(performance.now() - at);
    if (this.times.length > 5000) this.times.shift();
  }

  /** @param {Done} done */
  hearDone(done) {
    if (done.generation !== this.generation) return;
    this.done = done;
    for (let i = 0; i < done.crossings.length; i += 3) {
      const fit = this.fits[done.crossings[i]];
      if (fit) (fit.crossings ??= []).push([done.crossings[i + 1], done.crossings[i + 2]]);
    }
    this.flying = null;
    this.next();
    this.changed();
    if (!done.draft && !this.waiting) for (const tell of this.finished.splice(0)) tell();
  }

  /** @param {number} generation */
  failed(generation) {
    if (generation !== this.generation) return;
    this.flying = null;
    this.next();
    this.changed();
  }

  next() {
    const { waiting } = this;
    if (waiting) this.send(waiting.message, waiting.draft, waiting.patient);
  }
}
