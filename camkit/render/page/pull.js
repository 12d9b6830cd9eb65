// Pull the answer: a peak of a curve or a limit's chip is dragged, and the kernel lets the free sliders follow.
import { make } from "./controls.js";
import { told } from "./measures.js";
import { say } from "./pointer.js";

const FAR = 5; // pixels from where it was pressed before a press is a drag
const PER = 0.004; // of the number for a pixel along a chip
const STEP = 0.01; // of the number for a key
const SOON = 100; // ms after a drag for its click
const QUIET = 200; // ms without a move before the peaks are found anew

/** @typedef {{m: any, element: HTMLElement, place: import("./places.js").Place | null}} Peak */

export class Pull {
  /** @param {import("./panel.js").Panel} panel */
  constructor(panel) {
    Object.assign(this, { panel, held: null, asked: false, next: null, droppedAt: -Infinity, known: "" });
    const { structure, host, root, leaving } = panel;
    const limited = host?.seek ? structure.measures.filter((/** @type {any} */ m) => m.limit !== undefined) : [];
    /** @type {Peak[]} */ this.peaks = limited.map((/** @type {any} */ m) => this._peak(m));
    if (limited.length) root.addEventListener("camkit-shown", () => this._shown(), { signal: leaving.signal });
  }

  /** Leave the page. */
  end() { clearTimeout(this.quiet); }

  /** Whether somebody is there who lets the sliders follow. */
  get possible() { return Boolean(this.panel.host?.seek && !this.panel.left && !this.panel.sentence); }

  /** @param {string} name @returns {any} the measure as it is now */
  _now(name) { return this.panel.judged?.find((/** @type {any} */ row) => row.m.name === name); }

  /** Ask for a value of a measure: one question at a time, of those that wait the last. @param {any} m @param {number} value */
  want(m, value) {
    if (this.asked) { this.next = [m, value]; return; }
    this.asked = true;
    this.panel.history.goOn();
    this.panel.host.seek(m.name, value);
  }

  /** The kernel has answered. */
  hear() {
    const { next } = this;
    Object.assign(this, { asked: false, next: null });
    if (next) this.want(next[0], next[1]); else if (!this.held) this._shown();
  }

  /** A chip is dragged to the side, or moved by arrow keys; returns whether what was pressed has become a drag.
   * @param {HTMLElement} element @param {() => any} measure */
  chip(element, measure) {
    if (!this.panel.host?.seek) return;
    const value = (/** @type {any} */ row, /** @type {number} */ px) => row.now + PER * px * Math.abs(row.now || row.m.factor);
    this._drags(element, measure, (row, dx) => value(row, dx));
  }

  /** @param {any} m @returns {Peak} */
  _peak(m) {
    const element = make("button", { type: "button", role: "slider", class: "camkit-handle camkit-peak", "aria-orientation": "vertical", hidden: true,
      title: `${m.name}: drag it, and the sliders follow` }, make("span"));
    const peak = { m, element, place: null };
    this._drags(element, () => m, (row, _, dy, from) => {
      const { chart, y, inverse } = from, to = chart.y.back(chart.y(y) + dy), by = inverse ? y / to : to / y;
      return Number.isFinite(by) ? row.now * by : NaN;
    }, peak);
    return peak;
  }

