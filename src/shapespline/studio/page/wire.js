// The WebSocket: messages with a header in JSON and arrays behind it; it comes back by itself.

const LENGTH = 4;
const FIRST_WAIT = 250;
const LONGEST_WAIT = 4000;

/** @param {Object<string, any>} header @param {Uint8Array} [content] @returns {Uint8Array<ArrayBuffer>} */
export function packed(header, content) {
  let text = new TextEncoder().encode(JSON.stringify(header));
  const padded = new Uint8Array(Math.ceil(text.length / LENGTH) * LENGTH).fill(32);
  padded.set(text);
  const message = new Uint8Array(LENGTH + padded.length + (content?.length ?? 0));
  new DataView(message.buffer).setUint32(0, padded.length, true);
  message.set(padded, LENGTH);
  if (content) message.set(content, LENGTH + padded.length);
  return message;
}

/** @param {ArrayBuffer} buffer @returns {any} the header, its arrays as members, their shapes too */
export function unpacked(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, LENGTH, length)));
  const first = LENGTH + length;
  header.shapes = {};
  for (const [name, [kind, shape, at]] of Object.entries(header.arrays)) {
    const count = shape.reduce((/** @type {number} */ a, /** @type {number} */ b) => a * b, 1);
    const Kind = kind === "f" ? Float32Array : kind === "i" ? Int32Array : Uint8Array;
    header[name] = new Kind(buffer, first + at, count);
    header.shapes[name] = shape;
  }
  delete header.arrays;
  return header;
}

export class Wire {
  /**
   * @param {(message: any) => void} hear
   * @param {(connected: boolean) => void} changed
   */
  constructor(hear, changed) {
    this.hear = hear;
    this.changed = changed;
    this.wait = FIRST_WAIT;
    /** @type {WebSocket | null} */
    this.socket = null;
    this.connect();
  }

  connect() {
    const address = new URL("socket", location.href);
    address.protocol = "ws:";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.wait = FIRST_WAIT;
      this.changed(true);
    };
    socket.onmessage = (event) => this.hear(unpacked(event.data));
    socket.onclose = () => {
      this.socket = null;
      this.changed(false);
      setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST_WAIT);
    };
    this.socket = socket;
  }

  get connected() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** @param {Object<string, any>} header @param {Uint8Array} [content] */
  send(header, content) {
    if (this.connected) this.socket?.send(packed(header, content));
  }
}
