// The controls of a page: a row for each quantity, with a slider to drag and a box to type in; native elements all.
import { spansInWords } from "./spans.js";
import { format, indexed, parse, pretty } from "./numbers.js";

/** An element with attributes and children; every text is a text node.
 * @param {string} tag @param {Record<string, any>} [attributes] @param {...(Node | string)} children @returns {any} */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  if (["button", "canvas", "input", "select", "summary"].includes(tag) || "tabindex" in attributes) element.setAttribute("data-lm-suppress-shortcuts", "true");
  element.append(...children);
  return element;
}

/** A text in which symbols stand, their indices lowered. @param {string} text @returns {(Node | string)[]} */
export const lettered = (text) => indexed(text).map((piece, k) => (k % 2 ? make("sub", {}, piece) : piece));

/** A step of a slider: round, some hundreds of them from end to end. @param {number} low @param {number} high */
export function stepOf(low, high) {
  const power = 10 ** Math.floor(Math.log10((high - low) / 200));
  return power * ([1, 2, 5].find((k) => (high - low) / (k * power) <= 500) ?? 10);
}

/** One number: name, symbol, slider, box, unit.  `value` is in SI; `moved(value, settled)` is called for what a person does. */
export class Row {
  /** @param {{name: string, symbol: string, unit: string, factor: number, low: number, high: number, meaning: string,
   *   value: number, group?: string, written?: string}} declared
   * @param {{known: any, of(unit: string): import("./units.js").Shown}} units
   * @param {(value: number, settled: boolean) => void} moved */
  constructor(declared, units, moved) {
    Object.assign(this, { declared, units, moved, value: declared.value });
    const { name, symbol, factor, low, high, meaning, group } = declared;
    const inGroup = group && name.startsWith(`${group} `) ? name.slice(group.length + 1) : name;
    this.slider = make("input", { type: "range" });
    this.box = make("input", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false" });
    this.after = make("span", { class: "camkit-unit" });
    this.track = make("div", { class: "camkit-track" });
    /** @type {import("./spans.js").Span[]} */ this.spans = [];
    this.refusal = make("div", { class: "camkit-refusal", role: "alert" });
    const title = meaning && meaning !== name ? `${name}: ${meaning}` : name;
    const label = make("label", { title }, inGroup, " ", symbol === name ? "" : make("i", {}, ...lettered(symbol)));
    this.element = make("div", { class: "camkit-row" }, label,
      make("span", { class: "camkit-box" }, this.box, this.after), this.slider, this.track, this.refusal);
    this.slider.addEventListener("input", () => this._take(Number(this.slider.value) * this.factor, false));
    this.slider.addEventListener("change", () => moved(this.value, true));
    this.box.addEventListener("input", () => this._fit());
    this.box.addEventListener("change", () => this._typed());
    this.box.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.show(this.value);
      else if (event.key === "Enter") this._typed(); // JupyterLab takes what Enter does to a field
    });
    this.between(low * factor, high * factor);
  }

  /** Numbers in the units that are shown. */
  measure() {
    const { name, unit } = this.declared, shown = this.units.of(unit), said = shown.unit ? `${name}, ${shown.unit}` : name;
    Object.assign(this, { unit: shown.unit, factor: this.declared.factor / shown.ratio });
    const [low, high] = [this.low, this.high].map((end) => Number(format(end / this.factor, ".12g"))), step = stepOf(low, high);
    const round = shown.ratio !== 1; // then the ends are not; steps go from one to the other
    this.slider.min = String(round ? +(Math.ceil(low / step - 1e-9) * step).toPrecision(12) : low);
    this.slider.max = String(high);
    this.slider.step = String(step);
    this.slider.setAttribute("aria-label", said);
    this.box.setAttribute("aria-label", `${said}, number`);
    this.after.textContent = pretty(shown.unit);
    this.show(this.value);
    this._sayTrack();
  }

  /** Paint on the track what can be built, or nothing. @param {import("./spans.js").Span[]} spans
   * @param {boolean} limited whether there are limits */
  paint(spans, limited) {
    Object.assign(this, { spans, limited });
    const share = (/** @type {number} */ value) => (100 * (value - this.low)) / (this.high - this.low);
    this.track.classList.remove("camkit-old");
    this.track.replaceChildren(...spans.map(({ low, high, kind }) => {
      const part = make("span", { class: ["camkit-cannot", "camkit-missed", "camkit-kept"][kind] });
      Object.assign(part.style, { left: `${share(low)}%`, width: `${share(high) - share(low)}%` });
      return part;
    }));
    this._sayTrack();
  }

  /** What is painted, for those who do not see it. */
  _sayTrack() {
    const text = (/** @type {number} */ value) => `${format(value / this.factor, ".3g")} ${pretty(this.unit)}`.trim();
    this.slider.title = this.spans.length ? spansInWords(this.spans, text, this.limited) : "";
  }

  /** Stand at a value. @param {number} value */
  show(value) {
    this.value = value;
    const read = value / this.factor;
    this.slider.value = String(read);
    this.written = this.box.value = this.box.defaultValue = format(read, this.declared.written ?? ".6g");
    this.slider.setAttribute("aria-valuetext", `${this.box.value} ${pretty(this.unit)}`.trim());
    this._fit();
    this.refuse("");
  }

  /** The box is as wide as what is in it. */
  _fit() { this.box.style.width = `${Math.min(Math.max(this.box.value.length, 2), 14) + (/[A-Za-z%]/.test(this.box.value) ? 2 : 0.6)}ch`; }

  /** Other ends of the slider, in SI. @param {number} low @param {number} high */
  between(low, high) {
    if (low === this.low && high === this.high) return;
    Object.assign(this, { low, high });
    this.measure();
  }

  /** Say why a text was not taken, or nothing. @param {string} sentence */
  refuse(sentence) {
    this.refusal.textContent = sentence;
    this.box.setAttribute("aria-invalid", String(Boolean(sentence)));
  }

  /** @param {number} value @param {boolean} settled */
  _take(value, settled) { this.show(value); this.moved(value, settled); }

  /** Take what is in the box, unless it is what was written there: that may have fewer digits than the value. */
  _typed() {
    if (this.box.value === this.written) { this.refuse(""); return; }
    const read = parse(this.box.value, this.unit, this.units.known);
    const value = read.value * this.factor;
    if (read.error) this.refuse(read.error);
    else if (!Number.isFinite(value)) this.refuse(`'${this.box.value}' is too large for a computer`);
    else this._take(value, true);
  }
}

/** Rows in groups that fold, the first ones open. @param {[string, Row][]} rows a group's name and a row each */
export function folded(rows) {
  /** @type {Map<string, Row[]>} */
  const groups = new Map();
  for (const [group, row] of rows) groups.set(group, [...(groups.get(group) ?? []), row]);
  let seen = 0;
  return [...groups].map(([name, members]) => {
    const open = seen < 7;
    seen += members.length;
    const title = (name || "size").replace(/^./, (c) => c.toUpperCase());
    return make("details", { open }, make("summary", {}, `${title} (${members.length})`), ...members.map((row) => row.element));
  });
}
