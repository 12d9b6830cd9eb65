// A button that lets a person choose a file and hands its bytes to the kernel, no more than it would take.
function render({ model, el }) {
  const button = document.createElement("button");
  const input = document.createElement("input");
  button.className = "jupyter-button widget-button camkit-file";
  button.textContent = model.get("description");
  input.type = "file";
  input.accept = model.get("accept");
  input.hidden = true;
  button.addEventListener("click", () => input.click());
  input.addEventListener("change", async () => {
    if (input.files.length) {
      const start = input.files[0].slice(0, model.get("most"));
      model.send({ name: input.files[0].name }, undefined, [await start.arrayBuffer()]);
    }
    input.value = "";
  });
  el.append(button, input);
}
export default { render };
