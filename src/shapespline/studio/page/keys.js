// Keys: everything can be done by them; / shows the list.

import { byId, element, input } from "./words.js";

/** @type {[string, string][]} */
const LIST = [["O", "open a file"], ["V", "paste"], ["E", "export"], ["Y", "copy as SVG, Python, command line, settings"],
  ["Z, Shift Z", "undo, redo"], ["+ − 0", "zoom in, out, fit to view"], ["Shift with arrows", "on the drawing: pan"],
  ["Arrows up, down", "larger, smaller tolerance; with Shift ten times as far"], ["[ and ]", "step through the nodes of the outline"],
  ["C", "corner at the node or point in hand: make or unmake"], ["H", "hold the point in hand, or let it go"],
  ["Alt with arrows", "move the node in hand"], ["N, Shift N", "next and previous outline"],
  ["L", "to the layers"], ["G", "to the graphs; arrows walk along them"], ["B", "compare"], ["P", "the paper"], ["M", "measure"],
  ["Escape", "cancel what is under way"], ["/", "these keys"]];

export class Keys {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    this.node = -1;
    const body = byId("keys", HTMLTableElement).tBodies[0];
    for (const [keys, does] of LIST) {
      const row = body.insertRow();
      row.insertCell().innerHTML = `<kbd>${keys}</kbd>`;
      row.insertCell().textContent = does;
    }
    element("help").addEventListener("click", () => this.help());
    addEventListener("keydown", (event) => this.down(event));
  }

  help() {
    byId("help-dialog", HTMLDialogElement).showModal();
  }

  /** @param {KeyboardEvent} event */
  down(event) {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || document.querySelector("dialog[open]")) return;
    const typing = target instanceof HTMLInputElement && !["checkbox", "radio", "button", "range"].includes(target.type);
    const written = typing || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
    if (written && event.key !== "Escape") return;
    const arrows = event.key.startsWith("Arrow");
    if (arrows && target instanceof HTMLInputElement) return;
    const act = arrows ? this.arrow(event) : this.letter(event);
    if (act) {
      event.preventDefault();
      act();
    }
  }

  /** @param {KeyboardEvent} event @returns {(() => void) | null} */
  arrow(event) {
    const { app } = this;
    const [dx, dy] = /** @type {Object<string, number[]>} */ ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] })[event.key];
    if (event.altKey) return () => this.moveNode(dx, dy);
    if (event.shiftKey && event.target === app.scene.canvas) {
      return () => {
        app.scene.view.pan(-40 * dx, 40 * dy);
        app.scene.draw();
      };
    }
    if (dy === 0) return null;
    return () => app.nudge(dy * (event.shiftKey ? 10 : 1));
  }

  /** @param {KeyboardEvent} event @returns {(() => void) | null} */
  letter(event) {
    const { app } = this;
    const { scene } = app;
    const middle = /** @type {[number, number]} */ ([scene.view.width / 2, scene.view.height / 2]);
    const zoom = (/** @type {number} */ factor) => () => {
      scene.view.zoom(factor, ...middle);
      scene.draw();
    };
    /** @type {Object<string, () => void>} */
    const acts = {
      o: () => input("file").click(), v: () => app.files.pasteFromClipboard(), e: () => app.files.openExport(),
      y: () => app.files.openCopy(), z: () => (event.shiftKey ? app.store.redo() : app.store.undo()),
      "+": zoom(1.25), "=": zoom(1.25), "-": zoom(0.8), 0: () => app.fitView(),
      "[": () => this.step(-1), "]": () => this.step(1),
      c: () => this.withHit((hit) => app.tools.corner(hit)), h: () => this.withHit((hit) => app.tools.hold(hit)),
      n: () => app.select((scene.outline + (event.shiftKey ? -1 : 1) + (scene.shape?.outlines.length ?? 1)) % (scene.shape?.outlines.length ?? 1)),
      l: () => element("layer-source").focus(), g: () => element(`tab-${app.graph.tab}`).focus(),
      b: () => app.compare.turn(!app.compare.on), p: () => app.paper.turn(!app.paper.on), m: () => app.tools.turn("measure"),
      "/": () => this.help(), "?": () => this.help(), escape: () => app.cancel(),
    };
    return acts[event.key.toLowerCase()] ?? null;
  }

  /** @param {(hit: import("./types.js").Hit) => void} act */
  withHit(act) {
    if (this.app.tools.hover) act(this.app.tools.hover);
    else element("under").textContent = "No node is in hand: point at one, or step with [ and ].";
  }

  /** @param {number} by */
  step(by) {
    const { scene, tools } = this.app;
    const fit = scene.fits()[scene.outline];
    if (!fit) return;
    const count = fit.turns.length;
    this.node = (((this.node + by) % count) + count) % count;
    const i = this.node;
    tools.over({ kind: fit.turns[i] ? "corner" : "node", outline: scene.outline, x: fit.nodes[2 * i], y: fit.nodes[2 * i + 1], node: i, point: fit.points[i] });
    element("canvas-said").textContent = element("under").textContent;
  }

  /** @param {number} dx @param {number} dy steps of two pixels of the screen */
  moveNode(dx, dy) {
    const { hover } = this.app.tools;
    if (!hover) return;
    const step = 2 / this.app.scene.view.scale;
    Object.assign(hover, { x: hover.x + dx * step, y: hover.y + dy * step });
    this.app.tools.moveTo(hover, hover.x, hover.y, false);
  }
}
