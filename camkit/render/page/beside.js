// A design beside the one in hand, pinned or looked at: it may be of another make, and is drawn from what computes it.
import { numberOf } from "./measures.js";

/**
 * @typedef {{make?: string, values: Float64Array, outputs: import("./engine.js").Outputs, pictures: any[], measures: any[],
 *   run?: import("./engine.js").Run}} Beside without `run` it stays where it stands
 */

/** A design as a panel shows it. @param {any} panel @param {Float64Array} values @param {import("./engine.js").Outputs} outputs
 * @returns {Beside} */
export function besideOf({ structure: { make, pictures, measures }, runs }, values, outputs) {
  return { make, pictures, measures, values, outputs, run: runs };
}

/** Stand where the design in hand does. @param {Beside} beside @param {ArrayLike<number>} at the values of the positions */
export function turn(beside, at) {
  const { values, run } = beside, begin = values.length - at.length;
  if (!run || Array.prototype.every.call(at, (/** @type {number} */ value, /** @type {number} */ k) => values[begin + k] === value)) return;
  values.set(at, begin);
  beside.outputs = run(values);
}

/** What is drawn of it in a picture: outputs and marks, if it has such a picture that computes.
 * @param {Beside | null} beside @param {any} picture @param {number} k which one of the panel's it is */
export function drawnOf(beside, picture, k) {
  const same = (/** @type {any} */ one) => one?.name === picture.name, { pictures, outputs } = beside ?? { pictures: [], outputs: [] };
  const its = same(pictures[k]) ? pictures[k] : pictures.find(same);
  return its && !its.still && !picture.still ? { picture: its, outputs } : undefined;
}

/** Its number of a measure. @param {Beside} beside @param {any} measure */
export function measureOf({ measures, outputs }, { name }) {
  const its = measures.find((one) => one.name === name);
  return its ? numberOf(its, outputs) : NaN;
}