  /** @param {HTMLElement} element @param {() => any} measure
   * @param {(row: any, dx: number, dy: number, from: any) => number} wanted the value for a way in pixels @param {Peak} [peak] */
  _drags(element, measure, wanted, peak) {
    /** @type {any} */ let press = null;
    element.style.touchAction = peak ? "none" : "pan-y";
    const far = (/** @type {PointerEvent} */ { clientX, clientY }) => [clientX - press.x, clientY - press.y];
    element.addEventListener("pointerdown", (event) => {
      const row = this._now(measure()?.name);
      if (event.button || press || !this.possible || !Number.isFinite(row?.now)) return;
      press = { element, id: event.pointerId, x: event.clientX, y: event.clientY, row, from: peak?.place && { ...peak.place }, drags: false };
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      if (event.pointerId !== press?.id) return;
      const [dx, dy] = far(event);
      if (!press.drags && Math.abs(peak ? dy : dx) < FAR) return;
      if (!press.drags) this._begin(press);
      this._to(element, press.row.m, wanted(press.row, dx, dy, press.from), event);
      if (peak) element.style.transform = `translate(${press.px}px, ${press.py + dy}px)`;
    });
    for (const kind of ["pointerup", "pointercancel"]) {
      element.addEventListener(kind, (/** @type {any} */ event) => {
        if (event.pointerId !== press?.id) return;
        const { drags, from, zoomed } = press;
        press = null;
        if (!drags) return;
        if (from) from.chart.zoomed = zoomed;
        Object.assign(this, { held: null, droppedAt: performance.now() });
        this.panel.tip.hidden = true;
        this.panel.ask(true);
      });
    }
    element.addEventListener("click", (event) => { // what ends a drag is no click
      if (performance.now() - this.droppedAt < SOON) event.stopImmediatePropagation();
    }, { capture: true });
    element.addEventListener("keydown", (event) => this._key(event, measure(), Boolean(peak)));
  }

  /** A press has become a drag: the scale of the curve stays as long as it is held. @param {any} press */
  _begin(press) {
    press.drags = true;
    this.held = press;
    this.panel.why.hide();
    if (!press.from) return;
    const { chart, x, y } = press.from;
    Object.assign(press, { zoomed: chart.zoomed, px: chart.x(x), py: chart.y(y) });
    chart.zoomed = { x: { ...chart.ends.x }, y: { ...chart.ends.y } };
  }

  /** @param {HTMLElement} element @param {any} m @param {number} value @param {MouseEvent} event */
  _to(element, m, value, event) {
    if (!Number.isFinite(value)) return;
    const { panel } = this, box = panel.root.getBoundingClientRect();
    say(panel.tip, [`${m.name}: ${told(m, value, panel.units)} wanted`], event.clientX - box.left, event.clientY - box.top);
    this.want(m, value);
  }

  /** @param {KeyboardEvent} event @param {any} m @param {boolean} upright */
  _key(event, m, upright) {
    const { key, shiftKey } = event, [more, less] = upright ? ["ArrowUp", "ArrowDown"] : ["ArrowRight", "ArrowLeft"];
    const row = m && this._now(m.name);
    if (![more, less].includes(key) || event.ctrlKey || event.metaKey || event.altKey || !this.possible || !Number.isFinite(row?.now)) return;
    event.preventDefault(); event.stopPropagation();
    this.want(m, row.now + (key === more ? 1 : -1) * STEP * (shiftKey ? 10 : 1) * Math.abs(row.now || m.factor));
  }

  /** The page has drawn a design: its peaks are found when nothing has moved for a moment. */
  _shown() {
    const { panel, known } = this;
    this.known = panel.values.slice(0, panel.history.count).join();
    if (known !== this.known) for (const { element } of this.peaks) element.hidden ||= element !== this.held?.element;
    clearTimeout(this.quiet);
    this.quiet = setTimeout(() => { if (!this.held) for (const peak of this.peaks) this._put(peak); }, QUIET);
  }

  /** Stand on the peak of a curve, if a measure has one in sight. @param {Peak} peak */
  _put(peak) {
    const { panel } = this, { m, element } = peak, place = this.possible ? panel.places.of(m) : null;
    const [px, py] = place?.chart.box ? [place.chart.x(place.x), place.chart.y(place.y)] : [NaN, NaN];
    peak.place = place;
    element.hidden = !place?.chart.inside(px, py);
    if (element.hidden) return;
    if (element.parentElement !== place.chart.canvas.parentElement) place.chart.canvas.after(element);
    element.style.transform = `translate(${px}px, ${py}px)`;
    const now = this._now(m.name);
    for (const [name, value] of Object.entries({ "aria-label": `${m.name}, peak of the curve ${place.chart.axes.title}`,
      "aria-valuenow": now.now / m.factor, "aria-valuetext": told(m, now.now, panel.units) })) element.setAttribute(name, String(value));
  }
}
