// A sheet as a widget of a notebook.
import { movable } from "./cell.js";
import { Sheet } from "./sheet.js";

/** @param {import("./cell.js").Host} host */
function view({ model, el }) {
  const sheet = new Sheet(el.appendChild(document.createElement("div")), model);
  Object.assign(el, { camkit: sheet });
  return () => sheet.end();
}

export default movable(view);
