// The marks of a picture, drawn on a canvas in the units of its axes.

/**
 * @typedef {{at: number}} Output an array that the program gives, by its number
 * @typedef {Record<string, any> & {key: string, kind: string, role: string}} Mark
 * @typedef {{name: string, still: string, axes: Record<string, any>, marks: Mark[]}} Picture
 * @typedef {{low: number, high: number, log: boolean}} Ends
 */

export const LETTERS = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
export const POINT = 96 / 72; // CSS pixels

/** What a value of a picture is: itself, or what the program gives. @param {any} value @param {ArrayLike<number>[]} outputs */
export const found = (value, outputs) => (value !== null && typeof value === "object" && "at" in value ? outputs[value.at] : value);
/** @param {any} value @param {ArrayLike<number>[]} outputs */
export const one = (value, outputs) => { const v = found(value, outputs); return typeof v === "object" && v !== null ? v[0] : v; };
/** @param {any} value @param {ArrayLike<number>[]} outputs @returns {ArrayLike<number>} */
export const many = (value, outputs) => { const v = found(value, outputs); return typeof v === "number" ? [v] : v; };
export const real = Number.isFinite;

/** The numbers of the outputs that anything in a picture is made of. @param {any} thing @returns {Set<number>} */
export function given(thing, places = new Set()) {
  if (thing === null || typeof thing !== "object") return places;
  if ("at" in thing) places.add(thing.at);
  if (Array.isArray(thing) && typeof thing[0] === "number" && typeof thing[1] !== "number") places.add(thing[0]); // of a text
  for (const part of Object.values(thing)) given(part, places);
  return places;
}

/** Widths of texts by font and text, any digit for each digit. @type {Map<string, number>} */
const widths = new Map(), rule = document.createElement("canvas").getContext("2d");
const KEPT = 2000; // so many of them

/** How wide a text is, with digits as wide as 0: then nothing moves beside a number that runs. @param {string} font @param {string} text */
export function widthOf(font, text) {
  const words = text.replace(/\d/g, "0"), key = `${font} ${words}`, known = widths.get(key);
  if (known !== undefined) return known;
  if (widths.size > KEPT) widths.clear();
  rule.font = font;
  const { width } = rule.measureText(words);
  widths.set(key, width);
  return width;
}

/** Where each coordinate of a mark may reach, as names of its fields. @type {Record<string, [string[], string[]]>} */
export const REACH = {
  line: [["x"], ["y"]], points: [["x"], ["y"]], polygon: [["x"], ["y"]], area: [["x"], ["low", "high"]],
  circle: [["x"], ["y"]], text: [[], []], band: [[], []],
};

/** @param {CanvasRenderingContext2D} pen @param {string} tint @param {number[][]} points */
export function stroke(pen, tint, points) {
  pen.strokeStyle = tint; pen.beginPath();
  points.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.stroke();
}

const BEND = 0.1; // pixels

/** A path through points; what is no number parts it.  Points are left out where a straight line stands for them: the area
 * between it and the path is at most `BEND` times its length.
 * @param {Chart} chart @param {ArrayLike<number>} x @param {ArrayLike<number>} y @param {boolean} [steps] */
export function trace(chart, x, y, steps = false) {
  const { pen } = chart, n = Math.max(x.length, y.length);
  let down = false, fromX = 0, fromY = 0, lastX = 0, lastY = 0, area = 0; // twice what is between line and path
  const end = () => { if (down && (lastX !== fromX || lastY !== fromY)) pen.lineTo(lastX, lastY); down = false; };
  pen.beginPath();
  for (let i = 0; i < n; i++) {
    const p = chart.x(x.length === 1 ? x[0] : x[i]), q = chart.y(y.length === 1 ? y[0] : y[i]);
    if (!real(p) || !real(q)) { end(); continue; }
    const along = p - fromX, up = q - fromY, before = lastX - fromX, below = lastY - fromY;
    const more = area + Math.abs(before * up - below * along), back = before * (p - lastX) + below * (q - lastY) < 0;
    if (!down) { pen.moveTo(p, q); down = true; area = 0; fromX = p; fromY = q; } else if (steps) {
      pen.lineTo(p, lastY); pen.lineTo(p, q);
      fromX = p; fromY = q;
    } else if (back || more * more > 4 * BEND * BEND * (along * along + up * up)) {
      pen.lineTo(lastX, lastY);
      area = 0; fromX = lastX; fromY = lastY;
    } else area = more;
    lastX = p; lastY = q;
  }
  end();
}

/** @param {Chart} chart @param {Mark} mark @param {ArrayLike<number>[]} outputs */
export function circle(chart, mark, outputs) {
  const [x, y, r] = ["x", "y", "radius"].map((name) => one(mark[name], outputs));
  const px = chart.x(x), py = chart.y(y), pr = Math.abs(chart.x(x + r) - px);
  chart.pen.beginPath();
  if (real(px) && real(py) && real(pr)) chart.pen.arc(px, py, Math.max(pr, 1.5), 0, 2 * Math.PI);
  return { x: [x], y: [y], radius: r };
}

