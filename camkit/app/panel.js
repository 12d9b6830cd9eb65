// Tells a screen reader what each slider, box and menu of the panel is: the words that stand beside it.
const NAMELESS = ["[role=slider]", "input", "select"].map((kind) => `.jupyter-widgets ${kind}:not([aria-label])`).join();

function nameOf(control) {
  const label = control.closest(".jupyter-widgets").querySelector(".widget-label, .widget-label-basic");
  const own = label && label.style.display !== "none" ? label.textContent.trim() : "";
  const row = control.closest(".widget-hbox");
  if (own || !row) return own || control.title;
  const asked = row.querySelector("input[type=text][title]");
  if (asked) return asked.title;
  const words = [...row.querySelectorAll(":scope > .widget-html")].map((cell) => cell.textContent.trim());
  const name = row.querySelector("[data-name]")?.dataset.name ?? words.filter(Boolean).join(", ");
  const bounds = [...row.querySelectorAll("input[type=number]")];
  if (control.type === "checkbox") return `${name}, free`;
  return bounds.length === 2 ? `${name}, ${control === bounds[0] ? "least" : "greatest"}` : name;
}

function render({ el }) {
  let panel = null;
  const name = () => {
    for (const control of panel.querySelectorAll(NAMELESS)) {
      const words = nameOf(control);
      if (words) control.setAttribute("aria-label", words);
    }
  };
  const observer = new MutationObserver(name); // controls arrive one by one, and a slider with new ends is a new one
  const waiting = setInterval(() => { // what is rendered here is not on the page yet
    panel = el.closest(".camkit-panel");
    if (!panel) return;
    clearInterval(waiting);
    name();
    observer.observe(panel, { childList: true, subtree: true });
  }, 50);
  return () => {
    clearInterval(waiting);
    observer.disconnect();
  };
}
export default { render };
