// A design under sliders: the page computes and draws it.  `engine.run(values)` gives the outputs of the program.
import { Chart } from "./picture.js";
import { make } from "./controls.js";
import { fill, format } from "./numbers.js";
import { button, filesOf, screenOf } from "./bar.js";
import { conversionsOf, takeDrops, tableOf } from "./drop.js";
import { Handles } from "./handles.js";
import { Made } from "./made.js";
import { History } from "./history.js";
import { Around } from "./around.js";
import { besideOf, drawnOf, measureOf, turn } from "./beside.js";
import { Idle } from "./idle.js";
import { Table, judged, numberOf, told } from "./measures.js";
import { Names } from "./names.js";
import { Places } from "./places.js";
import { listen } from "./pointer.js";
import { Pull } from "./pull.js";
import { Positions } from "./positions.js";
import { Quantities } from "./quantities.js";
import { Tabs } from "./tabs.js";
import { Theme } from "./theme.js";
import { Units } from "./units.js";
import { Verdict } from "./verdict.js";
import { Why } from "./why.js";

const NARROW = 60; // letters: below it everything stands in one column
const QUIET = 250; // ms without a move before tracks are painted
const APART = 150; // ms between two values that the host hears of in a drag: a notebook shows that its kernel is busy with each
const KEYS = "Arrow keys move it, + and - bring it nearer, 0 shows all of it";

/**
 * @typedef {import("./engine.js").Engine} Engine
 * @typedef {{changed(values: number[], measures: (number | null)[]): void, choose(path: string, option: string): void,
 *   back(step: import("./history.js").Step): void, pin(step: import("./history.js").Step, at: number[]): void,
 *   seek(name: string, value: number): void, convert(name: string): void, reset(): void, file(kind: string): void, open(file: File): void, name(asked: Record<string, any>): void, study(): void, workshop(): void}} Host what
 *   stands behind the page, if anything does
 */

export class Panel {
  /** @param {HTMLElement} root @param {any} structure @param {Engine} engine @param {Host | null} [host] */
  constructor(root, structure, engine, host = null) {
    Object.assign(this, { root, structure, engine, host, outputs: null, ghost: null, sentence: "", asked: 0, shownAt: 0 });
    this.inputs = [...structure.quantities, ...structure.positions].map((/** @type {any} */ given) => given.value);
    this.values = Float64Array.from(this.inputs);
    this.history = new History(this.values, structure.quantities.length, structure.make);
    this.leaving = new AbortController();
    /** Designs around this one, if the page computes them. */
    this.around = engine.twin ? new Around(structure, engine.twin()) : null;
    this.slopes = new Idle();
    this.painting = new Idle();
    /** Of each row, what the others were when its track was painted. @type {Map<number, string>} */ this.painted = new Map();
    this._build();
    this.theme = new Theme(root, () => this.ask(true));
    this.resized = new ResizeObserver(() => this._resize());
    for (const part of [root, ...this.charts.map((/** @type {Chart} */ chart) => chart.canvas)]) this.resized.observe(part);
    document.addEventListener("pointerdown", () => this.history.rest(), { capture: true, signal: this.leaving.signal });
    this._resize();
  }

  /** Other sizes: they are read now and not in every picture, which would lay the page out twice. */
  _resize() {
    this.letter = parseFloat(getComputedStyle(this.root).fontSize);
    this.root.classList.toggle("camkit-narrow", this.root.clientWidth < NARROW * this.letter);
    for (const chart of this.charts) chart.size = null;
    this.ask(true);
  }

  /** Leave the page. */
  end() {
    clearTimeout(this.resting); clearTimeout(this.reporting);
    this.leaving.abort(); this.engine.end?.(); this.resized.disconnect(); this.theme.end(); this.why.hide(); this.painting.stop(); this.handles.end(); this.pull.end();
    this.positions.playing = false; this.ended = true;
    this.root.classList.remove("camkit-refused");
    this.root.replaceChildren();
  }

  /** Show `values` in the next frame. @param {boolean} [settled] whether nothing is being dragged */
  ask(settled = false) {
    this.settling = this.settling || settled;
    if (!this.frame) this.frame = requestAnimationFrame(() => this._begin());
  }

  /** Show what was asked for, now. */
  _begin() {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    void this._show();
  }

  /** What is shown, in user units: of each picture its window and marks; measures; the sentence of a refusal. */
  shown() {
    const pictures = this.charts.map((/** @type {Chart} */ chart) => chart.shown());
    return { pictures, measures: this.numbers, sentence: this.sentence, values: [...this.values] };
  }

