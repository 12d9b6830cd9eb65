// What is to be said of a design: trouble, limits as chips, worst first, and in a live region for those who hear it.
import { make } from "./controls.js";
import { letters } from "./numbers.js";
import { told } from "./measures.js";

const MOST = 5; // chips, if few have a limit

export class Verdict {
  /** @param {(element: HTMLElement, measure: () => any) => void} explain what shows why a measure is what it is
   * @param {(element: HTMLElement, measure: any) => void} go what a click on a measure does
   * @param {() => void} goTo what a click on the trouble does */
  constructor(explain, go, goTo) {
    Object.assign(this, { explain, go });
    this.trouble = pressed(make("div", { class: "camkit-trouble camkit-chip camkit-bad", role: "button", "data-lm-suppress-shortcuts": true, hidden: true }),
      goTo);
    this.chips = make("div", { class: "camkit-chips", role: "group", "aria-label": "limits and measures" });
    this.others = make("button", { type: "button", class: "camkit-others", hidden: true, onclick: () => {
      this.chips.classList.toggle("camkit-all");
      this._count();
    } });
    this.said = make("div", { class: "camkit-said", role: "status" });
    this.elements = [this.trouble, this.chips, this.others, this.said];
    this.chips.addEventListener("focusin", (/** @type {any} */ { target }) => { // by a key: it is not seen
      if (!this._below().includes(target)) return;
      this.chips.classList.add("camkit-all");
      this._count();
    });
    new ResizeObserver(() => this._count()).observe(this.chips);
    /** @type {{element: HTMLElement, name: HTMLElement, words: Text, more: HTMLElement, m: any}[]} */ this.made = [];
    /** Chips that stand before those of measures. @type {HTMLElement[]} */ this.first = [];
    this.count = 0;
  }

  /** @param {import("./measures.js").Judged[]} rows @param {string} trouble @param {import("./units.js").Units} units */
  tell(rows, trouble, units) {
    const said = (/** @type {import("./measures.js").Judged} */ { m, now }) => Boolean(trouble) && m.inTrouble && now < 0; // once
    const every = rows.filter(({ m }) => m.limit !== undefined), limited = every.filter((row) => !said(row)).sort((a, b) => b.miss - a.miss);
    const free = rows.filter(({ m, now }) => m.limit === undefined && Number.isFinite(now));
    const others = free.slice(0, Math.max(0, MOST - limited.length));
    this.verdict = verdictOf(limited, trouble, limited.length < every.length);
    const told = [...limited, ...others], chips = told.map((row) => chipOf(row, units)), written = JSON.stringify([trouble, chips]);
    if (this.written !== written) { // else the page would be laid out anew in every frame
      this.written = written;
      this.trouble.textContent = trouble; this.trouble.hidden = !trouble;
      if (trouble) this.trouble.tabIndex = 0; else this.trouble.removeAttribute("tabindex");
      this._fill(told.map(({ m }) => m), chips);
    }
  }

  /** The design stays: it is said to those who hear, and how many chips do not fit. */
  rest() {
    if (this.said.textContent !== this.verdict) this.said.textContent = this.verdict;
    this._count();
  }

  /** Chips stay as elements, so that one keeps the focus. @param {any[]} measures @param {string[][]} chips */
  _fill(measures, chips) {
    while (this.made.length < chips.length) this.made.push(this._chip());
    chips.forEach(([kind, name, words, more], k) => {
      const made = this.made[k];
      made.m = measures[k];
      made.element.className = `camkit-chip ${kind}`;
      made.element.setAttribute("aria-label", `${name} ${words} ${more}`.replace(/ +/g, " "));
      made.name.textContent = name;
      made.words.data = ` ${words} `;
      made.more.textContent = more;
    });
    if (this.count === chips.length) return;
    this.count = chips.length;
    this.putFirst(this.first);
  }

  /** Other chips before those of measures. @param {HTMLElement[]} first */
  putFirst(first) {
    this.first = first;
    this.chips.replaceChildren(...first, ...this.made.slice(0, this.count).map(({ element }) => element));
  }

  /** The chips below those that are shown. @returns {any[]} */
  _below() {
    const { chips } = this;
    return [...chips.children].filter((/** @type {any} */ chip) => chip.offsetTop >= chips.offsetTop + chips.clientHeight);
  }

  /** Of the chips one line is shown, and how many there are below it; a press shows all. */
  _count() {
    const { chips, others } = this, all = chips.classList.contains("camkit-all");
    chips.classList.remove("camkit-cut");
    chips.scrollTop = 0;
    const cut = all || this._below().length > 0;
    chips.classList.toggle("camkit-cut", cut);
    others.hidden = !cut;
    const words = all ? "fewer" : `+${this._below().length} more`;
    if (others.textContent !== words) others.textContent = words;
    others.setAttribute("aria-expanded", String(all));
  }

  _chip() {
    const name = make("span", { class: "camkit-name" }), words = new Text(""), more = make("small");
    const element = make("span", { role: "button" }, name, words, more), made = { element, name, words, more, m: null };
    this.explain(element, () => made.m);
    pressed(element, () => this.go(element, made.m));
    return made;
  }
}

/** In words, for those who hear it. @param {import("./measures.js").Judged[]} limited @param {string} trouble
 * @param {boolean} others whether the trouble says of more limits that they are missed */
function verdictOf(limited, trouble, others) {
  const missed = limited.filter(({ kept }) => !kept).map(({ m }) => m.name);
  const limits = missed.length ? `limit not kept: ${missed.join(", ")}` : limited.length ? `every ${others ? "other " : ""}limit is kept` : "";
  return [trouble, limits].filter(Boolean).join("; ");
}

/** A button that is no native one, as its words may stand in lines. @param {HTMLElement} element @param {() => void} act */
export function pressed(element, act) {
  element.addEventListener("click", act);
  element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault(); event.stopPropagation();
    act();
  });
  return element;
}

/** Kind, name, number and limit; what has none has its number there. @param {import("./measures.js").Judged} row
 * @param {import("./units.js").Units} units */
function chipOf({ m, now, kept }, units) {
  const shown = Number.isNaN(now) ? "cannot be computed" : told(m, now, units), name = letters(m.name);
  if (m.limit === undefined) return ["camkit-free", name, "", shown];
  const limit = `${m.sense > 0 ? "\u2264" : "\u2265"} ${told(m, m.limit, units)}`;
  return [kept ? "camkit-ok" : "camkit-bad", name, shown, limit];
}
