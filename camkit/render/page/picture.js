// Draws pictures as data on a canvas: axes, and marks with roles.  It knows neither cams nor their numbers.
import { format, pretty } from "./numbers.js";

/**
 * @typedef {{at: number}} Output an array that the program gives, by its number
 * @typedef {Record<string, any> & {key: string, kind: string, role: string}} Mark
 * @typedef {{name: string, still: string, axes: Record<string, any>, marks: Mark[]}} Picture
 * @typedef {{low: number, high: number, log: boolean}} Ends
 */

const LETTERS = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
const POINT = 96 / 72; // CSS pixels

/** What a value of a picture is: itself, or what the program gives. @param {any} value @param {ArrayLike<number>[]} outputs */
export const found = (value, outputs) => (value !== null && typeof value === "object" && "at" in value ? outputs[value.at] : value);
/** @param {any} value @param {ArrayLike<number>[]} outputs */
const one = (value, outputs) => { const v = found(value, outputs); return typeof v === "object" && v !== null ? v[0] : v; };
/** @param {any} value @param {ArrayLike<number>[]} outputs @returns {ArrayLike<number>} */
const many = (value, outputs) => { const v = found(value, outputs); return typeof v === "number" ? [v] : v; };
const real = Number.isFinite;
/** Letters whose colour as a line would be too pale to read on white. @type {Record<string, string>} */
const READABLE = { guide: "#5b6875", pitch: "#5b6875", trouble: "#b03a00", limit: "#b03a00" };

/** Round numbers from one end to the other, about `count` of them. @param {number} low @param {number} high @param {number} count */
export function ticks(low, high, count) {
  const rough = (high - low) / Math.max(count, 1), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) marks.push(+(k * step).toPrecision(12));
  return marks;
}

/** Ticks of an angle in degrees, if it goes round: 0, 90, 180 ... @param {number} low @param {number} high @param {number} count */
function degreeTicks(low, high, count) {
  const step = [15, 30, 45, 60, 90, 180].find((s) => (high - low) / s <= count + 1) ?? 360;
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9; k++) marks.push(k * step);
  return marks;
}

/** Places of a scale: from numbers to pixels and back. @param {Ends} ends @param {number} from @param {number} to */
function scale(ends, from, to) {
  const f = ends.log ? Math.log10 : Number, low = f(ends.low), span = f(ends.high) - low || 1;
  /** @param {number} value */
  const place = (value) => from + ((to - from) * (f(value) - low)) / span;
  /** @param {number} pixel */
  place.back = (pixel) => { const v = low + ((pixel - from) * span) / (to - from); return ends.log ? 10 ** v : v; };
  return place;
}

/** Where each coordinate of a mark may reach, as names of its fields. @type {Record<string, [string[], string[]]>} */
const REACH = {
  line: [["x"], ["y"]], points: [["x"], ["y"]], polygon: [["x"], ["y"]], area: [["x"], ["low", "high"]],
  circle: [["x"], ["y"]], text: [[], []], band: [[], []],
};

/** One picture on its canvas. */
export class Chart {
  /** @param {HTMLCanvasElement} canvas @param {Picture} picture @param {any} look */
  constructor(canvas, picture, look) {
    Object.assign(this, { canvas, picture, look, window: null, zoomed: null, hover: null });
    /** What was drawn last, in user units. @type {any} */
    this.list = null;
    this.compact = false;
    /** The size of letters, as a share of what it mostly is. */
    this.em = 1;
  }

