// The units that a page shows numbers in: those of the declarations, or others that a person chooses.
import { format, unitOf } from "./numbers.js";

/** By the name of a system: what it puts in the place of other units. @type {Record<string, Record<string, string>>} */
const SYSTEMS = {};
const METRIC = { in: "mm", inch: "mm", ft: "m", lbf: "N", lb: "kg", psi: "MPa", hp: "kW" };
const IMPERIAL = {
  mm: "inch", cm: "inch", m: "ft", N: "lbf", kN: "lbf", kg: "lb", g: "lb", Pa: "psi", MPa: "psi", GPa: "psi", W: "hp", kW: "hp",
};
for (const [lengths, other] of [["mm", METRIC], ["inch", IMPERIAL]]) {
  const force = lengths === "mm" ? "N" : "lbf";
  SYSTEMS[`${lengths}, deg, ${force}`] = { ...other, rad: "deg" };
  SYSTEMS[`${lengths}, rad, ${force}`] = { ...other, deg: "rad" };
}
const DEGREES = /(?<=\d) deg\b(?![/^\u00B2])/g; // of a number
const NAME = /[A-Za-zµμ%°]+/g;
const NUMBER = String.raw`[-\u2212]?\d+(?:\.\d+)?(?:e[+-]\d+)?`;
const JOINED = String.raw`(?:,? (?:and|to|or|\u00D7) )`; // numbers that have one unit, as in 3 to 4 mm; after a comma alone stands something else

const PART = String.raw`(?:mm|cm|m|um|inch|ft|deg|rad|\u00B0|N|kN|lbf|kg|g|lb|Pa|MPa|GPa|psi|W|kW|hp|s|min|h|rpm)(?:\^[-+]?\d+(?:\.\d+)?|[\u00B2\u00B3])?(?![A-Za-z])`;
/** What a unit looks like in a text: a product of powers, such as N mm or mm/rad\u00B2; "in" is a word. */
const PRODUCT = `(?:1/)?${PART}(?:[ */]${PART})*`;

/** @typedef {{unit: string, ratio: number}} Shown a unit, and how many of it one of the declared ones is */


export class Units {
  /** @param {any} structure */
  constructor(structure) {
    this.known = structure.units;
    const used = [...structure.quantities, ...structure.measures].map((/** @type {any} */ one) => one.unit);
    /** The system of the declarations. */
    this.own = named(used);
    this.names = [this.own, ...Object.keys(SYSTEMS).filter((name) => name !== this.own)];
    /** What in a text is a number with a unit. */
    const units = [PRODUCT, ...[...new Set(used.filter(Boolean))].sort(longer).map(quoted)].join("|");
    this.said = RegExp(`(?<![\\w.^])(${NUMBER}(?:${JOINED}${NUMBER})*) ?(${units})(?![\\w/^\u00B2\u00B3])`, "g");
    this.use(this.own);
  }

  /** Show numbers in a system, by its name. @param {string} name */
  use(name) {
    if (!this.names.includes(name)) return;
    this.name = name;
    /** @type {Record<string, string>} */ this.others = name === this.own ? {} : SYSTEMS[name];
    /** @type {Map<string, Shown>} */ this.found = new Map();
  }

  /** In which unit numbers of a unit are shown. @param {string} unit @returns {Shown} */
  of(unit) {
    let shown = this.found.get(unit);
    if (!shown) this.found.set(unit, shown = this._of(unit));
    return shown;
  }

  /** @param {string} unit @returns {Shown} */
  _of(unit) {
    const [, tens, own] = /^(10\^[+-]?\d+ )?(.*)$/.exec(unit); // of an axis
    const other = own.replace(NAME, (name) => this.others[name] ?? name);
    if (other === own) return { unit, ratio: 1 };
    try {
      return { unit: (tens ?? "") + other, ratio: unitOf(own, this.known)[0] / unitOf(other, this.known)[0] };
    } catch {
      return { unit, ratio: 1 }; // a word that stands where units stand
    }
  }

  /** A text, its numbers with a unit in the units that are shown. @param {string} text */
  words(text) { return this._converted(text).replace(DEGREES, " \u00B0"); }

  /** @param {string} text */
  _converted(text) {
    if (this.name === this.own) return text;
    return text.replace(this.said, (whole, numbers, unit) => {
      const shown = this.of(unit.replace("\u00B0", "deg"));
      if (shown.ratio === 1) return whole;
      return `${numbers.replace(RegExp(NUMBER, "g"), (/** @type {string} */ number) => rewritten(number, shown.ratio))} ${shown.unit}`;
    });
  }
}

/** A number in another unit, with as many digits, four at least. @param {string} number @param {number} ratio */
function rewritten(number, ratio) {
  const digits = number.replace(/e.*$/, "").replace(/\D/g, "").replace(/^0+/, "").length;
  return format(Number(number.replace("\u2212", "-")) * ratio, `.${Math.max(digits, 4)}g`);
}

/** The name of a system, by units of declarations. @param {string[]} units */
function named(units) {
  const names = units.flatMap((unit) => unit.match(NAME) ?? []);
  const first = (/** @type {string[]} */ some, /** @type {string} */ otherwise) => names.find((name) => some.includes(name)) ?? otherwise;
  const length = first(["mm", "inch", "in"], "mm").replace(/^in$/, "inch");
  return `${length}, ${first(["deg", "rad"], "deg")}, ${first(["N", "lbf"], length === "inch" ? "lbf" : "N")}`;
}

const longer = (/** @type {string} */ a, /** @type {string} */ b) => b.length - a.length;
const quoted = (/** @type {string} */ text) => text.replace(/[.*+?^${}()|[\]\\/]/g, "\\$&");
