// The layers of the drawing: each draws itself in data units from one scene.

import { KINDS, colors } from "./colors.js";

/** @typedef {import("./scene.js").Scene} Scene */
/** @typedef {import("./types.js").Fit} Fit */

// Points are drawn one by one as long as so many are in view.
const MOST_DOTS = 6000;
// A tooth of the comb where curvature is that of all but a twentieth of the samples, pixels at first.
const COMB_PIXELS = 46;
/** @type {WeakMap<object, any>} */
const made = new WeakMap();

/** What is derived from a fit, once. @template T @param {object} key @param {string} name @param {() => T} make @returns {T} */
function once(key, name, make) {
  let held = made.get(key);
  if (!held) made.set(key, (held = {}));
  return (held[name] ??= make());
}

/** Name, title, whether on at first, what draws it. @type {[string, string, boolean, (s: Scene, c: CanvasRenderingContext2D) => void][]} */
export const LAYERS = [
  ["source", "source", true, drawSource],
  ["band", "tolerance band", false, drawBand],
  ["points", "points", true, drawPoints],
  ["error", "error as colour", false, drawError],
  ["comb", "curvature comb", false, drawComb],
  ["polygon", "control polygon", false, drawPolygon],
  ["curve", "curve by kind", true, drawCurve],
  ["knots", "knots", false, drawKnots],
  ["nodes", "nodes and corners", true, drawNodes],
  ["crossings", "crossings", true, drawCrossings],
];

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawSource(scene, c) {
  const { image, shape, view } = scene;
  if (!image || !shape?.frame) return;
  const [x, y, width, height] = shape.frame;
  const [left, top] = view.toScreen(x - shape.origin[0], y + height - shape.origin[1]);
  c.save();
  c.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
  c.globalAlpha = 0.3;
  c.imageSmoothingEnabled = (view.scale * width) / image.width < 4;
  c.drawImage(image, left, top, width * view.scale, height * view.scale);
  c.restore();
}

