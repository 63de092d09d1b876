// The pointer on the canvas: pan, zoom, corners by a click, held and moved points, measure, crop.

import { counted, element, short } from "./words.js";

/** @typedef {import("./types.js").Hit} Hit */
/** @typedef {import("./types.js").Own} Own */

// Pixels that a press may move and still be a click.
const STILL = 4;

export class Tools {
  /** @param {import("./main.js").App} app */
  constructor(app) {
    this.app = app;
    /** @type {"" | "measure" | "crop"} */
    this.mode = "";
    /** @type {[number, number][]} */
    this.ends = [];
    /** @type {Hit | null} */
    this.hover = null;
    /** @type {{x: number, y: number, hit: Hit | null, moved: boolean, alt: boolean} | null} */
    this.press = null;
    /** @type {Map<number, [number, number]>} */
    this.fingers = new Map();
    const { canvas } = app.scene;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.cancel(event));
    canvas.addEventListener("pointerleave", () => this.over(null));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const unit = event.deltaMode === 1 ? 30 : 1;
      app.scene.view.zoom(Math.exp(-0.0016 * unit * event.deltaY), ...this.place(event));
      app.scene.draw();
    }, { passive: false });
  }

  /** @param {MouseEvent} event @returns {[number, number]} */
  place(event) {
    const box = this.app.scene.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** @param {PointerEvent} event */
  down(event) {
    const [x, y] = this.place(event);
    const { scene } = this.app;
    scene.canvas.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, [x, y]);
    if (this.fingers.size > 1) {
      this.press = null;
      return;
    }
    const hit = this.mode || this.app.paper.on ? null : scene.hit(x, y);
    this.press = { x, y, hit, moved: false, alt: event.altKey };
    if (this.mode) this.ends = [this.snapped(x, y)];
  }

  /** @param {PointerEvent} event */
  move(event) {
    const [x, y] = this.place(event);
    const { scene } = this.app;
    const before = this.fingers.get(event.pointerId);
    if (before && this.fingers.size === 2) {
      this.pinch(event.pointerId, x, y);
      return;
    }
    if (!this.press || !before) {
      this.over(scene.hit(x, y));
      if (!this.hover) this.app.graph.nearCanvas(...scene.view.toData(x, y));
      return;
    }
    this.press.moved ||= Math.hypot(x - this.press.x, y - this.press.y) > STILL;
    this.fingers.set(event.pointerId, [x, y]);
    if (!this.press.moved) return;
    if (this.mode) {
      this.ends = [this.ends[0], this.snapped(x, y)];
      this.tellMeasure();
    } else if (this.press.hit && this.press.hit.node >= 0) {
      this.drag(this.press.hit, x, y, true);
    } else {
      scene.view.pan(x - before[0], y - before[1]);
    }
    scene.draw();
  }

  /** @param {PointerEvent} event */
  up(event) {
    const { press } = this;
    this.fingers.delete(event.pointerId);
    this.press = null;
    if (!press) return;
    const [x, y] = this.place(event);
    if (this.mode === "crop" && press.moved) this.app.picture.cropTo(this.ends);
    if (this.mode) return;
    if (press.moved && press.hit && press.hit.node >= 0) {
      this.drag(press.hit, x, y, false);
    } else if (!press.moved && press.hit) {
      if (press.hit.outline !== this.app.scene.outline) this.app.select(press.hit.outline);
      if (press.alt || event.altKey) this.hold(press.hit);
      else this.corner(press.hit);
    }
  }

  /** @param {PointerEvent} event */
  cancel(event) {
    this.fingers.delete(event.pointerId);
    this.press = null;
  }

  /** @param {number} id @param {number} x @param {number} y */
  pinch(id, x, y) {
    const other = [...this.fingers.entries()].find(([key]) => key !== id);
    const before = this.fingers.get(id);
    if (!other || !before) return;
    const [ox, oy] = other[1];
    const factor = Math.hypot(x - ox, y - oy) / Math.max(1, Math.hypot(before[0] - ox, before[1] - oy));
    const { view } = this.app.scene;
    view.zoom(factor, (x + ox) / 2, (y + oy) / 2);
    view.pan((x - before[0]) / 2, (y - before[1]) / 2);
    this.fingers.set(id, [x, y]);
    this.app.scene.draw();
  }

  /** A place of the canvas as data, a point where one is near. @param {number} x @param {number} y @returns {[number, number]} */
  snapped(x, y) {
    const hit = this.mode === "measure" ? this.app.scene.hit(x, y) : null;
    return hit ? [hit.x, hit.y] : this.app.scene.view.toData(x, y);
  }

  tellMeasure() {
    if (this.ends.length < 2 || this.mode !== "measure") return;
    const [[x, y], [u, v]] = this.ends;
    const unit = this.app.scene.shape?.unit ?? "";
    element("under").textContent = `${short(Math.hypot(u - x, v - y), 5)} ${unit}, ` +
      `dx ${short(u - x, 4)}, dy ${short(v - y, 4)}, ${short((Math.atan2(v - y, u - x) * 180) / Math.PI, 4)}°`;
  }

  /** @param {"" | "measure" | "crop"} mode */
  turn(mode) {
    this.mode = this.mode === mode ? "" : mode;
    this.ends = [];
    element("measure").setAttribute("aria-pressed", String(this.mode === "measure"));
    element("p-crop").setAttribute("aria-pressed", String(this.mode === "crop"));
    element("under").textContent = this.mode === "measure" ? "Drag from one place to another."
      : this.mode === "crop" ? "Drag over the part of the picture that you want." : "";
    this.app.scene.canvas.style.cursor = this.mode ? "crosshair" : "";
    this.app.scene.draw();
  }

  /** What the pointer is over, in words. @param {Hit | null} hit */
  over(hit) {
    if (this.mode) return;
    this.hover = hit;
    element("under").textContent = hit ? this.said(hit) : "";
    this.app.scene.canvas.style.cursor = hit ? "pointer" : "";
    if (hit) this.app.graph.atPoint(hit.outline, hit.point);
    this.app.scene.draw();
  }

  /** @param {Hit} hit */
  said(hit) {
    const { scene, store } = this.app;
    const shape = /** @type {import("./types.js").Shape} */ (scene.shape);
    const own = store.now.own[hit.outline] ?? {};
    const words = [{ corner: "Corner", node: "Node", point: "Point" }[hit.kind] ?? "Point"];
    if (own.through?.includes(hit.point)) words.push("held");
    if (own.moved?.some(([i]) => i === hit.point)) words.push("moved by hand");
    const fit = scene.fits()[hit.outline];
    const { drawn } = scene.pointPlace(hit.outline, hit.point);
    const error = fit?.errors[drawn - shape.outlines[hit.outline].first];
    const [x, y] = [hit.x + shape.origin[0], hit.y + shape.origin[1]];
    return `${words.join(", ")} at point ${hit.point + 1} of ${counted(shape.outlines[hit.outline].n_points, "point")},` +
      ` ${short(x, 5)}, ${short(y, 5)}${error === undefined ? "" : `, ${short(Math.abs(error), 2)} off`}`;
  }

  /** Make or unmake a corner. @param {Hit} hit */
  corner(hit) {
    const { store, fitter } = this.app;
    const own = store.now.own[hit.outline] ?? {};
    const known = own.corners ?? [...(fitter.fits[hit.outline]?.corners ?? [])];
    const corners = known.includes(hit.point) ? known.filter((i) => i !== hit.point) : [...known, hit.point];
    store.changeOwn(hit.outline, { ...own, corners: corners.sort((a, b) => a - b) });
  }

  /** Hold a point, or let it go. @param {Hit} hit */
  hold(hit) {
    const { store } = this.app;
    const own = store.now.own[hit.outline] ?? {};
    const held = own.through ?? [];
    const through = held.includes(hit.point) ? held.filter((i) => i !== hit.point) : [...held, hit.point];
    store.changeOwn(hit.outline, { ...own, through: through.length ? through.sort((a, b) => a - b) : undefined });
  }

  /** A node on its way: the curve is to go through it there. @param {Hit} hit @param {number} px @param {number} py @param {boolean} draft */
  drag(hit, px, py, draft) {
    const [x, y] = this.app.scene.view.toData(px, py);
    this.moveTo(hit, x, y, draft);
  }

  /** @param {Hit} hit @param {number} x @param {number} y @param {boolean} draft */
  moveTo(hit, x, y, draft) {
    const { scene, store } = this.app;
    const own = store.now.own[hit.outline] ?? {};
    const place = scene.pointPlace(hit.outline, hit.point);
    const others = (own.moved ?? []).filter(([i]) => i !== hit.point);
    const known = (own.moved ?? []).find(([i]) => i === hit.point);
    const [before, after] = known ? known.slice(3) : this.reaches(hit);
    const moved = [...others, [hit.point, x - place.x, y - place.y, before, after]];
    store.changeOwn(hit.outline, { ...own, moved }, draft);
  }

  /** Lengths along the outline to the nodes beside one. @param {Hit} hit @returns {[number, number]} */
  reaches(hit) {
    const { scene } = this.app;
    const fit = scene.fits()[hit.outline];
    const shape = /** @type {import("./types.js").Shape} */ (scene.shape);
    const { length, closed } = shape.outlines[hit.outline];
    if (!fit) return [length / 20, length / 20];
    const at = (/** @type {number} */ point) => shape.at[scene.pointPlace(hit.outline, point).drawn];
    const here = at(hit.point);
    const gaps = [...fit.points].filter((p) => p !== hit.point).map((p) => at(p) - here);
    const ahead = gaps.map((g) => (g > 0 ? g : closed ? g + length : Infinity));
    const behind = gaps.map((g) => (g < 0 ? -g : closed ? length - g : Infinity));
    const limit = length / 4;
    return [Math.min(limit, ...behind), Math.min(limit, ...ahead)];
  }
}
