// Why a measure is what it is: a card with its formula, its source, the test that holds it, and what each slider does to it.
import { lettered, make } from "./controls.js";
import { format, pretty } from "./numbers.js";

const WAIT = 400; // ms that a pointer rests on a measure before its card comes
const SHARE = 0.01; // of a slider's range, for slopes
const TITLE = "What 1 % of each slider's range does to it";
let count = 0; // an element's id is the only one of its kind in the document

/** A path with places where its line may break. @param {string} path */
const broken = (path) => path.split(/(?<=[/_]|::)/).flatMap((part) => [part, make("wbr")]);

export class Why {
  /** @param {import("./panel.js").Panel} panel */
  constructor(panel) {
    this.panel = panel;
    this.element = make("div", { class: "camkit-why", role: "tooltip", id: `camkit-why-${++count}`, hidden: true });
    this.element.addEventListener("pointerenter", () => clearTimeout(this.timer));
    this.element.addEventListener("pointerleave", () => this.hide());
    panel.root.addEventListener("camkit-shown", () => this._follow(), { signal: panel.leaving.signal });
  }

  /** Show the card of a measure whenever the pointer rests on an element or it has the focus.
   * @param {HTMLElement} element @param {() => any} measure */
  explain(element, measure) {
    element.tabIndex = 0;
    element.setAttribute("aria-describedby", this.element.id);
    element.setAttribute("data-lm-suppress-shortcuts", "true");
    const later = (/** @type {() => void} */ act) => { clearTimeout(this.timer); this.timer = setTimeout(act, WAIT); };
    element.addEventListener("pointerenter", () => later(() => this.show(element, measure())));
    element.addEventListener("pointerleave", () => later(() => this.hide()));
    element.addEventListener("focus", () => this.show(element, measure()));
    element.addEventListener("blur", () => this.hide());
    element.addEventListener("keydown", (event) => { if (event.key === "Escape") this.hide(); });
  }

  hide() {
    clearTimeout(this.timer);
    this.element.hidden = true;
    this.measure = null;
    this.panel.slopes.stop();
  }

  /** The design has moved under the card. */
  _follow() {
    if (this.measure && this.design !== this._design) this.show(this.at, this.measure);
  }

  get _design() { return this.panel.values.slice(0, this.panel.history.count).join(); }

  /** @param {HTMLElement} at @param {any} measure */
  show(at, measure) {
    clearTimeout(this.timer);
    if (!measure || !this.panel.outputs) return;
    Object.assign(this, { at, measure, design: this._design });
    if (measure.lines) { // words of its own
      this.element.replaceChildren(make("h2", {}, measure.name),
        ...measure.lines.map((/** @type {string} */ words) => make("p", {}, ...lettered(this.panel.words(words)))));
      this.element.hidden = false;
      this._place();
      return;
    }
    const { why } = measure, now = this.panel.numbers.find((/** @type {any} */ m) => m.name === measure.name);
    const line = (/** @type {string} */ name, /** @type {string} */ words) =>
      make("p", {}, make("b", {}, `${name} `), ...lettered(words.replace(/``?/g, "")));
    this.bars = make("div", { class: "camkit-slopes" });
    this.element.replaceChildren(
      make("h2", {}, ...lettered(measure.name), " ", now?.text ?? ""),
      this.bars,
      ...(why.formula.length ? why.formula : ["none is given"]).map((/** @type {string} */ words, /** @type {number} */ k) =>
        line(k ? "" : "Formula, in SI units:", words)),
      line("Source:", why.source || "none is named"),
      make("p", {}, make("b", {}, "Held by: "), ...broken(why.test || "no test is named")));
    this.element.hidden = false;
    this._place();
    this._slopes();
  }

  /** Below the element, inside the page. */
  _place() {
    const page = this.panel.root.getBoundingClientRect(), box = this.at.getBoundingClientRect(), { style } = this.element;
    style.left = `${Math.max(4, Math.min(box.left - page.left, page.width - this.element.offsetWidth - 4))}px`;
    const below = box.bottom - page.top + 3, above = box.top - page.top - this.element.offsetHeight - 3;
    style.top = `${below + this.element.offsetHeight > page.height && above > 0 ? above : below}px`;
  }

  /** A bar for each free slider, when they are computed. */
  _slopes() {
    const { panel, measure, bars } = this, { around, structure } = panel;
    if (!around) { bars.append("The kernel computes this design: the page has no slopes."); return; }
    if (panel.sentence) { bars.append("This design cannot be built: there are no slopes."); return; }
    const values = panel.values.slice(), every = [...structure.quantities.keys()], { quantities } = structure;
    bars.append(make("b", {}, TITLE), " ...");
    /** @type {{k: number, by: number}[]} */ const found = [];
    const { rows } = panel, done = () => this._draw(found);
    panel.slopes.begin((function* steps() {
      for (const k of every.filter((place) => quantities[place].free)) {
        found.push({ k, by: around.slope(values, k, SHARE * (rows[k].high - rows[k].low), measure) });
        yield;
      }
      done();
    })());
  }

  /** Bars, the longest first: to the right and blue what grows, to the left and orange what shrinks.
   * @param {{k: number, by: number}[]} found */
  _draw(found) {
    const { panel, measure } = this, size = Math.max(...found.map(({ by }) => Math.abs(by) || 0));
    const shown = found.filter(({ by }) => Math.abs(by) > 1e-9 * size).sort((a, b) => Math.abs(b.by) - Math.abs(a.by));
    const { unit, ratio } = panel.units.of(measure.unit), factor = ratio / measure.factor;
    const bar = (/** @type {{k: number, by: number}} */ { k, by }) => {
      const name = panel.structure.quantities[k].name, words = `${format(by * factor, "+.3g")} ${pretty(unit)}`.trim();
      const length = make("span", { class: by > 0 ? "camkit-more" : "camkit-less" });
      length.style.width = `${(50 * Math.abs(by)) / size}%`;
      return make("div", { class: "camkit-slope" }, make("span", {}, name), make("span", { class: "camkit-length" }, length),
        make("span", {}, `${by > 0 ? "\u25B2" : "\u25BC"} ${words}`));
    };
    const cannot = found.filter(({ by }) => Number.isNaN(by)).map(({ k }) => panel.structure.quantities[k].name);
    this.bars.replaceChildren(
      make("b", {}, shown.length ? TITLE : "No slider changes it here"), ...shown.map(bar),
      ...(cannot.length ? [make("p", {}, `Where a step cannot be built: ${cannot.join(", ")}`)] : []));
    this._place();
  }
}
