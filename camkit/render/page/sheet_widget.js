// A sheet as a widget of a notebook.
import { Sheet } from "./sheet.js";
import { download } from "./files.js";

const GONE = "The kernel has ended: run the cell again to go on.";

/** @param {{model: any, el: HTMLElement}} host */
function render({ model, el }) {
  const root = el.appendChild(document.createElement("div")), sheet = new Sheet(root, model);
  Object.assign(el, { camkit: sheet });
  const show = () => sheet.show();
  const sent = (/** @type {any} */ message) => { if (message.text !== undefined) download(message.name, new Blob([message.text], { type: message.mime })); };
  const gone = () => { root.dataset.gone = GONE; };
  model.on("change:body", show);
  model.on("msg:custom", sent);
  model.on("comm_live_update", gone); // it happens once more after the beginning: at the end
  return () => { sheet.end(); model.off("change:body", show); model.off("msg:custom", sent); model.off("comm_live_update", gone); };
}

export default { render };
