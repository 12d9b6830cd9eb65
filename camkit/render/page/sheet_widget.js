// A sheet as a widget of a notebook.
import { Sheet } from "./sheet.js";

/** @param {{model: any, el: HTMLElement}} host */
function render({ model, el }) {
  const sheet = new Sheet(el.appendChild(document.createElement("div")), model);
  Object.assign(el, { camkit: sheet });
  return () => sheet.end();
}

export default { render };
