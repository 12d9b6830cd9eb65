// A small instrument: parts below each other and their pictures, as the kernel says; by itself or as a tab of a panel.
import { make } from "./controls.js";
import { PARTS } from "./parts.js";
import { Chart } from "./picture.js";
import { fill } from "./numbers.js";
import { placeOf, say, under, zooms } from "./pointer.js";
import { copy, download } from "./files.js";
import { PATIENCE, arrays, atTheEnd } from "./kernel.js";
import { many } from "./marks.js";
import { Theme } from "./theme.js";
import { Units } from "./units.js";

/**
 * @typedef {{get(name: string): any, send(message: any, callbacks?: any, buffers?: ArrayBuffer[]): void,
 *   on(event: string, act: Function): void, off(event: string, act: Function): void, stored?: boolean}} Model
 */

const UNITED = /(?<![A-Za-z])(?:mm|inch|deg|rad|N|lbf|MPa|kg|W)(?![A-Za-z])/; // units that others stand for
const ROOM = 850; // pixels of a window that has room for what else stands folded

const GONE = "The kernel has ended: run the cell again to go on.";

export class Sheet {
  /** @param {HTMLElement} root @param {Model} model what the kernel says, or what a file holds
   * @param {import("./panel.js").Panel | null} [panel] the panel whose tab it is */
  constructor(root, model, panel = null) {
    Object.assign(this, { root, model, panel, asked: 0, sentAt: 0 });
    const { look, units } = model.get("setting");
    Object.assign(this, { look, own: new Units({ units, quantities: [], measures: [] }) });
    this.shows = { known: units, of: (/** @type {string} */ unit) => this.units.of(unit) };
    /** @type {Map<number, {part: any, text: string, sent: number}>} */ this.parts = new Map();
    /** What waits to be sent: the newest of all that is done alike with a part. @type {Map<string, any>} */ this.waiting = new Map();
    root.classList.add("camkit-sheet");
    /** The box that a person types in. @type {any} */ this.typing = null;
    root.addEventListener("input", ({ target }) => { if (/** @type {any} */ (target).type === "text") this.typing = target; });
    this.theme = new Theme(root, () => this.draw());
    this.resized = new ResizeObserver(() => this.draw());
    this.resized.observe(root);
    this.heard = {
      "change:body": () => this.show(),
      "msg:custom": (/** @type {any} */ message, /** @type {DataView[]} */ [data] = []) => {
        if ((message.name ?? message.copy) === undefined || !this.spoke) return; // another view of the sheet asked for it
        this.spoke = false;
        if (message.copy === undefined) download(message.name, new Blob([data ?? message.text], { type: message.mime }));
        else void copy(message.copy);
      },
      "comm_live_update": () => this._gone(), // it happens once more after the beginning: at the end
    };
    this.unhear = atTheEnd(model, () => this._gone());
    for (const [event, act] of Object.entries(this.heard)) model.on(event, act);
    root.classList.toggle("camkit-stored", Boolean(model.stored));
    this.show();
  }

  /** No kernel hears what is done any more. */
  _gone() { this.root.dataset.gone = GONE; }

  /** Leave the page. */
  end() {
    for (const [event, act] of Object.entries(this.heard)) this.model.off(event, act);
    this.unhear(); this.theme.end();
    this.resized.disconnect(); this.root.replaceChildren(); this.ended = true;
  }

  /** A design of a picture under the pointer, or none: the panel shows it beside its own. @param {Float64Array | null} design */
  preview(design) { void this.panel?.preview(design); }

  /** A design of a picture is taken, where no kernel does it. @param {Float64Array} design */
  choose(design) { if (this.model.stored) this.panel?.load(design); }

  /** A text, its numbers in the units that are shown. @param {string} text */
  words = (text) => this.units.words(text);

  /** In which units numbers are shown: those of the panel, if it is a tab of one, else its own. */
  get units() { return this.panel?.units ?? this.own; }

