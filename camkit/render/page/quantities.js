// The quantities of a design: rows in groups that fold, menus for choices, and a box to find them by name.
import { Row, folded, make } from "./controls.js";

const MANY = 8; // from here on there is a box to find one
const ROOM = 24; // pixels below what is brought into sight

export class Quantities {
  /** @param {any} structure @param {import("./units.js").Units} units
   * @param {(k: number, value: number, settled: boolean) => void} moved
   * @param {((path: string, option: string) => void) | null} choose what takes a choice, if anything does */
  constructor(structure, units, moved, choose) {
    this.declared = structure.quantities;
    this.rows = this.declared.map((/** @type {any} */ quantity, /** @type {number} */ k) =>
      new Row({ ...quantity }, units, (value, settled) => moved(k, value, settled)));
    /** The menu that was used last. @type {HTMLElement | null} */ this.chosen = null;
    this.choices = structure.choices.map((/** @type {any} */ choice) => menuOf(choice, choose, (menu) => { this.chosen = menu; }));
    const free = this.rows.map((/** @type {Row} */ row, /** @type {number} */ k) => [this.declared[k].group, row]);
    this.groups = folded(free.filter((/** @type {any} */ _, /** @type {number} */ k) => this.declared[k].free));
    if (this.choices.length) {
      this.groups.push(make("details", {}, make("summary", {}, `Choices (${this.choices.length})`), ...this.choices));
    }
    const words = "find a quantity";
    this.find = make("input", { type: "search", placeholder: words, "aria-label": words, oninput: () => this._filter() });
    this.nothing = make("p", { class: "camkit-nothing", hidden: true }, "no quantity has this name");
    const search = this.rows.length > MANY ? [this.find, this.nothing] : [];
    this.element = make("div", { class: "camkit-left", role: "group", "aria-label": "quantities" }, ...search, ...this.groups);
  }

  /** Places of the rows that have a slider in sight: free, in a group that is open, those that are not scrolled away first. */
  get inSight() {
    const box = this.element.getBoundingClientRect(), every = [...this.rows.keys()];
    const seen = every.filter((k) => this.declared[k].free && this.rows[k].element.offsetParent);
    const away = (/** @type {number} */ k) => {
      const { top, bottom } = this.rows[k].element.getBoundingClientRect();
      return bottom < box.top || top > box.bottom ? 1 : 0;
    };
    return seen.map((k) => [k, away(k)]).sort((a, b) => a[1] - b[1]).map(([k]) => k);
  }

  /** Put something before the quantities of a part, by its name. @param {string} name @param {HTMLElement} element */
  lead(name, element) {
    const group = this.groups.find((/** @type {any} */ each) => `${titleOf(each)} `.toLowerCase().startsWith(`${name} `.toLowerCase()));
    if (group) group.firstChild.after(element); else this.element.append(element);
  }

  /** How a person has them before them: the groups that are open, how far it is scrolled. */
  get held() {
    const open = this.groups.filter((/** @type {any} */ group) => group.open).map(titleOf);
    return { known: this.groups.map(titleOf), open, down: this.element.scrollTop };
  }

  /** Stand as others did; a group that is new stays as it is. @param {{known: string[], open: string[], down: number}} held */
  hold({ known, open, down }) {
    for (const group of this.groups) if (known.includes(titleOf(group))) group.open = open.includes(titleOf(group));
    this.element.scrollTop = down;
  }

  /** Bring a control of these into sight, within their column alone. @param {HTMLElement | null} control */
  bring(control) {
    if (!control || !this.element.contains(control)) return;
    const below = control.getBoundingClientRect().bottom + ROOM - this.element.getBoundingClientRect().bottom;
    if (below > 0) this.element.scrollTop += below;
  }

  /** Mark what a design cannot be built with: a group that is folded opens. @param {number[]} guilty places of rows */
  blame(guilty) {
    this.rows.forEach((row, k) => {
      const { element, slider } = row, is = guilty.includes(k), group = element.closest("details");
      if (element.classList.contains("camkit-guilty") === is) return;
      element.classList.toggle("camkit-guilty", is);
      slider.setAttribute("aria-invalid", String(is));
      if (is && group) group.open = true;
    });
  }

  /** Mark the menu whose last choice was refused, or none any more. @param {boolean} refused */
  blameChoice(refused) {
    this.chosen?.classList.toggle("camkit-guilty", refused);
    if (!refused) this.chosen = null;
  }

  _filter() {
    const wanted = this.find.value.trim().toLowerCase(), has = (/** @type {string} */ text) => text.toLowerCase().includes(wanted);
    this.declared.forEach((/** @type {any} */ q, /** @type {number} */ k) => {
      this.rows[k].element.hidden = !has(`${q.name} ${q.symbol}`);
    });
    for (const choice of this.choices) choice.hidden = !has(choice.firstChild.textContent);
    for (const group of this.groups) {
      if (wanted) group.open = true;
      group.hidden = Boolean(wanted) && ![...group.querySelectorAll(".camkit-row, .camkit-choice")].some((row) => !row.hidden);
    }
    this.nothing.hidden = this.groups.some((/** @type {HTMLElement} */ group) => !group.hidden);
  }
}

/** The name of a group, without how many it has. @param {any} group */
const titleOf = (group) => group.firstChild.textContent.replace(/ \(\d+\)$/, "");

/** A menu; what nobody takes stays as it is. @param {{path: string, name: string, options: string[], chosen: string}} choice
 * @param {((path: string, option: string) => void) | null} choose @param {(row: HTMLElement) => void} used */
function menuOf({ path, name, options, chosen }, choose, used) {
  if (!choose) return make("div", { class: "camkit-choice" }, make("span", {}, name), make("b", {}, chosen));
  const offered = options.includes(chosen) ? options : [chosen, ...options];
  const menu = make("select", { "aria-label": name, "data-asks": true, onchange: () => { used(row); choose(path, menu.value); menu.value = chosen; } },
    ...offered.map((option) => make("option", { value: option, selected: option === chosen }, option)));
  const row = make("label", { class: "camkit-choice" }, make("span", {}, name), menu);
  return row;
}
