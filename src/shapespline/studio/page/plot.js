// Plain graphs on a canvas: axes with round numbers, lines, marks.

import { colors } from "./colors.js";
import { short } from "./words.js";

const [LEFT, RIGHT, TOP, BOTTOM] = [58, 14, 10, 24];

export class Plot {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.range = [0, 1, 0, 1];
    this.log = false;
  }

  /** Make it empty, with axes. @param {number[]} range x, x, y, y @param {boolean} [log] of both: x from 0 counts one more */
  begin(range, log = false) {
    const box = this.canvas.getBoundingClientRect();
    const ratio = devicePixelRatio || 1;
    this.width = box.width;
    this.height = box.height;
    this.canvas.width = Math.round(box.width * ratio);
    this.canvas.height = Math.round(box.height * ratio);
    this.log = log;
    this.range = log ? [Math.log10(1 + range[0]), Math.log10(1 + range[1]), Math.log10(range[2]), Math.log10(range[3])] : range;
    const c = this.context;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, box.width, box.height);
    c.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    this.axes();
  }

  width = 1;
  height = 1;

  /** @param {number} x @param {number} y @returns {[number, number]} */
  at(x, y) {
    const [a, b, low, high] = this.range;
    const v = this.log ? Math.log10(Math.max(y, 1e-300)) : y;
    const u = this.log ? Math.log10(1 + x) : x;
    return [LEFT + ((u - a) / (b - a || 1)) * (this.width - LEFT - RIGHT),
      this.height - BOTTOM - ((v - low) / (high - low || 1)) * (this.height - TOP - BOTTOM)];
  }

  /** @param {number} px @returns {number} x of the data */
  xAt(px) {
    const [a, b] = this.range;
    return a + ((px - LEFT) / (this.width - LEFT - RIGHT)) * (b - a);
  }

  axes() {
    const c = this.context;
    const [a, b, low, high] = this.range;
    c.strokeStyle = colors().faint;
    c.fillStyle = colors().soft;
    c.lineWidth = 1;
    c.textAlign = "right";
    c.textBaseline = "middle";
    const value = (/** @type {number} */ v) => (this.log ? 10 ** v : v);
    for (const v of steps(low, high, Math.max(2, Math.floor((this.height - TOP - BOTTOM) / 19)))) {
      const py = this.at(0, value(v))[1];
      c.beginPath();
      c.moveTo(LEFT, py);
      c.lineTo(this.width - RIGHT, py);
      c.stroke();
      c.fillText(short(value(v)), LEFT - 6, py);
    }
    c.textAlign = "center";
    c.textBaseline = "alphabetic";
    const across = this.log ? [0, 1, 2, 5, 10, 20, 50, 100, 300, 1000, 3000, 10000].filter((v) => Math.log10(1 + v) <= b)
      : steps(a, b, Math.max(2, Math.floor(this.width / 110)));
    for (const v of across) {
      c.fillText(short(v), this.at(v, value(low))[0], this.height - 8);
    }
  }

  /** Names of the axes, above the lines. @param {string} x @param {string} y */
  names(x, y) {
    const c = this.context;
    c.fillStyle = colors().soft;
    c.textAlign = "right";
    this.label(x, this.width - RIGHT - 4, this.height - BOTTOM - 6);
    c.textAlign = "left";
    this.label(y, LEFT + 4, TOP + 11);
  }

  /** A text that lines do not run through. @param {string} text @param {number} x @param {number} y */
  label(text, x, y) {
    const c = this.context;
    const { width } = c.measureText(text);
    const { fillStyle } = c;
    c.fillStyle = colors().paper;
    c.fillRect((c.textAlign === "right" ? x - width : x) - 3, y - 11, width + 6, 15);
    c.fillStyle = fillStyle;
    c.fillText(text, x, y);
  }

  /** @param {Iterable<[number, number]>} points @param {string} color @param {number} [width] @param {number[]} [dash] */
  line(points, color, width = 1.5, dash = []) {
    const c = this.context;
    c.strokeStyle = color;
    c.lineWidth = width;
    c.lineJoin = "round";
    c.setLineDash(dash);
    c.beginPath();
    for (const [x, y] of points) c.lineTo(...this.at(x, y));
    c.stroke();
    c.setLineDash([]);
  }

  /** @param {number} x @param {number} y @param {string} color @param {number} [radius] */
  dot(x, y, color, radius = 3) {
    const c = this.context;
    c.fillStyle = color;
    c.beginPath();
    c.arc(...this.at(x, y), radius, 0, 2 * Math.PI);
    c.fill();
  }

  /** @param {string} text */
  says(text) {
    const c = this.context;
    c.fillStyle = colors().soft;
    c.textAlign = "center";
    c.fillText(text, this.width / 2, this.height / 2);
  }
}

/** Round numbers within a range. @param {number} low @param {number} high @param {number} most */
function steps(low, high, most) {
  const raw = (high - low) / most;
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= raw) ?? raw;
  const found = [];
  for (let v = Math.ceil(low / step) * step; v <= high + 1e-9 * step; v += step) found.push(Math.abs(v) < step * 1e-9 ? 0 : v);
  return found;
}