  /** A menu for the units of a sheet by itself, as soon as anything in it has one. @param {any} body */
  _offerUnits(body) {
    const { own, model } = this, axes = [...this.parts.keys()].flatMap((id) => model.get(`picture_${id}`) ?? []).map(({ picture }) => picture.axes);
    if (this.menu || this.panel || model.stored || !UNITED.test(JSON.stringify([body, axes]))) return;
    this.menu = make("select", { class: "camkit-units", "aria-label": "units of this sheet", onchange: () => { own.use(this.menu.value); this.measure(); } },
      ...own.names.map((name) => make("option", { value: name }, name)));
    this.root.append(this.menu);
  }

  /** Show all numbers in other units. */
  measure() {
    for (const { part, text } of this.parts.values()) {
      if (text) this._show(part, JSON.parse(text));
      for (const chart of part.charts ?? []) chart.window = null; // its ends are round numbers
    }
    this.draw();
  }

  dark = () => this.theme.dark;

  /** What is shown: the state of each part, and of each picture its window and marks in user units. */
  shown() {
    const charts = [...this.parts.values()].flatMap(({ part }) => part.charts ?? []);
    return { body: this.model.get("body"), pictures: charts.map((chart) => chart.shown()) };
  }

  /** Show what the kernel says. */
  show() {
    const body = this.model.get("body"), heading = this.model.get("heading");
    if (this.ended || !body.kind) return; // the kernel opens a sheet first and fills it then; a page may show it between
    this.heading ??= make("h3", {}, heading);
    this.heading.hidden = !heading;
    this.answered = body.heard;
    this.asked = Math.max(this.asked, body.heard); // other views of the sheet count on
    this.seen = new Set();
    const top = this._part(body).element;
    if (top.parentElement !== this.root) this.root.replaceChildren(this.heading, top, ...(this.menu ? [this.menu] : []));
    this._offerUnits(body);
    for (const id of this.parts.keys()) if (!this.seen.has(id)) this.parts.delete(id);
    for (const [key, { id }] of this.waiting) if (!this.seen.has(id)) this.waiting.delete(key);
    this._sendNext();
    this.draw();
  }

  /** The part of a state, made once; what a person has just done with it and the kernel has not heard stays.
   * @param {any} state */
  _part(state) {
    const { children, ...own } = state;
    this.seen.add(state.id);
    let known = this.parts.get(state.id);
    if (!known) {
      const make_ = KINDS[state.kind] ?? PARTS[state.kind];
      known = { part: null, text: "", sent: -1 };
      known.part = make_(own, this._for(state.id));
      this.parts.set(state.id, known);
    }
    const text = JSON.stringify(own), done = known.sent >= 0 && known.sent <= this.answered;
    if (known.sent < 0 || state.kind === "picture" ? text !== known.text : done) { known.text = text; known.sent = -1; this._show(known.part, own); }
    known.part.element.hidden = !state.visible || (state.kind === "table" && !state.head.length);
    if (children) hold(known.part.inside, children.map((/** @type {any} */ child) => this._part(child).element));
    return known.part;
  }

  /** Another state of a part; a text that is being typed stays. @param {any} part @param {any} state */
  _show(part, state) {
    const box = part.element.contains(this.typing) && this.typing.matches(":focus") ? this.typing : null, text = box?.value;
    part.show(state);
    if (box) box.value = text;
  }

  /** What a part needs of its sheet. @param {number} id */
  _for(id) {
    return {
      units: this.shows, words: this.words, look: this.look, dark: this.dark, sheet: this, id,
      say: (/** @type {any} */ done, /** @type {ArrayBuffer[]} */ buffers = []) => {
        const known = this.parts.get(id), key = `${id} ${done.does ?? ""}`; // a click is not lost because a release comes after it
        if (known) known.sent = Infinity;
        if (known?.part?.element.contains(this.typing)) this.typing = null; // it is taken
        this.waiting.delete(key);
        this.waiting.set(key, { id, done, buffers });
        this._sendNext();
      },
    };
  }

