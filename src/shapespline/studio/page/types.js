// The words of the page, for the checker of types; nothing here runs.

/**
 * @typedef {{n_points: number, n_drawn: number, closed: boolean, hole: boolean, color: string | null,
 *   length: number, first: number}} Outline
 * @typedef {{name: string, picture: boolean, options: Object<string, any>, unit: string | null,
 *   box: number[], origin: number[], diagonal: number, frame: number[] | null, tolerance: number,
 *   sentences: string[], outlines: Outline[], points: Float32Array, indices: Int32Array,
 *   at: Float32Array, generation: number}} Shape
 * @typedef {{outline: number, generation: number, slot: string, draft: boolean, seconds: number,
 *   status: string, sentence: string, kept: boolean, tolerance: number, max_distance: number,
 *   hausdorff_distance: number, rms_distance: number, n_stored_points: number,
 *   n_control_points: number, degree: number, method: string, closed: boolean, kinds: string[],
 *   n_kinds: Object<string, number>, knots: number, n_outliers: number, regularities: Regularity[], crossings?: number[][],
 *   cubics: Float32Array, counts: Int32Array, nodes: Float32Array, turns: Int32Array,
 *   points: Int32Array, corners: Int32Array, polygon: Float32Array, polygons: Int32Array,
 *   samples: Float32Array, errors: Float32Array}} Fit
 * @typedef {{name: string, noun: string, pieces: number[], off: number, order: number}} Regularity
 * @typedef {{slot: string, draft: boolean, crossings: Float32Array, n_stored_points: number, n_bytes: number | null,
 *   n_kept: number, distance: number, seconds: number, generation: number, regularities: Regularity[],
 *   remarks: string[]}} Done
 * @typedef {{corners?: number[], through?: number[], end_tangents?: (number[] | null)[],
 *   moved?: number[][]}} Own
 * @typedef {{goal: string, tolerance: number, points: number, degree: number, corners: string,
 *   form: string, effort: string, ends: string, symmetric: boolean, outliers: boolean,
 *   words: Object<string, string>, regularities: string[] | null,
 *   own: Object<string, Own>, reading: Object<string, any>}} State
 * @typedef {{length: number, window: number, floor: number, n_control_points: number, error: number,
 *   seconds: number, closed: boolean, outline: number, method: string, h: Float32Array,
 *   places: Float32Array, maxima: Int32Array, stations: Int32Array, tangents: Float32Array,
 *   normals: Float32Array, control: Float32Array, cubics: Float32Array}} PaperStart
 * @typedef {{asked: string, method: string, sentence: string, n_iterations: number,
 *   seconds: number, error: number, hausdorff_distance: number, iterations: number[],
 *   history: Float32Array, control: Float32Array, cubics: Float32Array,
 *   shapes: Object<string, number[]>}} Film
 * @typedef {{kind: string, outline: number, x: number, y: number, node: number, point: number}} Hit
 */

export {};
