// Tells a screen reader what each slider, box and menu of the panel is: the words that stand beside it.
// What has been named here is named again when the words change.
const NAMED = ["[role=slider]", "input", "select"]
  .flatMap((kind) => [":not([aria-label])", "[data-named]"].map((state) => `.jupyter-widgets ${kind}${state}`)).join();

function nameOf(control) {
  const handles = [...(control.closest(".noUi-base")?.querySelectorAll("[role=slider]") ?? [])];
  const end = handles.length === 2 ? `, ${control === handles[0] ? "least" : "greatest"}` : "";
  return `${wordsFor(control)}${end}`;
}

function wordsFor(control) {
  const label = control.closest(".jupyter-widgets").querySelector(".widget-label, .widget-label-basic");
  const own = label && label.style.display !== "none" ? label.textContent.trim() : "";
  const row = control.closest(".widget-hbox");
  if (own || !row) return own || control.title;
  const asked = row.querySelector("input[type=text][title]:not([role=spinbutton])");
  if (asked) return asked.title;
  const words = [...row.querySelectorAll(":scope > .widget-html")].map((cell) => cell.textContent.trim());
  const name = row.querySelector("[data-name]")?.dataset.name ?? words.filter(Boolean).join(", ");
  const bounds = [...row.querySelectorAll("input[role=spinbutton]")];
  if (!name) return control.title;
  if (control.type === "checkbox") return `${name}, free`;
  return bounds.length === 2 ? `${name}, ${control === bounds[0] ? "least" : "greatest"}` : name;
}

function render({ el }) {
  let panel = null;
  const name = () => {
    for (const control of panel.querySelectorAll(NAMED)) {
      const words = nameOf(control);
      if (!words || words === control.ariaLabel) continue;
      control.setAttribute("aria-label", words);
      control.dataset.named = "";
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
