// Designs with names: kept in the page, and by the kernel where there is one; a name is shown as text and nothing else.
import { make } from "./controls.js";

const NAME = "name for this design";
const LONGEST = 60; // letters of a name

/** @typedef {[string, number[] | null]} Named a name, and the quantities of its design if it is one of this make */

export class Names {
  /** @param {any} panel @param {Named[]} kept @param {((asked: Record<string, any>) => void) | null} tell who else keeps them */
  constructor(panel, kept, tell) {
    Object.assign(this, { panel, tell, old: null });
    this.kept = new Map(kept);
    this.head = make("summary", { title: "Designs with a name", tabindex: "0" });
    this.list = make("div", { role: "list" });
    this.box = make("input", { type: "text", placeholder: NAME, "aria-label": NAME, maxlength: LONGEST, autocomplete: "off", oninput: () => this._offer() });
    this.taking = make("button", { type: "button", onclick: () => this._take() });
    this.box.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => { if (event.key === "Enter") this._take(); });
    const open = make("div", { class: "camkit-named-designs" }, this.list, make("div", { class: "camkit-naming" }, this.box, this.taking));
    this.element = make("details", { class: "camkit-names" }, this.head, open);
    this.element.addEventListener("toggle", () => { if (this.element.open) this.box.focus(); else this._leave(); });
    this.element.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      if (event.key === "Escape" && this.element.open) { event.stopPropagation(); this.element.open = false; this.head.focus(); }
    });
    const { signal } = panel.leaving;
    document.addEventListener("pointerdown", ({ target }) => {
      if (!this.element.contains(/** @type {Node} */ (target))) this.element.open = false;
    }, { signal });
    panel.root.addEventListener("camkit-shown", () => this._head(), { signal });
    this._show();
  }

  /** What is kept now, as the kernel says. @param {Named[]} kept */
  hear(kept) { this.kept = new Map(kept); this._show(); }

  /** The name of the design in the sliders, if it has one. */
  get now() {
    const { values, history: { count } } = this.panel;
    const same = (/** @type {number} */ value, /** @type {number} */ k) => Math.abs(value - values[k]) <= 1e-12 * Math.abs(value); // a file rounds
    return [...this.kept].find(([, kept]) => kept?.length === count && kept.every(same))?.[0];
  }

  _head() {
    const words = this.now ?? (this.kept.size ? `Designs (${this.kept.size})` : "Designs");
    if (this.head.textContent !== words) this.head.textContent = words;
    for (const row of this.list.children) row.classList.toggle("camkit-now", row.firstChild.textContent === this.now);
    this._offer();
  }

  _show() {
    const act = (/** @type {string} */ words, /** @type {string} */ name, /** @type {() => void} */ does) =>
      make("button", { type: "button", "aria-label": `${words} ${name}`, onclick: does }, words);
    this.list.replaceChildren(...[...this.kept].map(([name, kept]) => {
      const show = make("button", { type: "button", "aria-label": `Show ${name}`, title: name, "data-asks": !kept, onclick: () => this._put(name) }, name);
      const look = (/** @type {number[] | null} */ values) => this.panel.preview(values);
      show.disabled = !kept && this.panel.left; // the kernel alone knows how another make is computed
      for (const kind of ["pointerenter", "focus"]) show.addEventListener(kind, () => look(kept));
      for (const kind of ["pointerleave", "blur"]) show.addEventListener(kind, () => look(null));
      return make("div", { role: "listitem" }, show, act("Rename", name, () => this._rename(name)), act("Forget", name, () => this._forget(name)));
    }));
    this._head();
  }

  /** What a press on the button will do. */
  _offer() {
    const there = this.kept.has(this.box.value.trim());
    this.taking.textContent = this.old !== null ? "Rename" : there ? "Replace" : "Keep";
    this.taking.disabled = !this.box.value.trim() || Boolean(this.panel.sentence) || (this.old !== null && there);
    this.taking.title = this.panel.sentence ? "What cannot be built is not kept" : "";
  }

  _leave() { this.old = null; this.box.value = ""; this._offer(); }

  /** Keep the design in the sliders under the name that is typed, or give another one its name. */
  _take() {
    const name = this.box.value.trim(), { old, panel } = this;
    this._offer();
    if (this.taking.disabled) return;
    this.box.focus(); // the button will have nothing to do
    this._leave();
    const values = [...panel.values.slice(0, panel.history.count)];
    if (old === null) this._change({ keep: [name, values] }, [...this.kept, [name, values]]);
    else this._change({ rename: [old, name] }, [...this.kept].map(([one, kept]) => [one === old ? name : one, kept]));
  }

  /** @param {string} name */
  _rename(name) { this.old = name; this.box.value = name; this._offer(); this.box.select(); this.box.focus(); }

  /** @param {string} name */
  _forget(name) { this._change({ forget: name }, [...this.kept].filter(([one]) => one !== name)); this.box.focus(); }

  /** @param {Record<string, any>} asked @param {any} kept what there is then */
  _change(asked, kept) { this.hear(kept); if (!this.panel.left) this.tell?.(asked); }

  /** One step for Undo. @param {string} name */
  _put(name) {
    const kept = this.kept.get(name), { panel } = this;
    this.element.open = false;
    panel.preview(null);
    if (!kept) { this.tell?.({ show: name }); return; }
    panel.put([...kept, ...panel.values.slice(kept.length)]);
    panel.history.settle(panel.values);
  }
}