  /** Draw what the program gave. @param {ArrayLike<number>[]} outputs
   * @param {{dark: boolean, cursor?: number, ghost?: ArrayLike<number>[], settled?: boolean, words: (text: any) => string}} how */
  draw(outputs, how) {
    this.outputs = outputs;
    const ratio = globalThis.devicePixelRatio || 1, { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio); this.canvas.height = Math.round(height * ratio);
    }
    this.pen = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d"));
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.pen.clearRect(0, 0, width, height);
    this.how = how;
    const { axes } = this.picture, [title, xlabel, ylabel] = [axes.title, axes.xlabel, axes.ylabel].map(how.words);
    this.axes = { ...axes, title, xlabel, ylabel };
    const marks = [...this.picture.marks].map((mark) => ({ mark, height: one(mark.height, outputs) }));
    marks.sort((a, b) => a.height - b.height);
    this.window = this._window(outputs, Boolean(how.settled));
    this.now = how.cursor === undefined ? [] : this.valuesAt(how.cursor);
    this._place(width, height);
    this._frame();
    this.list = { name: this.picture.name, window: { ...this.window }, marks: [] };
    if (how.ghost) for (const { mark } of marks) this._ghost(mark, how.ghost);
    for (const { mark } of marks) this._mark(mark, outputs);
    this._cursor();
    this._title(width);
  }

  /** The colour of a role. @param {string} role @param {number} [index] */
  colour(role, index = 0) {
    const theme = this.how.dark ? "dark" : "light";
    return role === "series" ? this.look.series[theme][index % 20] : this.look.roles[role][theme];
  }

  /** The colour of letters in a role. @param {string} role @param {number} [index] */
  ink(role, index) { return (!this.how.dark && READABLE[role]) || this.colour(role, index); }

  /** Letters of a size. @param {number} size @param {number} [weight] */
  letters(size, weight = 400) { this.pen.font = `${weight} ${size * this.em}px ${LETTERS}`; }

  /** The ends of both axes: those of the picture, or what is drawn; they stay while it fits well enough, and while
   * something moves they only make room.
   * @param {ArrayLike<number>[]} outputs @param {boolean} settled */
  _window(outputs, settled) {
    if (this.zoomed) return this.zoomed;
    const axes = this.picture.axes, reach = { x: [Infinity, -Infinity], y: [Infinity, -Infinity] };
    const widen = (/** @type {"x"|"y"} */ name, /** @type {ArrayLike<number>} */ values, by = 0) => {
      const ends = reach[name], log = axes.log.includes(name);
      for (let i = 0; i < values.length; i++) {
        const v = values[i];
        if (!real(v) || (log && v <= 0)) continue;
        if (v - by < ends[0]) ends[0] = v - by;
        if (v + by > ends[1]) ends[1] = v + by;
      }
    };
    for (const mark of this.picture.marks) {
      const [across, up] = REACH[mark.kind] ?? [[], []], by = mark.kind === "circle" ? Math.abs(one(mark.radius, outputs)) || 0 : 0;
      for (const name of across) widen("x", many(mark[name], outputs), by);
      for (const name of up) widen("y", many(mark[name], outputs), by);
      if (mark.kind === "band" && mark.along === "y") widen("x", [one(mark.low, outputs), one(mark.high, outputs)]);
    }
    const scattered = !this.picture.marks.some(({ kind, role }) => ["line", "area", "polygon"].includes(kind) && role !== "guide" && role !== "limit");
    /** @param {"x"|"y"} name */
    const ends = (name) => {
      const asked = found(axes[`${name}lim`], outputs) ?? [null, null], log = axes.log.includes(name);
      let [low, high] = reach[name];
      if (!(low <= high)) [low, high] = log ? [0.1, 1] : [0, 1];
      const margin = log ? 0 : (axes.equal || (name === "x" && scattered) ? 0.04 : name === "x" ? 0 : 0.06) * (high - low) || (high === low ? Math.abs(low) * 0.1 || 1 : 0);
      const fit = { low: low - margin, high: high + margin, log };
      const before = this.window?.[name], span = before ? before.high - before.low : 0;
      const alike = before && !log && high - low > (settled ? 0.6 : 0.25) * span && high - low < 4 * span;
      if (alike && low >= before.low && high <= before.high) Object.assign(fit, { low: before.low, high: before.high });
      else if (alike && !settled) Object.assign(fit, { low: Math.min(before.low, fit.low), high: Math.max(before.high, fit.high) });
      else if (!log && !axes.equal && name === "y" && fit.high > fit.low) {
        const marks = ticks(fit.low, fit.high, 8), step = marks.length > 1 ? marks[1] - marks[0] : fit.high - fit.low;
        fit.low = Math.floor(fit.low / step + 1e-9) * step; fit.high = Math.ceil(fit.high / step - 1e-9) * step;
      }
      const [a, b] = [one(asked[0], outputs), one(asked[1], outputs)];
      if (typeof a === "number" && real(a)) fit.low = a;
      if (typeof b === "number" && real(b)) fit.high = b;
      return fit;
    };
    return { x: ends("x"), y: ends("y") };
  }

  /** Room for title and numbers, and the scales. @param {number} width @param {number} height */
  _place(width, height) {
    const { axes } = this, { x, y } = this.window, small = this.compact;
    const bare = axes.bare, named = !small && axes.xlabel && !axes.equal, { em } = this;
    this.heading = this._heading(width);
    this.letters(10.5);
    const ticked = Object.values(axes.yticks ?? {}).flatMap((words) => this.how.words(words).split("\n").map((line) => this.pen.measureText(line).width));
    const box = { left: bare ? 6 : axes.yticks ? Math.min(10 + Math.max(0, ...ticked), 0.45 * width) : 44 * em, right: width - 8, top: this.heading.rows * 15 * em + 7, bottom: height - (bare ? 6 : (named ? 34 : 18) * em) };
    let ends = { x, y };
    if (axes.equal) {
      const across = box.right - box.left, up = box.bottom - box.top;
      const unit = Math.max((x.high - x.low) / across, (y.high - y.low) / up) || 1;
      const middle = (/** @type {Ends} */ e, /** @type {number} */ span) => ({ low: (e.low + e.high - span) / 2, high: (e.low + e.high + span) / 2, log: false });
      ends = { x: middle(x, unit * across), y: middle(y, unit * up) };
    }
    Object.assign(this, { box, ends, x: scale(ends.x, box.left, box.right), y: scale(ends.y, box.bottom, box.top) });
  }

  /** Numbers, grid and names of the axes. */
  _frame() {
    const { pen, box, ends, em, axes } = this;
    if (axes.bare) return;
    const grid = this.colour("body"), ink = this.ink("guide");
    this.letters(10.5); pen.lineWidth = 1; pen.setLineDash([]);
    /** @param {"x"|"y"} name */
    const marks = (name) => {
      const given = axes[`${name}ticks`];
      if (given) return Object.entries(given).map(([at, words]) => [Number(at), this.how.words(words)]);
      const { low, high, log } = ends[name], long = name === "x" ? box.right - box.left : box.bottom - box.top;
      const apart = axes.equal ? Math.max(60 * em, (box.right - box.left) / 10, (box.bottom - box.top) / 10) : 60 * em;
      const room = axes.equal || name === "x" ? long / apart : Math.min(long / (34 * em), 4.5);
      if (log) return ticks(Math.log10(low), Math.log10(high), Math.min(room, 6)).map((p) => [10 ** p, short(10 ** p)]);
      const degrees = name === "x" && /\[deg\]/.test(axes.xlabel) && high - low > 60;
      return (degrees ? degreeTicks(low, high, room) : ticks(low, high, room)).map((v) => [v, short(v)]);
    };
    pen.textBaseline = "top"; pen.textAlign = "center";
    for (const [at, words] of marks("x")) {
      const p = this.x(at);
      if (p < box.left - 0.5 || p > box.right + 0.5) continue;
      if (axes.grid) stroke(pen, grid, [[p, box.top], [p, box.bottom]]);
      pen.fillStyle = ink;
      const half = pen.measureText(words).width / 2;
      pen.fillText(words, Math.min(Math.max(p, box.left - 4 + half), box.right - half), box.bottom + 4);
    }
    pen.textBaseline = "middle"; pen.textAlign = "right";
    for (const [at, words] of marks("y")) {
      const p = this.y(at);
      if (p < box.top - 0.5 || p > box.bottom + 0.5) continue;
      if (axes.grid) stroke(pen, grid, [[box.left, p], [box.right, p]]);
      pen.fillStyle = ink;
      const lines = words.split("\n");
      lines.forEach((/** @type {string} */ line, /** @type {number} */ k) => pen.fillText(line, box.left - 5, p + (k - (lines.length - 1) / 2) * 12.5 * em));
    }
    if (!this.compact && axes.xlabel && !axes.equal) {
      pen.textAlign = "right"; pen.textBaseline = "bottom";
      pen.fillText(axisName(axes.xlabel), box.right, box.bottom + 33 * em);
    }
  }

  /** Each labelled mark that is there, once: its name, its value at the position that is shown, its colour, its form.
   * @returns {{words: string, tint: string, form?: string}[]} */
  _legend() {
    const values = new Map(this.now.map(({ mark, value }) => [mark, value]));
    const labels = new Map();
    for (const mark of this.picture.marks) {
      const name = axisName(this.how.words(mark.label)), valued = values.has(mark);
      if (name ? !this._there(mark) : !valued || values.size > 1) continue;
      if (labels.has(name) && (labels.get(name).valued || !valued)) continue;
      const words = `${name} ${valued ? format(values.get(mark), ".4g") : ""}`.trim();
      labels.set(name, { words, valued, tint: this.colour(mark.role, one(mark.index, this.outputs)), form: mark.kind === "points" ? mark.mark : undefined });
    }
    return [...labels.values()];
  }

  /** Whether anything of a mark can be seen. @param {Mark} mark */
  _there(mark) {
    return (REACH[mark.kind] ?? []).flat().every((name) => Array.prototype.some.call(many(mark[name], this.outputs), real));
  }

  /** Where title and names stand, in rows as wide as the canvas. @param {number} width */
  _heading(width) {
    const { pen, axes } = this, unit = /\[(.*)\]\s*$/.exec(axes.ylabel);
    const title = axes.equal || axes.bare || !unit ? axes.title : `${axes.title}  [${pretty(unit[1])}]`;
    this.letters(12, 600);
    let at = pen.measureText(title).width + 16, row = 0;
    this.letters(11);
    const names = [];
    for (const name of this._legend()) {
      const wide = pen.measureText(name.words).width + 28;
      if (at + wide > width - 6 && at > 8) { row += 1; at = 8; }
      names.push({ ...name, at, row });
      at += wide;
    }
    const rows = Math.min(row + 1, this.compact ? 2 : 6);
    const up = axes.equal || axes.bare || axes.yticks ? "" : axes.ylabel.replace(/\s*\[.*?\]/, "").toLowerCase();
    const upward = this.compact || title.toLowerCase().includes(up) ? "" : axisName(axes.ylabel);
    return { title, names: names.filter((name) => name.row < rows), upward, rows: rows + (upward ? 1 : 0) };
  }

  /** The title with its unit, and the names of the marks. @param {number} width */
  _title(width) {
    const { pen, em } = this, { title, names, upward, rows } = this.heading;
    pen.textAlign = "left"; pen.textBaseline = "middle"; pen.globalAlpha = 1;
    this.letters(12, 600); pen.fillStyle = this.colour("ink");
    pen.fillText(title, 4, 9 * em, width - 8);
    this.letters(11);
    for (const { words, tint, form, at, row } of names) {
      const middle = (9 + 15 * row) * em;
      pen.fillStyle = pen.strokeStyle = tint;
      if (form) this._sign(form, at + 6, middle); else pen.fillRect(at, middle - 2, 12, 4);
      pen.fillStyle = this.colour("ink"); pen.fillText(words, at + 16, middle);
    }
    if (upward) {
      this.letters(10.5); pen.fillStyle = this.ink("guide"); pen.textAlign = "left";
      pen.fillText(upward, 4, (15 * rows - 5) * em);
    }
    if (this.picture.still && !this.own) {
      pen.fillStyle = this.ink("guide"); pen.textAlign = "right";
      pen.fillText("of the stored design", width - 8, this.box.bottom - 8);
    }
  }

  /** What points look like, beside their name. @param {string} form @param {number} px @param {number} py */
  _sign(form, px, py) {
    const { pen } = this;
    pen.save(); pen.translate(px, py); pen.beginPath(); FORMS[form](pen, 4);
    pen.lineWidth = 1.4;
    if (["plus", "cross"].includes(form)) pen.stroke(); else pen.fill();
    pen.restore();
  }

  /** @param {Mark} mark @param {ArrayLike<number>[]} outputs */
  _mark(mark, outputs) {
    const pen = this.pen, tint = this.colour(mark.role, one(mark.index, outputs)), role = this.look.roles[mark.role];
    const line = { width: role.width * POINT * 0.9, dashes: role.dashes, cap: "butt" };
    for (const name of (mark.stroke ?? "").split(" ").filter(Boolean)) {
      const style = this.look.strokes[name];
      if (style.width !== null) line.width = style.width * POINT * 0.9;
      if (style.dashes) line.dashes = style.dashes;
      if (style.cap) line.cap = style.cap;
    }
    pen.save();
    if (mark.kind !== "text") { pen.beginPath(); pen.rect(this.box.left - 1, this.box.top - 3, this.box.right - this.box.left + 2, this.box.bottom - this.box.top + 6); pen.clip(); }
    pen.globalAlpha = one(mark.opacity, outputs);
    pen.strokeStyle = pen.fillStyle = tint;
    pen.lineWidth = line.width; pen.lineCap = /** @type {CanvasLineCap} */ (line.cap); pen.lineJoin = "round";
    pen.setLineDash(line.dashes.map((/** @type {number} */ d) => d * line.width));
    const drawn = DRAW[mark.kind](this, mark, outputs, tint);
    pen.restore();
    this.list.marks.push({ key: mark.key, kind: mark.kind, role: mark.role, ...drawn });
  }

  /** A mark of the pinned design, pale. @param {Mark} mark @param {ArrayLike<number>[]} outputs */
  _ghost(mark, outputs) {
    if (!["line", "polygon", "circle"].includes(mark.kind) || mark.role === "limit") return;
    const pen = this.pen;
    pen.save();
    pen.beginPath(); pen.rect(this.box.left, this.box.top, this.box.right - this.box.left, this.box.bottom - this.box.top); pen.clip();
    pen.strokeStyle = this.colour("guide"); pen.lineWidth = 1; pen.setLineDash([4, 3]); pen.globalAlpha = 0.8;
    if (mark.kind === "circle") circle(this, mark, outputs); else trace(this, many(mark.x, outputs), many(mark.y, outputs), Boolean(mark.steps));
    pen.stroke();
    pen.restore();
  }

  /** One line through every curve at the position that is shown. */
  _cursor() {
    const { cursor } = this.how, { pen, box, ends } = this;
    if (cursor === undefined || cursor < ends.x.low || cursor > ends.x.high) return;
    pen.save(); pen.globalAlpha = 0.8; pen.lineWidth = 1.2; pen.setLineDash([]);
    stroke(pen, this.colour("profile"), [[this.x(cursor), box.top], [this.x(cursor), box.bottom]]);
    pen.restore();
    for (const { mark, value } of this.now) {
      pen.beginPath(); pen.fillStyle = this.colour(mark.role, one(mark.index, this.outputs));
      pen.arc(this.x(cursor), this.y(value), 3, 0, 7); pen.fill();
    }
  }

  /** What the curves are at a place of the first axis. @param {number} at @returns {{mark: Mark, value: number}[]} */
  valuesAt(at) {
    const values = [], { low, high } = this.window.y, noise = 1e-9 * (high - low);
    for (const mark of this.picture.marks) {
      if (mark.kind !== "line" || mark.role === "limit" || mark.role === "guide") continue;
      const x = many(mark.x, this.outputs), y = many(mark.y, this.outputs);
      const value = x.length > 2 ? between(x, y, at) : NaN;
      if (real(value)) values.push({ mark, value: Math.abs(value) < noise ? 0 : value });
    }
    return values;
  }

  /** What is to be seen, for those who do not see it: title, what is drawn, from where to where, and what it says. */
  describe() {
    const { axes } = this, { x } = this.ends, near = (/** @type {number} */ v) => format(v, ".3g");
    const names = this.heading.names.map(({ words }) => words), said = this.list.marks.map((/** @type {any} */ m) => m.words);
    const across = axes.bare || axes.xticks ? [] : [`${axisName(axes.xlabel) || "x"} from ${near(x.low)} to ${near(x.high)}`];
    return [this.heading.title, ...names, ...said.filter(Boolean), ...across].join("; ");
  }

  /** Whether a place of the canvas is inside the axes. @param {number} px @param {number} py */
  inside(px, py) {
    const { box } = this;
    return Boolean(box) && px >= box.left && px <= box.right && py >= box.top && py <= box.bottom;
  }

  /** Nearer or farther around a place of the canvas. @param {number} factor @param {number} px @param {number} py */
  zoom(factor, px, py) {
    /** @param {"x"|"y"} name @param {number} pixel @returns {Ends} */
    const about = (name, pixel) => {
      const { low, high, log } = this.ends[name], at = this[name].back(pixel), f = log ? Math.log : Number, g = log ? Math.exp : Number;
      return { low: g(f(at) + (f(low) - f(at)) * factor), high: g(f(at) + (f(high) - f(at)) * factor), log };
    };
    this.zoomed = { x: about("x", px), y: about("y", py) };
  }

  /** Move what is seen by so many pixels. @param {number} dx @param {number} dy */
  pan(dx, dy) {
    /** @param {"x"|"y"} name @param {number} by @returns {Ends} */
    const moved = (name, by) => {
      const { low, high, log } = this.ends[name], f = log ? Math.log : Number, g = log ? Math.exp : Number;
      const step = ((f(high) - f(low)) * by) / (name === "x" ? this.box.right - this.box.left : this.box.bottom - this.box.top);
      return { low: g(f(low) - step), high: g(f(high) - step), log };
    };
    this.zoomed = { x: moved("x", dx), y: moved("y", -dy) };
  }

  /** Everything in sight again. */
  fit() { this.zoomed = this.window = null; }
}