  /** What the measures are: name, value, text. */
  get numbers() { return this.judged?.map(({ m, now }) => ({ name: m.name, value: now, text: told(m, now, this.units) })); }

  /** Take other values, as undo does. @param {ArrayLike<number>} values */
  put(values) {
    this.values.set(values);
    this.rows.forEach((row, k) => row.show(this.values[k]));
    this.quantities.element.classList.add("camkit-jumped"); // what is painted is of a design that is far away
    this.ask(true);
  }

  /** Take the design that somebody else chose: one step for Undo, also if they chose it by a drag. @param {ArrayLike<number>} values of the quantities */
  load(values) {
    clearTimeout(this.reporting); // what waits to be reported is of the design before
    this.put([...Array.from(values), ...this.values.slice(values.length)]);
    this.history.load(this.values);
    this.reported = Array.from(values);
  }

  /** One thing more that can be shown at the right, by a tab. @param {string} name @param {HTMLElement} element
   * @param {() => void} [onshow] called whenever it begins to be shown @param {boolean} [wide] whether it takes more room */
  addTab(name, element, onshow, wide = false) { this.tabs.add(name, element, onshow, wide); }

  /** Choose what is shown at the right. @param {string} name */
  showTab(name) { this.tabs.show(name); }

  /** A text with the numbers of what is shown. @param {any} text */
  words = (text) => this.units.words(this.plain(text));

  /** The same in the units of the declarations. @param {any} text */
  plain = (text) => (typeof text === "string" ? text : fill(text, this.outputs));

  /** Show every number in a system of units, by its name. @param {string} name */
  use(name) {
    this.units.use(name);
    for (const row of this.rows) row.measure();
    for (const chart of this.charts) chart.window = null; // its ends are round numbers
    for (const sheet of this.sheets ?? []) sheet.measure();
    this.chosen.value = this.units.name;
    this.ask(true);
  }

  /** Whether the mechanism is turning. */
  get playing() { return this.positions.playing; }

  get dark() { return this.theme.dark; }

  /** Say something in a line of its own, or nothing. @param {string} sentence */
  say(sentence) { this.note.textContent = sentence; this.note.hidden = !sentence; this.quantities.blameChoice(Boolean(sentence)); }

  /** Pictures that do not compute, made anew. @param {Record<string, any>} pictures @param {ArrayLike<number>[]} arrays
   * @param {number[]} values the design that they are of */
  redraw(pictures, arrays, values) {
    for (const [k, picture] of Object.entries(pictures)) Object.assign(this.charts[Number(k)], { picture, own: arrays, of: values });
    this.ask(true);
  }

  /** Whether a curve is over the angle that turns the mechanism. @param {Chart} chart */
  overTurn(chart) { return this.positions.over(this.words(chart.picture.axes.xlabel)); }

