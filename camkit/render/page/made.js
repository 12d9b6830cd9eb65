// The yield: which share of the parts that are made of a design keeps every limit.  A kernel tells it, a little later.
import { make } from "./controls.js";
import { pressed } from "./verdict.js";

const TAB = "Tolerances";

/** @typedef {{values: number[], make: string, text: string, good?: boolean, more?: string, lines?: string[]}} Told the yield
 * in words, how sure it is, and of which design it is */

export class Made {
  /** @param {any} panel */
  constructor(panel) {
    this.panel = panel;
    /** @type {Partial<Told>} */ this.told = {};
    this.text = new Text(""); this.more = make("small");
    this.chip = make("span", { role: "button" }, make("span", { class: "camkit-name" }, "yield"), this.text, this.more);
    panel.why.explain(this.chip, () => this._card);
    pressed(this.chip, () => {
      if (!panel.tabs.all.some((/** @type {any} */ { name }) => name === TAB)) { panel.why.show(this.chip, this._card); return; }
      panel.why.hide();
      panel.showTab(TAB);
    });
    panel.root.addEventListener("camkit-shown", () => this._show(), { signal: panel.leaving.signal });
  }

  /** @param {Partial<Told>} told */
  hear(told) {
    this.told = told;
    this._show();
    if (told.more) this.panel.verdict.rest(); // a longer chip may push others below
  }

  get _card() { return { name: "Yield", lines: this.told.lines ?? ["It is being computed."] }; }

  /** Pale while it is of an older design; away where nobody tells it any more. */
  _show() {
    const { chip, panel, told: { values, make: its, text = "", good, more = "" } } = this, { verdict } = panel;
    const older = its !== panel.structure.make || !values?.every((value, k) => value === panel.values[k]);
    const there = Boolean(text) && !(older && panel.left);
    if (there !== verdict.first.includes(chip)) verdict.putFirst(there ? [chip] : []);
    const kind = `camkit-chip ${good === undefined ? "" : good ? "camkit-ok" : "camkit-bad"}${older ? " camkit-older" : ""}`;
    if (chip.className !== kind) chip.className = kind;
    if (this.text.data === ` ${text} ` && this.more.textContent === more) return;
    this.text.data = ` ${text} `;
    this.more.textContent = more;
    chip.setAttribute("aria-label", `yield ${text} ${more}`.trim());
  }
}
