// Colours of light and dark, told apart without colour vision: shapes and dashes go with them.

const LIGHT = {
  ground: "#f4f5f7", ink: "#1c2127", soft: "#5a6572", faint: "#c3cad3", paper: "#ffffff",
  line: "#0b5cab", bezier: "#00735c", spline: "#7a3e9d", arc: "#b35309", other: "#444444",
  band: "rgba(11, 92, 171, 0.14)", fill: "rgba(11, 92, 171, 0.05)", node: "#0b5cab",
  corner: "#a3470a", held: "#a11226", second: "#a3470a", comb: "rgba(122, 62, 157, 0.5)",
  errors: ["#9fb6c8", "#6f9ec4", "#e0b100", "#d9730d", "#a11226"],
};
const DARK = {
  ground: "#15181c", ink: "#e8ecf1", soft: "#aab4c0", faint: "#4a545f", paper: "#1d2126",
  line: "#78b7f2", bezier: "#58d0b0", spline: "#d19bf0", arc: "#f0a35e", other: "#cccccc",
  band: "rgba(120, 183, 242, 0.2)", fill: "rgba(120, 183, 242, 0.07)", node: "#78b7f2",
  corner: "#f0a35e", held: "#ff96a3", second: "#f0a35e", comb: "rgba(209, 155, 240, 0.55)",
  errors: ["#4d6172", "#4b86b4", "#d8bd45", "#ef9a45", "#ff7585"],
};

/** Dashes and widths of the kinds of pieces, pixels. @type {Object<string, {dash: number[], width: number}>} */
export const KINDS = {
  line: { dash: [], width: 3 },
  bezier: { dash: [], width: 1.8 },
  spline: { dash: [11, 3], width: 2.2 },
  arc: { dash: [11, 3, 2.5, 3], width: 2.4 },
};

const dark = matchMedia("(prefers-color-scheme: dark)");

/** @returns {typeof LIGHT & Object<string, any>} */
export function colors() {
  return dark.matches ? DARK : LIGHT;
}

/** @param {() => void} listener */
export function onScheme(listener) {
  dark.addEventListener("change", listener);
}
