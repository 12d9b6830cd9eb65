// A page that stands alone: what it shows and the program that it runs are in the file.
import { programOf } from "./engine.js";
import { Panel } from "./panel.js";

const text = (/** @type {string} */ id) => document.getElementById(id)?.textContent ?? "";
const structure = JSON.parse(text("structure"));
const run = await programOf(Uint8Array.from(atob(text("program")), (c) => c.charCodeAt(0)));
document.title = structure.name;
globalThis.camkit = new Panel(document.querySelector(".camkit-page"), structure, { run });
