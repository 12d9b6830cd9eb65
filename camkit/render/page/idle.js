// Work that waits: done bit by bit while the page has nothing else to do, and given up when other work begins.

const SLICE = 8; // ms: a picture in between is not late
const request = globalThis.requestIdleCallback ?? ((/** @type {() => void} */ act) => setTimeout(act, 30));

export class Idle {
  /** Do one step after the other. @param {Iterator<unknown>} steps @param {number} [wait] ms before the first one */
  begin(steps, wait = 0) {
    this.stop();
    const slice = () => {
      if (this.steps !== steps) return;
      const end = performance.now() + SLICE;
      while (performance.now() < end) if (steps.next().done) { this.steps = null; return; }
      request(slice);
    };
    /** @type {Iterator<unknown> | null} */ this.steps = steps;
    this.timer = setTimeout(() => request(slice), wait);
  }

  /** Give it up. */
  stop() { clearTimeout(this.timer); this.steps = null; }
}
