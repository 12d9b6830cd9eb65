// What stands at the right of a page: one of several things, chosen in a row of tabs.
import { make } from "./controls.js";

let count = 0; // an element's id is the only one of its kind in the document

/** @typedef {{name: string, tab: any, element: HTMLElement, onshow: () => void, wide: boolean}} Tab */

export class Tabs {
  constructor() {
    /** @type {Tab[]} */ this.all = [];
    /** @type {Tab | null} */ this.shown = null;
    this.row = make("div", { class: "camkit-tabs", role: "tablist", "aria-label": "shown at the right" });
    this.row.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this._key(event));
    this.element = make("div", { class: "camkit-right-side" });
  }

  /** One thing more; the first one is shown. @param {string} name @param {HTMLElement} element
   * @param {() => void} [onshow] called whenever it begins to be shown @param {boolean} [wide] whether it takes more room */
  add(name, element, onshow = () => {}, wide = false) {
    const there = this.all.find((one) => one.name === name);
    if (there) { // another thing of the same name
      element.setAttribute("role", "tabpanel"); element.id = there.element.id;
      element.setAttribute("aria-labelledby", there.tab.id);
      there.element.replaceWith(element);
      Object.assign(there, { element, onshow, wide });
      this._mark();
      return;
    }
    const id = `camkit-tab-${++count}`;
    const tab = make("button", { type: "button", role: "tab", id, "aria-controls": `${id}-panel`, onclick: () => this.show(name) }, name);
    for (const [attribute, value] of [["role", "tabpanel"], ["id", `${id}-panel`], ["aria-labelledby", id]]) {
      element.setAttribute(attribute, value);
    }
    this.all.push({ name, tab, element, onshow, wide });
    this.row.append(tab);
    this.element.append(element);
    if (this.shown) this._mark(); else this.show(name);
  }

  /** @param {string} name */
  show(name) {
    this.shown = this.all.find((one) => one.name === name) ?? this.shown;
    this._mark();
    this.shown?.onshow();
  }

  _mark() {
    for (const one of this.all) {
      const shown = one === this.shown;
      one.element.hidden = !shown;
      one.tab.setAttribute("aria-selected", String(shown));
      one.tab.tabIndex = shown ? 0 : -1;
    }
    this.element.classList.toggle("camkit-wide", Boolean(this.shown?.wide));
  }

  /** Arrow keys go from tab to tab, as in every row of tabs. @param {KeyboardEvent} event */
  _key(event) {
    const at = this.all.findIndex((one) => one === this.shown), last = this.all.length - 1;
    const to = { ArrowLeft: at > 0 ? at - 1 : last, ArrowRight: at < last ? at + 1 : 0, Home: 0, End: last }[event.key];
    if (to === undefined) return;
    event.preventDefault(); event.stopPropagation();
    this.show(this.all[to].name);
    this.all[to].tab.focus();
  }
}
