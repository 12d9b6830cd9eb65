// A box for a number, read by the kernel: what is typed is told to it as text, and it says what is to be shown.
let boxes = 0;

function render({ model, el }) {
  el.classList.add("jupyter-widgets", "widget-inline-hbox", "widget-text", "camkit-number");
  const label = document.createElement("label"), input = document.createElement("input");
  input.id = `camkit-number-${boxes++}`;
  label.htmlFor = input.id;
  label.className = "widget-label";
  Object.assign(input, { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false });
  input.setAttribute("role", "spinbutton");
  const show = () => {
    input.value = model.get("text");
    input.setAttribute("aria-valuenow", Number(input.value));
    input.setAttribute("aria-valuetext", input.value);
    input.title = model.get("meaning");
    input.inputMode = model.get("whole") ? "numeric" : "decimal";
    input.disabled = model.get("disabled");
    label.textContent = model.get("description");
    label.style.display = label.textContent ? "" : "none";
    label.style.width = model.get("description_width");
  };
  const tell = () => {
    if (input.value === model.get("text")) return;
    model.set("text", input.value);
    model.save_changes();
  };
  const keys = { Enter: tell, Escape: show, ArrowUp: () => move(1), ArrowDown: () => move(-1) };
  const move = (steps) => {
    const value = Number(input.value);
    if (input.value.trim() === "" || !Number.isFinite(value)) return;
    input.value = String(Number((value + steps * model.get("step")).toPrecision(12)));
    tell();
  };
  input.addEventListener("change", tell);
  input.addEventListener("keydown", (event) => {
    event.stopPropagation(); // no shortcut of the page is meant
    if (!(event.key in keys) || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key !== "Enter") event.preventDefault();
    keys[event.key]();
  });
  input.addEventListener("keypress", (event) => event.stopPropagation());
  input.addEventListener("keyup", (event) => event.stopPropagation());
  const told = ["text", "meaning", "whole", "disabled", "description", "description_width"].map((name) => `change:${name}`);
  for (const change of told) model.on(change, show);
  show();
  el.append(label, input);
  return () => { for (const change of told) model.off(change, show); };
}
export default { render };
