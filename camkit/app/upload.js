// A button that lets a person choose a file and hands its text to the kernel.
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
    if (input.files.length) model.send({ text: await input.files[0].text() });
    input.value = "";
  });
  el.append(button, input);
}
export default { render };
