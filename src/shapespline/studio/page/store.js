// The state: what is asked of the document; undo is a list of such states.

/** @typedef {import("./types.js").State} State */
/** @typedef {import("./types.js").Own} Own */

const MOST_UNDONE = 500;

/** @returns {State} */
export function firstState() {
  return {
    goal: "tolerance", tolerance: 1, points: 24, degree: 3, corners: "auto", form: "pieces",
    effort: "balanced", ends: "free", symmetric: false, outliers: false, words: {}, regularities: null,
    own: {}, reading: {},
  };
}

/** What a message asks: only options that act together; indices of points by outline.
 * @param {State} state @returns {{settings: Object<string, any>, own: Object<string, Own>}} */
export function asked(state) {
  /** @type {Object<string, any>} */
  const settings = {};
  /** @type {Object<string, Own>} */
  let own = {};
  if (state.goal === "tolerance") settings.tolerance = state.tolerance;
  if (state.goal === "points") settings.n_control_points = state.points;
  if (state.degree !== 3) settings.degree = state.degree;
  if (state.ends !== "free") settings.ends = state.ends;
  if (state.outliers) settings.outliers = true;
  if (state.goal !== "points") {
    if (state.corners !== "auto") settings.corners = state.corners === "none" ? null : state.corners;
    if (state.form !== "pieces") settings.form = state.form;
    if (state.effort !== "balanced") settings.effort = state.effort;
    for (const [name, word] of Object.entries(state.words)) if (word) settings[name] = word;
    if (state.regularities) settings.regularities = state.regularities.length ? state.regularities : null;
  }
  if (state.goal === "tolerance") {
    if (state.symmetric) settings.symmetric = true;
    own = state.own;
  }
  return { settings, own };
}

export class Store {
  constructor() {
    this.now = firstState();
    /** @type {State[]} */
    this.past = [];
    /** @type {State[]} */
    this.future = [];
    /** @type {State | null} */
    this.before = null;
    /** @type {((draft: boolean) => void)[]} */
    this.listeners = [];
  }

  /** @param {Partial<State>} change @param {boolean} [draft] while something is dragged */
  change(change, draft = false) {
    this.before ??= this.now;
    this.now = { ...this.now, ...change };
    if (!draft) this.commit();
    this.tell(draft);
  }

  /** @param {number} outline @param {Own} own @param {boolean} [draft] */
  changeOwn(outline, own, draft = false) {
    const kept = Object.fromEntries(Object.entries(own).filter(([name, v]) => v !== undefined &&
      (name === "corners" || !Array.isArray(v) || v.some((one) => one !== null))));
    const all = { ...this.now.own };
    if (Object.keys(kept).length) all[outline] = kept;
    else delete all[outline];
    this.change({ own: all }, draft);
  }

  commit() {
    if (this.before === null) return;
    if (JSON.stringify(this.before) !== JSON.stringify(this.now)) {
      this.past.push(this.before);
      if (this.past.length > MOST_UNDONE) this.past.shift();
      this.future = [];
    }
    this.before = null;
  }

  /** A new document: nothing to undo. @param {State} state */
  begin(state) {
    Object.assign(this, { now: state, past: [], future: [], before: null });
    this.tell(false);
  }

  undo() {
    const last = this.past.pop();
    if (!last) return;
    this.future.push(this.now);
    this.now = last;
    this.tell(false);
  }

  redo() {
    const next = this.future.pop();
    if (!next) return;
    this.past.push(this.now);
    this.now = next;
    this.tell(false);
  }

  /** @param {boolean} draft */
  tell(draft) {
    for (const listener of this.listeners) listener(draft);
  }
}