/** Numbers beside an axis. @param {number} value */
const short = (value) => String(+value.toPrecision(6)).replace("-", "\u2212");

/** The name of an axis with its unit as it is printed. @param {string} words */
const axisName = (words) => words.replace(/\[(.*?)\]/, (_, unit) => `[${pretty(unit)}]`);

/** @param {CanvasRenderingContext2D} pen @param {string} tint @param {number[][]} points */
function stroke(pen, tint, points) {
  pen.strokeStyle = tint; pen.beginPath();
  points.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
}

/** What a curve is at a place between its points, which may go either way. @param {ArrayLike<number>} x @param {ArrayLike<number>} y @param {number} at */
function between(x, y, at) {
  for (let i = 1; i < x.length; i++) {
    const [a, b] = [x[i - 1], x[i]];
    if ((a <= at && at <= b) || (b <= at && at <= a)) {
      const value = y.length === 1 ? y[0] : b === a ? y[i] : y[i - 1] + ((y[i] - y[i - 1]) * (at - a)) / (b - a);
      if (real(value)) return value;
    }
  }
  return NaN;
}

/** A path through points; what is no number parts it. @param {Chart} chart @param {ArrayLike<number>} x @param {ArrayLike<number>} y @param {boolean} [steps] */
function trace(chart, x, y, steps = false) {
  const { pen } = chart, n = Math.max(x.length, y.length);
  pen.beginPath();
  for (let i = 0, down = false, last = 0; i < n; i++) {
    const p = chart.x(x.length === 1 ? x[0] : x[i]), q = chart.y(y.length === 1 ? y[0] : y[i]);
    if (!real(p) || !real(q)) { down = false; continue; }
    if (down && steps) pen.lineTo(p, last);
    if (down) pen.lineTo(p, q); else pen.moveTo(p, q);
    down = true; last = q;
  }
}

