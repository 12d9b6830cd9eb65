// Where a mechanism stands, and from where it is seen: a row for each angle, Play, and one cursor for the curves.
import { found } from "./marks.js";
import { Row, make } from "./controls.js";

export const DEGREE = Math.PI / 180;
const TURN = 6; // seconds for a whole turn

export class Positions {
  /** `values` are those of the panel: of quantities and, from `begin` on, of positions.
   * @param {any} structure @param {import("./units.js").Units} units @param {Float64Array} values
   * @param {(k: number, value: number, settled: boolean) => void} moved
   * @param {(settled?: boolean) => void} ask */
  constructor(structure, units, values, moved, ask) {
    const begin = structure.quantities.length;
    Object.assign(this, { structure, values, begin, moved, ask, playing: false, range: [0, 2 * Math.PI] });
    const end = (/** @type {any} */ given, /** @type {number} */ otherwise) => (typeof given === "number" ? given / DEGREE : otherwise);
    this.rows = structure.positions.map((/** @type {any} */ { label, value, low, high }, /** @type {number} */ k) => new Row(
      { name: label, symbol: label, unit: "deg", factor: DEGREE, low: end(low, -180), high: end(high, 180), meaning: "", value, written: ".4g" },
      units, (value, settled) => moved(begin + k, value, settled)));
    this.turn = this._named("turn");
    this.button = make("button", { type: "button", title: "Play", "aria-label": "Play", onclick: () => this.play() }, "\u25B6");
    this.element = make("div", { class: "camkit-play", hidden: !this.rows.length },
      ...(this.turn < 0 ? [] : [this.button]), ...this.rows.map((/** @type {Row} */ row) => row.element));
  }

  /** @param {string} name */
  _named(name) { return this.structure.positions.findIndex((/** @type {any} */ p) => p.name === name); }

  /** Turn the mechanism, or stop it. */
  play() {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? "\u275A\u275A" : "\u25B6";
    this.button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    let before = performance.now();
    const step = (/** @type {number} */ now) => {
      if (!this.playing) return;
      const k = this.begin + this.turn, [low, high] = this.range;
      const next = this.values[k] + (Math.min(now - before, 100) / 1000 / TURN) * (high - low);
      before = now;
      this.values[k] = next > high ? low + ((next - low) % (high - low)) : next;
      this.rows[this.turn].show(this.values[k]);
      this.ask();
      requestAnimationFrame(step);
    };
    if (this.playing) requestAnimationFrame(step); else this.ask(true);
  }

  /** Stand at a value of a position, within its range. @param {number} k @param {number} value */
  stand(k, value) {
    const row = this.rows[k];
    row.show(Math.min(Math.max(value, row.low), row.high));
    this.moved(this.begin + k, row.value, false);
  }

  /** Stand as others of the same name did. @param {Positions} before */
  resume(before) {
    this.structure.positions.forEach((/** @type {any} */ { name }, /** @type {number} */ k) => {
      const j = before._named(name);
      if (j >= 0) this.rows[k].show(this.values[this.begin + k] = before.values[before.begin + j]);
    });
    this.ask(true);
  }

  /** Stand at an angle, degrees. @param {number} angle */
  turnTo(angle) { this.stand(this.turn, angle * DEGREE); }

  /** Turn on by a share of the range. @param {number} share */
  turnBy(share) { this.stand(this.turn, this.values[this.begin + this.turn] + share * (this.range[1] - this.range[0])); }

  /** See it from elsewhere. @param {number} across @param {number} up radians */
  orbit(across, up) {
    const [k, j] = [this._named("azimuth"), this._named("elevation")];
    const [azimuth, elevation] = [k, j].map((place) => this.values[this.begin + place]);
    this.stand(k, (((azimuth + across) / DEGREE + 540) % 360) * DEGREE - Math.PI);
    this.stand(j, elevation + up);
  }

  /** Whether a picture is seen from a place in space. @param {import("./picture.js").Chart} chart */
  orbits(chart) { return chart.picture.axes.bare && this._named("azimuth") >= 0; }

  /** Whether a curve is over the angle that turns the mechanism. @param {string} along what its first axis is */
  over(along) {
    return this.turn >= 0 && along.startsWith(this.structure.positions[this.turn].label) && along.endsWith("[deg]");
  }

  /** Where the mechanism stands, degrees. */
  get angle() { return this.values[this.begin + this.turn] / DEGREE; }

  /** The slider that turns the mechanism goes over its range. @param {ArrayLike<number>[]} outputs */
  fit(outputs) {
    if (this.turn < 0) return;
    const position = this.structure.positions[this.turn];
    const [low, high] = [position.low, position.high].map((end) => {
      const value = found(end, outputs);
      return typeof value === "number" ? value : value[0];
    });
    if (Number.isFinite(low) && Number.isFinite(high) && low < high) {
      this.rows[this.turn].between(low, high);
      this.range = [low, high];
    }
  }
}
