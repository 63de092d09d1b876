// What the user did, drawn above the layers: corners by hand, held and moved points, measures.

import { colors } from "./colors.js";

/** @typedef {import("./scene.js").Scene} Scene */

/** @param {CanvasRenderingContext2D} c @param {number} x @param {number} y @param {number} r */
function diamond(c, x, y, r) {
  c.beginPath();
  c.moveTo(x - r, y);
  c.lineTo(x, y + r);
  c.lineTo(x + r, y);
  c.lineTo(x, y - r);
  c.closePath();
}

/** Corners by hand as squares, held points as filled discs in a ring, moved ones as diamonds with their way.
 * @param {Scene} scene @param {CanvasRenderingContext2D} c @param {Object<string, import("./types.js").Own>} own */
export function drawOwn(scene, c, own) {
  const palette = colors();
  const r = 5 / scene.view.scale;
  c.lineWidth = 2 / scene.view.scale;
  for (const [k, options] of Object.entries(own)) {
    const s = 6.5 / scene.view.scale;
    c.strokeStyle = palette.corner;
    for (const point of options.corners ?? []) {
      const { x, y } = scene.pointPlace(+k, point);
      c.strokeRect(x - s, y - s, 2 * s, 2 * s);
    }
    c.fillStyle = c.strokeStyle = palette.held;
    for (const point of options.through ?? []) {
      const { x, y } = scene.pointPlace(+k, point);
      c.beginPath();
      c.arc(x, y, 0.7 * r, 0, 2 * Math.PI);
      c.fill();
      c.beginPath();
      c.arc(x, y, 1.6 * r, 0, 2 * Math.PI);
      c.stroke();
    }
    for (const [point, dx, dy] of options.moved ?? []) {
      const { x, y } = scene.pointPlace(+k, point);
      c.setLineDash([4 / scene.view.scale, 3 / scene.view.scale]);
      c.beginPath();
      c.moveTo(x, y);
      c.lineTo(x + dx, y + dy);
      c.stroke();
      c.setLineDash([]);
      diamond(c, x + dx, y + dy, 1.5 * r);
      c.fill();
    }
  }
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c @param {{x: number, y: number} | null} at */
export function drawHover(scene, c, at) {
  if (!at) return;
  const r = 8 / scene.view.scale;
  c.strokeStyle = colors().ink;
  c.lineWidth = 2 / scene.view.scale;
  c.beginPath();
  c.arc(at.x, at.y, r, 0, 2 * Math.PI);
  c.stroke();
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c @param {[number, number][]} ends */
export function drawMeasure(scene, c, ends) {
  if (ends.length < 2) return;
  const s = 5 / scene.view.scale;
  c.strokeStyle = colors().ink;
  c.lineWidth = 1.6 / scene.view.scale;
  c.beginPath();
  c.moveTo(...ends[0]);
  c.lineTo(...ends[1]);
  for (const [x, y] of ends) {
    c.moveTo(x - s, y);
    c.lineTo(x + s, y);
    c.moveTo(x, y - s);
    c.lineTo(x, y + s);
  }
  c.stroke();
}

/** @param {Scene} scene @param {CanvasRenderingContext2D} c @param {[number, number][]} ends */
export function drawCrop(scene, c, ends) {
  if (ends.length < 2) return;
  c.strokeStyle = colors().held;
  c.lineWidth = 2 / scene.view.scale;
  c.setLineDash([6 / scene.view.scale, 4 / scene.view.scale]);
  c.strokeRect(ends[0][0], ends[0][1], ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
  c.setLineDash([]);
}

/** The pieces of a fit, or some of them, on the path. @param {CanvasRenderingContext2D} c
 * @param {import("./types.js").Fit | undefined} fit @param {Set<number>} [chosen] */
function addPieces(c, fit, chosen) {
  let at = 0;
  fit?.counts.forEach((count, piece) => {
    for (let k = at; k < at + count && (chosen?.has(piece) ?? true); k++) {
      const q = fit.cubics.subarray(8 * k, 8 * k + 8);
      if (k === at) c.moveTo(q[0], q[1]);
      c.bezierCurveTo(q[2], q[3], q[4], q[5], q[6], q[7]);
    }
    at += count;
  });
}

/** What regularities are about, pieces of the chosen outline or whole outlines, as a broad line behind
 * its own. @param {Scene} scene @param {CanvasRenderingContext2D} c
 * @param {import("./types.js").Regularity[]} regularities */
export function drawRegular(scene, c, regularities) {
  if (!regularities.length) return;
  const fits = scene.fits();
  c.beginPath();
  for (const one of regularities) {
    if (one.noun === "outline") for (const place of one.pieces) addPieces(c, fits[place]);
    else addPieces(c, fits[scene.outline], new Set(one.pieces));
  }
  c.globalAlpha = 0.4;
  c.strokeStyle = colors().held;
  c.lineWidth = 10 / scene.view.scale;
  c.stroke();
  c.globalAlpha = 1;
}