/** @param {Chart} chart @param {Mark} mark @param {ArrayLike<number>[]} outputs */
function circle(chart, mark, outputs) {
  const [x, y, r] = ["x", "y", "radius"].map((name) => one(mark[name], outputs));
  const px = chart.x(x), py = chart.y(y), pr = Math.abs(chart.x(x + r) - px);
  chart.pen.beginPath();
  if (real(px) && real(py) && real(pr)) chart.pen.arc(px, py, Math.max(pr, 1.5), 0, 2 * Math.PI);
  return { x: [x], y: [y], radius: r };
}

/** Forms of points around 0, their size 2. @type {Record<string, (pen: CanvasRenderingContext2D, r: number) => void>} */
const FORMS = {
  dot: (pen, r) => pen.arc(0, 0, r, 0, 7),
  plus: (pen, r) => { pen.moveTo(-r, 0); pen.lineTo(r, 0); pen.moveTo(0, -r); pen.lineTo(0, r); },
  cross: (pen, r) => { pen.moveTo(-r, -r); pen.lineTo(r, r); pen.moveTo(-r, r); pen.lineTo(r, -r); },
  square: (pen, r) => pen.rect(-r, -r, 2 * r, 2 * r),
  diamond: (pen, r) => { pen.moveTo(0, -1.3 * r); pen.lineTo(r, 0); pen.lineTo(0, 1.3 * r); pen.lineTo(-r, 0); pen.closePath(); },
  triangle: (pen, r) => { pen.moveTo(0, -r); pen.lineTo(r, r); pen.lineTo(-r, r); pen.closePath(); },
  star: (pen, r) => {
    for (let k = 0; k < 10; k++) pen.lineTo((k % 2 ? 0.45 : 1.2) * r * Math.sin((k * Math.PI) / 5), -(k % 2 ? 0.45 : 1.2) * r * Math.cos((k * Math.PI) / 5));
    pen.closePath();
  },
};

