// What pointer and keys do on a picture: values under it, the cursor, orbit, zoom and pan.
import { format } from "./numbers.js";
import { UNIT } from "./heading.js";
import { many } from "./marks.js";
import { DEGREE } from "./positions.js";

const NEAR = 9; // pixels from a point of a picture
const HINT = "Ctrl + wheel zooms, double-click fits"; // said until a pointer has left a picture once

/** @param {import("./panel.js").Panel} panel @param {import("./picture.js").Chart} chart */
export function listen(panel, chart) {
  const { canvas } = chart, { positions, tip } = panel, orbits = positions.orbits(chart), overTurn = () => panel.overTurn(chart);
  const at = (/** @type {MouseEvent} */ event) => placeOf(canvas, event);
  /** @type {Map<number, number[]>} */ const held = new Map(); // a pinch has two
  canvas.style.touchAction = chart.picture.axes.equal || orbits ? "none" : "pan-y"; // past curves the page scrolls
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    held.set(event.pointerId, at(event));
    canvas.setPointerCapture(event.pointerId);
    if (overTurn() && held.size === 1) positions.turnTo(chart.x.back(at(event)[0]));
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => { if (held.delete(event.pointerId)) panel.ask(true); });
  }
  canvas.addEventListener("pointerleave", () => { panel.hinted ||= !tip.hidden; tip.hidden = true; });
  canvas.addEventListener("pointermove", (event) => {
    const [px, py] = at(event), before = held.get(event.pointerId);
    if (!before) { hover(panel, chart, px, py, event); return; }
    const [dx, dy] = [px - before[0], py - before[1]], other = [...held].find(([id]) => id !== event.pointerId)?.[1];
    held.set(event.pointerId, [px, py]);
    if (other) {
      const far = (/** @type {number[]} */ p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
      chart.zoom(far(before) / far([px, py]), ...other);
      panel.ask();
    } else if (overTurn()) positions.turnTo(chart.x.back(px));
    else if (orbits) positions.orbit(-dx * 0.01, dy * 0.01);
    else { chart.pan(dx, dy); panel.ask(); }
  });
  zooms(chart, (settled) => panel.ask(settled));
  canvas.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => arrow(panel, chart, event));
}

/** Where on a canvas the pointer is. @param {HTMLCanvasElement} canvas @param {MouseEvent} event */
export function placeOf(canvas, event) {
  const box = canvas.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** The wheel brings a picture nearer, a double click shows all of it. @param {import("./picture.js").Chart} chart
 * @param {(settled: boolean) => void} draw */
export function zooms(chart, draw) {
  const { canvas } = chart;
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && document.activeElement !== canvas) return; // the page scrolls
    event.preventDefault();
    const [px, py] = placeOf(canvas, event);
    chart.zoom(Math.exp(event.deltaY * 0.0015), px, py);
    draw(false);
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { chart.fit(); draw(true); });
}

/** Say something in lines beside a place, or nothing, and stay within what is around it. @param {HTMLElement} tip
 * @param {string[]} lines @param {number} x @param {number} y */
export function say(tip, lines, x, y) {
  tip.textContent = lines.join("\n");
  tip.hidden = !tip.textContent;
  if (tip.hidden) return;
  const { clientWidth, clientHeight } = /** @type {HTMLElement} */ (tip.offsetParent ?? tip.parentElement);
  tip.style.left = `${Math.min(x + 14, clientWidth - tip.offsetWidth - 4)}px`;
  tip.style.top = `${Math.min(y + 14, clientHeight - tip.offsetHeight)}px`;
}

/** The values of the curves under the pointer. @param {import("./panel.js").Panel} panel
 * @param {import("./picture.js").Chart} chart @param {number} px @param {number} py @param {PointerEvent} event */
function hover(panel, chart, px, py, event) {
  const { tip, root } = panel, said = panel.outputs && chart.inside(px, py) ? under(chart, px, py) : null;
  const box = root.getBoundingClientRect();
  say(tip, said ? [...said, ...(panel.hinted ? [] : [HINT])] : [], event.clientX - box.left, event.clientY - box.top);
}

/** What is under the pointer, in lines: the values of the curves there, or a place. @param {import("./picture.js").Chart} chart
 * @param {number} px @param {number} py */
