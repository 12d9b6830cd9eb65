// The sheets that stand in tabs of a panel: models of their own in a notebook, stored ones in a file.
import { make } from "./controls.js";
import { Sheet } from "./sheet.js";

/** @typedef {{title: string, models: import("./sheet.js").Model[]}} Dock */

export class Docks {
  constructor() {
    /** @type {Map<any, {sheet: Sheet, element: HTMLElement}>} */ this.made = new Map();
  }

  /** Tabs of these sheets in a panel; a sheet that is there already stays as it is. @param {any} panel @param {Dock[]} docks */
  show(panel, docks) {
    /** The sheets in the tabs, in their order. @type {Sheet[]} */ panel.sheets = [];
    for (const { title, models } of docks) {
      const parts = models.map((model) => this._sheet(model, panel));
      panel.sheets.push(...parts.map(({ sheet }) => sheet));
      panel.addTab(title, make("div", { class: "camkit-dock" }, ...parts.map(({ element }) => element)),
        () => { for (const { sheet } of parts) sheet.draw(); }, true);
    }
    for (const [model, { sheet }] of this.made) if (!panel.sheets.includes(sheet)) { sheet.end(); this.made.delete(model); }
  }

  /** @param {import("./sheet.js").Model} model @param {any} panel */
  _sheet(model, panel) {
    let made = this.made.get(model);
    if (!made) {
      const element = make("div", {});
      made = { element, sheet: new Sheet(element, model, panel) };
      this.made.set(model, made);
    }
    made.sheet.panel = panel;
    return made;
  }

  /** Leave the page. */
  end() { for (const { sheet } of this.made.values()) sheet.end(); }
}
