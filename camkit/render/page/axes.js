// The axes of a picture: from where to where they go, their numbers, grid and names.
import { found, many, one, real, stroke, REACH, widthOf } from "./marks.js";
import { degreeTicks, logTicks, short, ticks } from "./scales.js";

/**
 * @typedef {import("./marks.js").Ends} Ends
 * @typedef {import("./picture.js").Chart} Chart
 */

/** The ends of both axes: those of the picture, or what is drawn; they stay while it fits well enough, and while
 * something moves they only make room.
 * @param {Chart} chart @param {ArrayLike<number>[]} outputs @param {boolean} settled @returns {Record<"x"|"y", Ends>} */
export function windowOf(chart, outputs, settled) {
  if (chart.zoomed) return chart.zoomed;
  const { axes, marks: drawn } = chart.picture, reach = { x: [Infinity, -Infinity], y: [Infinity, -Infinity] };
  const widen = (/** @type {"x"|"y"} */ name, /** @type {ArrayLike<number>} */ values, by = 0) => {
    const ends = reach[name], log = axes.log.includes(name);
    for (let i = 0; i < values.length; i++) {
      const v = values[i];
      if (!real(v) || (log && v <= 0)) continue;
      if (v - by < ends[0]) ends[0] = v - by;
      if (v + by > ends[1]) ends[1] = v + by;
    }
  };
  for (const mark of drawn) {
    const [across, up] = REACH[mark.kind] ?? [[], []], by = mark.kind === "circle" ? Math.abs(one(mark.radius, outputs)) || 0 : 0;
    for (const name of across) widen("x", many(mark[name], outputs), by);
    for (const name of up) widen("y", many(mark[name], outputs), by);
    if (mark.kind === "band" && mark.along === "y") widen("x", [one(mark.low, outputs), one(mark.high, outputs)]);
  }
  const joined = ["line", "area", "polygon"];
  const scattered = !drawn.some(({ kind, role }) => joined.includes(kind) && role !== "guide" && role !== "limit");
  /** @param {"x"|"y"} name */
  const ends = (name) => {
    const asked = found(axes[`${name}lim`], outputs) ?? [null, null], log = axes.log.includes(name);
    let [low, high] = reach[name];
    if (!(low <= high)) [low, high] = log ? [0.1, 1] : [0, 1];
    const free = axes.equal ? 0.06 : name === "x" && scattered ? 0.04 : name === "x" ? 0 : 0.06;
    const margin = log ? 0 : free * (high - low) || (high === low ? Math.abs(low) * 0.1 || 1 : 0);
    const fit = { low: low - margin, high: high + margin, log };
    const before = chart.window?.[name], span = before ? before.high - before.low : 0;
    const alike = before && !log && high - low > (settled ? 0.6 : 0.25) * span && high - low < 4 * span;
    const room = axes.equal ? 0.02 * (high - low) : 0; // for what is drawn around a point, as a pivot is
    if (alike && low - room >= before.low && high + room <= before.high) Object.assign(fit, { low: before.low, high: before.high });
    else if (alike && !settled) Object.assign(fit, { low: Math.min(before.low, fit.low), high: Math.max(before.high, fit.high) });
    else if (!log && !axes.equal && name === "y" && fit.high > fit.low) {
      const per = chart.per.y, marks = ticks(fit.low * per, fit.high * per, 8); // round as they are shown
      const step = marks.length > 1 ? (marks[1] - marks[0]) / per : fit.high - fit.low;
      fit.low = Math.floor(fit.low / step + 1e-9) * step; fit.high = Math.ceil(fit.high / step - 1e-9) * step;
    }
    const [a, b] = [one(asked[0], outputs), one(asked[1], outputs)];
    if (typeof a === "number" && real(a)) fit.low = a;
    if (typeof b === "number" && real(b)) fit.high = b;
    return fit;
  };
  return { x: ends("x"), y: ends("y") };
}

/** Numbers, grid and names of the axes. @param {Chart} chart */
export function frame(chart) {
  const { pen, box, ends, em, axes, x, y } = chart;
  if (axes.bare) return;
  const grid = chart.colour("body"), ink = chart.ink("guide");
  const font = pen.font = chart.font(10.5);
  pen.lineWidth = 1; pen.setLineDash([]);
  /** @param {"x"|"y"} name */
  const marks = (name) => {
    const given = axes[`${name}ticks`];
    if (given) return Object.entries(given).map(([at, words]) => [Number(at), chart.how.words(words)]);
    const ratio = chart.per[name], { log } = ends[name], [low, high] = [ends[name].low * ratio, ends[name].high * ratio];
    const long = name === "x" ? box.right - box.left : box.bottom - box.top;
    const apart = axes.equal ? Math.max(60 * em, (box.right - box.left) / 10, (box.bottom - box.top) / 10) : 60 * em;
    const room = axes.equal || name === "x" ? long / apart : Math.min(long / (34 * em), 4.5);
    if (log) return logTicks(low, high, room).map((v) => [v / ratio, short(v)]);
    const degrees = name === "x" && /\[°\]/.test(axes.xlabel) && high - low > 60;
    return (degrees ? degreeTicks(low, high, room) : ticks(low, high, room)).map((v) => [v / ratio, short(v)]);
  };
  pen.textBaseline = "top"; pen.textAlign = "center";
  const below = marks("x").filter(([at]) => x(at) > box.left - 0.5 && x(at) < box.right + 0.5).map(([at, words]) => {
    const half = widthOf(font, words) / 2, middle = Math.min(Math.max(x(at), box.left - 4 + half), box.right - half);
    return { at, words, middle, left: middle - half, right: middle + half };
  });
  const named = nameOf(chart, below);
  pen.fillStyle = ink;
  for (const { at, words, middle, left, right } of below) {
    if (axes.grid) stroke(pen, grid, [[x(at), box.top], [x(at), box.bottom]]);
    if (!named || right < named.left || left > named.right) pen.fillText(words, middle, box.bottom + 4);
  }
  if (named) pen.fillText(axes.xlabel, (named.left + named.right) / 2, box.bottom + 4);
  pen.textBaseline = "middle"; pen.textAlign = "right";
  for (const [at, words] of marks("y")) {
    const p = y(at);
    if (p < box.top - 0.5 || p > box.bottom + 0.5) continue;
    if (axes.grid) stroke(pen, grid, [[box.left, p], [box.right, p]]);
    pen.fillStyle = ink;
    const lines = words.split("\n"), first = p - ((lines.length - 1) / 2) * 12.5 * em;
    lines.forEach((/** @type {string} */ line, /** @type {number} */ k) =>
      pen.fillText(line, box.left - 5, first + k * 12.5 * em, box.left - 7));
  }
  if (!chart.compact && axes.xlabel && !axes.equal) {
    pen.textAlign = "right"; pen.textBaseline = "bottom";
    pen.fillText(axes.xlabel, box.right, box.bottom + 33 * em);
  }
}

/** Where the name of the first axis stands in a small picture: before its last number, if there is room between that and
 * the first one. @param {Chart} chart @param {{left: number, right: number}[]} below the numbers */
function nameOf(chart, below) {
  const { axes } = chart, apart = 6, wide = widthOf(chart.font(10.5), axes.xlabel);
  if (!chart.compact || axes.equal || !axes.xlabel || below.length < 2) return null;
  const right = below[below.length - 1].left - apart;
  return right - wide - apart > below[0].right ? { left: right - wide, right } : null;
}