/** The data polyline of an outline, of many points so fine as the screen. @param {Scene} scene @param {number} k */
export function dataPath(scene, k) {
  const shape = /** @type {import("./types.js").Shape} */ (scene.shape);
  return once(shape.outlines[k], "path", () => {
    const { first, n_drawn, closed } = shape.outlines[k];
    const path = new Path2D();
    for (let i = first; i < first + n_drawn; i++) path.lineTo(shape.points[2 * i], shape.points[2 * i + 1]);
    if (closed) path.closePath();
    return path;
  });
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawBand(scene, c) {
  const tolerance = scene.tolerance();
  if (!scene.shape || !tolerance) return;
  c.strokeStyle = colors().band;
  c.lineWidth = 2 * tolerance;
  c.lineJoin = c.lineCap = "round";
  scene.shape.outlines.forEach((_, k) => c.stroke(dataPath(scene, k)));
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawPoints(scene, c) {
  const { shape, view } = scene;
  if (!shape) return;
  const [left, top] = view.toData(-4, -4);
  const [right, low] = view.toData(view.width + 4, view.height + 4);
  const { points } = shape;
  const seen = [];
  for (let i = 0; i < points.length && seen.length <= MOST_DOTS; i += 2) {
    if (points[i] >= left && points[i] <= right && points[i + 1] >= low && points[i + 1] <= top) seen.push(i);
  }
  const apart = shape.outlines.reduce((sum, one) => sum + one.length, 0) / (points.length / 2);
  c.strokeStyle = c.fillStyle = colors().soft;
  if (seen.length > MOST_DOTS || apart * view.scale < 2.2) {
    c.lineWidth = 1 / view.scale;
    shape.outlines.forEach((_, k) => c.stroke(dataPath(scene, k)));
    return;
  }
  const side = Math.min(4.5, Math.max(1.4, apart * view.scale * 0.4)) / view.scale;
  for (const i of seen) c.fillRect(points[i] - side / 2, points[i + 1] - side / 2, side, side);
}

/** Paths of so few pieces are small on the screen, which a browser without a graphics card draws far sooner (STU-08). */
const IN_A_PATH = 48;

/** Paths for each kind of piece; pieces that follow each other are one line. @param {Fit} fit @returns {Object<string, Path2D[]>} */
function kindPaths(fit) {
  return once(fit, "kinds", () => {
    /** @type {Object<string, Path2D[]>} */
    const paths = {};
    const { cubics, counts, kinds } = fit;
    let [at, held, before] = [0, 0, ""];
    for (let p = 0; p < kinds.length; p++) {
      const kind = kinds[p];
      const all = (paths[kind] ??= []);
      held = kind === before ? held + 1 : 0;
      if (held % IN_A_PATH === 0) {
        all.push(new Path2D());
        all[all.length - 1].moveTo(cubics[8 * at], cubics[8 * at + 1]);
      }
      const path = all[all.length - 1];
      for (let k = 0; k < counts[p]; k++, at++) {
        const o = 8 * at;
        if (kind === "line") path.lineTo(cubics[o + 6], cubics[o + 7]);
        else path.bezierCurveTo(cubics[o + 2], cubics[o + 3], cubics[o + 4], cubics[o + 5], cubics[o + 6], cubics[o + 7]);
      }
      before = kind;
    }
    return paths;
  });
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawCurve(scene, c) {
  const palette = colors();
  const { view } = scene;
  c.lineJoin = c.lineCap = "round";
  for (const [k, fit] of scene.fits().entries()) {
    if (!fit) continue;
    for (const [kind, paths] of Object.entries(kindPaths(fit))) {
      const { dash, width } = KINDS[kind] ?? KINDS.bezier;
      c.strokeStyle = palette[kind] ?? palette.other;
      c.lineWidth = (width + (k === scene.outline && scene.fits().length > 1 ? 0.7 : 0)) / view.scale;
      c.lineCap = dash.length ? "butt" : "round";
      c.setLineDash(dash.map((d) => d / view.scale));
      for (const path of paths) c.stroke(path);
    }
  }
  c.setLineDash([]);
}

/** Of error to tolerance the bin, 0 to 4. @param {number} part */
export function bin(part) {
  return part > 1.000001 ? 4 : Math.min(3, Math.floor(4 * part));
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawError(scene, c) {
  const { view } = scene;
  c.lineCap = "butt";
  for (const fit of scene.fits()) {
    if (!fit) continue;
    const paths = once(fit, "errors", () => {
      const bins = Array.from({ length: 5 }, () => new Path2D());
      const s = fit.samples;
      for (let i = 0; i + 6 < s.length; i += 6) {
        const worst = Math.max(Math.abs(s[i + 5]), Math.abs(s[i + 11]));
        const path = bins[bin(worst / fit.tolerance)];
        path.moveTo(s[i], s[i + 1]);
        path.lineTo(s[i + 6], s[i + 7]);
      }
      return bins;
    });
    paths.forEach((path, k) => {
      c.strokeStyle = colors().errors[k];
      c.lineWidth = (5 + 2.2 * k) / view.scale;
      c.stroke(path);
    });
  }
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawComb(scene, c) {
  const all = scene.fits().filter((fit) => fit !== undefined);
  const bends = all.flatMap((fit) => {
    const s = fit.samples;
    return Array.from({ length: s.length / 6 }, (_, i) => Math.abs(s[6 * i + 4]));
  }).sort((a, b) => a - b);
  const high = bends[Math.floor(0.95 * bends.length)] || 1;
  const factor = COMB_PIXELS / scene.view.fitted / high;
  const most = 2.2 * COMB_PIXELS / scene.view.fitted;
  c.strokeStyle = colors().comb;
  c.lineWidth = 1 / scene.view.scale;
  for (const fit of all) {
    const s = fit.samples;
    const teeth = new Path2D();
    const spans = fit.knots - 1;
    const each = s.length / 6 / spans;
    for (let i = 0; i < s.length / 6; i++) {
      const o = 6 * i;
      // Outwards where the curve bends: against the side that its centre lies on.
      const reach = Math.max(-most, Math.min(most, -factor * s[o + 4]));
      const [x, y] = [s[o] + reach * s[o + 2], s[o + 1] + reach * s[o + 3]];
      teeth.moveTo(s[o], s[o + 1]);
      teeth.lineTo(x, y);
      if (i % each !== 0) {
        const before = Math.max(-most, Math.min(most, -factor * s[o - 2]));
        teeth.moveTo(s[o - 6] + before * s[o - 4], s[o - 5] + before * s[o - 3]);
        teeth.lineTo(x, y);
      }
    }
    c.stroke(teeth);
  }
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawPolygon(scene, c) {
  const { scale } = scene.view;
  const r = 2.6 / scale;
  c.lineWidth = 1 / scale;
  c.strokeStyle = colors().soft;
  c.fillStyle = colors().paper;
  for (const fit of scene.fits()) {
    if (!fit) continue;
    let at = 0;
    const lines = new Path2D();
    const dots = new Path2D();
    for (const count of fit.polygons) {
      for (let i = at; i < at + count; i++) {
        const [x, y] = [fit.polygon[2 * i], fit.polygon[2 * i + 1]];
        if (i === at) lines.moveTo(x, y);
        else lines.lineTo(x, y);
        dots.moveTo(x + r, y);
        dots.arc(x, y, r, 0, 2 * Math.PI);
      }
      at += count;
    }
    c.stroke(lines);
    c.fill(dots);
    c.stroke(dots);
  }
}

/** Ends of the polynomials, as strokes across the curve. @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawKnots(scene, c) {
  const half = 6 / scene.view.scale;
  c.strokeStyle = colors().ink;
  c.lineWidth = 1.3 / scene.view.scale;
  for (const fit of scene.fits()) {
    if (!fit) continue;
    const s = fit.samples;
    const stride = s.length / (fit.knots - 1);
    const path = new Path2D();
    for (let o = 0; o < s.length; o += stride) {
      path.moveTo(s[o] - half * s[o + 2], s[o + 1] - half * s[o + 3]);
      path.lineTo(s[o] + half * s[o + 2], s[o + 1] + half * s[o + 3]);
    }
    c.stroke(path);
  }
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawNodes(scene, c) {
  const palette = colors();
  const { scale } = scene.view;
  for (const [k, fit] of scene.fits().entries()) {
    if (!fit || !scene.shape) continue;
    // Where nodes lie close on the screen they are smaller, and gone before they hide the curve.
    const apart = (scene.shape.outlines[k].length * scale) / fit.turns.length;
    if (apart < 3) continue;
    const size = Math.min(1, 0.35 + apart / 40);
    const [r, s, wide] = [(3.6 * size) / scale, (4 * size) / scale, (1.6 * size) / scale];
    const [left, top] = scene.view.toData(-9, -9);
    const [right, low] = scene.view.toData(scene.view.width + 9, scene.view.height + 9);
    /** @type {[number, number][][]} */
    const [round, square] = [[], []];
    for (let i = 0; i < fit.turns.length; i++) {
      const [x, y] = [fit.nodes[2 * i], fit.nodes[2 * i + 1]];
      if (x >= left && x <= right && y >= low && y <= top) (fit.turns[i] ? square : round).push([x, y]);
    }
    c.lineWidth = wide;
    c.strokeStyle = palette.node;
    c.fillStyle = palette.paper;
    for (const [x, y] of round) {
      c.beginPath();
      c.arc(x, y, r, 0, 2 * Math.PI);
      c.fill();
      c.stroke();
    }
    for (const [color, half] of /** @type {[string, number][]} */ ([[palette.corner, s + wide / 2], [palette.paper, s - wide / 2]])) {
      c.fillStyle = color;
      for (const [x, y] of square) c.fillRect(x - half, y - half, 2 * half, 2 * half);
    }
  }
}

/** Where curves cross, as crosses in rings. @param {Scene} scene @param {CanvasRenderingContext2D} c */
function drawCrossings(scene, c) {
  const { scale } = scene.view;
  const [r, s] = [9 / scale, 5 / scale];
  c.strokeStyle = colors().held;
  c.lineWidth = 1.8 / scale;
  c.beginPath();
  for (const fit of scene.fits()) {
    for (const [x, y] of fit?.crossings ?? []) {
      c.moveTo(x + r, y);
      c.arc(x, y, r, 0, 2 * Math.PI);
      c.moveTo(x - s, y - s);
      c.lineTo(x + s, y + s);
      c.moveTo(x - s, y + s);
      c.lineTo(x + s, y - s);
    }
  }
  c.stroke();
}
