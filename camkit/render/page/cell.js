// A notebook that changes what a cell has stored shows the cell's panel anew: what a person sees moves there as it is.

/** @typedef {{model: any, el: HTMLElement}} Host */
/** @typedef {{el: any, stood: boolean, focused: HTMLElement | null, end: () => void}} View */

/** Whether it was taken out of its cell; a cell that is scrolled away is itself out of the page. @param {HTMLElement} el */
const takenOut = (el) => !el.isConnected && !el.closest(".jp-Cell");

/** @param {View} view @param {HTMLElement} el where it stands from now on */
function place(view, el) {
  view.el = el;
  const seen = new ResizeObserver(() => { if (el.isConnected) { view.stood = true; seen.disconnect(); } });
  seen.observe(el);
  el.addEventListener("focusin", ({ target }) => { view.focused = /** @type {HTMLElement} */ (target); });
}

/** @param {View} view @param {HTMLElement} el */
function move(view, el) {
  el.replaceChildren(...view.el.childNodes);
  Object.assign(el, { camkit: view.el.camkit });
  place(view, el);
  requestAnimationFrame(() => { if (document.activeElement === document.body) view.focused?.focus({ preventScroll: true }); });
}

/** A widget whose views move. @param {(host: Host) => Promise<() => void> | (() => void)} begin makes one, and gives how it ends */
export const movable = (begin) => () => {
  /** The views of one model. @type {Set<View>} */ const views = new Set();
  return {
    async render(/** @type {Host} */ { model, el }) {
      const old = [...views].find((each) => each.stood && takenOut(each.el));
      const view = old ?? { el, stood: false, focused: null, end() {} };
      if (old) move(old, el);
      else { views.add(view); place(view, el); view.end = await begin({ model, el }); }
      return () => { if (view.el === el) { views.delete(view); view.end(); } };
    },
  };
};
