// A page that stands alone: what it shows and the program that it runs are in the file.
import { engineOf } from "./engine.js";
import { Docks } from "./docks.js";
import { Panel } from "./panel.js";

const text = (/** @type {string} */ id) => document.getElementById(id)?.textContent ?? "";
const structure = JSON.parse(text("structure"));
const program = await engineOf(Uint8Array.from(atob(text("program")), (c) => c.charCodeAt(0)));
document.title = structure.name;
const shown = new Panel(document.querySelector(".camkit-page"), structure, program);
new Docks().show(shown, structure.docks.map(({ title, sheets }) => ({ title, models: sheets.map(stored) })));
globalThis.camkit = shown;

/** What a sheet has shown when the file was written. @param {Record<string, any>} sheet @returns {any} */
function stored(sheet) {
  const held = /** @type {any} */ (unpacked({ ...sheet, setting: structure }));
  return { stored: true, get: (/** @type {string} */ name) => held[name], on() {}, off() {}, send() {} };
}

/** With bytes in the place of their letters. @param {any} value @returns {any} */
function unpacked(value) {
  if (Array.isArray(value)) return value.map(unpacked);
  if (value === null || typeof value !== "object") return value;
  if ("base64" in value) return new DataView(Uint8Array.from(atob(value.base64), (c) => c.charCodeAt(0)).buffer);
  return Object.fromEntries(Object.entries(value).map(([name, part]) => [name, unpacked(part)]));
}
