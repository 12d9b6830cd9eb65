// Whether a page is dark: as its host says, or else the system.

const DARK = "(prefers-color-scheme: dark)";

export class Theme {
  /** @param {() => void} changed called when it may be another one */
  constructor(changed) {
    this.system = matchMedia(DARK);
    this.leaving = new AbortController();
    this.system.addEventListener("change", changed, { signal: this.leaving.signal });
    this.host = new MutationObserver(changed);
    this.host.observe(document.body, { attributes: true, attributeFilter: ["data-jp-theme-light", "class"] });
  }

  get dark() {
    const light = document.body.dataset.jpThemeLight;
    return light ? light === "false" : this.system.matches;
  }

  /** Leave the page. */
  end() { this.leaving.abort(); this.host.disconnect(); }
}
