// What stands on a sheet: an element for each kind of part.  Controls are native elements, every text is a text node.
import { Row, make } from "./controls.js";
import { format, parse, pretty } from "./numbers.js";

/**
 * @typedef {Record<string, any> & {id: number, kind: string}} State what a part shows
 * @typedef {(done: Record<string, any>, buffers?: ArrayBuffer[]) => void} Say tells what a person has done with it
 * @typedef {{element: HTMLElement, show(state: State): void}} Part
 * @typedef {{say: Say, units: {known: any, of(unit: string): import("./units.js").Shown}, words(text: string): string,
 *   look: any, dark(): boolean}} Sheet how numbers are shown, and a text with them
 */

/** A text in the units that are shown, powers raised. @param {string} text @param {Sheet} sheet */
const said = (text, sheet) => sheet.words(text).replace(/(?<=[A-Za-z°])\^[+-]?\d+(?:\.\d+)?/g, (power) => pretty(power));

/** A line of words, some of which look otherwise. @param {any} line @param {Sheet} sheet @returns {(Node | string)[]} */
function pieces(line, sheet) {
  if (typeof line === "string") return [said(line, sheet)];
  if (Array.isArray(line)) return line.flatMap((piece) => pieces(piece, sheet));
  const element = make("span", { class: line.look ? `camkit-${line.look}` : "" }, said(line.words, sheet));
  if (line.series === undefined) return [element];
  const bar = make("span", { class: "camkit-colour" });
  bar.style.background = sheet.look.series[sheet.dark() ? "dark" : "light"][line.series % 20];
  return [bar, element];
}

/** An input with a name before it. @param {string} words @param {...HTMLElement} parts */
const named = (words, ...parts) => make("label", { class: "camkit-named" }, make("span", {}, words), ...parts);

