// Numbers and nouns.

/** @param {number} value @param {number} [digits] */
export function short(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  const text = Number(value.toPrecision(digits));
  return Math.abs(text) >= 1e6 || (text !== 0 && Math.abs(text) < 1e-4) ? text.toExponential() : `${text}`;
}

/** @param {number} count @param {string} noun */
export function counted(count, noun) {
  return `${count.toLocaleString("en")} ${noun}${count === 1 ? "" : "s"}`;
}

/** @param {number} bytes */
export function size(bytes) {
  return bytes < 1000 ? `${bytes} B` : bytes < 1e6 ? `${short(bytes / 1000)} kB` : `${short(bytes / 1e6)} MB`;
}

/** @param {number} seconds */
export function time(seconds) {
  return seconds < 1 ? `${Math.round(1000 * seconds)} ms` : `${short(seconds)} s`;
}

/** @template {HTMLElement} T @param {string} id @param {{new (): T}} kind @returns {T} */
export function byId(id, kind) {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`the page has no ${id}`);
  return found;
}

/** @param {string} id @returns {HTMLInputElement} */
export const input = (id) => byId(id, HTMLInputElement);
/** @param {string} id @returns {HTMLSelectElement} */
export const choice = (id) => byId(id, HTMLSelectElement);
/** @param {string} id @returns {HTMLButtonElement} */
export const button = (id) => byId(id, HTMLButtonElement);
/** @param {string} id @returns {HTMLElement} */
export const element = (id) => byId(id, HTMLElement);

/** @param {HTMLSelectElement} list @param {(string | [string, string])[]} options values, or values and texts */
export function fill(list, options) {
  list.replaceChildren(...options.map((one) => {
    const [value, text] = typeof one === "string" ? [one, one] : one;
    return new Option(text, value);
  }));
}

/** Sentences as the items of a list. @param {string} id @param {string[]} sentences */
export function say(id, sentences) {
  const list = element(id);
  if (list.children.length === sentences.length && sentences.every((text, k) => list.children[k].textContent === text)) return;
  list.replaceChildren(...sentences.map((text) => {
    const item = document.createElement("li");
    item.textContent = text;
    return item;
  }));
}

/** @param {string} text */
export function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