  /** One message at a time; a kernel that does not answer is asked again later. */
  _sendNext() {
    const free = this.answered >= this.asked || performance.now() - this.sentAt > PATIENCE, [next] = this.waiting;
    if (!free || !next) return;
    const [key, { id, done, buffers }] = next;
    this.waiting.delete(key);
    this.sentAt = performance.now();
    this.parts.get(id).sent = ++this.asked;
    this.spoke = true;
    this.model.send({ ...done, part: id, count: this.asked }, undefined, buffers);
  }

  /** Draw every picture in the next frame. */
  draw() {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      this.root.classList.toggle("camkit-dark", this.dark());
      this.root.classList.toggle("camkit-wide", this.root.clientWidth >= 760);
      for (const { part } of this.parts.values()) part.draw?.();
    });
  }
}

/** The same children without touching those that stay. @param {HTMLElement} parent @param {HTMLElement[]} children */
function hold(parent, children) {
  if (children.length !== parent.children.length || children.some((child, k) => parent.children[k] !== child)) parent.replaceChildren(...children);
}

/** Parts that only a sheet has. @type {Record<string, (state: any, sheet: any) => any>} */
const KINDS = {
  group({ look: kind }, { sheet }) {
    const inside = make("div", {}), folds = ["fold", "room"].includes(kind), name = make("summary", { tabindex: "0" });
    const element = folds ? make("details", { class: "camkit-fold", open: kind === "room" && innerHeight >= ROOM, ontoggle: () => sheet.draw() }, name, inside) : inside;
    return { element, inside, show(/** @type {any} */ { row, look, description, open }) {
      inside.className = `camkit-group ${row ? "camkit-line" : ""} ${look && !folds ? look.replace(/\w+/g, "camkit-$&") : ""}`;
      if (folds) { name.textContent = description; element.open ||= open; }
      else if (description) { element.setAttribute("role", "group"); element.setAttribute("aria-label", description); }
    } };
  },

  picture(_, { sheet, say, look, dark, words, units }) {
    const element = make("div", { class: "camkit-pictures" }), tip = make("div", { class: "camkit-tip", hidden: true });
    /** @type {any} */ const part = { element, charts: [] };
    part.draw = () => {
      for (const chart of part.charts) {
        chart.size = null; // whatever made this sheet draw may have laid it out anew
        if (!chart.canvas.clientWidth) continue;
        chart.em = parseFloat(getComputedStyle(element).fontSize) / 13;
        const said = (/** @type {any} */ text) => words(typeof text === "string" ? text : fill(text, chart.own));
        chart.draw(chart.own, { dark: dark(), settled: true, words: said, units, low: 165 * chart.em });
        chart.canvas.setAttribute("aria-label", chart.describe());
      }
    };
    part.show = (/** @type {any} */ { id, pixels, description, pointing, movable }) => {
      const made = sheet.model.get(`picture_${id}`) ?? [];
      if (made.length !== part.charts.length) {
        part.charts = made.map((/** @type {any} */ one, /** @type {number} */ k) => pointed(new Chart(make("canvas", { role: "img", tabindex: "0" }), one.picture, look), k, tip, part, say, sheet));
        element.replaceChildren(...part.charts.map((/** @type {Chart} */ chart) => chart.canvas), tip);
      }
      Object.assign(part, { pointing, movable });
      element.style.setProperty("--tall", String(pixels));
      element.setAttribute("role", "group"); element.setAttribute("aria-label", description);
      part.charts.forEach((/** @type {Chart} */ chart, /** @type {number} */ k) => {
        const { axes } = made[k].picture, named = (/** @type {any} */ of) => JSON.stringify([of.xlabel, of.ylabel]);
        if (named(axes) !== named(chart.picture.axes)) chart.fit(); // other quantities: the ends of the last ones say nothing
        chart.canvas.style.touchAction = pointing === "drag" || axes.equal ? "none" : "pan-y"; // past curves the page scrolls
      });
      made.forEach((/** @type {any} */ one, /** @type {number} */ k) => Object.assign(part.charts[k], { picture: one.picture, own: arrays(one.arrays), offered: one.offered && arrays(one.offered) }));
      sheet.draw();
    };
    return part;
  },
};

