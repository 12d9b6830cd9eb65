// Designs that a person has settled on, to go back to and forth again; where they stand (the last values) is no design.

const REMEMBERED = 50;
const SOON = 500; // ms between designs that somebody else chooses in one drag

export class History {
  /** @param {Float64Array} values @param {number} count how many of them are the design's */
  constructor(values, count) {
    Object.assign(this, { now: values.slice(), count, loaded: -Infinity });
    /** @type {Float64Array[]} */ this.past = [];
    /** @type {Float64Array[]} */ this.future = [];
  }

  /** One step more, unless it is the same design. @param {Float64Array} values */
  settle(values) {
    if (!this.now.every((value, k) => k >= this.count || value === values[k])) this.step(values);
  }

  /** One step more. @param {Float64Array} values */
  step(values) {
    this.loaded = -Infinity;
    this.past = [...this.past, this.now].slice(-REMEMBERED);
    this.future = [];
    this.now = values.slice();
  }

  /** What somebody else chose: one step more, or the last one goes on. @param {Float64Array} values */
  load(values) {
    const now = performance.now();
    if (now - this.loaded < SOON) this.now = values.slice(); else this.step(values);
    this.loaded = now;
  }

  /** The design before, if there is one. */
  undo() { return this._go(this.past, this.future); }

  /** The design that was left by `undo`, if there is one. */
  redo() { return this._go(this.future, this.past); }

  /** @param {Float64Array[]} from @param {Float64Array[]} to */
  _go(from, to) {
    const values = from.pop();
    if (!values) return null;
    this.loaded = -Infinity;
    to.push(this.now);
    this.now = values;
    return values.slice(0, this.count);
  }
}