/** Each kind of part. @type {Record<string, (state: State, sheet: Sheet) => Part>} */
export const PARTS = {
  words(_, sheet) {
    const element = make("div", {});
    return { element, show({ value, look, role }) {
      element.className = `camkit-words ${look && `camkit-${look}`}`;
      if (role) element.setAttribute("role", role); else element.removeAttribute("role");
      element.replaceChildren(...value.map((/** @type {any} */ line) => make("div", {}, ...pieces(line, sheet))));
    } };
  },

  table(_, sheet) {
    const element = make("div", { class: "camkit-numbers", tabindex: "0", role: "group", "aria-label": "table" });
    /** @param {string} tag @param {any[]} cells @param {any} [attributes] */
    const line = (tag, cells, attributes = {}) => make("tr", {}, ...cells.map((cell) => make(tag, { ...attributes, class: cell.look ? `camkit-${cell.look}` : undefined }, ...pieces(cell.look ? cell.words : cell, sheet))));
    return { element, show({ head, rows }) {
      element.hidden = !head.length;
      element.replaceChildren(make("table", {}, make("thead", {}, line("th", head, { scope: "col" })), make("tbody", {}, ...rows.map((/** @type {any[]} */ row) => line("td", row)))));
    } };
  },

  progress() {
    const bar = make("progress", { "aria-label": "progress" });
    return { element: bar, show({ value, max }) { bar.max = Math.max(max, 1); bar.value = value; } };
  },

  button(_, { say }) {
    const element = make("button", { type: "button", onclick: () => say({}) });
    return { element, show({ description, disabled, tooltip, primary, look }) {
      Object.assign(element, { textContent: description, disabled, title: tooltip });
      element.classList.toggle("camkit-primary", primary);
      element.classList.toggle("camkit-icon", look === "icon");
      if (look === "icon") element.setAttribute("aria-label", tooltip);
    } };
  },

  upload(state, { say }) {
    const file = make("input", { type: "file", hidden: true, onchange: async () => {
      const [chosen] = file.files;
      if (chosen) say({}, [await chosen.slice(0, state.most).arrayBuffer()]);
      file.value = "";
    } });
    const button = make("button", { type: "button", onclick: () => file.click() });
    return { element: make("span", {}, button, file), show({ description, accept }) { button.textContent = description; file.accept = accept; } };
  },

  number(state, { say, units }) {
    const row = new Row({ ...state.declared, value: state.value }, units, (value, settled) => say({ value, settled }));
    return { element: row.element, show({ value, declared, disabled }) {
      row.between(declared.low * declared.factor, declared.high * declared.factor);
      if (row.unit !== units.of(declared.unit).unit) row.measure();
      row.show(value);
      row.slider.disabled = row.box.disabled = disabled;
    } };
  },

  menu(_, { say }) {
    const name = make("span", {}), menu = make("select", { onchange: () => say({ value: Number(menu.value) }) });
    return { element: make("label", { class: "camkit-named" }, name, menu), show({ description, names, chosen, disabled, tooltip }) {
      name.textContent = description;
      menu.replaceChildren(...names.map((/** @type {string} */ words, /** @type {number} */ k) => make("option", { value: k }, words)));
      menu.value = chosen === null ? "" : String(chosen);
      Object.assign(menu, { disabled, title: tooltip });
      if (!description) menu.setAttribute("aria-label", tooltip);
    } };
  },

  scale(_, { say }) {
    const slider = make("input", { type: "range", min: 0, step: 1, oninput: () => say({ value: Number(slider.value) }) });
    return { element: slider, show({ names, chosen, pale, description, tooltip }) {
      Object.assign(slider, { max: names.length - 1, value: chosen, title: tooltip });
      slider.setAttribute("aria-label", description);
      slider.setAttribute("aria-valuetext", pale ? `not judged, about ${names[chosen]}` : names[chosen]);
      slider.classList.toggle("camkit-pale", pale);
    } };
  },

  whole({ slider }, { say }) {
    const box = make("input", { type: slider ? "range" : "text", inputmode: "numeric", step: 1 });
    const told = make("output", {}), refusal = make("div", { class: "camkit-refusal", role: "alert" });
    let state = { min: 0, max: 0 }, said = 0;
    const take = () => {
      const { value, error } = parse(box.value, "", {}), { min, max } = state;
      const why = error ?? (Number.isInteger(value) && value >= min && value <= max ? "" : `a whole number from ${min} to ${max} is possible`);
      refusal.textContent = why;
      if (!why && value !== said) { told.textContent = said = value; say({ value }); }
    };
    box.addEventListener(slider ? "input" : "change", take);
    if (!slider) box.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => { if (event.key === "Enter") take(); });
    const element = make("div", {}, named("", box, told), refusal);
    return { element, show(now) {
      state = /** @type {any} */ (now); said = now.value;
      element.firstChild.firstChild.textContent = now.description;
      Object.assign(box, { min: now.min, max: now.max, value: now.value, defaultValue: now.value, disabled: now.disabled, title: now.tooltip });
      told.textContent = slider ? now.value : "";
      refusal.textContent = "";
    } };
  },

  check(_, { say }) {
    const box = make("input", { type: "checkbox", onchange: () => say({ value: box.checked }) }), words = make("span", {});
    return { element: make("label", { class: "camkit-check" }, box, words), show({ value, description, disabled, tooltip }) {
      Object.assign(box, { checked: value, disabled, title: tooltip });
      words.textContent = description;
    } };
  },

  amount(_, { say, units }) {
    const title = make("span", {});
    const box = make("input", { type: "text", inputmode: "decimal", autocomplete: "off", size: 8 });
    const unit = make("span", { class: "camkit-unit" }), refusal = make("div", { class: "camkit-refusal", role: "alert" });
    /** @type {any} */ let state = null;
    let told = "";
    const shown = () => units.of(state.unit), written = () => format(state.value * shown().ratio, shown().ratio === 1 ? ".12g" : ".6g");
    const take = () => {
      if (box.value === told) { refusal.textContent = ""; return; }
      const read = parse(box.value, shown().unit, units.known);
      refusal.textContent = read.error ?? "";
      if (!read.error) { told = box.value; say({ value: read.value / shown().ratio }); }
    };
    box.addEventListener("change", take);
    box.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => { if (event.key === "Enter") take(); });
    return { element: make("span", { class: "camkit-amount" }, title, make("span", { class: "camkit-box" }, box, unit), refusal), show(now) {
      state = now; title.textContent = now.named ? now.description : "";
      box.value = box.defaultValue = told = written(); box.disabled = now.disabled; box.title = now.tooltip;
      const { unit: name } = shown();
      box.setAttribute("aria-label", name ? `${now.description}, ${name}` : now.description);
      unit.textContent = pretty(name); refusal.textContent = "";
    } };
  },

  typed({ named: titled }, { say }) {
    const box = make("input", { type: "text", autocomplete: "off", size: 8 }), boxed = make("span", { class: "camkit-box" }, box);
    let told = "";
    const take = () => { if (box.value !== told) say({ value: (told = box.value) }); };
    box.addEventListener("change", take);
    box.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => { if (event.key === "Enter") take(); });
    const element = titled ? named("", boxed) : boxed;
    return { element, show({ value, placeholder, description, tooltip, disabled }) {
      Object.assign(box, { value, defaultValue: value, placeholder, title: tooltip, disabled });
      told = value;
      box.setAttribute("aria-label", description);
      if (titled) element.firstElementChild.textContent = description;
    } };
  },

  span(_, { say, units }) {
    const ends = ["least", "greatest"].map((which) => make("input", { type: "range", step: "any", "data-which": which }));
    const told = make("output", {});
    /** @type {any} */ let state = null;
    const shown = (/** @type {number[]} */ both) => {
      const { ratio } = units.of(state.unit), [low, high] = both.map((end) => format(end * ratio, ".4g"));
      told.textContent = `${low} to ${high}`;
      ends.forEach((end, k) => end.setAttribute("aria-valuetext", [low, high][k]));
    };
    const take = () => { const value = ends.map((end) => Number(end.value)).sort((a, b) => a - b); shown(value); say({ value }); };
    for (const end of ends) end.addEventListener("input", take);
    return { element: make("span", { class: "camkit-span" }, ...ends, told), show(now) {
      state = now;
      const { unit } = units.of(state.unit), name = unit ? `${state.description}, ${unit}` : state.description;
      ends.forEach((end, k) => {
        Object.assign(end, { min: state.min, max: state.max, value: state.value[k], disabled: state.disabled });
        end.setAttribute("aria-label", `${name}, ${end.dataset.which}`);
      });
      shown(state.value);
    } };
  },
};
