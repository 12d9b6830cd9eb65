// Numbers in the page: written as Python writes them, and read as people type them.

/** @typedef {Object<string, [number, number[]]>} Units SI factor and dimension by name: `camkit.units.known_units()` */

const SPEC = /^(\+?)(,?)(?:\.(\d+))?([efg%])$/;

/**
 * What Python's `format(value, spec)` gives, for `[+][,][.digits]` and one of `e f g %`; for the spec "measure" what
 * `Measure.text` writes before the unit.
 * @param {number} value
 * @param {string} spec
 * @returns {string}
 */
export function format(value, spec) {
  if (spec === "measure") return measured(value);
  if (!SPEC.test(spec)) throw new RangeError(`no number is written as '${spec}' here`);
  const [, plus, comma, digits, kind] = SPEC.exec(spec);
  const sign = value < 0 || Object.is(value, -0) ? "-" : plus;
  const size = Math.abs(kind === "%" ? 100 * value : value);
  const text = Number.isFinite(size) ? written(size, Number(digits ?? 6), kind) : Number.isNaN(size) ? "nan" : "inf";
  const grouped = comma ? text.replace(/^\d+/, (whole) => whole.replace(/\B(?=(\d{3})+$)/g, ",")) : text;
  return sign + grouped + (kind === "%" ? "%" : "");
}

// Free of the last digit's noise.
const clean = (value) => (Number.isFinite(value) ? Number(format(value, ".15g")) : value);

function measured(value) {
  const read = clean(value);
  return format(read, Math.abs(read) >= 1e4 && Math.abs(read) < 1e6 ? ".0f" : ".4g");
}

