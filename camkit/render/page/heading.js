// What stands over a picture: its title with the unit, and the names of its marks with their values.
import { format, pretty } from "./numbers.js";
import { FORMS, REACH, many, one, real, widthOf } from "./marks.js";

/**
 * @typedef {import("./marks.js").Mark} Mark
 * @typedef {import("./picture.js").Chart} Chart
 * @typedef {{title: string, names: any[], upward: string, rows: number}} Heading
 */

/** The unit in an axis's name. */
export const UNIT = /\[(.*?)\]/;

/** The name of an axis with its unit as it is printed. @param {string} words */
export const axisName = (words) => words.replace(UNIT, (_, unit) => `[${pretty(unit)}]`);

/** Each labelled mark that is there, once: its name, its value at the position that is shown, its colour, its form.
 * @param {Chart} chart @returns {{words: string, tint: string, form?: string}[]} */
function legend(chart) {
  const { how, outputs, per } = chart, values = new Map(chart.now.map(({ mark, value }) => [mark, value]));
  const labels = new Map();
  for (const mark of chart.picture.marks) {
    const name = axisName(how.words(mark.label)), valued = values.has(mark);
    if (name ? !there(mark, outputs) : !valued || values.size > 1) continue;
    if (labels.has(name) && (labels.get(name).valued || !valued)) continue;
    const words = `${name} ${valued ? format(values.get(mark) * per.y, ".4g") : ""}`.trim();
    const tint = chart.colour(mark.role, one(mark.index, outputs)), form = mark.kind === "points" ? mark.mark : undefined;
    labels.set(name, { words, valued, tint, form });
  }
  return [...labels.values()];
}

/** Whether anything of a mark can be seen. @param {Mark} mark @param {ArrayLike<number>[]} outputs */
function there(mark, outputs) {
  return (REACH[mark.kind] ?? []).flat().every((name) => Array.prototype.some.call(many(mark[name], outputs), real));
}

/** Where title and names stand, in rows as wide as the canvas. @param {Chart} chart @param {number} width @returns {Heading} */
export function headingOf(chart, width) {
  const { axes, compact } = chart, unit = UNIT.exec(axes.ylabel);
  const up = axes.equal || axes.bare || axes.yticks ? "" : axes.ylabel.replace(/\s*\[.*?\]/, "").toLowerCase();
  const upward = compact || axes.title.toLowerCase().includes(up) ? "" : axisName(axes.ylabel);
  const title = axes.equal || axes.bare || !unit || upward ? axes.title : `${axes.title}  [${unit[1]}]`; // said once
  let at = widthOf(chart.font(12, 600), title) + 16, row = 0;
  const font = chart.font(11);
  const names = [];
  for (const name of legend(chart)) {
    const wide = widthOf(font, name.words) + 28;
    if (at + wide > width - 6 && at > 8) { row += 1; at = 8; }
    names.push({ ...name, at, row });
    at += wide;
  }
  const rows = Math.min(row + 1, compact ? 2 : 6);
  return { title, names: names.filter((name) => name.row < rows), upward, rows: rows + (upward ? 1 : 0) };
}

/** The title with its unit, and the names of the marks. @param {Chart} chart @param {number} width */
export function title(chart, width) {
  const { pen, em, heading: { title: words, names, upward, rows } } = chart;
  pen.textAlign = "left"; pen.textBaseline = "middle"; pen.globalAlpha = 1;
  pen.font = chart.font(12, 600); pen.fillStyle = chart.colour("ink");
  pen.fillText(words, 4, 9 * em, width - 8);
  pen.font = chart.font(11);
  for (const { words: name, tint, form, at, row } of names) {
    const middle = (9 + 15 * row) * em;
    pen.fillStyle = pen.strokeStyle = tint;
    if (form) sign(pen, form, at + 6, middle); else pen.fillRect(at, middle - 2, 12, 4);
    pen.fillStyle = chart.colour("ink"); pen.fillText(name, at + 16, middle);
  }
  if (upward) {
    pen.font = chart.font(10.5); pen.fillStyle = chart.ink("guide"); pen.textAlign = "left";
    pen.fillText(upward, 4, (15 * rows - 5) * em, width - 8);
  }
  if (chart.how.older) {
    pen.fillStyle = chart.ink("guide"); pen.textAlign = "right";
    pen.fillText(chart.own ? "of an earlier design" : "of the stored design", width - 8, chart.box.bottom - 8);
  }
}

/** What points look like, beside their name.
 * @param {CanvasRenderingContext2D} pen @param {string} form @param {number} px @param {number} py */
function sign(pen, form, px, py) {
  pen.save(); pen.translate(px, py); pen.beginPath(); FORMS[form](pen, 4);
  pen.lineWidth = 1.4;
  if (["plus", "cross"].includes(form)) pen.stroke(); else pen.fill();
  pen.restore();
}
