// The row above all: the name of the design, what was done and is undone, and files.
import { make } from "./controls.js";
import { openerOf } from "./drop.js";

const WORKSHOP = "workshop";

/** @param {string} words @param {string} title @param {() => void} act */
export const button = (words, title, act) =>
  make("button", { type: "button", title, "aria-label": /\w/.test(words) ? undefined : title, onclick: act }, words);

/** Buttons that save and open files, if there is a host to ask. @param {any} structure
 * @param {import("./panel.js").Host | null} host */
export function filesOf(structure, host) {
  if (!host) return [];
  const act = (/** @type {string} */ kind) => { if (kind === WORKSHOP) host.workshop(); else if (kind) host.file(kind); };
  const options = (/** @type {string} */ asked) => structure.files.flatMap((/** @type {string[]} */ [kind, words, group]) =>
    group === asked ? [make("option", { value: kind }, words)] : []);
  const groups = [...new Set(structure.files.map((/** @type {string[]} */ [, , group]) => group))].filter(Boolean);
  const save = make("select", { "aria-label": "Export", "data-asks": true, onchange: () => { act(save.value); save.value = ""; } },
    make("option", { value: "" }, "Export"), make("option", { value: WORKSHOP }, "To the workshop: all files in a zip \u2026"), ...options(""),
    ...groups.map((label) => make("optgroup", { label }, ...options(label))));
  return [...openerOf(structure, host), save];
}

/** A button for the whole screen, where there is one to be had. @param {HTMLElement} root */
export function screenOf(root) {
  if (!document.fullscreenEnabled) return [];
  const act = () => void (document.fullscreenElement ? document.exitFullscreen() : root.requestFullscreen());
  return [button("Full screen", "As large as the screen, and back", act)];
}
