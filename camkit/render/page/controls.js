// The controls of a page: a row for each quantity, with a slider to drag and a box to type in; native elements all.
import { format, letters, parse, pretty } from "./numbers.js";

/** An element with attributes and children; every text is a text node.
 * @param {string} tag @param {Record<string, any>} [attributes] @param {...(Node | string)} children @returns {any} */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  if (["button", "canvas", "input", "select", "summary"].includes(tag)) element.setAttribute("data-lm-suppress-shortcuts", "true");
  element.append(...children);
  return element;
}

/** A step of a slider: round, some hundreds of them from end to end. @param {number} low @param {number} high */
export function stepOf(low, high) {
  const power = 10 ** Math.floor(Math.log10((high - low) / 200));
  return power * ([1, 2, 5].find((k) => (high - low) / (k * power) <= 500) ?? 10);
}

/** One number: name, symbol, slider, box, unit.  `value` is in SI; `moved(value, settled)` is called for what a person does. */
export class Row {
  /** @param {{name: string, symbol: string, unit: string, factor: number, low: number, high: number, meaning: string, value: number, group?: string, written?: string}} declared
   * @param {any} units @param {(value: number, settled: boolean) => void} moved */
  constructor(declared, units, moved) {
    Object.assign(this, { declared, units, moved, value: declared.value });
    const { name, symbol, unit, low, high, meaning, group } = declared, said = unit ? `${name}, ${unit}` : name;
    const inGroup = group && name.startsWith(`${group} `) ? name.slice(group.length + 1) : name;
    this.slider = make("input", { type: "range", min: low, max: high, step: stepOf(low, high), "aria-label": said });
    this.box = make("input", { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", "aria-label": `${said}, number` });
    this.refusal = make("div", { class: "camkit-refusal", role: "alert" });
    const label = make("label", { title: meaning && meaning !== name ? `${name}: ${meaning}` : name }, inGroup, " ", symbol === name ? "" : make("i", {}, letters(symbol)));
    this.element = make("div", { class: "camkit-row" }, label,
      make("span", { class: "camkit-box" }, this.box, make("span", { class: "camkit-unit" }, pretty(unit))), this.slider, this.refusal);
    this.slider.addEventListener("input", () => this._take(Number(this.slider.value) * declared.factor, false));
    this.slider.addEventListener("change", () => moved(this.value, true));
    this.box.addEventListener("change", () => this._typed());
    this.box.addEventListener("keydown", (event) => { if (event.key === "Escape") this.show(this.value); else if (event.key === "Enter") this._typed(); }); // JupyterLab takes what Enter does to a field
    this.show(declared.value);
  }

  /** Stand at a value. @param {number} value */
  show(value) {
    this.value = value;
    const read = value / this.declared.factor;
    this.slider.value = String(read);
    this.written = this.box.value = format(read, this.declared.written ?? ".6g");
    this.slider.setAttribute("aria-valuetext", `${this.box.value} ${pretty(this.declared.unit)}`.trim());
    this.box.style.width = `${Math.max(this.box.value.length, 2) + 0.6}ch`;
    this.refuse("");
  }

  /** Other ends of the slider, in SI. @param {number} low @param {number} high */
  between(low, high) {
    const [a, b] = [low / this.declared.factor, high / this.declared.factor];
    Object.assign(this.declared, { low: a, high: b });
    this.slider.min = String(a); this.slider.max = String(b); this.slider.step = String(stepOf(a, b));
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
    const read = parse(this.box.value, this.declared.unit, this.units);
    const value = read.value * this.declared.factor;
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
