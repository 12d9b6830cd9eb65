// Whether a page is dark: as its host says, or else the system.

const DARK = "(prefers-color-scheme: dark)";

export class Theme {
  /** @param {HTMLElement} root @param {() => void} changed called when it may be another one */
  constructor(root, changed) {
    this.system = matchMedia(DARK);
    this.leaving = new AbortController();
    this.system.addEventListener("change", changed, { signal: this.leaving.signal });
    // JupyterLab hides all of itself while it takes another theme: what has no size yet is drawn when it has one.
    this.seen = new ResizeObserver(() => { this.seen.disconnect(); changed(); });
    this.host = new MutationObserver(() => { this.seen.disconnect(); this.seen.observe(root); });
    this.host.observe(document.body, { attributes: true, attributeFilter: ["data-jp-theme-light", "class"] });
  }

  get dark() {
    const light = document.body.dataset.jpThemeLight;
    return light ? light === "false" : this.system.matches;
  }

  /** Leave the page. */
  end() { this.leaving.abort(); this.host.disconnect(); this.seen.disconnect(); }
}