/** Forms of points around 0, their size 2. @type {Record<string, (pen: CanvasRenderingContext2D, r: number) => void>} */
export const FORMS = {
  dot: (pen, r) => pen.arc(0, 0, r, 0, 7),
  plus: (pen, r) => { pen.moveTo(-r, 0); pen.lineTo(r, 0); pen.moveTo(0, -r); pen.lineTo(0, r); },
  cross: (pen, r) => { pen.moveTo(-r, -r); pen.lineTo(r, r); pen.moveTo(-r, r); pen.lineTo(r, -r); },
  square: (pen, r) => pen.rect(-r, -r, 2 * r, 2 * r),
  diamond: (pen, r) => { pen.moveTo(0, -1.3 * r); pen.lineTo(r, 0); pen.lineTo(0, 1.3 * r); pen.lineTo(-r, 0); pen.closePath(); },
  triangle: (pen, r) => { pen.moveTo(0, -r); pen.lineTo(r, r); pen.lineTo(-r, r); pen.closePath(); },
  star: (pen, r) => {
    for (let k = 0; k < 10; k++) {
      const far = (k % 2 ? 0.45 : 1.2) * r, angle = (k * Math.PI) / 5;
      pen.lineTo(far * Math.sin(angle), -far * Math.cos(angle));
    }
    pen.closePath();
  },
};

/** How far down words stand in a small picture so that they are not across those that it has already.
 * @param {Chart} chart @param {number} left @param {number} wide @param {number} q @param {number} tall */
function below(chart, left, wide, q, tall) {
  if (chart.spotsOf !== chart.list) Object.assign(chart, { spotsOf: chart.list, spots: [] }); // drawn anew
  while (chart.spots.some((/** @type {number[]} */ [from, to, at]) => left < to + 4 && left + wide > from - 4 && Math.abs(q - at) < tall)) q += tall;
  chart.spots.push([left, left + wide, q]);
  return q;
}

/** How each kind of mark is drawn; what it gives stands in the display list, in user units.
 * @type {Record<string, (chart: Chart, mark: Mark, outputs: ArrayLike<number>[], tint: string) => object>} */
export const DRAW = {
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
    return { low, high, along: mark.along };
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
  text(chart, mark, outputs) {
    const { pen, box } = chart, [x, y] = [one(mark.x, outputs), one(mark.y, outputs)], words = chart.how.words(mark.words);
    const small = chart.compact && !chart.axes.equal && !chart.axes.bare; // there is room for one line above a curve
    let p = chart.x(x);
    let q = chart.y(y);
    const at = mark.anchor.split(" "), size = mark.size * (small ? 1 : 1.1) * chart.em;
    if (!real(p) || !real(q)) return { x: [x], y: [y], words: "" };
    const across = at.includes("left") ? "left" : at.includes("right") ? "right" : "center";
    const upright = at.includes("top") ? "top" : at.includes("bottom") ? "bottom" : "middle";
    const font = pen.font = `${mark.bold ? 600 : 400} ${size}px ${LETTERS}`;
    pen.textAlign = /** @type {CanvasTextAlign} */ (across); pen.textBaseline = /** @type {CanvasTextBaseline} */ (upright);
    const lines = small ? [words.split("\n").join(" ")] : words.split("\n");
    const wide = Math.max(...lines.map((line) => widthOf(font, line))), tall = lines.length * size * 1.25;
    if (small) {
      const before = across === "left" ? 0 : across === "right" ? wide : wide / 2;
      p = Math.max(Math.min(p, box.right - wide + before), box.left + before);
      q = below(chart, p - before, wide, q, tall);
    }
    if (mark.boxed || mark.framed) {
      const left = across === "left" ? p : across === "right" ? p - wide : p - wide / 2;
      const top = upright === "top" ? q : upright === "bottom" ? q - tall : q - tall / 2;
      pen.globalAlpha = 0.85; pen.fillStyle = chart.colour("paper"); pen.fillRect(left - 3, top - 1, wide + 6, tall + 2);
      if (mark.framed) { pen.lineWidth = 1; pen.strokeRect(left - 3, top - 1, wide + 6, tall + 2); }
      pen.globalAlpha = 1;
    }
    pen.fillStyle = mark.framed ? chart.colour("ink") : chart.ink(mark.role, one(mark.index, outputs));
    const first = q - (upright === "top" ? 0 : upright === "bottom" ? tall - size * 1.25 : (tall - size * 1.25) / 2);
    pen.lineWidth = 3; pen.setLineDash([]); pen.strokeStyle = chart.colour("paper"); pen.lineJoin = "round";
    lines.forEach((line, k) => {
      if (small) pen.strokeText(line, p, first + k * size * 1.25); // readable across a curve
      pen.fillText(line, p, first + k * size * 1.25);
    });
    return { x: [x], y: [y], words };
  },
};
