// The view: where the document lies on the canvas. Data are relative to the origin, y up.

const CLOSEST = 4e6;

export class View {
  constructor() {
    this.x = 0;
    this.y = 0;
    this.scale = 1;
    this.width = 1;
    this.height = 1;
    this.ratio = 1;
    this.touched = false;
  }

  /** @param {number} x @param {number} y @returns {[number, number]} pixels of the page */
  toScreen(x, y) {
    return [(x - this.x) * this.scale + this.width / 2, (this.y - y) * this.scale + this.height / 2];
  }

  /** @param {number} px @param {number} py @returns {[number, number]} data */
  toData(px, py) {
    return [(px - this.width / 2) / this.scale + this.x, this.y - (py - this.height / 2) / this.scale];
  }

  /** @param {CanvasRenderingContext2D} context */
  apply(context) {
    const s = this.scale * this.ratio;
    context.setTransform(s, 0, 0, -s, (this.width / 2 - this.x * this.scale) * this.ratio,
      (this.height / 2 + this.y * this.scale) * this.ratio);
  }

  /** @param {number} factor @param {number} px @param {number} py */
  zoom(factor, px, py) {
    const [x, y] = this.toData(px, py);
    const size = Math.max(this.width, this.height);
    this.scale = Math.min(Math.max(this.scale * factor, this.fitted / 50), (this.fitted * CLOSEST) / size);
    const [ax, ay] = this.toData(px, py);
    this.x += x - ax;
    this.y += y - ay;
    this.touched = true;
  }

  /** @param {number} dx @param {number} dy pixels */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.touched = true;
  }

  /** @param {number[]} box relative to the origin: x, y, x, y */
  fit(box) {
    const margin = Math.min(44, 0.1 * Math.min(this.width, this.height));
    const across = Math.max(box[2] - box[0], 1e-300);
    const up = Math.max(box[3] - box[1], 1e-300);
    this.scale = Math.min((this.width - 2 * margin) / across, (this.height - 2 * margin) / up);
    this.fitted = this.scale;
    this.x = (box[0] + box[2]) / 2;
    this.y = (box[1] + box[3]) / 2;
    this.touched = false;
  }

  fitted = 1;
}
