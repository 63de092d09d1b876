// Finds what is near a place: places sorted into square cells.

export class Grid {
  /** @param {Float32Array} places x and y in turn @param {number} cell side, data units */
  constructor(places, cell) {
    this.places = places;
    this.cell = cell > 0 ? cell : 1;
    /** @type {Map<string, number[]>} */
    this.cells = new Map();
    for (let i = 0; i < places.length / 2; i++) {
      const key = this.key(places[2 * i], places[2 * i + 1]);
      const held = this.cells.get(key);
      if (held) held.push(i);
      else this.cells.set(key, [i]);
    }
  }

  /** @param {number} x @param {number} y */
  key(x, y) {
    return `${Math.floor(x / this.cell)} ${Math.floor(y / this.cell)}`;
  }

  /** @param {number} x @param {number} y @param {number} radius @returns {number} index or -1 */
  nearest(x, y, radius) {
    let best = -1;
    let least = radius * radius;
    const reach = Math.ceil(radius / this.cell);
    /** @param {number} i */
    const look = (i) => {
      const d = (this.places[2 * i] - x) ** 2 + (this.places[2 * i + 1] - y) ** 2;
      if (d <= least) [best, least] = [i, d];
    };
    if ((2 * reach + 1) ** 2 > this.places.length) {
      for (let i = 0; i < this.places.length / 2; i++) look(i);
      return best;
    }
    for (let dx = -reach; dx <= reach; dx++) {
      for (let dy = -reach; dy <= reach; dy++) {
        this.cells.get(this.key(x + dx * this.cell, y + dy * this.cell))?.forEach(look);
      }
    }
    return best;
  }
}
