// A design under sliders: the page computes and draws it.  `engine.run(values)` gives the outputs of the program.
import { Chart, found } from "./picture.js";
import { Row, folded, make } from "./controls.js";
import { fill, format, letters, pretty } from "./numbers.js";

const DEGREE = Math.PI / 180, REMEMBERED = 50, TURN = 6; // seconds for a whole turn
const NARROW = 60; // letters: below it everything stands in one column
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
    this.leaving = new AbortController();
    this._build();
    this.system = matchMedia("(prefers-color-scheme: dark)");
    this.system.addEventListener("change", () => this.ask(true), { signal: this.leaving.signal });
    this.theme = new MutationObserver(() => this.ask(true));
    this.theme.observe(document.body, { attributes: true, attributeFilter: ["data-jp-theme-light", "class"] });
    this.resized = new ResizeObserver(() => { root.classList.toggle("camkit-narrow", root.clientWidth < NARROW * this.letter); this.ask(true); });
    for (const part of [root, this.middle, this.right]) this.resized.observe(part);
    this.ask(true);
  }

  /** Leave the page. */
  end() {
    this.leaving.abort(); this.resized.disconnect(); this.theme.disconnect(); this.playing = false; this.ended = true;
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

  /** The size of letters, pixels. */
  get letter() { return parseFloat(getComputedStyle(this.root).fontSize); }

  get dark() {
    const light = document.body.dataset.jpThemeLight;
    return light ? light === "false" : this.system.matches;
  }

  _build() {
    const { structure } = this;
    const count = structure.quantities.length;
    const row = (/** @type {any} */ declared, /** @type {number} */ k) =>
      new Row({ ...declared }, structure.units, (value, settled) => this._moved(k, value, settled));
    const rows = structure.quantities.map(row);
    const positions = structure.positions.map((/** @type {any} */ p, /** @type {number} */ k) =>
      row({ name: p.label, symbol: p.label, unit: "deg", factor: DEGREE, low: -180, high: 180, meaning: "", value: p.value, written: ".4g" }, count + k));
    this.rows = [...rows, ...positions];
    this.turn = structure.positions.findIndex((/** @type {any} */ p) => p.name === "turn");
    const button = (/** @type {string} */ words, /** @type {string} */ title, /** @type {() => void} */ act) => make("button", { type: "button", title, "aria-label": /\w/.test(words) ? undefined : title, onclick: act }, words);
    this.undoing = button("\u21B6", "Undo", () => this._back(this.past, this.future));
    this.redoing = button("\u21B7", "Redo", () => this._back(this.future, this.past));
    this.pinning = button("Pin to compare", "Pin this design to compare others with it", () => this._pin());
    this.tables = button("Numbers", "Show the numbers in place of the curves", () => this._flip());
    this.bar = make("div", { class: "camkit-bar-top" }, make("b", { role: "heading", "aria-level": "1" }, structure.name), this.undoing, this.redoing,
      button("Reset", "Back to the design that the page began with", () => { this._remember(); this.put(this.inputs); this._remember(); }), this.pinning, make("span", { class: "camkit-space" }), this.tables, ...this._files(),
      ...(document.fullscreenEnabled ? [button("Full screen", "As large as the screen, and back", () => void (document.fullscreenElement ? document.exitFullscreen() : this.root.requestFullscreen()))] : []));
    this.note = make("div", { class: "camkit-note", role: "status", hidden: true });
    this.trouble = make("div", { class: "camkit-trouble camkit-chip camkit-bad", hidden: true });
    this.chips = make("div", { class: "camkit-chips", role: "group", "aria-label": "limits and measures", tabindex: "0" });
    this.said = make("div", { class: "camkit-said", role: "status" });
    this.find = make("input", { type: "search", placeholder: "find a quantity", "aria-label": "find a quantity", oninput: () => this._filter() });
    this.choices = structure.choices.map((/** @type {any} */ choice) => this._menu(choice));
    this.groups = folded(rows.map((/** @type {Row} */ r, /** @type {number} */ k) => [structure.quantities[k].group, r]).filter((/** @type {any} */ _, /** @type {number} */ k) => structure.quantities[k].free));
    if (this.choices.length) this.groups.push(make("details", {}, make("summary", {}, `Choices (${this.choices.length})`), ...this.choices));
    this.nothing = make("p", { class: "camkit-nothing", hidden: true }, "no quantity has this name");
    this.left = make("div", { class: "camkit-left", role: "group", "aria-label": "quantities" }, ...(rows.length > 8 ? [this.find, this.nothing] : []), ...this.groups);
    this.charts = structure.pictures.map((/** @type {any} */ picture) => new Chart(make("canvas", { role: "img", tabindex: "0", "aria-description": "Arrow keys move it, + and - bring it nearer, 0 shows all of it" }), picture, structure.look));
    this.over = make("div", { class: "camkit-over", role: "alert", hidden: true });
    this.tip = make("div", { class: "camkit-tip", hidden: true });
    this.middle = make("div", { class: "camkit-middle" }, ...(this.charts.length ? [this.charts[0].canvas] : []), this.over);
    this.curves = make("div", { class: "camkit-curves" }, ...this.charts.slice(1).map((/** @type {Chart} */ c) => make("div", { class: "camkit-curve" }, c.canvas)));
    this.table = make("div", { class: "camkit-numbers", hidden: true });
    this.right = make("div", { class: "camkit-right-side" }, this.curves, this.table);
    this.play = button("\u25B6", "Play", () => this._play());
    this.bottom = make("div", { class: "camkit-play", hidden: !positions.length }, ...(this.turn < 0 ? [] : [this.play]), ...positions.map((/** @type {Row} */ r) => r.element));
    this.root.classList.add("camkit-page");
    this.root.replaceChildren(this.bar, this.note, this.trouble, this.chips, this.left, this.middle, this.right, this.bottom, this.tip, this.said);
    for (const chart of this.charts) { this._pointer(chart); chart.canvas.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this._arrow(chart, event)); }
    this.root.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this._key(event), { signal: this.leaving.signal });
  }

  /** A menu; without a host what is chosen stays. @param {{path: string, name: string, options: string[], chosen: string}} choice */
  _menu({ path, name, options, chosen }) {
    if (!this.host) return make("div", { class: "camkit-choice" }, make("span", {}, name), make("b", {}, chosen));
    const offered = options.includes(chosen) ? options : [chosen, ...options];
    const menu = make("select", { "aria-label": name, onchange: () => { this.host.choose(path, menu.value); menu.value = chosen; } }, ...offered.map((option) => make("option", { value: option, selected: option === chosen }, option)));
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

  /** The pinned design stands where the other one does, if the page computes it. */
  _turnGhost() {
    const { ghost } = this, count = this.structure.quantities.length;
    if (ghost.values.every((/** @type {number} */ value, /** @type {number} */ k) => k < count || value === this.values[k])) return;
    ghost.values.set(this.values.subarray(count), count);
    ghost.outputs = this.engine.run(ghost.values);
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
    for (const choice of this.choices) choice.hidden = !choice.firstChild.textContent.toLowerCase().includes(wanted);
    for (const group of this.groups) {
      if (wanted) group.open = true;
      group.hidden = Boolean(wanted) && ![...group.children].slice(1).some((row) => !row.hidden);
    }
    this.nothing.hidden = this.groups.some((/** @type {HTMLElement} */ group) => !group.hidden);
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
    if (this.ghost && outputs === ran) this._turnGhost();
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
    this.undoing.setAttribute("aria-disabled", String(!this.past.length)); this.redoing.setAttribute("aria-disabled", String(!this.future.length));
    if (!refused) this.outputs = outputs;
    if (!this.outputs) return;
    if (this.turn >= 0 && !refused) this._fitTurn(outputs);
    const words = this.words, dark = this.dark, em = this.letter / 13;
    this.root.classList.toggle("camkit-dark", dark);
    for (const chart of this.charts) {
      Object.assign(chart, { compact: chart.canvas.clientHeight < 190 * em, em });
      chart.draw(chart.own ?? this.outputs, { dark, settled: settled && !this.playing, words, ghost: this.ghost?.outputs, cursor: this._cursorOf(chart) });
      if (settled && chart.list) this._describe(chart);
    }
    if (!refused) this._tell(outputs, settled);
    this.root.dispatchEvent(new CustomEvent("camkit-shown"));
  }

  /** The text in place of a picture; a curve over the turn is a slider, whose value are those of the curves. @param {Chart} chart */
  _describe(chart) {
    const { canvas, how: { cursor } } = chart, told = chart.describe();
    const of = cursor === undefined ? { role: "img", "aria-label": told } : {
      role: "slider", "aria-label": chart.heading.title, "aria-valuetext": `at ${format(cursor, ".4g")}; ${told}`,
      "aria-valuenow": format(cursor, ".4g"), "aria-valuemin": format(chart.ends.x.low, ".4g"), "aria-valuemax": format(chart.ends.x.high, ".4g"),
    };
    for (const [name, value] of Object.entries(of)) canvas.setAttribute(name, value);
  }

  /** Where the mechanism stands, on a curve over the angle that turns it. @param {Chart} chart */
  _cursorOf(chart) {
    if (this.turn < 0 || !this._overTurn(chart)) return undefined;
    return this.values[this.structure.quantities.length + this.turn] / DEGREE;
  }

  /** @param {Chart} chart */
  _overTurn(chart) {
    const along = this.words(chart.picture.axes.xlabel);
    return this.turn >= 0 && along.startsWith(this.structure.positions[this.turn].label) && along.endsWith("[deg]");
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

  /** Measures as numbers, limits as chips, worst first. @param {ArrayLike<number>[]} outputs @param {boolean} settled */
  _tell(outputs, settled) {
    const first = this.first ??= outputs;
    const value = (/** @type {any} */ m, /** @type {any} */ of) => { const v = found(m.value, of); return typeof v === "number" ? v : v[0]; };
    const told = (/** @type {any} */ m, /** @type {number} */ v) => `${format(v / m.factor, "measure")} ${pretty(m.unit)}`.trim();
    const shown = (/** @type {any} */ m, /** @type {number} */ v) => (Number.isNaN(v) ? "cannot be computed" : told(m, v));
    this.numbers = this.structure.measures.map((/** @type {any} */ m) => ({ name: m.name, value: value(m, outputs), text: told(m, value(m, outputs)) }));
    const rows = this.structure.measures.map((/** @type {any} */ m) => {
      const [now, then] = [value(m, outputs), value(m, this.ghost?.outputs ?? first)], change = then && Number.isFinite(now - then) ? (100 * (now - then)) / Math.abs(then) : NaN;
      const miss = (m.sense * (now - m.limit)) / (Math.abs(m.limit) || 1), kept = m.limit === undefined || miss <= this.structure.kept;
      return { m, now, change, kept, miss: Number.isNaN(miss) ? 1e300 : miss };
    });
    const limited = rows.filter((/** @type {any} */ r) => r.m.limit !== undefined).sort((/** @type {any} */ a, /** @type {any} */ b) => b.miss - a.miss);
    const others = rows.filter((/** @type {any} */ r) => r.m.limit === undefined && Number.isFinite(r.now)).slice(0, Math.max(0, 5 - limited.length));
    const trouble = this.words(this.structure.trouble);
    const missed = limited.filter((/** @type {any} */ r) => !r.kept).map((/** @type {any} */ r) => r.m.name);
    const verdict = [trouble, missed.length ? `limit not kept: ${missed.join(", ")}` : limited.length ? "every limit is kept" : ""].filter(Boolean).join("; ");
    if (settled && this.said.textContent !== verdict) this.said.textContent = verdict;
    const chips = [
      ...limited.map((/** @type {any} */ { m, now, kept }) => [kept ? "camkit-ok" : "camkit-bad", `${letters(m.name)} ${shown(m, now)} `, "small", `${m.sense > 0 ? "\u2264" : "\u2265"} ${told(m, m.limit)}`]),
      ...others.map((/** @type {any} */ { m, now }) => ["", `${letters(m.name)} `, "b", told(m, now)])];
    if (this.chipped !== (this.chipped = JSON.stringify([trouble, chips]))) { // else the page would be laid out anew in every frame
      this.trouble.textContent = trouble; this.trouble.hidden = !trouble;
      this.chips.replaceChildren(...chips.map(([kind, words, tag, more]) => make("span", { class: `camkit-chip ${kind}` }, words, make(tag, {}, more))));
    }
    if (this.table.hidden) return;
    const head = make("tr", {}, ...["measure", "now", this.ghost ? "pinned" : "start", "change"].map((words) => make("th", { scope: "col" }, words)));
    this.table.replaceChildren(make("table", {}, head, ...rows.filter((/** @type {any} */ r) => Number.isFinite(r.now)).map(({ m, now, change, kept }) =>
      make("tr", { class: kept ? "" : "camkit-bad" }, make("td", {}, letters(m.name)), make("td", {}, told(m, now)), make("td", {}, told(m, value(m, this.ghost?.outputs ?? first))), make("td", {}, Number.isFinite(change) ? `${format(change, "+.1f")} %` : "")))));
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

  /** Whether a picture is seen from a place in space. @param {Chart} chart */
  _orbits(chart) { return chart.picture.axes.bare && this.structure.positions.some((/** @type {any} */ p) => p.name === "azimuth"); }

  /** Stand at a value of a position, within its range. @param {number} k @param {number} value */
  _stand(k, value) {
    const row = this.rows[this.structure.quantities.length + k], { low, high } = row.declared;
    row.show(Math.min(Math.max(value, low * DEGREE), high * DEGREE));
    this._moved(this.structure.quantities.length + k, row.value, false);
  }

  /** See it from elsewhere. @param {number} across @param {number} up radians */
  _orbit(across, up) {
    const seen = (/** @type {string} */ name) => this.structure.positions.findIndex((/** @type {any} */ p) => p.name === name);
    const [azimuth, elevation] = ["azimuth", "elevation"].map((name) => this.values[this.structure.quantities.length + seen(name)]);
    this._stand(seen("azimuth"), (((azimuth + across) / DEGREE + 540) % 360) * DEGREE - Math.PI);
    this._stand(seen("elevation"), elevation + up);
  }

  /** Arrow keys on a picture turn what is seen, or move it; + and - bring it nearer, 0 shows all of it.
   * @param {Chart} chart @param {KeyboardEvent} event */
  _arrow(chart, event) {
    const across = { ArrowLeft: -1, ArrowRight: 1 }[event.key] ?? 0, up = { ArrowDown: -1, ArrowUp: 1 }[event.key] ?? 0;
    const nearer = { "+": 0.8, "=": 0.8, "-": 1.25 }[event.key], [low, high] = this.range ?? [0, 0];
    if (event.ctrlKey || event.metaKey || event.altKey || !chart.box || !(across || up || nearer || event.key === "0")) return;
    event.preventDefault();
    const { left, right, top, bottom } = chart.box;
    if (nearer) chart.zoom(nearer, (left + right) / 2, (top + bottom) / 2);
    else if (event.key === "0") chart.fit();
    else if (this._orbits(chart)) this._orbit(5 * DEGREE * across, 5 * DEGREE * up);
    else if (this.turn < 0) chart.pan(-20 * across, 20 * up);
    else this._stand(this.turn, this.values[this.structure.quantities.length + this.turn] + ((across + up) * (event.shiftKey ? 10 : 1) * (high - low)) / 180);
    this.ask(true);
  }

  /** Hover for values, drag the cursor, orbit, zoom and pan. @param {Chart} chart */
  _pointer(chart) {
    const { canvas } = chart, orbits = this._orbits(chart);
    const at = (/** @type {PointerEvent | WheelEvent | MouseEvent} */ event) => { const r = canvas.getBoundingClientRect(); return [event.clientX - r.left, event.clientY - r.top]; };
    /** @type {Map<number, number[]>} */ const held = new Map(); // a pinch has two
    canvas.style.touchAction = chart.picture.axes.equal || orbits ? "none" : "pan-y"; // past curves the page scrolls
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      held.set(event.pointerId, at(event)); canvas.setPointerCapture(event.pointerId);
      if (this._overTurn(chart) && held.size === 1) this._stand(this.turn, chart.x.back(at(event)[0]) * DEGREE);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => { if (held.delete(event.pointerId)) this.ask(true); });
    canvas.addEventListener("pointerleave", () => { this.tip.hidden = true; });
    canvas.addEventListener("pointermove", (event) => {
      const [px, py] = at(event), before = held.get(event.pointerId);
      if (!before) { this._hover(chart, px, py, event); return; }
      const [dx, dy] = [px - before[0], py - before[1]], other = [...held].find(([id]) => id !== event.pointerId)?.[1];
      held.set(event.pointerId, [px, py]);
      if (other) {
        const far = (/** @type {number[]} */ p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
        chart.zoom(far(before) / far([px, py]), ...other); this.ask();
      } else if (this._overTurn(chart)) this._stand(this.turn, chart.x.back(px) * DEGREE);
      else if (orbits) this._orbit(-dx * 0.01, dy * 0.01);
      else { chart.pan(dx, dy); this.ask(); }
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
    const rows = curve ? chart.valuesAt(x).map(({ mark, value }) => `${chart.how.words(mark.label) || chart.axes.title} ${round(value)}`) : [];
    this.tip.textContent = curve ? [`at ${round(x)}`, ...rows].join("\n") : chart.picture.axes.bare ? "" : `x ${round(x)}, y ${round(y)}`;
    this.tip.hidden = !this.tip.textContent;
    const box = this.root.getBoundingClientRect();
    this.tip.style.left = `${Math.min(event.clientX - box.left + 14, box.width - 150)}px`;
    this.tip.style.top = `${Math.min(event.clientY - box.top + 14, box.height - this.tip.offsetHeight)}px`;
  }
}

/** The function that a program is, from what gzip packed. @param {Uint8Array} bytes @returns {Promise<(values: Float64Array) => Float64Array[]>} */
export async function programOf(bytes) {
  const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  return machine(...JSON.parse(text)); // what runs any program stands before the modules
}
