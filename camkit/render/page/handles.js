// Handles on the curve that motion laws shape: one for each free coefficient, where it does most; dragged up or down it
// changes the coefficient so that the curve goes with the pointer.
import { lettered, make, stepOf } from "./controls.js";
import { Idle } from "./idle.js";
import { many, one, real } from "./marks.js";
import { between } from "./scales.js";

const APART = 26; // pixels between two handles
const STILL = 0.55; // a handle stays while the coefficient does this share of the most that it does anywhere
const SHARE = 0.01; // of a slider's range, for slopes
const QUIET = 120; // ms without a move before handles are placed anew
const TRIES = 4; // towards the pointer, in one frame
const NEAR = 0.3; // pixels

/**
 * @typedef {import("./picture.js").Chart} Chart
 * @typedef {import("./marks.js").Mark} Mark
 * @typedef {{k: number, element: any, chart?: Chart, mark?: Mark, at?: number, slopes: Float64Array | null}} Handle `k` is
 * the quantity's number, `at` where it stands on the first axis, `slopes` what a step of it does at each place of the curve
 */

export class Handles {
  /** @param {import("./panel.js").Panel} panel @param {(k: number, value: number, settled: boolean) => void} moved */
  constructor(panel, moved) {
    Object.assign(this, { panel, moved, idle: new Idle(), leaving: new AbortController() });
    const { quantities } = panel.structure, free = [...quantities.keys()].filter((k) => quantities[k].free && quantities[k].shapes);
    /** The curves that coefficients shape. @type {{chart: Chart, mark: Mark}[]} */
    this.curves = panel.charts.filter((/** @type {Chart} */ chart) => !chart.picture.still).flatMap((/** @type {Chart} */ chart) =>
      chart.picture.marks.filter(({ kind, shaped }) => kind === "line" && shaped).map((mark) => ({ chart, mark })));
    /** @type {Handle[]} */ this.all = panel.around && this.curves.length ? free.map((k) => this._made(k)) : [];
    /** The design of which slopes are known. */ this.known = "";
    for (const { chart } of this.all.length ? this.curves : []) chart.canvas.parentElement?.classList.add("camkit-shaped"); // more room
    if (this.all.length) panel.root.addEventListener("camkit-shown", () => this._shown(), { signal: this.leaving.signal });
  }

  /** Leave the page. */
  end() { this.idle.stop(); this.leaving.abort(); }

