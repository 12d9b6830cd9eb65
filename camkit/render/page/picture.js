// Draws pictures as data on a canvas: axes, and marks with roles.  It knows neither cams nor their numbers.
import { format, pretty } from "./numbers.js";
import { DRAW, LETTERS, POINT, circle, given, many, one, real, stroke, trace, widthOf } from "./marks.js";
import { between, scale } from "./scales.js";
import { UNIT, axisName, headingOf, title } from "./heading.js";
import { frame, windowOf } from "./axes.js";

/**
 * @typedef {import("./marks.js").Mark} Mark
 * @typedef {import("./marks.js").Picture} Picture
 * @typedef {import("./marks.js").Ends} Ends
 * @typedef {{dark: boolean, cursor?: number, ghost?: {picture: Picture, outputs: ArrayLike<number>[]}, settled?: boolean, older?: boolean, words: (text: any) => string,
 *   low?: number, units?: {of(unit: string): import("./units.js").Shown}}} How pictures lower than `low` are compact, one that is
 *   `older` says so
 */

/** One picture on its canvas. */
export class Chart {
  /** @param {HTMLCanvasElement} canvas @param {Picture} picture @param {any} look */
  constructor(canvas, picture, look) {
    Object.assign(this, { canvas, picture, look, window: null, zoomed: null, size: null });
    /** What was drawn last, in user units. @type {any} */
    this.list = null;
    this.compact = false;
    /** Of pictures: the places of the outputs that they name. @type {WeakMap<Picture, number[]>} */ this.given = new WeakMap();
    /** The size of letters, as a share of what it mostly is. */
    this.em = 1;
    /** What is drawn, without what moves over it, as soon as it is needed twice. @type {HTMLCanvasElement | null} */
    this.under = null;
  }

  /** Draw what the program gave: all of it if anything in it is new, else only what moves over it.
   * @param {ArrayLike<number>[]} outputs @param {How} how */
  draw(outputs, how) {
    if (!this.size) this._measure();
    const { width, height } = this.size;
    if (!width || !height) { this.size = null; return; } // it is hidden, and has another one when it is not
    const same = this._same(outputs, how), at = this.how?.cursor, rows = this.heading?.rows;
    Object.assign(this, { outputs, how });
    if (same && at === how.cursor) return;
    if (!same) this._read(outputs);
    this.now = how.cursor === undefined ? [] : this.valuesAt(how.cursor);
    this.heading = headingOf(this, width);
    if (same && rows === this.heading.rows) this._again();
    else { this.kept = false; this._pen(this.canvas); this._still(); }
    this._cursor();
    title(this, width);
  }

  /** The size of the canvas, which is known until `size` is forgotten: to ask for it lays the page out. */
  _measure() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.size = { width, height };
  }

  /** Whether the picture is as it was drawn last, but for what moves over it. @param {ArrayLike<number>[]} outputs @param {How} how */
  _same(outputs, how) {
    const { picture, size, em, zoomed } = this, { dark, units, ghost, older } = how;
    const places = this._placesOf(picture), was = this.from;
    this.compact = size.height < (how.low ?? 0);
    this.from = [picture, size.width, size.height, globalThis.devicePixelRatio, em, zoomed, dark, units?.name, !ghost, older,
      ...places.map((at) => outputs[at]), ...(ghost ? this._placesOf(ghost.picture).map((at) => ghost.outputs[at]) : [])];
    return !how.settled && was?.length === this.from.length && this.from.every((part, k) => part === was[k]);
  }

  /** The places of the outputs that a picture names. @param {Picture} picture @returns {number[]} */
  _placesOf(picture) {
    let places = this.given.get(picture);
    if (!places) this.given.set(picture, places = [...given(picture)]);
    return places;
  }

  /** What outputs say of axes and marks. @param {ArrayLike<number>[]} outputs */
  _read(outputs) {
    const { axes } = this.picture, [name, xlabel, ylabel] = [axes.title, axes.xlabel, axes.ylabel].map(this.how.words);
    this.axes = { ...axes, title: name, xlabel: this._measured(xlabel, "x"), ylabel: this._measured(ylabel, "y") };
    this.marks = this.picture.marks.map((mark) => ({ mark, height: one(mark.height, outputs) }))
      .sort((a, b) => a.height - b.height).map(({ mark }) => mark);
    this.window = windowOf(this, outputs, Boolean(this.how.settled));
  }

  /** Begin to draw on a canvas. @param {HTMLCanvasElement} canvas */
  _pen(canvas) {
    const ratio = globalThis.devicePixelRatio || 1, { width, height } = this.size;
    const [across, up] = [width, height].map((pixels) => Math.round(pixels * ratio));
    if (canvas.width !== across || canvas.height !== up) Object.assign(canvas, { width: across, height: up });
    this.pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.pen.clearRect(0, 0, width, height);
  }

  /** Everything but what moves over it. */
  _still() {
    const { picture, outputs, marks, how: { ghost }, size: { width, height } } = this;
    this._place(width, height);
    frame(this);
    this.list = { name: picture.name, window: { ...this.window }, marks: [], troubles: [] };
    if (ghost) for (const mark of ghost.picture.marks) this._ghost(mark, ghost.outputs);
    for (const mark of marks) this._mark(mark, outputs);
    if (picture.axes.equal) this._nameTroubles(marks.filter(({ role, kind }) => role === "trouble" && kind === "line"));
  }

  /** The same once more: it is drawn beside the canvas the first time, and copied from there. */
  _again() {
    this.under ??= document.createElement("canvas");
    if (!this.kept) { this._pen(this.under); this._still(); this.kept = true; }
    this._pen(this.canvas);
    this.pen.drawImage(this.under, 0, 0, this.size.width, this.size.height);
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
  font(size, weight = 400) { return `${weight} ${size * this.em}px ${LETTERS}`; }

  /** Room for title and numbers, and the scales. @param {number} width @param {number} height */
  _place(width, height) {
    const { axes } = this, { x, y } = this.window, small = this.compact;
    const bare = axes.bare, named = !small && axes.xlabel && !axes.equal, { em } = this;
    const font = this.font(10.5), names = Object.values(axes.yticks ?? {}).flatMap((words) => this.how.words(words).split("\n"));
    const ticked = Math.max(0, ...names.map((line) => widthOf(font, line))), below = bare ? 6 : (named ? 34 : 18) * em;
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
    const { pen, box, em } = this, x = many(mark.x ?? [], this.outputs), y = many(mark.y ?? [], this.outputs), there = [];
    for (let k = 0; k < x.length; k++) if (real(x[k]) && real(y[k])) there.push(k);
    if (!there.length) return;
    const i = there[there.length >> 1];
    const font = pen.font = this.font(11.5, 600), [px, py] = [this.x(x[i]), this.y(y[i])], ring = 7 * em;
    const left = Math.min(px + 22 * em, box.right - widthOf(font, words)), up = Math.max(py - 22 * em, box.top + 8 * em);
    pen.textAlign = "left"; pen.textBaseline = "middle"; pen.lineJoin = "round"; pen.setLineDash([]);
    for (const [tint, wide] of [[this.colour("paper"), 5], [this.colour("trouble"), 2]]) { // with a halo
      pen.lineWidth = wide;
      stroke(pen, tint, [[px + 0.7 * ring, py - 0.7 * ring], [left - 2, up]]);
      pen.beginPath(); pen.arc(px, py, ring, 0, 7); pen.stroke();
    }
    pen.lineWidth = 5; pen.strokeStyle = this.colour("paper"); pen.strokeText(words, left, up);
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