export function under(chart, px, py) {
  const { equal, bare } = chart.picture.axes;
  return bare ? [] : !equal && chart.valuesAt(chart.x.back(px)).length ? onCurves(chart, px) : atPoint(chart, px, py);
}

/** A number of an axis with the unit that is shown. @param {import("./picture.js").Chart} chart @param {"x"|"y"} name
 * @param {number} value */
function measured(chart, name, value) {
  const unit = UNIT.exec(chart.axes[`${name}label`])?.[1] ?? "";
  return `${format(value * chart.per[name], ".4g")} ${unit}`.trim();
}

/** What the curves are over a pixel. @param {import("./picture.js").Chart} chart @param {number} px */
function onCurves(chart, px) {
  const x = chart.x.back(px), named = (/** @type {any} */ mark) => chart.how.words(mark.label) || chart.axes.title;
  const rows = chart.valuesAt(x).map(({ mark, value }) => `${named(mark)} ${measured(chart, "y", value)}`);
  return [`at ${measured(chart, "x", x)}`, ...rows];
}

/** Both numbers of a place with the names of the axes: of a point that is near, else of the pixel.
 * @param {import("./picture.js").Chart} chart @param {number} px @param {number} py */
function atPoint(chart, px, py) {
  /** @type {{far: number, x: number, y: number, head: string[], more: string[]}} */
  let best = { far: NEAR, x: chart.x.back(px), y: chart.y.back(py), head: [], more: [] };
  for (const mark of chart.picture.axes.equal ? [] : chart.picture.marks) {
    if (mark.kind !== "points") continue;
    const [xs, ys] = [many(mark.x, chart.outputs), many(mark.y, chart.outputs)], name = chart.how.words(mark.label);
    for (let i = 0; i < xs.length; i++) {
      const far = Math.hypot(chart.x(xs[i]) - px, chart.y(ys[i]) - py), which = xs.length > 1 ? ` ${i + 1} of ${xs.length}` : "";
      if (far < best.far) best = { far, x: xs[i], y: ys[i], head: name || which ? [`${name || "point"}${which}`] : [], more: mark.names?.slice?.(i, i + 1) ?? [] };
    }
  }
  const named = (/** @type {"x"|"y"} */ name) =>
    `${chart.axes[`${name}label`].replace(UNIT, "").trim() || name} ${measured(chart, name, best[name])}`;
  if (chart.offered && best.head.length) best.head = offeredAt(chart, best) ?? best.head;
  return chart.picture.axes.equal ? [`${named("x")}, ${named("y")}`] : [...best.head, ...best.more, named("x"), named("y")];
}

/** The name of the design that is offered at a point, counted as the front counts.
 * @param {any} chart @param {{x: number, y: number}} point */
function offeredAt({ offered: [x, y] }, point) {
  const k = Array.prototype.findIndex.call(x, (/** @type {number} */ value, /** @type {number} */ i) => value === point.x && y[i] === point.y);
  return k < 0 ? null : [`design ${k}`];
}

/** Arrow keys on a picture turn what is seen, or move it; + and - bring it nearer, 0 shows all of it.
 * @param {import("./panel.js").Panel} panel @param {import("./picture.js").Chart} chart @param {KeyboardEvent} event */
function arrow(panel, chart, event) {
  const { positions } = panel, { key, shiftKey } = event;
  const across = { ArrowLeft: -1, ArrowRight: 1 }[key] ?? 0, up = { ArrowDown: -1, ArrowUp: 1 }[key] ?? 0;
  const nearer = { "+": 0.8, "=": 0.8, "-": 1.25 }[key];
  if (event.ctrlKey || event.metaKey || event.altKey || !chart.box || !(across || up || nearer || key === "0")) return;
  event.preventDefault();
  const { left, right, top, bottom } = chart.box;
  if (nearer) chart.zoom(nearer, (left + right) / 2, (top + bottom) / 2);
  else if (key === "0") chart.fit();
  else if (positions.orbits(chart)) positions.orbit(5 * DEGREE * across, 5 * DEGREE * up);
  else if (positions.turn < 0) chart.pan(-20 * across, 20 * up);
  else positions.turnBy(((across + up) * (shiftKey ? 10 : 1)) / 180);
  panel.ask(true);
}
