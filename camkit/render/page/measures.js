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
 * @param {ArrayLike<number>[]} before @returns {Judged[]} */
export const judged = (structure, outputs, before) => structure.measures.map((/** @type {any} */ m) => {
  const [now, then] = [numberOf(m, outputs), numberOf(m, before)];
  const change = then && Number.isFinite(now - then) ? (100 * (now - then)) / Math.abs(then) : NaN;
  const miss = (m.sense * (now - m.limit)) / (Math.abs(m.limit) || 1), kept = m.limit === undefined || miss <= structure.kept;
  return { m, now, then, change, kept, miss: Number.isNaN(miss) ? 1e300 : miss };
});

/** The measures as rows. @param {Judged[]} rows @param {string} before how the other design is called
 * @param {import("./units.js").Units} units */
export function tableOf(rows, before, units) {
  const cell = (/** @type {string} */ words) => make("td", {}, words);
  const head = make("tr", {}, ...["measure", "now", before, "change"].map((words) => make("th", { scope: "col" }, words)));
  const lines = rows.filter((row) => Number.isFinite(row.now)).map(({ m, now, then, change, kept }) =>
    make("tr", { class: kept ? "" : "camkit-bad" }, ...[
      letters(m.name), told(m, now, units), told(m, then, units), Number.isFinite(change) ? `${format(change, "+.1f")} %` : "",
    ].map(cell)));
  return make("table", {}, head, ...lines);
}
