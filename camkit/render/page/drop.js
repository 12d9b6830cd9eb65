// Files that a person gives to a page: dropped on it, or chosen by a button.
import { make } from "./controls.js";

const DESIGN = "a saved design (JSON)";
const wanted = (/** @type {any} */ { tables, readable }) => (!tables?.length ? DESIGN : readable.includes(".dxf")
  ? `${DESIGN}, the table of a motion or the outline of a cam (CSV, TXT, XLSX, DXF)` : `${DESIGN} or the table of a motion (CSV, TXT, XLSX)`);
const TABLE = "Cam angle and lift from a file (CSV, TXT, XLSX) in place of this motion; it can be dropped anywhere on this panel, too";

/** A button that opens a file, and the input behind it. @param {string} words @param {string} title @param {string} accept
 * @param {import("./panel.js").Host} host */
function chooser(words, title, accept, host) {
  const file = make("input", { type: "file", accept, hidden: true, onchange: () => { if (file.files[0]) host.open(file.files[0]); file.value = ""; } });
  return [make("button", { type: "button", title, "data-asks": true, onclick: () => file.click() }, words), file];
}

/** A button for all that a panel opens. @param {any} structure @param {import("./panel.js").Host} host */
export const openerOf = (structure, host) => chooser("Open", `Open ${wanted(structure)}`, structure.tables?.length ? `.json,${structure.readable}` : ".json", host);

/** A button beside the quantities of a motion, which takes it from a table. @param {any} structure
 * @param {import("./panel.js").Host} host */
export const tableOf = ({ readable }, host) => make("div", { class: "camkit-from-table" }, ...chooser("Motion from a table", TABLE, readable, host));

/** Buttons beside the quantities of a part, which make the design another one. @param {{name: string, meaning: string}[]} conversions
 * @param {import("./panel.js").Host} host */
export const conversionsOf = (conversions, host) => make("div", { class: "camkit-from-table" }, ...conversions.map(({ name, meaning }) =>
  make("button", { type: "button", title: meaning, "data-asks": true, onclick: () => host.convert(name) }, name)));

/** Take files that are dropped on a panel whose kernel hears of them. @param {any} panel */
export function takeDrops(panel) {
  const { root, host, structure, leaving: { signal } } = panel;
  const over = make("div", { class: "camkit-drop", hidden: true }, `Drop ${wanted(structure)}`);
  const files = (/** @type {any} */ event) => host && !panel.left && [...event.dataTransfer?.types ?? []].includes("Files");
  const on = (/** @type {string} */ kind, /** @type {(event: any) => void} */ act) => root.addEventListener(kind, (/** @type {any} */ event) => {
    if (!files(event)) return;
    event.preventDefault(); event.stopPropagation();
    act(event);
  }, { signal });
  on("dragenter", () => { over.hidden = false; });
  on("dragover", (event) => { event.dataTransfer.dropEffect = "copy"; over.hidden = false; });
  on("dragleave", ({ relatedTarget }) => { if (!root.contains(relatedTarget)) over.hidden = true; });
  on("drop", ({ dataTransfer: { files: [file] } }) => { over.hidden = true; if (file) host.open(file); });
  root.append(over);
}