  _build() {
    const { structure, host, root } = this;
    const moved = (/** @type {number} */ k, /** @type {number} */ value, /** @type {boolean} */ settled) => this._moved(k, value, settled);
    this.units = new Units(structure);
    this.quantities = new Quantities(structure, this.units, moved,
      host && ((path, option) => host.choose(path, option)));
    for (const motion of host ? structure.tables ?? [] : []) this.quantities.lead(motion, tableOf(structure, host));
    const conversions = host ? structure.conversions ?? [] : [];
    for (const part of new Set(conversions.map((/** @type {any} */ one) => one.part))) {
      this.quantities.lead(part, conversionsOf(conversions.filter((/** @type {any} */ one) => one.part === part), host));
    }
    this.positions = new Positions(structure, this.units, this.values, moved, (settled) => this.ask(settled));
    this.rows = [...this.quantities.rows, ...this.positions.rows];
    const explain = (/** @type {HTMLElement} */ element, /** @type {() => any} */ measure) => this.why.explain(element, measure);
    this.why = new Why(this);
    this.places = new Places(this);
    this.pull = new Pull(this);
    const chip = (/** @type {HTMLElement} */ element, /** @type {() => any} */ measure) => { explain(element, measure); this.pull.chip(element, measure); };
    this.verdict = new Verdict(chip, (element, measure) => { // a click goes there, or says why
      if (this.places.go(measure)) this.why.hide(); else this.why.show(element, measure);
    }, () => this.places.goTo(this.plain(this.structure.trouble)));
    this.made = new Made(this);
    this.table = new Table(explain);
    this.note = make("div", { class: "camkit-note", role: "status", hidden: true });
    this.over = make("div", { class: "camkit-over", role: "alert", hidden: true });
    this.tip = make("div", { class: "camkit-tip", hidden: true });
    this.charts = structure.pictures.map((/** @type {any} */ picture) =>
      new Chart(make("canvas", { role: "img", tabindex: "0", "aria-description": KEYS }), picture, structure.look));
    const [first, ...curves] = this.charts.map((/** @type {Chart} */ chart) => chart.canvas);
    this.middle = make("div", { class: "camkit-middle" }, ...(first ? [first] : []), this.over);
    this.tabs = new Tabs();
    const framed = curves.map((/** @type {HTMLElement} */ canvas) => make("div", { class: "camkit-curve" }, canvas));
    this.addTab("Curves", make("div", { class: "camkit-curves" }, ...framed), () => this._resize());
    this.addTab("Numbers", this.table.element, () => this.ask(true), true);
    if (host?.study) this.addTab("Study", make("div", { class: "camkit-dock" }, "It opens as soon as its kernel is free."), () => host.study(), true);
    root.classList.add("camkit-page");
    const seen = make("div", { class: "camkit-seen" }, ...this.verdict.elements, this.middle); // in one column it stays in sight
    root.replaceChildren(this._bar(), this.note, seen, this.quantities.element, this.tabs.element, this.positions.element,
      this.tabs.row, this.tip, this.why.element);
    for (const chart of this.charts) listen(this, chart);
    takeDrops(this);
    this.handles = new Handles(this, moved);
    this.quantities.element.addEventListener("toggle", () => this._paint(), { capture: true }); // a group was opened
    root.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this._key(event), { signal: this.leaving.signal });
  }

  _bar() {
    const { structure } = this;
    this.undoing = button("\u21B6", "Undo", () => this._undo());
    this.redoing = button("\u21B7", "Redo", () => this._redo());
    this.pinning = button("Pin to compare", "Pin this design to compare others with it", () => this._pin());
    const reset = button("Reset", "Back to the design that the page began with", () => {
      const count = structure.quantities.length, asked = this.host && !this.left; // it knows what was chosen, too
      this.history.settle(this.values);
      this.put(asked ? [...this.values.slice(0, count), ...this.inputs.slice(count)] : this.inputs);
      if (asked) this.host.reset(); else this.history.settle(this.values);
    });
    this.chosen = make("select", { "aria-label": "units", onchange: () => this.use(this.chosen.value) },
      ...this.units.names.map((name) => make("option", { value: name }, name)));
    this.names = new Names(this, structure.named ?? [], this.host && ((asked) => this.host.name(asked)));
    return make("div", { class: "camkit-bar-top" }, make("b", { role: "heading", "aria-level": "1", title: structure.name }, structure.name),
      this.names.element, this.undoing, this.redoing, reset, this.pinning, make("span", { class: "camkit-space" }),
      this.chosen, ...filesOf(structure, this.host), ...screenOf(this.root));
  }

  /** @param {number} k @param {number} value @param {boolean} settled */
  _moved(k, value, settled) {
    this.values[k] = value;
    this.last = k;
    if (k < this.history.count) this._leaveTracks();
    if (settled) this.history.settle(this.values);
    this.ask(settled);
    if (settled) this._begin(); // the next frame has but to paint it
  }

  /** What is painted on tracks is of another design, but on that which is being moved. */
  _leaveTracks() {
    this.painting.stop();
    clearTimeout(this.resting);
    this.quantities.element.classList.remove("camkit-jumped");
    this.quantities.element.classList.add("camkit-moving");
  }

  _undo() { if (this._can(this.history.past)) this._back(this.history.undo()); }

  _redo() { if (this._can(this.history.future)) this._back(this.history.redo()); }

  /** Whether the last of these steps can be come back to: another make needs its kernel. @param {import("./history.js").Step[]} steps */
  _can(steps) { return steps.length > 0 && (steps.at(-1).make === this.history.now.make || Boolean(this.host && !this.left)); }

  /** Undo and Redo that were asked for while another make was on its way. */
  goOn() {
    for (let by = this.history.next(); by; by = this.history.asked ? 0 : this.history.next()) {
      if (by < 0) this._undo(); else this._redo();
    }
  }

  /** A design, where the mechanism stands now. @param {import("./history.js").Step | null} step */
  _back(step) {
    if (!step) return;
    if (step.make === this.history.now.make) this.put([...step.values, ...this.values.slice(step.values.length)]);
    else this.host.back(step);
  }

  /** @param {KeyboardEvent} event */
  _key(event) {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || !["z", "y"].includes(key) || typing(event.target)) return;
    event.preventDefault(); event.stopPropagation();
    if (key === "y" || event.shiftKey) this._redo(); else this._undo();
  }

  _pin() { this.pin(this.ghost ? null : this.outputs && besideOf(this, this.built.slice(), this.outputs)); }

  /** Compare with a design from now on, or with none. @param {import("./beside.js").Beside | null} ghost */
  pin(ghost) {
    this.ghost = ghost;
    this.pinning.textContent = this.ghost ? "Unpin" : "Pin to compare";
    this.ask(true);
  }

  /** Show a design beside the one in hand as long as somebody looks at it, or none. @param {ArrayLike<number> | null} design */
  preview(design) {
    if (!this.engine.twin) return;
    if (design?.length !== this.history.count) { if (this.looked) { this.looked = null; this.ask(); } return; } // or of another law
    const values = Float64Array.from([...Array.from(design), ...this.values.slice(design.length)]);
    if (this.looked?.values.every((/** @type {number} */ v, /** @type {number} */ k) => v === values[k])) return;
    this.looked = besideOf(this, values, this.runs(values));
    this.ask();
  }

  /** What computes other designs of this make beside the one that the page goes on from, if the page does. */
  get runs() { return this.twin ??= this.engine.twin?.(); }

  async _show() {
    const number = ++this.asked, settled = this.settling, values = this.values.slice(), ran = this.engine.run(values);
    this.settling = false;
    const outputs = ran instanceof Promise ? await ran : ran;
    if (number < this.shownAt || this.ended) return; // a newer one is there
    this.shownAt = number;
    if (outputs.structure) this._adopt(outputs.structure);
    if (this.ghost) turn(this.ghost, values.subarray(this.history.count));
    this._draw(outputs, values, settled);
    this.computed = values.subarray(0, this.history.count);
    this._report(settled);
    if (!settled) return;
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this._rest()); // the picture comes first
  }

  /** What follows a design that is settled on. */
  _rest() {
    const letter = parseFloat(getComputedStyle(this.root).fontSize);
    if (letter !== this.letter) { this._resize(); return; }
    for (const chart of this.charts) if (chart.list) this._describe(chart);
    this.verdict.rest();
    this._paint();
  }

  /** Pictures, positions and measures that somebody else has made. @param {any} structure */
  _adopt(structure) {
    Object.assign(this.structure, structure);
    this.charts.forEach((/** @type {Chart} */ chart, /** @type {number} */ k) => { chart.picture = structure.pictures[k]; });
  }

  /** The host hears of other values, with the measures that the page has computed for them; in a drag now and then.
   * @param {boolean} settled */
  _report(settled) {
    const values = [...this.computed], now = performance.now(), wait = (this.reportedAt ?? 0) + APART - now;
    clearTimeout(this.reporting);
    if (!this.host || (this.reported && values.every((value, k) => value === this.reported[k]))) return;
    if (!settled && wait > 0) { this.reporting = setTimeout(() => this._report(true), wait); return; }
    const first = !this.reported, number = (/** @type {any} */ { now }) => (Number.isFinite(now) ? now : null);
    Object.assign(this, { reported: values, reportedAt: now });
    if (!first) this.host.changed(values, this.sentence ? [] : this.judged.map(number));
  }

  /** Paint on each track in sight what can be built, when nothing has moved for a moment.  What is painted holds as long
   * as all the other quantities stay. */
  _paint() {
    const { around, structure, rows, painted } = this, values = this.values.slice();
    this.quantities.element.classList.remove("camkit-moving");
    if (!around) return;
    const design = [...values.subarray(0, structure.quantities.length)];
    const others = (/** @type {number} */ k) => design.map((value, j) => (j === k ? "" : value)).join();
    const old = this.quantities.inSight.filter((k) => painted.get(k) !== others(k));
    for (const k of old) rows[k].track.classList.add("camkit-old");
    const limited = structure.measures.some((/** @type {any} */ m) => m.limit !== undefined);
    this.painting.begin((function* steps() {
      for (const k of old) {
        yield* around.spans(values, k, rows[k].low, rows[k].high, (spans) => rows[k].paint(spans, limited));
        painted.set(k, others(k));
      }
    })(), QUIET);
  }

  /** @param {import("./engine.js").Outputs} outputs @param {Float64Array} values what they are of @param {boolean} settled */
  _draw(outputs, values, settled) {
    const missed = this.structure.refusals.find((/** @type {any} */ r) => outputs.length && outputs[r.at][0] !== 1);
    const refused = missed ? fill(missed.words, outputs) : outputs.sentence ?? "";
    this._refuse(refused);
    this.undoing.setAttribute("aria-disabled", String(!this._can(this.history.past)));
    this.redoing.setAttribute("aria-disabled", String(!this._can(this.history.future)));
    if (!refused) Object.assign(this, { outputs, built: values });
    if (!this.outputs) return;
    if (!refused) this.positions.fit(outputs);
    const { words, dark, playing, units } = this, em = this.letter / 13, low = 190 * em;
    this.root.classList.toggle("camkit-dark", dark);
    for (const [k, chart] of this.charts.entries()) {
      const pinned = drawnOf(this.looked ?? this.ghost, chart.picture, k), cursor = this._cursorOf(chart);
      chart.em = em;
      const how = { dark, settled: settled && !playing, words, units, ghost: pinned, cursor, low, older: this._older(chart) };
      chart.draw(chart.own ?? this.outputs, how);
    }
    if (!refused) this._tell(outputs);
    this.root.dispatchEvent(new CustomEvent("camkit-shown"));
  }

  /** Whether a picture that does not compute is of another design. @param {Chart} chart */
  _older({ picture, own, of }) {
    return Boolean(picture.still) && (!own || of.some((/** @type {number} */ value, /** @type {number} */ k) => value !== this.values[k]));
  }

  /** The text in place of a picture; a curve over the turn is a slider, whose values are those of the curves.
   * @param {Chart} chart */
  _describe(chart) {
    const { canvas, how: { cursor }, ends } = chart, text = chart.describe();
    const near = (/** @type {number} */ v) => format(v * chart.per.x, ".4g");
    const of = cursor === undefined ? { role: "img", "aria-label": text } : {
      role: "slider", "aria-label": chart.heading.title, "aria-valuetext": `at ${near(cursor)}; ${text}`,
      "aria-valuenow": near(cursor), "aria-valuemin": near(ends.x.low), "aria-valuemax": near(ends.x.high),
    };
    for (const [name, value] of Object.entries(of)) canvas.setAttribute(name, value);
  }

  /** Where the mechanism stands, on a curve over the angle that turns it. @param {Chart} chart */
  _cursorOf(chart) { return this.overTurn(chart) ? this.positions.angle : undefined; }

  /** The sentence over the last good picture. @param {string} sentence */
  _refuse(sentence) {
    if (sentence || this.sentence) this.quantities.blame(sentence ? this._guilty() : []);
    const said = sentence && `This cannot be built: ${this.units.words(sentence)}.`;
    if (this.over.textContent === said) return;
    this.sentence = sentence;
    this.over.textContent = said;
    this.over.hidden = !sentence;
    this.root.classList.toggle("camkit-refused", Boolean(sentence));
  }

  /** Quantities that are not as in the last design that could be built: those of which one alone would do, if taken back. */
  _guilty() {
    const { values, built, around, history: { count } } = this, every = [...values.keys()].slice(0, count);
    const other = built ? every.filter((k) => values[k] !== built[k]) : [this.last];
    const alone = around && other.length > 1 ? other.filter((k) => around.at(values, k, built[k])) : [];
    return alone.length ? alone : other;
  }

  /** Measures as numbers, limits as chips. @param {ArrayLike<number>[]} outputs */
  _tell(outputs) {
    this.first ??= outputs;
    const { structure: { first }, ghost } = this;
    const rows = judged(this.structure, outputs,
      (m) => (ghost ? measureOf(ghost, m) : first ? first[m.name] ?? NaN : numberOf(m, this.first)));
    this.judged = rows;
    this.verdict.tell(rows, this.words(this.structure.trouble), this.units);
    if (!this.table.element.hidden) this.table.fill(rows, this.ghost ? "pinned" : "start", this.units);
  }
}

/** Whether something is typed in a box and not taken yet. @param {any} box */
const typing = (box) => box.matches("input:not([type=range], [type=checkbox])") && box.value !== box.defaultValue;