/** How each kind of mark is drawn; what it gives stands in the display list, in user units.
 * @type {Record<string, (chart: Chart, mark: Mark, outputs: ArrayLike<number>[], tint: string) => object>} */
const DRAW = {
  line(chart, mark, outputs) {
    const x = many(mark.x, outputs), y = many(mark.y, outputs);
    trace(chart, x, y, Boolean(mark.steps));
    chart.pen.stroke();
    return { x, y };
  },
  polygon(chart, mark, outputs) {
    const x = many(mark.x, outputs), y = many(mark.y, outputs);
    trace(chart, x, y);
    chart.pen.fill("evenodd");
    if (mark.edged) { chart.pen.closePath(); chart.pen.stroke(); }
    return { x, y };
  },
  area(chart, mark, outputs) {
    const [x, low, high] = ["x", "low", "high"].map((name) => many(mark[name], outputs));
    trace(chart, [...Array.from(x), ...Array.from(x).reverse()], [...Array.from(low), ...Array.from(high).reverse()]);
    chart.pen.fill();
    return { x, low, high };
  },
  band(chart, mark, outputs) {
    const { pen, box } = chart, [low, high] = [one(mark.low, outputs), one(mark.high, outputs)];
    const along = mark.along === "x" ? chart.y : chart.x, [a, b] = [along(low), along(high)].sort((p, q) => p - q);
    pen.beginPath();
    if (mark.along === "x") pen.rect(box.left, a, box.right - box.left, b - a); else pen.rect(a, box.top, b - a, box.bottom - box.top);
    pen.fill(); pen.globalAlpha = 1; pen.stroke();
    return { low, high };
  },
  points(chart, mark, outputs, tint) {
    const { pen } = chart, x = many(mark.x, outputs), y = many(mark.y, outputs), r = (one(mark.size, outputs) / 2) * POINT * 0.9;
    const open = ["plus", "cross"].includes(mark.mark);
    pen.lineWidth = mark.size > 6 ? 2 : 1.4; pen.setLineDash([]);
    for (let i = 0; i < Math.max(x.length, y.length); i++) {
      const [p, q] = [chart.x(x[x.length === 1 ? 0 : i]), chart.y(y[y.length === 1 ? 0 : i])];
      if (!real(p) || !real(q)) continue;
      pen.save(); pen.translate(p, q); pen.beginPath(); FORMS[mark.mark](pen, r);
      pen.fillStyle = mark.fill === "paper" ? chart.colour("paper") : tint;
      if (!open && mark.fill !== "none") pen.fill();
      if (open || mark.fill !== "full") pen.stroke();
      pen.restore();
    }
    return { x, y };
  },
  circle(chart, mark, outputs) {
    const drawn = circle(chart, mark, outputs);
    chart.pen.stroke();
    return drawn;
  },
  text(chart, mark, outputs, tint) {
    const { pen } = chart, [x, y] = [one(mark.x, outputs), one(mark.y, outputs)], words = chart.how.words(mark.words);
    const [p, q] = [chart.x(x), chart.y(y)], at = mark.anchor.split(" "), size = mark.size * 1.1 * chart.em;
    if (!real(p) || !real(q)) return { x: [x], y: [y], words: "" };
    const across = at.includes("left") ? "left" : at.includes("right") ? "right" : "center";
    const upright = at.includes("top") ? "top" : at.includes("bottom") ? "bottom" : "middle";
    pen.font = `${mark.bold ? 600 : 400} ${size}px ${LETTERS}`;
    pen.textAlign = /** @type {CanvasTextAlign} */ (across); pen.textBaseline = /** @type {CanvasTextBaseline} */ (upright);
    const lines = words.split("\n"), wide = Math.max(...lines.map((line) => pen.measureText(line).width)), tall = lines.length * size * 1.25;
    if (mark.boxed || mark.framed) {
      const left = across === "left" ? p : across === "right" ? p - wide : p - wide / 2;
      const top = upright === "top" ? q : upright === "bottom" ? q - tall : q - tall / 2;
      pen.globalAlpha = 0.85; pen.fillStyle = chart.colour("paper"); pen.fillRect(left - 3, top - 1, wide + 6, tall + 2);
      if (mark.framed) { pen.lineWidth = 1; pen.strokeRect(left - 3, top - 1, wide + 6, tall + 2); }
      pen.globalAlpha = 1;
    }
    pen.fillStyle = mark.framed ? chart.colour("ink") : READABLE[mark.role] ? chart.ink(mark.role) : tint;
    const first = q - (upright === "top" ? 0 : upright === "bottom" ? tall - size * 1.25 : (tall - size * 1.25) / 2);
    lines.forEach((line, k) => pen.fillText(line, p, first + k * size * 1.25));
    return { x: [x], y: [y], words };
  },
};
