// The end of a kernel that is shut down: the widgets of a page hear nothing of it, its connection does.

const ENDED = [undefined, "dead", "terminating"]; // a connection that is disposed of says nothing

/** Call `act` once the kernel of a model has ended; what is returned stops that.
 * @param {any} model @param {() => void} act @returns {() => void} */
export function atTheEnd(model, act) {
  const kernel = model.widget_manager?.kernel, signals = [kernel?.disposed, kernel?.statusChanged];
  const hear = (/** @type {any} */ _, /** @type {string | undefined} */ status) => { if (ENDED.includes(status)) act(); };
  for (const signal of signals) signal?.connect?.(hear);
  return () => { for (const signal of signals) signal?.disconnect?.(hear); };
}
