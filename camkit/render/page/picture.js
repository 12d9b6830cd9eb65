// Draws pictures as data on a canvas: axes, and marks with roles.  It knows neither cams nor their numbers.
import { format, pretty } from "./numbers.js";
import { DRAW, FORMS, LETTERS, POINT, REACH, circle, found, many, one, real, stroke, trace } from "./marks.js";
import { between, degreeTicks, logTicks, scale, short, ticks } from "./scales.js";

/**
 * @typedef {import("./marks.js").Mark} Mark
 * @typedef {import("./marks.js").Picture} Picture
 * @typedef {import("./marks.js").Ends} Ends
 */

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
   * @param {{dark: boolean, cursor?: number, ghost?: ArrayLike<number>[], settled?: boolean, words: (text: any) => string,
   *   units?: {of(unit: string): import("./units.js").Shown}}} how */
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
    this.axes = { ...axes, title, xlabel: this._measured(xlabel, "x"), ylabel: this._measured(ylabel, "y") };
    const marks = [...this.picture.marks].map((mark) => ({ mark, height: one(mark.height, outputs) }));
    marks.sort((a, b) => a.height - b.height);
    this.window = this._window(outputs, Boolean(how.settled));
    this.now = how.cursor === undefined ? [] : this.valuesAt(how.cursor);
    this._place(width, height);
    this._frame();
    this.list = { name: this.picture.name, window: { ...this.window }, marks: [], troubles: [] };
    if (how.ghost) for (const { mark } of marks) this._ghost(mark, how.ghost);
    for (const { mark } of marks) this._mark(mark, outputs);
    if (axes.equal) this._nameTroubles(marks.map(({ mark }) => mark).filter(({ role, kind }) => role === "trouble" && kind === "line"));
    this._cursor();
    this._title(width);
  }

  /** How many of the units that are shown one of the picture's own is. */
  per = { x: 1, y: 1 };

  /** The name of an axis in the unit that is shown. @param {string} words @param {"x"|"y"} name */
  _measured(words, name) {
    const own = UNIT.exec(words)?.[1], shown = own && this.how.units?.of(own);
    this.per[name] = shown ? shown.ratio : 1;
    return shown ? words.replace(UNIT, `[${pretty(shown.unit)}]`) : axisName(words);
  }

  /** What was drawn last, in the units that are shown. */
  shown() {
    const { x, y } = this.per, { list } = this;
    if (!list || (x === 1 && y === 1)) return list;
    /** @type {Record<string, number>} */ const by = { x, y, radius: x, low: y, high: y };
    const times = (/** @type {any} */ value, /** @type {number} */ ratio) =>
      (ratio === 1 ? value : typeof value === "number" ? value * ratio : Array.from(value, (/** @type {number} */ v) => v * ratio));
    const ends = (/** @type {Ends} */ { low, high, log }, /** @type {number} */ ratio) => ({ low: low * ratio, high: high * ratio, log });
    const marks = list.marks.map((/** @type {any} */ mark) => Object.fromEntries(Object.entries(mark).map(([part, value]) =>
      [part, part in by ? times(value, mark.along === "y" ? x : by[part]) : value])));
    return { ...list, window: { x: ends(list.window.x, x), y: ends(list.window.y, y) }, marks };
  }

  /** The colour of a role. @param {string} role @param {number} [index] */
  colour(role, index = 0) {
    const theme = this.how.dark ? "dark" : "light";
    return role === "series" ? this.look.series[theme][index % 20] : this.look.roles[role][theme];
  }

  /** The colour of letters in a role. @param {string} role @param {number} [index] */
  ink(role, index = 0) {
    const theme = this.how.dark ? "dark" : "light";
    return role === "series" ? this.look.seriesLetters[theme][index % 20] : this.look.letters[theme][role];
  }

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
    const drawn = ["line", "area", "polygon"];
    const scattered = !this.picture.marks.some(({ kind, role }) => drawn.includes(kind) && role !== "guide" && role !== "limit");
    /** @param {"x"|"y"} name */
    const ends = (name) => {
      const asked = found(axes[`${name}lim`], outputs) ?? [null, null], log = axes.log.includes(name);
      let [low, high] = reach[name];
      if (!(low <= high)) [low, high] = log ? [0.1, 1] : [0, 1];
      const free = axes.equal || (name === "x" && scattered) ? 0.04 : name === "x" ? 0 : 0.06;
      const margin = log ? 0 : free * (high - low) || (high === low ? Math.abs(low) * 0.1 || 1 : 0);
      const fit = { low: low - margin, high: high + margin, log };
      const before = this.window?.[name], span = before ? before.high - before.low : 0;
      const alike = before && !log && high - low > (settled ? 0.6 : 0.25) * span && high - low < 4 * span;
      if (alike && low >= before.low && high <= before.high) Object.assign(fit, { low: before.low, high: before.high });
      else if (alike && !settled) Object.assign(fit, { low: Math.min(before.low, fit.low), high: Math.max(before.high, fit.high) });
      else if (!log && !axes.equal && name === "y" && fit.high > fit.low) {
        const per = this.per.y, marks = ticks(fit.low * per, fit.high * per, 8); // round as they are shown
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

  /** Room for title and numbers, and the scales. @param {number} width @param {number} height */
  _place(width, height) {
    const { axes } = this, { x, y } = this.window, small = this.compact;
    const bare = axes.bare, named = !small && axes.xlabel && !axes.equal, { em } = this;
    this.heading = this._heading(width);
    this.letters(10.5);
    const names = Object.values(axes.yticks ?? {}).flatMap((words) => this.how.words(words).split("\n"));
    const ticked = Math.max(0, ...names.map((line) => this.pen.measureText(line).width)), below = bare ? 6 : (named ? 34 : 18) * em;
    const left = bare ? 6 : axes.yticks ? Math.min(10 + ticked, 0.48 * width) : 44 * em;
    const box = { left, right: width - 8, top: this.heading.rows * 15 * em + 7, bottom: height - below };
    let ends = { x, y };
    if (axes.equal) {
      const across = box.right - box.left, up = box.bottom - box.top;
      const unit = Math.max((x.high - x.low) / across, (y.high - y.low) / up) || 1;
      const middle = (/** @type {Ends} */ { low, high }, /** @type {number} */ span) =>
        ({ low: (low + high - span) / 2, high: (low + high + span) / 2, log: false });
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
      const ratio = this.per[name], { log } = ends[name], [low, high] = [ends[name].low * ratio, ends[name].high * ratio];
      const long = name === "x" ? box.right - box.left : box.bottom - box.top;
      const apart = axes.equal ? Math.max(60 * em, (box.right - box.left) / 10, (box.bottom - box.top) / 10) : 60 * em;
      const room = axes.equal || name === "x" ? long / apart : Math.min(long / (34 * em), 4.5);
      if (log) return logTicks(low, high, room).map((v) => [v / ratio, short(v)]);
      const degrees = name === "x" && /\[°\]/.test(axes.xlabel) && high - low > 60;
      return (degrees ? degreeTicks(low, high, room) : ticks(low, high, room)).map((v) => [v / ratio, short(v)]);
    };
    pen.textBaseline = "top"; pen.textAlign = "center";
    const below = marks("x").filter(([at]) => this.x(at) > box.left - 0.5 && this.x(at) < box.right + 0.5).map(([at, words]) => {
      const half = pen.measureText(words).width / 2, middle = Math.min(Math.max(this.x(at), box.left - 4 + half), box.right - half);
      return { at, words, middle, left: middle - half, right: middle + half };
    });
    const named = this._named(below);
    pen.fillStyle = ink;
    for (const { at, words, middle, left, right } of below) {
      if (axes.grid) stroke(pen, grid, [[this.x(at), box.top], [this.x(at), box.bottom]]);
      if (!named || right < named.left || left > named.right) pen.fillText(words, middle, box.bottom + 4);
    }
    if (named) pen.fillText(axes.xlabel, (named.left + named.right) / 2, box.bottom + 4);
    pen.textBaseline = "middle"; pen.textAlign = "right";
    for (const [at, words] of marks("y")) {
      const p = this.y(at);
      if (p < box.top - 0.5 || p > box.bottom + 0.5) continue;
      if (axes.grid) stroke(pen, grid, [[box.left, p], [box.right, p]]);
      pen.fillStyle = ink;
      const lines = words.split("\n"), first = p - ((lines.length - 1) / 2) * 12.5 * em;
      lines.forEach((/** @type {string} */ line, /** @type {number} */ k) => pen.fillText(line, box.left - 5, first + k * 12.5 * em, box.left - 7));
    }
    if (!this.compact && axes.xlabel && !axes.equal) {
      pen.textAlign = "right"; pen.textBaseline = "bottom";
      pen.fillText(axes.xlabel, box.right, box.bottom + 33 * em);
    }
  }

  /** Where the name of the first axis stands in a small picture: before its last number, if there is room between that and
   * the first one. @param {{left: number, right: number}[]} below the numbers */
  _named(below) {
    const { axes, pen } = this, apart = 6, wide = pen.measureText(axes.xlabel).width;
    if (!this.compact || axes.equal || !axes.xlabel || below.length < 2) return null;
    const right = below[below.length - 1].left - apart;
    return right - wide - apart > below[0].right ? { left: right - wide, right } : null;
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
      const words = `${name} ${valued ? format(values.get(mark) * this.per.y, ".4g") : ""}`.trim();
      const tint = this.colour(mark.role, one(mark.index, this.outputs)), form = mark.kind === "points" ? mark.mark : undefined;
      labels.set(name, { words, valued, tint, form });
    }
    return [...labels.values()];
  }

  /** Whether anything of a mark can be seen. @param {Mark} mark */
  _there(mark) {
    return (REACH[mark.kind] ?? []).flat().every((name) => Array.prototype.some.call(many(mark[name], this.outputs), real));
  }

  /** Where title and names stand, in rows as wide as the canvas. @param {number} width */
  _heading(width) {
    const { pen, axes } = this, unit = UNIT.exec(axes.ylabel);
    const up = axes.equal || axes.bare || axes.yticks ? "" : axes.ylabel.replace(/\s*\[.*?\]/, "").toLowerCase();
    const upward = this.compact || axes.title.toLowerCase().includes(up) ? "" : axisName(axes.ylabel);
    const title = axes.equal || axes.bare || !unit || upward ? axes.title : `${axes.title}  [${unit[1]}]`; // said once
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
      pen.fillText(upward, 4, (15 * rows - 5) * em, width - 8);
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
    if (mark.kind !== "text") this._clip(1, 3);
    pen.globalAlpha = one(mark.opacity, outputs);
    pen.strokeStyle = pen.fillStyle = tint;
    pen.lineWidth = line.width; pen.lineCap = /** @type {CanvasLineCap} */ (line.cap); pen.lineJoin = "round";
    pen.setLineDash(line.dashes.map((/** @type {number} */ d) => d * line.width));
    const drawn = DRAW[mark.kind](this, mark, outputs, tint);
    pen.restore();
    this.list.marks.push({ key: mark.key, kind: mark.kind, role: mark.role, ...drawn });
  }

  /** The name of what is wrong beside each place; of several flanks one may bear it for all. @param {Mark[]} marks */
  _nameTroubles(marks) {
    const words = this.how.words(marks.find(({ label }) => label)?.label ?? "");
    for (const mark of words ? marks : []) this._nameTrouble(mark, words);
  }

  /** @param {Mark} mark @param {string} words */
  _nameTrouble(mark, words) {
    const { pen, box, em } = this, x = many(mark.x ?? [], this.outputs), y = many(mark.y ?? [], this.outputs);
    const there = Array.from(x, (v, i) => i).filter((i) => real(x[i]) && real(y[i])), i = there[there.length >> 1];
    if (i === undefined) return;
    this.letters(11, 600);
    const left = Math.min(this.x(x[i]) + 9, box.right - pen.measureText(words).width), up = Math.max(this.y(y[i]) - 9, box.top + 8 * em);
    pen.textAlign = "left"; pen.textBaseline = "middle"; pen.lineWidth = 3; pen.setLineDash([]);
    pen.strokeStyle = this.colour("paper"); pen.strokeText(words, left, up);
    pen.fillStyle = this.ink("trouble"); pen.fillText(words, left, up);
    this.list.troubles.push({ words, x: x[i], y: y[i] });
  }

  /** Draw inside the axes only, and so far around them. @param {number} across @param {number} up */
  _clip(across, up) {
    const { pen, box: { left, right, top, bottom } } = this;
    pen.beginPath();
    pen.rect(left - across, top - up, right - left + 2 * across, bottom - top + 2 * up);
    pen.clip();
  }

  /** A mark of the pinned design, pale. @param {Mark} mark @param {ArrayLike<number>[]} outputs */
  _ghost(mark, outputs) {
    if (!["line", "polygon", "circle"].includes(mark.kind) || mark.role === "limit") return;
    const pen = this.pen;
    pen.save();
    this._clip(0, 0);
    pen.strokeStyle = this.colour("guide"); pen.lineWidth = 1; pen.setLineDash([4, 3]); pen.globalAlpha = 0.8;
    if (mark.kind === "circle") circle(this, mark, outputs);
    else trace(this, many(mark.x, outputs), many(mark.y, outputs), Boolean(mark.steps));
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
    const reach = `${axes.xlabel || "x"} from ${near(x.low * this.per.x)} to ${near(x.high * this.per.x)}`;
    const across = axes.bare || axes.xticks ? [] : [reach];
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

/** The unit in an axis's name. */
const UNIT = /\[(.*?)\]/;

/** The name of an axis with its unit as it is printed. @param {string} words */
const axisName = (words) => words.replace(UNIT, (_, unit) => `[${pretty(unit)}]`);
