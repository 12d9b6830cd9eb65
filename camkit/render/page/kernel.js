// What a kernel sends, and its end: the widgets of a page hear nothing of one that is shut down, its connection does.

const ENDED = [undefined, "dead", "terminating"]; // a connection that is disposed of says nothing

/** Call `act` once the kernel of a model has ended; what is returned stops that.
 * @param {any} model @param {() => void} act @returns {() => void} */
export function atTheEnd(model, act) {
  const kernel = model.widget_manager?.kernel, signals = [kernel?.disposed, kernel?.statusChanged];
  const hear = (/** @type {any} */ _, /** @type {string | undefined} */ status) => { if (ENDED.includes(status)) act(); };
  for (const signal of signals) signal?.connect?.(hear);
  return () => { for (const signal of signals) signal?.disconnect?.(hear); };
}

/** Arrays that came in buffers. @param {DataView[]} buffers */
export const arrays = (buffers) => buffers.map((b) => new Float64Array(b.buffer.slice(b.byteOffset, b.byteOffset + b.byteLength)));

/** How long a question waits for its answer before another one is asked, ms. */
export const PATIENCE = 10_000;
