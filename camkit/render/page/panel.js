// A design under sliders: the page computes and draws it.  `engine.run(values)` gives the outputs of the program.
import { Chart, found } from "./picture.js";
import { Row, folded, make } from "./controls.js";
import { fill, format, pretty } from "./numbers.js";

const DEGREE = Math.PI / 180, REMEMBERED = 50, TURN = 6; // seconds for a whole turn
/** @type {Record<string, string>} */
const FILES = { json: "Design (JSON)", html: "Living page (HTML)", svg: "Picture (SVG)", pdf: "Picture (PDF)", csv: "Profile (CSV)", dxf: "Profile (DXF)" };

/**
 * @typedef {ArrayLike<number>[] & {structure?: any, sentence?: string}} Outputs
 * @typedef {{run(values: Float64Array): Outputs | Promise<Outputs>}} Engine
 * @typedef {{changed(values: number[], measures: (number | null)[]): void, choose(path: string, option: string): void,
 *   file(kind: string): void, open(text: string): void}} Host what stands behind the page, if anything does
 */

export class Panel {
  /** @param {HTMLElement} root @param {any} structure @param {Engine} engine @param {Host | null} [host] */
  constructor(root, structure, engine, host = null) {
    Object.assign(this, { root, structure, engine, host, outputs: null, ghost: null, sentence: "", playing: false, asked: 0, shownAt: 0 });
    this.inputs = [...structure.quantities.map((/** @type {any} */ q) => q.value), ...structure.positions.map((/** @type {any} */ p) => p.value)];
    this.values = Float64Array.from(this.inputs);
    /** @type {Float64Array[]} */ this.past = [];
    /** @type {Float64Array[]} */ this.future = [];
    this.settledValues = this.values.slice();
    this._build();
    this.themes = [matchMedia("(prefers-color-scheme: dark)"), new MutationObserver(() => this.ask(true))];
    this.themes[0].addEventListener("change", () => this.ask(true));
    this.themes[1].observe(document.body, { attributes: true, attributeFilter: ["data-jp-theme-light", "class"] });
    this.resized = new ResizeObserver(() => this.ask(true));
    this.resized.observe(this.middle); this.resized.observe(this.right);
    this.ask(true);
  }

  /** Leave the page. */
  end() {
    this.resized.disconnect(); this.themes[1].disconnect(); this.playing = false; this.ended = true;
    this.root.replaceChildren();
  }

  /** Show `values` in the next frame. @param {boolean} [settled] whether nothing is being dragged */
  ask(settled = false) {
    this.settling = this.settling || settled;
    if (!this.frame) this.frame = requestAnimationFrame(() => { this.frame = 0; void this._show(); });
  }

  /** What is shown, in user units: of each picture its window and marks; measures; the sentence of a refusal. */
  shown() {
    return { pictures: this.charts.map((chart) => chart.list), measures: this.numbers, sentence: this.sentence, values: [...this.values] };
  }

  /** Take other values, as undo does. @param {ArrayLike<number>} values */
  put(values) {
    this.values.set(values);
    this.rows.forEach((row, k) => row.show(this.values[k]));
    this.ask(true);
  }

  /** Take the design that somebody else chose: one step for Undo. @param {ArrayLike<number>} values of the quantities */
  load(values) {
    this.past = [...this.past, this.settledValues].slice(-REMEMBERED);
    this.future = [];
    this.put([...Array.from(values), ...this.values.slice(values.length)]);
    this.settledValues = this.values.slice();
    this.reported = Array.from(values);
  }

  /** A text with the numbers of what is shown. @param {any} text */
  words = (text) => (typeof text === "string" ? text : fill(text, this.outputs));

  get dark() {
    const light = document.body.dataset.jpThemeLight;
    return light ? light === "false" : this.themes[0].matches;
  }

