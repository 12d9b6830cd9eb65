// Where a number of the verdict stands: the curve that has it as its largest or least value, and the angle there.
import { make } from "./controls.js";
import { many } from "./marks.js";
import { unitOf } from "./numbers.js";

const ALIKE = 5e-4; // a share: the curve is drawn at its samples, the measure is of the curve
const SURE = 1e-4; // a share: by so much nearer, the place is another measure's, and this one's number is near it by chance
const LONG = 1800; // ms for which a place is shown
const TOLD = /\bat ([-\u2212]?\d+(?:\.\d+)?)(?: to ([-\u2212]?\d+(?:\.\d+)?))? (?:deg\b|°)/; // in a sentence
const UNIT = /\[(.*?)\]/;

/** @typedef {{chart: import("./picture.js").Chart, x: number, y: number, miss: number, size: number, inverse: boolean}} Place in units of
 * the axes; `miss`: how far the curve is from the number there, a share; `size`: of the curve there, as the number would be, SI;
 * `inverse`: the curve is of 1 over the number */

export class Places {
  /** @param {import("./panel.js").Panel} panel */
  constructor(panel) { this.panel = panel; }

  /** Where the number of a measure stands, if a curve that is computed has it. @param {any} measure @returns {Place | null} */
  of(measure) {
    const { panel } = this, value = panel.numbers?.find((/** @type {any} */ row) => row.name === measure.name)?.value;
    if (!Number.isFinite(value) || value === 0) return null;
    const wanted = unitOf(measure.unit, panel.units.known)[1];
    /** @type {Place | null} */ let best = null;
    for (const chart of panel.charts) {
      const { axes, still, marks } = chart.picture, unit = UNIT.exec(String(axes.ylabel))?.[1];
      if (axes.equal || axes.bare || (still && !chart.own) || unit === undefined) continue;
      let [factor, dimension] = [1, [NaN]];
      try { [factor, dimension] = unitOf(unit, panel.units.known); } catch { continue; } // a word where units stand
      const same = (/** @type {number} */ sign) => dimension.every((d, i) => Math.abs(sign * d - wanted[i]) < 1e-9);
      if (!same(1) && !same(-1)) continue;
      for (const mark of marks) {
        if (mark.kind !== "line" || mark.role === "limit" || mark.role === "guide") continue;
        const outputs = chart.own ?? panel.outputs, x = many(mark.x, outputs), y = many(mark.y, outputs);
        const [highest, lowest, farthest] = extremes(y);
        for (const i of new Set([highest, lowest, farthest].filter((place) => place >= 0))) {
          const size = same(1) ? y[i] * factor : 1 / (y[i] * factor), of = size / value;
          const miss = Math.abs((i === farthest ? Math.abs(of) : of) - 1); // of what is farthest from 0 its size is meant
          if (miss < ALIKE && miss < (best?.miss ?? Infinity)) best = { chart, x: x[x.length === 1 ? 0 : i], y: y[i], miss, size, inverse: !same(1) };
        }
      }
    }
    if (!best) return null;
    const { size, miss } = best;
    const others = panel.judged.some((/** @type {any} */ { m, now }) => // of its own number this is never so
      m.unit === measure.unit && Math.abs(Math.abs(now / size) - 1) < miss - SURE);
    return others ? null : best;
  }

  /** Turn to where a measure is what it is, and show that place on its curve. @param {any} measure
   * @returns {boolean} whether there is one */
  go(measure) {
    const { panel } = this, place = this.of(measure);
    if (!place) return false;
    const { chart, x, y } = place, frame = /** @type {HTMLElement} */ (chart.canvas.parentElement);
    panel.showTab("Curves");
    if (panel.overTurn(chart)) this._turn(x);
    frame.scrollIntoView({ block: "nearest" });
    flash(frame);
    this._ring(chart, () => [x, y]);
    return true;
  }

  /** Turn to where a sentence says that something is wrong, and show what is named there. @param {string} sentence */
  goTo(sentence) {
    const { panel } = this, told = TOLD.exec(sentence), [chart] = panel.charts;
    const [from, to] = (told?.slice(1) ?? []).map((word) => Number((word ?? "NaN").replace("\u2212", "-")));
    if (told && panel.positions.turn >= 0) this._turn(Number.isNaN(to) ? from : (from + to) / 2);
    if (!chart) return;
    panel.middle.scrollIntoView({ block: "nearest" });
    flash(panel.middle);
    for (const [i] of [...(chart.list?.troubles ?? []).entries()]) {
      this._ring(chart, () => { const here = chart.list.troubles[i]; return here ? [here.x, here.y] : [NaN, NaN]; });
    }
  }

  /** @param {number} angle degrees */
  _turn(angle) {
    const { panel } = this;
    if (panel.positions.playing) panel.positions.play();
    panel.positions.turnTo(angle);
    panel.ask(true);
    flash(panel.middle);
  }

  /** A ring around a place of a picture, which goes with it, for a while. @param {import("./picture.js").Chart} chart
   * @param {() => number[]} place in units of the axes */
  _ring(chart, place) {
    const { root } = this.panel, ring = make("span", { class: "camkit-ring", "aria-hidden": "true" });
    const put = () => { const [x, y] = place(); ring.style.transform = `translate(${chart.x(x)}px, ${chart.y(y)}px)`; };
    chart.canvas.after(ring);
    put();
    root.addEventListener("camkit-shown", put);
    setTimeout(() => { ring.remove(); root.removeEventListener("camkit-shown", put); }, LONG);
  }
}

/** Where a curve is highest, lowest, and farthest from 0. @param {ArrayLike<number>} y */
function extremes(y) {
  const at = [-1, -1, -1];
  for (let i = 0; i < y.length; i++) {
    if (!Number.isFinite(y[i])) continue;
    if (at[0] < 0 || y[i] > y[at[0]]) at[0] = i;
    if (at[1] < 0 || y[i] < y[at[1]]) at[1] = i;
    if (at[2] < 0 || Math.abs(y[i]) > Math.abs(y[at[2]])) at[2] = i;
  }
  return at;
}

/** An outline, for a while. @param {HTMLElement} element */
function flash(element) {
  element.classList.remove("camkit-flash");
  void element.offsetWidth; // begin again
  element.classList.add("camkit-flash");
  setTimeout(() => element.classList.remove("camkit-flash"), LONG);
}