/** What the pointer does in a picture: hover for values; click and drag for the kernel, else pan and zoom.
 * @param {Chart} chart @param {number} view @param {HTMLElement} tip @param {any} part @param {any} say @param {Sheet} sheet */
function pointed(chart, view, tip, part, say, sheet) {
  const { canvas } = chart, draw = () => sheet.draw(), pointing = () => part.pointing;
  /** @type {number[] | null} */ let from = null;
  let moved = false, holding = false;
  /** Where the mark stands that may be moved, if there is one. @returns {number[] | null} */
  const grip = () => {
    const mark = part.movable && chart.picture.marks.find((/** @type {any} */ { key }) => key === part.movable), [x] = mark ? many(mark.x, chart.own) : [];
    return x === undefined ? null : [chart.x(x), chart.y(many(mark.y, chart.own)[0])];
  };
  const near = (/** @type {number[]} */ [px, py]) => { const place = grip(); return place !== null && Math.hypot(place[0] - px, place[1] - py) < 14; };
  const at = (/** @type {any} */ event) => placeOf(canvas, event);
  const tell = (/** @type {string} */ does, /** @type {number[]} */ [px, py]) => {
    const [x, y] = [chart.x.back(px), chart.y.back(py)];
    say({ does, view, at: [x, y], pixel: [Math.abs(chart.x.back(px + 1) - x), Math.abs(chart.y.back(py + 1) - y)] });
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button || !chart.box) return;
    from = at(event); moved = false; holding = near(from);
    canvas.setPointerCapture(event.pointerId);
    if (pointing() === "drag") tell("press", from);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!chart.box) return;
    const here = at(event);
    if (!from) { hover(chart, tip, here); sheet.preview(designAt(chart, here)); canvas.style.cursor = near(here) ? "move" : ""; return; }
    if (!moved && Math.hypot(here[0] - from[0], here[1] - from[1]) < 4) return;
    moved = true;
    if (holding) tell("move", here);
    else if (pointing() === "drag") tell("drag", here);
    else { chart.pan(here[0] - from[0], here[1] - from[1]); from = here; draw(); }
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!from) return;
    from = null;
    const chosen = moved ? null : designAt(chart, at(event), Infinity);
    if (chosen) sheet.choose(chosen);
    if (!moved && pointing()) tell("click", at(event));
    if (pointing() === "drag") tell("release", at(event));
  });
  canvas.addEventListener("pointercancel", () => { from = null; });
  canvas.addEventListener("pointerleave", () => { tip.hidden = true; sheet.preview(null); });
  canvas.addEventListener("keydown", (event) => {
    const { key, ctrlKey, metaKey, altKey } = event, place = ctrlKey || metaKey || altKey ? null : grip();
    const [across, up] = /** @type {Record<string, number[]>} */ ({ ArrowLeft: [-8, 0], ArrowRight: [8, 0], ArrowUp: [0, -8], ArrowDown: [0, 8] })[key] ?? [0, 0];
    if (!place || !(across || up)) return;
    event.preventDefault();
    tell("move", [place[0] + across, place[1] + up]);
  });
  zooms(chart, draw);
  return chart;
}

/** The design whose point is nearest to a place, if the picture offers designs. @param {any} chart
 * @param {number[]} place pixels @param {number} [within] pixels @returns {Float64Array | null} */
function designAt(chart, [px, py], within = 18) {
  if (!chart.offered) return null;
  const [x, y, designs] = chart.offered, size = designs.length / (x.length || 1);
  let best = -1, least = within;
  for (let i = 0; i < x.length; i++) {
    const away = Math.hypot(chart.x(x[i]) - px, chart.y(y[i]) - py);
    if (away < least) { least = away; best = i; }
  }
  return best < 0 ? null : designs.subarray(best * size, (best + 1) * size);
}

/** The place under the pointer, or the values of the curves there. @param {Chart} chart @param {HTMLElement} tip @param {number[]} place */
function hover(chart, tip, [px, py]) {
  const said = chart.inside(px, py) ? under(chart, px, py).slice(0, 9) : [];
  say(tip, said, chart.canvas.offsetLeft + px, chart.canvas.offsetTop + py);
}