  /** @param {number} k @returns {Handle} */
  _made(k) {
    const { name, symbol } = this.panel.structure.quantities[k], row = this.panel.rows[k];
    const element = make("button", { type: "button", role: "slider", class: "camkit-handle", "aria-orientation": "vertical", hidden: true,
      title: `${name}: drag it up or down` }, make("span"), make("i", {}, ...lettered(symbol)));
    /** @type {Handle} */ const handle = { k, element, slopes: null };
    const light = (/** @type {boolean} */ on) => () => row.element.classList.toggle("camkit-lit", on);
    for (const kind of ["pointerenter", "focus"]) element.addEventListener(kind, light(true));
    for (const kind of ["pointerleave", "blur"]) element.addEventListener(kind, light(false));
    element.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this._key(handle, event));
    this._drags(handle);
    return handle;
  }

  /** What a pointer does to it. @param {Handle} handle */
  _drags(handle) {
    const { element, k } = handle, { panel } = this, row = panel.rows[k];
    /** @type {any} */ let held = null;
    element.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
      if (event.button || held) return;
      const { chart } = handle, { x, y } = chart.ends, { zoomed } = chart, centre = chart.y(this._height(handle, panel.outputs));
      element.setPointerCapture(event.pointerId);
      this.idle.stop(); // all stay where they are as long as one is held
      held = { id: event.pointerId, up: centre - event.clientY, zoomed, begin: row.value, slope: this._slope(handle) };
      chart.zoomed = { x: { ...x }, y: { ...y } }; // the scale stays as long as it is held
      this.held = handle;
    });
    element.addEventListener("pointermove", (/** @type {PointerEvent} */ event) => {
      if (event.pointerId === held?.id) this._follow(handle, held, event.clientY + held.up);
    });
    for (const kind of ["pointerup", "pointercancel"]) {
      element.addEventListener(kind, (/** @type {PointerEvent} */ event) => {
        if (event.pointerId !== held?.id) return;
        handle.chart.zoomed = held.zoomed;
        const { begin } = held;
        this.held = held = null;
        if (row.value !== begin) this.moved(k, row.value, true); else panel.ask(true);
      });
    }
  }

  /** The coefficient with which the curve comes to a place of the canvas. @param {Handle} handle
   * @param {{slope: number}} held what a step of it does there @param {number} py */
  _follow(handle, held, py) {
    const { panel } = this, { k, chart } = handle, { low, high } = panel.rows[k], values = panel.values, wanted = chart.y.back(py);
    let value = values[k], height = this._height(handle, panel.outputs);
    for (let i = 0; i < TRIES && Math.abs(chart.y(height) - py) > NEAR && held.slope; i++) {
      const next = Math.min(Math.max(value + (wanted - height) / held.slope, low), high);
      const outputs = next === value ? null : panel.around.at(values, k, next), there = outputs ? this._height(handle, outputs) : NaN;
      if (next === value) break;
      const slope = (there - height) / (next - value), steep = slope / held.slope;
      value = next;
      if (!real(there)) break; // it cannot be built, which is said
      if (steep > 0.1 && steep < 10) held.slope = slope;
      height = there;
    }
    this._take(k, value, false);
  }

  /** @param {Handle} handle @param {KeyboardEvent} event */
  _key(handle, event) {
    const { key, shiftKey } = event, row = this.panel.rows[handle.k], up = this._slope(handle) < 0 ? -1 : 1;
    const by = { ArrowRight: 1, ArrowLeft: -1, ArrowUp: up, ArrowDown: -up }[key];
    if (by === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault(); event.stopPropagation();
    const step = Number(row.slider.step) * row.factor * (shiftKey ? 10 : 1);
    this._take(handle.k, Math.min(Math.max(row.value + by * step, row.low), row.high), true);
  }

  /** A coefficient with a few digits; its slider goes with it. @param {number} k @param {number} value @param {boolean} settled */
  _take(k, value, settled) {
    const row = this.panel.rows[k], { factor, low, high } = row, fine = (stepOf(low / factor, high / factor) / 10) * factor;
    const round = Math.min(Math.max(Number((Math.round(value / fine) * fine).toPrecision(12)), low), high);
    if (round === row.value) return;
    row.show(round);
    this.moved(k, round, settled);
  }

  /** What the curve is where a handle stands. @param {Handle} handle @param {ArrayLike<number>[]} outputs */
  _height({ mark, at }, outputs) { return between(many(mark.x, outputs), many(mark.y, outputs), at); }

  /** How far the curve goes up where a handle stands, if its coefficient goes on by 1. @param {Handle} handle */
  _slope({ mark, at, slopes }) { return slopes ? between(many(mark.x, this.panel.outputs), slopes, at) : 0; }

  /** The page has drawn a design. */
  _shown() {
    const { panel } = this, { count } = panel.history, design = panel.values.slice(0, count).join();
    for (const handle of this.all) this._put(handle);
    if (this.held || panel.sentence) return;
    if (design !== this.known) this.idle.begin(this._search(panel.values.slice(), design), QUIET);
    else this._place();
  }

  /** Stand on the curve as it is drawn. @param {Handle} handle */
  _put(handle) {
    const { panel } = this, { element, chart, mark, at, k } = handle, { quantities } = panel.structure;
    const there = chart?.box && at !== undefined, px = there ? chart.x(at) : NaN, py = there ? chart.y(this._height(handle, panel.outputs)) : NaN;
    element.hidden = this.held !== handle && !(real(px + py) && chart.inside(px, py));
    if (element.hidden) return;
    element.style.transform = `translate(${px}px, ${py}px)`;
    element.style.color = chart.colour(mark.role, one(mark.index, panel.outputs));
    const { low, high, factor, slider } = panel.rows[k];
    const said = {
      "aria-label": `${quantities[k].name}, handle on the curve ${chart.axes.title}`, "aria-valuetext": slider.getAttribute("aria-valuetext"),
      "aria-valuenow": panel.rows[k].value / factor, "aria-valuemin": low / factor, "aria-valuemax": high / factor,
    };
    for (const [name, value] of Object.entries(said)) element.setAttribute(name, value);
  }

  /** What a step of each coefficient does along the curves, one after the other; then all are placed.
   * @param {Float64Array} values @param {string} design */
  * _search(values, design) {
    const { around, rows } = this.panel;
    for (const handle of this.all) {
      const { k } = handle, { low, high } = rows[k], step = SHARE * (high - low), now = values[k];
      const ends = [Math.max(now - step, Math.min(low, now)), now, Math.min(now + step, Math.max(high, now))].flatMap((value) => {
        const outputs = around.at(values, k, value);
        return outputs ? [{ value, heights: this.curves.map(({ mark }) => Float64Array.from(many(mark.y, outputs))) }] : [];
      });
      yield;
      const first = ends[0], last = ends[ends.length - 1], by = last.value - first.value; // what can be built is among them
      const slopes = first.heights.map((heights, i) => heights.map((y, j) => (last.heights[i][j] - y) / by));
      const best = slopes.map(largest), i = best.indexOf(Math.max(...best));
      Object.assign(handle, best[i] > 0 ? { ...this.curves[i], slopes: slopes[i] } : { slopes: null });
    }
    this.known = design;
    this._place();
  }

  /** Each where its coefficient does most, but not on another one. */
  _place() {
    const { outputs } = this.panel;
    /** @type {number[][]} */ const taken = [];
    for (const handle of this.all) {
      const { chart, mark, slopes, element } = handle;
      if (!slopes || !chart.box) { handle.at = undefined; this._put(handle); continue; }
      const x = many(mark.x, outputs), y = many(mark.y, outputs), most = largest(slopes);
      const placed = (/** @type {number} */ at, /** @type {number} */ height) => [chart.x(at), chart.y(height), this.curves.findIndex((c) => c.chart === chart)];
      const room = (/** @type {number[]} */ [px, py, c]) => Math.min(...taken.map((other) =>
        (other[2] === c ? Math.hypot(px - other[0], py - other[1]) : Infinity)), Infinity);
      const now = handle.at === undefined ? null : placed(handle.at, this._height(handle, outputs));
      if (!now || Math.abs(this._slope(handle)) < STILL * most || !(room(now) >= APART) || !chart.inside(now[0], now[1])) {
        let best = -1, found = -1;
        for (let i = 0; i < x.length; i++) {
          const place = placed(x[i], y[i]);
          if (!real(slopes[i]) || !chart.inside(place[0], place[1])) continue;
          const worth = (Math.abs(slopes[i]) / most) * Math.min(room(place) / APART, 1) ** 3;
          if (worth > best) [best, found] = [worth, i];
        }
        handle.at = found < 0 ? undefined : x[found];
      }
      if (handle.at !== undefined) taken.push(placed(handle.at, this._height(handle, outputs)));
      if (element.parentElement !== chart.canvas.parentElement) chart.canvas.after(element);
      this._put(handle);
    }
  }
}

/** The largest size of numbers. @param {Float64Array} values */
const largest = (values) => values.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);
