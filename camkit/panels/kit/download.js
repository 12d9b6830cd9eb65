// A button that asks the kernel for a file when it is pressed and hands it to the browser.
function render({ model, el }) {
  const button = document.createElement("button");
  button.className = "jupyter-button widget-button camkit-file";
  const name = () => { button.textContent = model.get("description"); };
  button.addEventListener("click", () => model.send({ wanted: true }));
  const receive = (file) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([file.text], { type: file.mime }));
    link.download = file.name;
    link.click();
    URL.revokeObjectURL(link.href);
  };
  model.on("msg:custom", receive);
  model.on("change:description", name);
  name();
  el.appendChild(button);
  return () => { model.off("msg:custom", receive); model.off("change:description", name); };
}
export default { render };
