// Designs that a person has settled on, to go back to and forth again.  Where the mechanism stands is no part of them.

const REMEMBERED = 50;
const SOON = 500; // ms between designs that somebody else chooses in one drag
const PATIENCE = 3000; // ms for a kernel that was asked for a design, before it is asked again

/** @typedef {{make: string, values: number[]}} Step a design: its make, as the kernel calls it, and the values of its quantities */

export class History {
  /** @param {ArrayLike<number>} values those of the design, which others may follow @param {number} count how many are the design's
   * @param {string} [make] */
  constructor(values, count, make = "") {
    Object.assign(this, { now: { make, values: Array.from(values).slice(0, count) }, count, loaded: -Infinity });
    /** @type {Step[]} */ this.past = [];
    /** @type {Step[]} */ this.future = [];
    /** The step of another make that the kernel was asked for. @type {Step | null} */ this.asked = null;
    /** How many steps are to be redone once it is there, below 0 how many undone. */ this.more = 0;
  }

  /** A design of the make that is shown. @param {ArrayLike<number>} values @returns {Step} */
  _step(values) { return { make: this.now.make, values: Array.from(values).slice(0, this.count) }; }

  /** One step more, unless it is the same design. @param {ArrayLike<number>} values */
  settle(values) {
    const step = this._step(values);
    if (!alike(this.now, step)) this._more(step);
  }

  /** @param {Step} step */
  _more(step) {
    this.loaded = -Infinity;
    this.past = [...this.past, this.now].slice(-REMEMBERED);
    this.future = [];
    this.now = step;
  }

  /** What somebody else chose: one step more, or the last one goes on. @param {ArrayLike<number>} values */
  load(values) {
    const now = performance.now(), step = this._step(values);
    if (now - this.loaded < SOON) this.now = step; else this._more(step);
    this.loaded = now;
  }

  /** What somebody else chooses next, whenever it comes, belongs to the last step, if that was theirs. */
  goOn() { if (this.loaded > 0) this.loaded = Infinity; }

  /** What somebody else chooses from now on is a step of its own. */
  rest() { this.loaded = -Infinity; }

  /** Go on after another panel's steps: with the design that it asked for, or with one step more.
   * @param {History} before */
  follow({ past, future, now, asked, more }) {
    const here = this.now;
    Object.assign(this, { past, future, now });
    const from = [past, future].find((steps) => asked && steps.at(-1) === asked);
    if (from && alike(asked, here)) { this._take(from); this.more = more; }
    else if (!alike(now, here)) this._more(here);
  }

  /** The design before, if there is one: taken, or asked for, or gone back to after the one that is asked for. */
  undo() { return this._go(this.past, -1); }

  /** The design that was left by `undo`, if there is one. */
  redo() { return this._go(this.future, 1); }

  /** @param {Step[]} steps @param {number} by */
  _go(steps, by) {
    if (this.asked && performance.now() - this.askedAt < PATIENCE) { this.more += by; return null; }
    const step = steps.at(-1) ?? null;
    if (step?.make === this.now.make) this._take(steps); else Object.assign(this, { asked: step, askedAt: performance.now(), more: 0 });
    return step;
  }

  /** One of the steps that are still to be done: 1, -1, or 0 if there is none. */
  next() {
    const by = Math.sign(this.more);
    this.more -= by;
    return by;
  }

  /** @param {Step[]} steps its last one is the design from now on */
  _take(steps) {
    this.loaded = -Infinity;
    (steps === this.past ? this.future : this.past).push(this.now);
    this.now = /** @type {Step} */ (steps.pop());
  }
}

/** Whether two steps are the same design; a file rounds. @param {Step} one @param {Step} other */
const alike = (one, other) => one.make === other.make && one.values.every((value, k) => Math.abs(value - other.values[k]) <= 1e-12 * Math.abs(value));
