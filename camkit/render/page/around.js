// Designs around the one that is shown, each with one quantity at another value: where limits are kept, and slopes.
import { judged, numberOf } from "./measures.js";
import { KEPT, MISSED, REFUSED } from "./spans.js";

const SAMPLES = 24, HALVED = 6; // along a slider; how often the way to the next kind of design is halved

/** @typedef {import("./spans.js").Span} Span */

export class Around {
  /** @param {any} structure @param {import("./engine.js").Run} run */
  constructor(structure, run) { Object.assign(this, { structure, run }); }

  /** The outputs with quantity `k` at a value; null if that cannot be built.
   * @param {Float64Array} values @param {number} k @param {number} value */
  at(values, k, value) {
    const other = values.slice();
    other[k] = value;
    const outputs = this.run(other);
    return this.structure.refusals.some((/** @type {any} */ r) => outputs[r.at][0] !== 1) ? null : outputs;
  }

  /** Which kind of design it is. @param {Float64Array} values @param {number} k @param {number} value */
  _kind(values, k, value) {
    const outputs = this.at(values, k, value);
    if (!outputs) return REFUSED;
    return judged(this.structure, outputs, () => NaN).every((row) => row.kept) ? KEPT : MISSED;
  }

  /** The spans of a quantity from `low` to `high`, a design a step; `found` gets them.
   * @param {Float64Array} values @param {number} k @param {number} low @param {number} high @param {(spans: Span[]) => void} found */
  * spans(values, k, low, high, found) {
    const place = (/** @type {number} */ i) => low + ((high - low) * i) / (SAMPLES - 1);
    /** @type {Span[]} */ const spans = [];
    for (let i = 0; i < SAMPLES; i++) {
      const kind = this._kind(values, k, place(i)), last = spans.at(-1);
      yield;
      if (last && last.kind !== kind) {
        let [from, to] = [place(i - 1), place(i)];
        for (let j = 0; j < HALVED; j++) {
          const middle = (from + to) / 2;
          if (this._kind(values, k, middle) === last.kind) from = middle; else to = middle;
          yield;
        }
        last.high = (from + to) / 2;
        spans.push({ low: last.high, high: place(i), kind });
      } else if (last) last.high = place(i); else spans.push({ low, high: low, kind });
    }
    found(spans);
  }

  /** By how much a measure changes if a quantity goes on by `step`, by central difference, or from one side where the
   * other one cannot be built; `nan` where neither can. @param {Float64Array} values @param {number} k
   * @param {number} step @param {any} measure */
  slope(values, k, step, measure) {
    const [less, now, more] = [-step, 0, step].map((by) => {
      const outputs = this.at(values, k, values[k] + by);
      return outputs ? numberOf(measure, outputs) : NaN;
    });
    const [before, after] = [now - less, more - now];
    return Number.isNaN(before) ? after : Number.isNaN(after) ? before : (before + after) / 2;
  }
}