function written(size, digits, kind) {
  if (kind === "f" || kind === "%") return fixed(size, digits);
  const decimals = kind === "g" ? Math.max(digits, 1) - 1 : digits;
  const [mantissa, exponent] = scientific(size, decimals);
  const power = `e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
  if (kind === "e") return mantissa + power;
  if (exponent < -4 || exponent > decimals) return short(mantissa) + power;
  return short(fixed(size, decimals - exponent));
}

const short = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);

function fixed(size, decimals) {
  const large = size >= 1e21; // toFixed would write an exponent
  if (large) return BigInt(size) + (decimals ? `.${"0".repeat(decimals)}` : "");
  return toEven(size.toFixed(decimals), size, decimals);
}

function scientific(size, decimals) {
  const [mantissa, exponent] = size.toExponential(decimals).split("e");
  return [toEven(mantissa, size, decimals - exponent), Number(exponent)];
}

// JavaScript rounds correctly, but what lies exactly between two texts up: there the last digit has to be even.
// Between them with n decimals lie the odd multiples of 2^-(n+1), which a product with a power of two shows exactly;
// with tens, hundreds ... for a last digit (n < 0), those of 5, 50 ... up to 5e21: more fives than 2^53 has no number.
function toEven(text, size, n) {
  const ten = Number(`1e${-n}`);
  const between = n >= 0 ? (size * 2 ** (n + 1)) % 2 === 1 : n > -23 && size % ten === ten / 2;
  const last = Number(text.at(-1));
  return between && last % 2 ? text.slice(0, -1) + (last - 1) : text;
}

/**
 * A sentence with its numbers: a part is a text, or the place of an output, whose first number counts, with a spec
 * ("~" before it: free of the noise after 15 digits), or with parts that are there if it is not 0.
 * @param {(string | [number, any])[]} parts
 * @param {ArrayLike<number>[]} outputs
 * @returns {string}
 */
export function fill(parts, outputs) {
  return parts.map((part) => (typeof part === "string" ? part : filled(outputs[part[0]][0], part[1], outputs))).join("");
}

function filled(value, how, outputs) {
  if (typeof how !== "string") return value ? fill(how, outputs) : "";
  return how.startsWith("~") ? format(clean(value), how.slice(1)) : format(value, how);
}

const LONGEST = 40; // so many characters at most are read as a number
const LEAST = 2 ** -1022; // below it a computer has fewer digits
const NUMBER = "(?:\\d+[.,]?\\d*|[.,]\\d+)(?:[eE][+-]?\\d+)?";
const MIXED = "(\\d+)\\s+(\\d+)/(\\d+)"; // 1 7/8
const PRODUCT = `${NUMBER}(?:\\s*[*×/]\\s*${NUMBER})*`; // 48,09, 3*16, 1/2
const TYPED = new RegExp(`^([+-]?)(?:${MIXED}|(${PRODUCT}))\\s*([A-Za-zµμ%°].*)?$`);
const SMALL = /^([+-]?\d*)\s*([¼-¾⅐-⅞])/; // 1⅞
const INCHES = /(\d)\s*["″”]$/; // 1 7/8"
const THOUSANDS = /^[1-9]\d{0,2},\d{3}$/;

/** Why a text is refused, in a sentence. */
class Refusal extends Error {}

/**
 * The number that `text` says, in `unit` if it has none of its own; or, for everything else, why it is refused.
 * @param {string} text
 * @param {string} unit
 * @param {Units} units
 * @returns {{value: number} | {error: string}}
 */
export function parse(text, unit, units) {
  try {
    return { value: read(text, unit, units) };
  } catch (refusal) {
    if (refusal instanceof Refusal) return { error: refusal.message };
    throw refusal;
  }
}

function read(text, unit, units) {
  const plain = text.trim().replace(/[−–－]/g, "-")
    .replace(SMALL, (_, whole, small) => `${whole}${/\d/.test(whole) ? " " : ""}${small.normalize("NFKD").replace("⁄", "/")}`)
    .replace(INCHES, "$1 in");
  const shown = quoted(text);
  if (!plain) throw new Refusal("an empty box is no number");
  const typed = plain.length <= LONGEST && TYPED.exec(plain);
  if (!typed || Number(typed[3]) >= Number(typed[4])) { // 1 17/8 would be 1 7/8 mistyped
    throw new Refusal(`${shown} is no number; 48.09, 48,09, 1e3, 1 7/8 and 3*16 are`);
  }
  const [, sign, whole, above, below, product, own] = typed;
  const size = product ? multiplied(product, shown) : Number(whole) + Number(above) / Number(below);
  const value = sign === "-" ? -size : size;
  return own ? convert(value, own, unit, units) : value;
}

function multiplied(product, shown) {
  const [first, ...others] = product.split(/\s*([*×/])\s*/);
  let value = one(first, shown);
  for (let k = 0; k < others.length; k += 2) {
    const other = one(others[k + 1], shown), divided = others[k] === "/";
    if (divided && other === 0) throw new Refusal(`${shown} divides by zero`);
    value = held(divided ? value / other : value * other, value === 0 || other === 0, shown);
  }
  return value;
}

function one(number, shown) {
  const point = number.replace(",", ".");
  if (THOUSANDS.test(number)) {
    const both = `${point} or ${number.replace(",", "")}`;
    throw new Refusal(`'${number}' may be ${both}; write ${both}`);
  }
  return held(Number(point), !/[1-9]/.test(number.split(/e/i)[0]), shown);
}

// The value, if a computer holds it with all its digits.
function held(value, zero, shown) {
  if (Math.abs(value) < LEAST && !zero) throw new Refusal(`${shown} is too small for a computer`);
  if (!Number.isFinite(value)) throw new Refusal(`${shown} is too large for a computer`);
  return value;
}

const quoted = (text) => `'${text.length <= LONGEST ? text : `${text.slice(0, LONGEST)}...`}'`;

function convert(value, unit, into, units) {
  const [factor, dimension] = unitOf(unit, units), [wanted, wantedDimension] = unitOf(into, units);
  if (dimension.some((power, k) => power !== wantedDimension[k])) {
    throw new Refusal(`${unit} cannot be converted into ${into || "a plain number"}`);
  }
  const shown = `${format(value, ".15g")} ${unit}`;
  const si = held(value * factor, value === 0, shown);
  return held(clean(si / wanted), value === 0, shown);
}

const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const RAISED = /⁻?[⁰¹²³⁴-⁹]+(?:·[⁰¹²³⁴-⁹]+)?/g;
const lowered = (text) => [...text].map((c) => ({ "⁻": "-", "·": "." })[c] ?? SUPERSCRIPTS.indexOf(c)).join("");
const raised = (text) => [...text].map((c) => ({ "-": "⁻", ".": "·", "+": "" })[c] ?? SUPERSCRIPTS[c]).join("");

// SI factor and dimension of a product of powers, such as mm^2, N m/rad or J/(kg m); also as `pretty` writes them.
export function unitOf(unit, units) {
  const [above, ...rest] = unit.replace(RAISED, (power) => `^${lowered(power)}`).split("/");
  const below = rest.join("/"), inBrackets = /^\((.*)\)$/.exec(below);
  const first = unit === "" || above.trim() === "1" ? [] : powers(above, units);
  const second = rest.length ? powers(inBrackets?.[1] ?? below, units) : [];
  if (!first || !second || (second.length > 1 && !inBrackets)) {
    throw new Refusal(`the unit ${quoted(unit)} is not known; products of powers such as mm, lbf/in and N/mm^2 are`);
  }
  const every = [...first, ...second.map(([known, power]) => [known, -power])];
  const factor = every.reduce((product, [[si], power]) => product * si ** power, 1);
  const sum = (k) => every.reduce((total, [[, dimension], power]) => total + dimension[k] * power, 0);
  return [factor, [0, 1, 2, 3].map(sum)];
}

// Units and their powers in a product without a division; null for what is none.
function powers(product, units) {
  const found = product.trim().split(/\s*[*·]\s*|\s+/).map((part) => {
    const [, name, power] = /^([A-Za-zµμ%°]+)(?:\^([+-]?\d(?:\.\d{1,2})?))?$/.exec(part) ?? [];
    return Object.hasOwn(units, name) ? [units[name], Number(power ?? 1)] : null;
  });
  return found.includes(null) ? null : found;
}

/**
 * A unit as a reader expects it: `mm/rad²` for mm/rad^2, `°/s` for deg/s.
 * @param {string} unit
 * @returns {string}
 */
export function pretty(unit) {
  return unit
    .replace(/\^([+-]?[\d.]+)/g, (_, power) => raised(power))
    .replace(/\b(deg|um|inch)\b/g, (name) => ({ deg: "°", um: "µm", inch: "in" })[name])
    .replace(/\s*\*\s*/g, "·");
}

const GREEK = (
  "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho final sigma tau upsilon " +
  "phi chi psi omega"
).split(" ");
const INDEXED = /\b([A-Za-z]+)_([A-Za-z0-9]+)\b/g;
const INDICES = "0123456789aehijklmnoprstuvx", SUBSCRIPTS = "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ";
const subscript = (index) => [...index].map((c) => SUBSCRIPTS[INDICES.indexOf(c)] ?? "_").join("");

/**
 * A symbol, or a text in which symbols stand, with the literature's letters: `ψ₀` for psi_0, `Fσ` for F_sigma.
 * @param {string} symbol
 * @returns {string}
 */
export function letters(symbol) {
  return symbol
    .replace(INDEXED, (word, letter, index) => {
      const known = greek(letter), below = greek(index);
      if (known.length > 1) return word; // a name, not a letter with an index
      return known + (subscript(below).includes("_") ? below : subscript(below)); // there is no small B
    })
    .replace(/[A-Za-z]+/g, greek)
    .replace(/\^([+-]?[\d.]+)/g, (_, power) => raised(power));
}

/**
 * The same in pieces, for a reader with lowered letters: text and index in turn, text first and last.
 * @param {string} symbol
 * @returns {string[]}
 */
export function indexed(symbol) {
  const pieces = [""], add = (text) => { pieces[pieces.length - 1] += text; };
  let from = 0;
  for (const { 0: word, 1: letter, 2: index, index: at } of symbol.matchAll(INDEXED)) {
    if (greek(letter).length > 1) continue; // a name, not a letter with an index
    add(letters(symbol.slice(from, at)) + greek(letter));
    pieces.push(greek(index), "");
    from = at + word.length;
  }
  add(letters(symbol.slice(from)));
  return pieces;
}

function greek(name) {
  const small = name[0].toLowerCase() + name.slice(1), place = GREEK.indexOf(small);
  return place < 0 || small === "final" ? name : String.fromCharCode((small === name ? 0x3b1 : 0x391) + place);
}
