// What pointer and keys do on a picture: values under it, the cursor, orbit, zoom and pan.
import { format } from "./numbers.js";
import { DEGREE } from "./positions.js";

/** @param {import("./panel.js").Panel} panel @param {import("./picture.js").Chart} chart */
export function listen(panel, chart) {
  const { canvas } = chart, { positions, tip } = panel, orbits = positions.orbits(chart), overTurn = () => panel.overTurn(chart);
  const at = (/** @type {MouseEvent} */ event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
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
  canvas.addEventListener("pointerleave", () => { tip.hidden = true; });
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
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && document.activeElement !== canvas) return; // the page scrolls
    event.preventDefault();
    chart.zoom(Math.exp(event.deltaY * 0.0015), ...at(event));
    panel.ask();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { chart.fit(); panel.ask(true); });
  canvas.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => arrow(panel, chart, event));
}

/** The values of the curves under the pointer. @param {import("./panel.js").Panel} panel
 * @param {import("./picture.js").Chart} chart @param {number} px @param {number} py @param {PointerEvent} event */
function hover(panel, chart, px, py, event) {
  const { tip, root } = panel, { axes } = chart.picture, curve = !axes.equal && !axes.bare;
  if (!panel.outputs || !chart.inside(px, py)) { tip.hidden = true; return; }
  const { per } = chart, x = chart.x.back(px), y = chart.y.back(py);
  const round = (/** @type {number} */ v, /** @type {number} */ ratio) => format(v * ratio, ".4g");
  const named = (/** @type {any} */ mark) => chart.how.words(mark.label) || chart.axes.title;
  const rows = curve ? chart.valuesAt(x).map(({ mark, value }) => `${named(mark)} ${round(value, per.y)}`) : [];
  tip.textContent = curve ? [`at ${round(x, per.x)}`, ...rows].join("\n") : axes.bare ? "" : `x ${round(x, per.x)}, y ${round(y, per.y)}`;
  tip.hidden = !tip.textContent;
  const box = root.getBoundingClientRect();
  tip.style.left = `${Math.min(event.clientX - box.left + 14, box.width - 150)}px`;
  tip.style.top = `${Math.min(event.clientY - box.top + 14, box.height - tip.offsetHeight)}px`;
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
