// The scales of a picture: round numbers along them, and places.

/** @typedef {import("./marks.js").Ends} Ends */

/** Round numbers from one end to the other, about `count` of them and two at least. @param {number} low @param {number} high @param {number} count */
export function ticks(low, high, count) {
  const rough = (high - low) / Math.max(count, 1), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) marks.push(+(k * step).toPrecision(12));
  return marks.length < 2 && high > low && count < 16 ? ticks(low, high, 2 * Math.max(count, 1)) : marks;
}

/** Round numbers along a logarithmic scale: powers of ten and, where there is room for them, 2 and 5 times those.
 * @param {number} low @param {number} high @param {number} count */
export function logTicks(low, high, count) {
  const first = Math.floor(Math.log10(low)), last = Math.ceil(Math.log10(high));
  const inside = (/** @type {number[]} */ parts, every = 1) => {
    const marks = [];
    for (let power = first; power <= last; power += every) marks.push(...parts.map((part) => +`${part}e${power}`));
    return marks.filter((mark) => mark >= low * (1 - 1e-9) && mark <= high * (1 + 1e-9));
  };
  const few = inside([1, 2, 5]), powers = inside([1]);
  if (few.length < 3) return ticks(low, high, count);
  if (few.length <= count) return few;
  return inside([1], Math.max(1, Math.ceil(powers.length / count)));
}

/** Ticks of an angle in degrees, if it goes round: 0, 90, 180 ... @param {number} low @param {number} high @param {number} count */
export function degreeTicks(low, high, count) {
  const step = [15, 30, 45, 60, 90, 180].find((s) => (high - low) / s <= count + 1) ?? 360;
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9; k++) marks.push(k * step);
  return marks;
}

/** Places of a scale: from numbers to pixels and back. @param {Ends} ends @param {number} from @param {number} to */
export function scale(ends, from, to) {
  const f = ends.log ? Math.log10 : Number, low = f(ends.low), span = f(ends.high) - low || 1, per = (to - from) / span;
  /** @param {number} value */
  const place = (value) => from + per * ((ends.log ? Math.log10(value) : value) - low);
  /** @param {number} pixel */
  place.back = (pixel) => { const v = low + ((pixel - from) * span) / (to - from); return ends.log ? 10 ** v : v; };
  return place;
}

/** Numbers beside an axis. @param {number} value */
export const short = (value) => String(+value.toPrecision(6)).replace("-", "\u2212");

/** What a curve is at a place between its points, which may go either way.
 * @param {ArrayLike<number>} x @param {ArrayLike<number>} y @param {number} at */
export function between(x, y, at) {
  for (let i = 1; i < x.length; i++) {
    const [a, b] = [x[i - 1], x[i]];
    if ((a <= at && at <= b) || (b <= at && at <= a)) {
      const value = y.length === 1 ? y[0] : b === a ? y[i] : y[i - 1] + ((y[i] - y[i - 1]) * (at - a)) / (b - a);
      if (Number.isFinite(value)) return value;
    }
  }
  return NaN;
}