  _build() {
    const { structure } = this;
    const count = structure.quantities.length;
    const row = (/** @type {any} */ declared, /** @type {number} */ k) =>
      new Row({ ...declared }, structure.units, (value, settled) => this._moved(k, value, settled));
    const rows = structure.quantities.map(row);
    const positions = structure.positions.map((/** @type {any} */ p, /** @type {number} */ k) =>
      row({ name: p.label, symbol: p.label, unit: "deg", factor: DEGREE, low: -180, high: 180, meaning: "", value: p.value }, count + k));
    this.rows = [...rows, ...positions];
    this.turn = structure.positions.findIndex((/** @type {any} */ p) => p.name === "turn");
    const button = (/** @type {string} */ words, /** @type {string} */ title, /** @type {() => void} */ act) => make("button", { type: "button", title, "aria-label": title, onclick: act }, words);
    this.undoing = button("\u21B6", "Undo", () => this._back(this.past, this.future));
    this.redoing = button("\u21B7", "Redo", () => this._back(this.future, this.past));
    this.pinning = button("Pin to compare", "Pin this design to compare others with it", () => this._pin());
    this.tables = button("Numbers", "Show the numbers in place of the curves", () => this._flip());
    this.bar = make("div", { class: "camkit-bar-top" }, make("b", {}, structure.name), this.undoing, this.redoing,
      button("Reset", "Back to the design that the page began with", () => { this._remember(); this.put(this.inputs); this._remember(); }), this.pinning, make("span", { class: "camkit-space" }), this.tables, ...this._files());
    this.note = make("div", { class: "camkit-note", role: "status", hidden: true });
    this.chips = make("div", { class: "camkit-chips", "aria-live": "polite" });
    this.find = make("input", { type: "search", placeholder: "find a quantity", "aria-label": "find a quantity", oninput: () => this._filter() });
    const choices = structure.choices.map((/** @type {any} */ choice) => this._menu(choice));
    this.groups = folded(rows.map((/** @type {Row} */ r, /** @type {number} */ k) => [structure.quantities[k].group, r]).filter((/** @type {any} */ _, /** @type {number} */ k) => structure.quantities[k].free));
    if (choices.length) this.groups.push(make("details", {}, make("summary", {}, `Choices (${choices.length})`), ...choices));
    this.left = make("div", { class: "camkit-left" }, ...(rows.length > 8 ? [this.find] : []), ...this.groups);
    this.charts = structure.pictures.map((/** @type {any} */ picture) => new Chart(make("canvas", { role: "img", tabindex: "0" }), picture, structure.look));
    this.over = make("div", { class: "camkit-over", role: "alert", hidden: true });
    this.tip = make("div", { class: "camkit-tip", hidden: true });
    this.middle = make("div", { class: "camkit-middle" }, ...(this.charts.length ? [this.charts[0].canvas] : []), this.over);
    this.curves = make("div", { class: "camkit-curves" }, ...this.charts.slice(1).map((/** @type {Chart} */ c) => make("div", { class: "camkit-curve" }, c.canvas)));
    this.table = make("div", { class: "camkit-numbers", hidden: true });
    this.right = make("div", { class: "camkit-right-side" }, this.curves, this.table);
    this.play = button("\u25B6", "Play", () => this._play());
    this.bottom = make("div", { class: "camkit-play" }, ...(this.turn < 0 ? [] : [this.play]), ...positions.map((/** @type {Row} */ r) => r.element));
    this.root.classList.add("camkit-page");
    this.root.replaceChildren(this.bar, this.note, this.chips, this.left, this.middle, this.right, this.bottom, this.tip);
    for (const chart of this.charts) this._pointer(chart);
    this.root.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this._key(event));
  }

  /** A menu; without a host what is chosen stays. @param {{path: string, name: string, options: string[], chosen: string}} choice */
  _menu({ path, name, options, chosen }) {
    if (!this.host) return make("div", { class: "camkit-choice" }, make("span", {}, name), make("b", {}, chosen));
    const offered = options.includes(chosen) ? options : [chosen, ...options];
    const menu = make("select", { "aria-label": name, onchange: () => this.host.choose(path, menu.value) }, ...offered.map((option) => make("option", { value: option, selected: option === chosen }, option)));
    return make("label", { class: "camkit-choice" }, make("span", {}, name), menu);
  }

  /** Buttons that save and open files, if there is a host to ask. */
  _files() {
    if (!this.host) return [];
    const file = make("input", { type: "file", accept: ".json", hidden: true, onchange: async () => { if (file.files[0]) this.host.open(await file.files[0].text()); file.value = ""; } });
    const save = make("select", { "aria-label": "Export", onchange: () => { if (save.value) this.host.file(save.value); save.value = ""; } },
      make("option", { value: "" }, "Export"), ...this.structure.files.map((/** @type {string} */ kind) => make("option", { value: kind }, FILES[kind])));
    return [make("button", { type: "button", title: "Open a saved design", onclick: () => file.click() }, "Open"), file, save];
  }

  /** Say something in a line of its own, or nothing. @param {string} sentence */
  say(sentence) { this.note.textContent = sentence; this.note.hidden = !sentence; }

  /** @param {number} k @param {number} value @param {boolean} settled */
  _moved(k, value, settled) {
    this.values[k] = value;
    this.last = k;
    if (settled) this._remember();
    this.ask(settled);
  }

  /** A step for Undo, and word for the host. */
  _remember() {
    const before = this.settledValues, count = this.structure.quantities.length;
    if (before.every((value, k) => k >= count || value === this.values[k])) return;
    this.past = [...this.past, before].slice(-REMEMBERED);
    this.future = [];
    this.settledValues = this.values.slice();
  }

  /** @param {Float64Array[]} from @param {Float64Array[]} to */
  _back(from, to) {
    const values = from.pop();
    if (!values) return;
    to.push(this.settledValues);
    const count = this.structure.quantities.length, turned = this.values.slice(count);
    this.settledValues = values;
    this.put([...values.slice(0, count), ...turned]);
  }

  _pin() {
    this.ghost = this.ghost ? null : this.outputs && { values: this.values.slice(), outputs: this.outputs };
    this.pinning.textContent = this.ghost ? "Unpin" : "Pin to compare";
    this.ask(true);
  }

  _flip() {
    this.table.hidden = !this.table.hidden;
    this.curves.hidden = !this.table.hidden;
    this.tables.textContent = this.table.hidden ? "Numbers" : "Curves";
    this.ask(true);
  }

  _filter() {
    const wanted = this.find.value.trim().toLowerCase();
    this.structure.quantities.forEach((/** @type {any} */ q, /** @type {number} */ k) => { this.rows[k].element.hidden = !`${q.name} ${q.symbol}`.toLowerCase().includes(wanted); });
    for (const group of this.groups) {
      if (wanted) group.open = true;
      group.hidden = Boolean(wanted) && ![...group.children].slice(1).some((row) => !row.hidden);
    }
  }

  /** @param {KeyboardEvent} event */
  _key(event) {
    if (!(event.ctrlKey || event.metaKey) || !["z", "y"].includes(event.key.toLowerCase())) return;
    event.preventDefault(); event.stopPropagation();
    if (event.key.toLowerCase() === "y" || event.shiftKey) this._back(this.future, this.past); else this._back(this.past, this.future);
  }

  async _show() {
    const number = ++this.asked, settled = this.settling, ran = this.engine.run(this.values);
    this.settling = false;
    const outputs = ran instanceof Promise ? await ran : ran;
    if (number < this.shownAt || this.ended) return; // a newer one is there
    this.shownAt = number;
    if (outputs.structure) this._adopt(outputs.structure);
    this._draw(outputs, settled);
    this._report();
  }

  /** Pictures, positions and measures that somebody else has made. @param {any} structure */
  _adopt(structure) {
    Object.assign(this.structure, structure);
    this.charts.forEach((chart, k) => { chart.picture = structure.pictures[k]; });
  }

  /** Pictures that do not compute, made anew. @param {Record<string, any>} pictures @param {ArrayLike<number>[]} arrays */
  redraw(pictures, arrays) {
    for (const [k, picture] of Object.entries(pictures)) Object.assign(this.charts[Number(k)], { picture, own: arrays });
    this.ask(true);
  }

  /** The host hears of other values, with the measures that the page has computed for them. */
  _report() {
    const values = [...this.values].slice(0, this.structure.quantities.length);
    if (!this.host || (this.reported && values.every((value, k) => value === this.reported[k]))) return;
    const first = !this.reported;
    this.reported = values;
    if (!first) this.host.changed(values, this.sentence ? [] : this.numbers.map((/** @type {any} */ m) => (Number.isFinite(m.value) ? m.value : null)));
  }

  /** @param {ArrayLike<number>[]} outputs @param {boolean} settled */
  _draw(outputs, settled) {
    const found = this.structure.refusals.find((/** @type {any} */ r) => outputs.length && outputs[r.at][0] !== 1);
    const refused = found ? fill(found.words, outputs) : outputs.sentence ?? "";
    this._refuse(refused);
    if (!refused) this.outputs = outputs;
    if (!this.outputs) return;
    if (this.turn >= 0 && !refused) this._fitTurn(outputs);
    const words = this.words, dark = this.dark;
    this.root.classList.toggle("camkit-dark", dark);
    for (const chart of this.charts) {
      chart.compact = chart.canvas.clientHeight < 190;
      chart.draw(chart.own ?? this.outputs, { dark, settled: settled && !this.playing, words, ghost: this.ghost?.outputs, cursor: this._cursorOf(chart) });
    }
    if (!refused) this._tell(outputs);
    this.root.dispatchEvent(new CustomEvent("camkit-shown"));
  }

  /** Where the mechanism stands, on a curve over the angle that turns it. @param {Chart} chart */
  _cursorOf(chart) {
    if (this.turn < 0 || !this._overTurn(chart)) return undefined;
    return this.values[this.structure.quantities.length + this.turn] / DEGREE;
  }

  /** @param {Chart} chart */
  _overTurn(chart) {
    return this.turn >= 0 && chart.picture.axes.xlabel.startsWith(this.structure.positions[this.turn].label) && chart.picture.axes.xlabel.endsWith("[deg]");
  }

  /** The slider that turns the mechanism goes over its range. @param {ArrayLike<number>[]} outputs */
  _fitTurn(outputs) {
    const position = this.structure.positions[this.turn], row = this.rows[this.structure.quantities.length + this.turn];
    const [low, high] = [position.low, position.high].map((end) => { const v = found(end, outputs); return typeof v === "number" ? v : v[0]; });
    if (Number.isFinite(low) && Number.isFinite(high) && low < high) { row.between(low, high); this.range = [low, high]; }
  }

  /** The sentence over the last good picture. @param {string} sentence */
  _refuse(sentence) {
    if (sentence === this.sentence) return;
    this.sentence = sentence;
    this.over.textContent = sentence && `This cannot be built: ${sentence}.`;
    this.over.hidden = !sentence;
    this.root.classList.toggle("camkit-refused", Boolean(sentence));
    this.rows.forEach((row, k) => row.element.classList.toggle("camkit-guilty", Boolean(sentence) && k === this.last));
  }

  /** Measures as numbers, limits as chips, worst first. @param {ArrayLike<number>[]} outputs */
  _tell(outputs) {
    const first = this.first ??= outputs;
    const value = (/** @type {any} */ m, /** @type {any} */ of) => { const v = found(m.value, of); return typeof v === "number" ? v : v[0]; };
    const told = (/** @type {any} */ m, /** @type {number} */ v) => `${format(v / m.factor, "measure")} ${pretty(m.unit)}`.trim();
    this.numbers = this.structure.measures.map((/** @type {any} */ m) => ({ name: m.name, value: value(m, outputs), text: told(m, value(m, outputs)) }));
    const rows = this.structure.measures.map((/** @type {any} */ m) => {
      const [now, then] = [value(m, outputs), value(m, this.ghost?.outputs ?? first)], change = then && Number.isFinite(now - then) ? (100 * (now - then)) / Math.abs(then) : NaN;
      const kept = m.limit === undefined || m.sense * (now - m.limit) <= 1e-9 * Math.max(1, Math.abs(m.limit));
      return { m, now, change, kept, miss: m.limit === undefined ? -Infinity : (m.sense * (now - m.limit)) / (Math.abs(m.limit) || 1) };
    });
    const limited = rows.filter((/** @type {any} */ r) => r.m.limit !== undefined).sort((/** @type {any} */ a, /** @type {any} */ b) => b.miss - a.miss);
    const others = rows.filter((/** @type {any} */ r) => r.m.limit === undefined && Number.isFinite(r.now)).slice(0, Math.max(0, 5 - limited.length));
    const trouble = this.words(this.structure.trouble);
    this.chips.replaceChildren(
      ...(trouble ? [make("span", { class: "camkit-chip camkit-bad", title: trouble }, trouble)] : []),
      ...limited.map(({ m, now, kept }) => make("span", { class: `camkit-chip ${kept ? "camkit-ok" : "camkit-bad"}` }, `${m.name} ${told(m, now)} `, make("small", {}, `${m.sense > 0 ? "\u2264" : "\u2265"} ${told(m, m.limit)}`))),
      ...others.map(({ m, now }) => make("span", { class: "camkit-chip" }, `${m.name} `, make("b", {}, told(m, now)))));
    if (this.table.hidden) return;
    const head = make("tr", {}, ...["measure", "now", this.ghost ? "pinned" : "start", "change"].map((words) => make("th", {}, words)));
    this.table.replaceChildren(make("table", {}, head, ...rows.filter((/** @type {any} */ r) => Number.isFinite(r.now)).map(({ m, now, change, kept }) =>
      make("tr", { class: kept ? "" : "camkit-bad" }, make("td", {}, m.name), make("td", {}, told(m, now)), make("td", {}, told(m, value(m, this.ghost?.outputs ?? first))), make("td", {}, Number.isFinite(change) ? `${format(change, "+.1f")} %` : "")))));
  }

  _play() {
    this.playing = !this.playing;
    this.play.textContent = this.playing ? "\u275A\u275A" : "\u25B6";
    this.play.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    let before = performance.now();
    const step = (/** @type {number} */ now) => {
      if (!this.playing || this.ended) return;
      const k = this.structure.quantities.length + this.turn, [low, high] = this.range ?? [0, 2 * Math.PI];
      const next = this.values[k] + (Math.min(now - before, 100) / 1000 / TURN) * (high - low);
      before = now;
      this.values[k] = next > high ? low + ((next - low) % (high - low)) : next;
      this.rows[k].show(this.values[k]);
      this.ask();
      requestAnimationFrame(step);
    };
    if (this.playing) requestAnimationFrame(step); else this.ask(true);
  }

  /** Hover for values, drag the cursor, orbit, zoom and pan. @param {Chart} chart */
  _pointer(chart) {
    const { canvas } = chart, seen = (/** @type {string} */ name) => this.structure.positions.findIndex((/** @type {any} */ p) => p.name === name);
    const orbits = chart.picture.axes.bare && seen("azimuth") >= 0;
    const at = (/** @type {PointerEvent | WheelEvent | MouseEvent} */ event) => { const r = canvas.getBoundingClientRect(); return [event.clientX - r.left, event.clientY - r.top]; };
    /** @type {number[] | null} */ let held = null;
    canvas.style.touchAction = "none";
    const set = (/** @type {number} */ k, /** @type {number} */ value, /** @type {boolean} */ wraps) => {
      const row = this.rows[this.structure.quantities.length + k], [low, high] = [row.declared.low * DEGREE, row.declared.high * DEGREE];
      const kept = wraps ? value : Math.min(Math.max(value, low), high);
      row.show(kept); this._moved(this.structure.quantities.length + k, kept, false);
    };
    canvas.addEventListener("pointerdown", (event) => { held = at(event); canvas.setPointerCapture(event.pointerId); if (this._overTurn(chart)) set(this.turn, chart.x.back(held[0]) * DEGREE, false); });
    canvas.addEventListener("pointerup", () => { held = null; this.ask(true); });
    canvas.addEventListener("pointerleave", () => { this.tip.hidden = true; });
    canvas.addEventListener("pointermove", (event) => {
      const [px, py] = at(event);
      if (!held) { this._hover(chart, px, py, event); return; }
      const [dx, dy] = [px - held[0], py - held[1]];
      held = [px, py];
      if (this._overTurn(chart)) set(this.turn, chart.x.back(px) * DEGREE, false);
      else if (orbits) {
        const count = this.structure.quantities.length, turned = (/** @type {number} */ v) => ((v / DEGREE + 540) % 360) * DEGREE - Math.PI;
        set(seen("azimuth"), turned(this.values[count + seen("azimuth")] - dx * 0.01), true);
        set(seen("elevation"), this.values[count + seen("elevation")] + dy * 0.01, false);
      } else { chart.pan(dx, dy); this.ask(); }
    });
    canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== canvas) return; // the page scrolls
      event.preventDefault();
      chart.zoom(Math.exp(event.deltaY * 0.0015), ...at(event)); this.ask();
    }, { passive: false });
    canvas.addEventListener("dblclick", () => { chart.fit(); this.ask(true); });
  }

  /** The values of the curves under the pointer. @param {Chart} chart @param {number} px @param {number} py @param {PointerEvent} event */
  _hover(chart, px, py, event) {
    const curve = !chart.picture.axes.equal && !chart.picture.axes.bare;
    if (!this.outputs || !chart.inside(px, py)) { this.tip.hidden = true; return; }
    const x = chart.x.back(px), y = chart.y.back(py), round = (/** @type {number} */ v) => format(v, ".4g");
    const rows = curve ? chart.valuesAt(x).map(({ mark, value }) => `${chart.how.words(mark.label) || chart.picture.axes.title} ${round(value)}`) : [];
    this.tip.textContent = curve ? [`at ${round(x)}`, ...rows].join("\n") : chart.picture.axes.bare ? "" : `x ${round(x)}, y ${round(y)}`;
    this.tip.hidden = !this.tip.textContent;
    const box = this.root.getBoundingClientRect();
    this.tip.style.left = `${Math.min(event.clientX - box.left + 14, box.width - 150)}px`;
    this.tip.style.top = `${event.clientY - box.top + 14}px`;
  }
}

/** The function that a program is, from what gzip packed. @param {Uint8Array} bytes @returns {Promise<(values: Float64Array) => Float64Array[]>} */
export async function programOf(bytes) {
  const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  return machine(...JSON.parse(text)); // what runs any program stands before the modules
}
