// What a page remembers beside its design: where it stands, what Undo goes back to, what is pinned, its units; and what
// its kernel offers of earlier.  A kernel that has ended leaves no control behind that does nothing.
import { besideOf } from "./beside.js";
import { make } from "./controls.js";

const QUIET = 400; // ms of rest after which the kernel hears how the page was left

/** How a panel stands, its design left out: plain numbers. @param {any} panel */
export function standOf(panel) {
  const { values, history: { count, now, past, future }, ghost, tabs, units } = panel;
  return {
    at: [...values.slice(count)], tab: tabs.shown?.name ?? "", units: units.name, make: now.make, past, future,
    pinned: ghost ? { make: ghost.make ?? "", values: [...ghost.values] } : null,
  };
}

/** Stand as a page was left; what does not belong to this design, or is of a make that this kernel does not know, is left out.
 * @param {any} panel @param {any} left */
export async function stand(panel, left) {
  const { history, values: { length } } = panel, { count, now: { make } } = history;
  const numbers = (/** @type {any} */ list) => Array.isArray(list) && list.every(Number.isFinite);
  const here = (/** @type {any} */ step) => ({ ...step, make: step.make === left.make && !sameKernel(left.make, make) ? make : step.make });
  const fits = (/** @type {any} */ { make: its, values }, /** @type {number} */ wanted) =>
    numbers(values) && (its === make ? values.length === wanted : sameKernel(its, make));
  const steps = (/** @type {any} */ list) => (Array.isArray(list) ? list : []).map(here).filter((step) => fits(step, count));
  const past = steps(left.past), future = steps(left.future);
  if (past.length + future.length) Object.assign(history, { past, future });
  if (numbers(left.at) && left.at.length === length - count) panel.put([...panel.values.slice(0, count), ...left.at]);
  history.now = { make, values: [...panel.values.slice(0, count)] };
  if (typeof left.units === "string") panel.use(left.units);
  if (typeof left.tab === "string") panel.showTab(left.tab);
  const pinned = left.pinned && here(left.pinned);
  if (!pinned || panel.ghost || !fits(pinned, length)) return;
  if (pinned.make !== make) { recall(panel, pinned); return; }
  const values = Float64Array.from(pinned.values), outputs = await panel.engine.run(values, true);
  if (!panel.ended && !panel.ghost && !outputs.sentence) panel.pin(besideOf(panel, values, outputs));
}

/** Ask the kernel for the pictures of a design of another make. @param {any} panel @param {import("./history.js").Step} pinned
 * with where it stands */
function recall(panel, { make, values }) {
  const count = values.length - panel.structure.positions.length;
  panel.wanted = make; // other pages of the kernel hear its answer, too
  panel.host?.pin({ make, values: values.slice(0, count) }, values.slice(count));
}

/** Pin what the kernel has drawn. @param {any} panel @param {any} drawn @param {import("./engine.js").Outputs} outputs */
export function pinDrawn(panel, { pinned: { make, values }, pictures, measures }, outputs) {
  if (panel.ghost || make !== panel.wanted) return;
  panel.pin({ make, values: Float64Array.from([...values, ...panel.values.slice(panel.history.count)]), outputs, pictures, measures });
}

/** Whether makes have their names from one kernel. @param {any} one @param {any} other */
const sameKernel = (one, other) => String(one).split(".")[0] === String(other).split(".")[0];

/** What of a panel is gone when it ends: what stood open, and what had the focus. @param {any} panel */
export function heldBy({ root, quantities }) {
  const { activeElement: focused } = document;
  return { ...quantities.held, focused: root.contains(focused) ? focused.getAttribute("aria-label") : null };
}

/** Go on where a panel of another make stood. @param {any} panel @param {any} before @param {ReturnType<typeof heldBy>} held */
export function follow(panel, before, { focused, ...held }) {
  panel.history.follow(before.history);
  panel.use(before.units.name);
  panel.showTab(before.tabs.shown?.name);
  panel.positions.resume(before.positions);
  panel.quantities.hold(held);
  if (before.ghost) panel.pin(before.ghost);
  const control = focused && panel.root.querySelector(`[aria-label="${CSS.escape(focused)}"]`);
  control?.focus({ preventScroll: true });
  panel.root.addEventListener("camkit-shown", () => panel.quantities.bring(control), { once: true }); // the verdict takes its room
}

/** Tells the kernel how a page was left, from a person's first touch on; `panel()` is the panel that is shown now. */
export class Session {
  /** @param {HTMLElement} root @param {any} model @param {() => any} panel */
  constructor(root, model, panel) {
    Object.assign(this, { root, model, panel, told: "", leaving: new AbortController() });
    const { signal } = this.leaving, touched = (/** @type {Event} */ event) => { if (event.isTrusted) this.touched = true; };
    for (const kind of ["pointerdown", "keydown", "input", "change"]) root.addEventListener(kind, touched, { signal, capture: true });
    const later = () => { clearTimeout(this.timer); if (this.touched) this.timer = setTimeout(() => this._tell(), QUIET); };
    root.addEventListener("camkit-shown", later, { signal });
    this.line = make("div", { class: "camkit-offer", role: "status", hidden: true });
    root.before(this.line);
  }

  /** Ask the kernel what it has kept. */
  ask() { this.model.send({ session: { hello: true } }); }

  /** The page is not looked at any more. */
  end() { clearTimeout(this.timer); this.leaving.abort(); this.line.remove(); }

  /** @param {string} sentence what could be gone on with, or nothing */
  offer(sentence) {
    const answer = (/** @type {boolean} */ yes) => { this.touched = true; this.model.send({ session: { continue: yes } }); };
    const button = (/** @type {string} */ words, /** @type {boolean} */ yes) => make("button", { type: "button", onclick: () => answer(yes) }, words);
    this.line.replaceChildren(...(sentence ? [make("span", {}, sentence), button("Continue", true), button("No", false)] : []));
    this.line.hidden = !sentence;
  }

  _tell() {
    const panel = this.panel();
    if (!panel || panel.ended) return;
    const left = standOf(panel), words = JSON.stringify([panel.structure.choices, [...panel.values], left]);
    if (words === this.told) return;
    this.told = words;
    const { study, number = 0 } = this.model.get("page"); // the kernel's own, and one more, since the design may be another one
    this.model.set("page", { ...left, ...(study && { study }), number: number + 1 });
    this.model.save_changes();
  }
}

/** Whether a kernel knows the model: one that a notebook was saved with is known to none. @param {any} model */
export const known = (model) => model.get("layout")?.comm_live !== false;

/** What only a kernel can do. */
const ASKS = "[data-asks], .camkit-sheet :is(input, select, button, textarea)";

/** Leave alone what only a kernel can do, and say so. @param {any} panel @param {boolean} computes whether the page itself does */
export function alone(panel, computes) {
  for (const control of panel.root.querySelectorAll(computes ? ASKS : "input, select, button")) control.disabled = true;
  panel.say(computes ? "No kernel knows this page: it computes by itself; run the cell again for menus, files and searches."
    : "No kernel knows this page, and one computes this design: run the cell again to go on.");
}
