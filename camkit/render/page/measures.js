// Measures of a design: their numbers, how they are written, and whether limits are kept.
import { found } from "./marks.js";
import { format, letters, pretty } from "./numbers.js";
import { make } from "./controls.js";

/** @typedef {{m: any, now: number, then: number, change: number, kept: boolean, miss: number}} Judged a measure: its number
 * now and before, the change in per cent, and by which share of its limit that is missed */

/** The number that a measure is. @param {any} measure @param {ArrayLike<number>[]} outputs @returns {number} */
export const numberOf = (measure, outputs) => {
  const value = found(measure.value, outputs);
  return typeof value === "number" ? value : value[0];
};

/** A number of a measure as it is read. @param {any} m @param {number} value @param {import("./units.js").Units} units */
export function told(m, value, units) {
  const { unit, ratio } = units.of(m.unit);
  return `${format((value / m.factor) * ratio, "measure")} ${pretty(unit)}`.trim();
}

/** Each measure against its limit, and against another design. @param {any} structure @param {ArrayLike<number>[]} outputs
 * @param {(m: any) => number} before @returns {Judged[]} */
export const judged = (structure, outputs, before) => structure.measures.map((/** @type {any} */ m) => {
  const [now, then] = [numberOf(m, outputs), before(m)];
  const change = then && Number.isFinite(now - then) ? (100 * (now - then)) / Math.abs(then) : NaN;
  const miss = (m.sense * (now - m.limit)) / (Math.abs(m.limit) || 1), kept = m.limit === undefined || miss <= structure.kept;
  return { m, now, then, change, kept, miss: Number.isNaN(miss) ? 1e300 : miss };
});

/** The measures as a table whose cells stay, so that a row keeps the focus. */
export class Table {
  /** @param {(element: HTMLElement, measure: () => any) => void} explain what shows why a measure is what it is */
  constructor(explain) {
    this.explain = explain;
    this.before = make("th", { scope: "col" });
    const [first, now, change] = ["measure", "now", "change"].map((words) => make("th", { scope: "col" }, words));
    this.table = make("table", {}, make("tr", {}, first, now, this.before, change));
    this.element = make("div", { class: "camkit-numbers camkit-measures" }, this.table);
    /** @type {{line: HTMLElement, cells: HTMLElement[], m: any}[]} */ this.lines = [];
  }

  /** @param {Judged[]} every @param {string} before how the other design is called @param {import("./units.js").Units} units */
  fill(every, before, units) {
    const rows = every.filter((row) => Number.isFinite(row.now));
    this.before.textContent = before;
    while (this.lines.length < rows.length) this._more();
    this.lines.forEach((line, i) => {
      line.line.hidden = i >= rows.length;
      if (i < rows.length) write(line, rows[i], units);
    });
  }

  _more() {
    const cells = [0, 1, 2, 3].map(() => make("td")), line = make("tr", {}, ...cells), made = { line, cells, m: null };
    this.explain(line, () => made.m);
    this.table.append(line);
    this.lines.push(made);
  }
}

/** @param {{line: HTMLElement, cells: HTMLElement[], m: any}} made @param {Judged} row @param {import("./units.js").Units} units */
function write(made, { m, now, then, change, kept }, units) {
  made.m = m;
  made.line.className = kept ? "" : "camkit-bad";
  const words = [letters(m.name), told(m, now, units), Number.isFinite(then) ? told(m, then, units) : "–", Number.isFinite(change) ? `${format(Math.abs(change) < 0.05 ? 0 : change, "+.1f")} %` : ""];
  words.forEach((word, k) => { if (made.cells[k].textContent !== word) made.cells[k].textContent = word; });
}
