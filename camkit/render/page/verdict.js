// What is to be said of a design: trouble, limits as chips, worst first, and in a live region for those who hear it.
import { make } from "./controls.js";
import { letters } from "./numbers.js";
import { told } from "./measures.js";

const MOST = 5; // chips, if few have a limit

export class Verdict {
  constructor() {
    this.trouble = make("div", { class: "camkit-trouble camkit-chip camkit-bad", hidden: true });
    this.chips = make("div", { class: "camkit-chips", role: "group", "aria-label": "limits and measures", tabindex: "0" });
    this.said = make("div", { class: "camkit-said", role: "status" });
    this.elements = [this.trouble, this.chips, this.said];
  }

  /** @param {import("./measures.js").Judged[]} rows @param {string} trouble @param {boolean} settled
   * @param {import("./units.js").Units} units */
  tell(rows, trouble, settled, units) {
    const limited = rows.filter(({ m }) => m.limit !== undefined).sort((a, b) => b.miss - a.miss);
    const free = rows.filter(({ m, now }) => m.limit === undefined && Number.isFinite(now));
    const others = free.slice(0, Math.max(0, MOST - limited.length));
    if (settled) this._say(limited, trouble);
    const chips = [
      ...limited.map((row) => chipOf(row, units)),
      ...others.map(({ m, now }) => ["", `${letters(m.name)} `, "b", told(m, now, units)])];
    const written = JSON.stringify([trouble, chips]);
    if (this.written === written) return; // else the page would be laid out anew in every frame
    this.written = written;
    this.trouble.textContent = trouble; this.trouble.hidden = !trouble;
    this.chips.replaceChildren(...chips.map(([kind, words, tag, more]) =>
      make("span", { class: `camkit-chip ${kind}` }, words, make(tag, {}, more))));
  }

  /** @param {import("./measures.js").Judged[]} limited @param {string} trouble */
  _say(limited, trouble) {
    const missed = limited.filter(({ kept }) => !kept).map(({ m }) => m.name);
    const limits = missed.length ? `limit not kept: ${missed.join(", ")}` : limited.length ? "every limit is kept" : "";
    const verdict = [trouble, limits].filter(Boolean).join("; ");
    if (this.said.textContent !== verdict) this.said.textContent = verdict;
  }
}

/** Kind, words and limit. @param {import("./measures.js").Judged} row @param {import("./units.js").Units} units */
function chipOf({ m, now, kept }, units) {
  const shown = Number.isNaN(now) ? "cannot be computed" : told(m, now, units);
  const limit = `${m.sense > 0 ? "\u2264" : "\u2265"} ${told(m, m.limit, units)}`;
  return [kept ? "camkit-ok" : "camkit-bad", `${letters(m.name)} ${shown} `, "small", limit];
}
