// The page as a widget of a notebook: it computes and draws by itself and tells the kernel what a person settled on.
import { engineOf } from "./engine.js";
import { Panel } from "./panel.js";
import { Docks } from "./docks.js";
import { download } from "./files.js";
import { movable } from "./cell.js";
import { PATIENCE, arrays, atTheEnd } from "./kernel.js";
import { Session, alone, follow, heldBy, known, pinDrawn, stand } from "./session.js";

/** What runs the program: the page, or the kernel if there is none. @param {any} model */
async function engineFor(model) {
  const packed = model.get("program");
  return packed.byteLength ? engineOf(new Uint8Array(packed.buffer, packed.byteOffset, packed.byteLength)) : asking(model);
}

/** The kernel computes: one question at a time, and of those that wait the newest, and those that must be answered. @param {any} model */
function asking(model) {
  let number = Math.floor(Math.random() * 2 ** 40); // each view of the model has its own
  /** @type {any} */ let asked = null;
  /** @type {any[]} */ let waiting = [];
  const send = (/** @type {any} */ question) => { asked = question; asked.at = performance.now(); model.send({ compute: question.values, number: ++number }); };
  const hear = (/** @type {any} */ message, /** @type {DataView[]} */ buffers) => {
    if (message.answer !== number) return;
    const { pictures, positions, measures, trouble, sentence } = message, { answered } = asked, next = waiting.shift();
    asked = null;
    if (next) send(next);
    answered(Object.assign(arrays(buffers), sentence ? { sentence } : { structure: { pictures, positions, measures, trouble } }));
  };
  model.on("msg:custom", hear);
  const ask = (/** @type {any} */ question) => { if (asked && performance.now() - asked.at < PATIENCE) waiting = [...waiting.filter(({ must }) => must), question]; else send(question); };
  return {
    run: (/** @type {Float64Array} */ values, must = false) => new Promise((answered) => { ask({ values: [...values], answered, must }); }),
    end: () => model.off("msg:custom", hear),
  };
}

const TRUST = "The page is saved: a browser runs it; inside JupyterLab it stands still until you press Trust HTML above it.";
const SAID = 20_000; // how long these stay, ms

/** @param {import("./cell.js").Host} host */
async function view({ model, el }) {
  const root = el.appendChild(document.createElement("div"));
  /** @type {any} */ let panel = null, saving = false;
  let at = 0; // by the clock of this view, which others do not have
  const own = Math.random(), leaving = new AbortController();
  let heardAt = 0; // what the kernel hears in any case before a cell that is run now
  /** Ask the kernel for something, with what is shown: a question may overtake that. @param {any} question @param {ArrayBuffer[]} [buffers] */
  const ask = (question, buffers) => {
    const { structure: { make }, values, history: { count } } = panel;
    clearTimeout(panel.reporting);
    panel.reported = [...values.slice(0, count)];
    heardAt = at = Math.max(at + 1, Date.now());
    model.send({ ...question, values: panel.reported, said: { at, make, view: own } }, undefined, buffers);
  };
  const host = {
    changed(/** @type {number[]} */ values, /** @type {(number | null)[]} */ computed) {
      if (!current()) return;
      at = Math.max(at + 1, Date.now());
      model.set({ values, computed, said: { at, make: panel.structure.make, view: own } });
      model.save_changes();
    },
    back: (/** @type {any} */ { make, values }) => ask({ back: [make, values] }),
    pin: (/** @type {any} */ { make, values }, /** @type {number[]} */ at) => model.send({ pin: [make, values, at] }),
    seek: (/** @type {string} */ name, /** @type {number} */ value) => ask({ seek: [name, value] }),
    convert: (/** @type {string} */ name) => ask({ convert: name }),
    reset: () => ask({ reset: true }),
    choose: (/** @type {string} */ path, /** @type {string} */ option) => ask({ choose: [path, option] }),
    file: (/** @type {string} */ kind) => { saving = true; ask({ file: kind }); },
    open: async (/** @type {File} */ file) => ask({ open: file.name }, [await file.slice(0, panel.structure.most).arrayBuffer()]),
    name: (/** @type {any} */ asked) => ask({ session: asked }),
    study: () => ask({ study: true }),
    workshop: () => ask({ workshop: true }),
  };
  /** Before somebody can run a cell: what is shown, though a kernel that is at work on an earlier value is told no newer
   * one till it is done. @param {any} event */
  const hurry = (event) => {
    if (heardAt === at || (event.type === "keydown" ? event.key !== "Enter" : root.contains(event.target))) return;
    heardAt = at;
    model.send({ values: panel.reported, said: { at: at - 0.5, make: panel.structure.make, view: own } }); // before the same with its measures
  };
  for (const kind of ["keydown", "pointerdown"]) document.addEventListener(kind, hurry, { capture: true, signal: leaving.signal });
  const docks = new Docks();
  const dock = async () => {
    const of = panel, found = await Promise.all(model.get("tabs").map(async (/** @type {any} */ { title, sheets }) => ({
      title, models: await Promise.all(sheets.map((/** @type {string} */ name) => model.widget_manager.get_model(name.replace("IPY_MODEL_", "")))),
    })));
    if (of === panel) docks.show(panel, found);
  };
  let begun = 0;
  /** @type {Promise<void>} */ let ready;
  const begin = () => (ready = starting());
  const starting = async () => {
    const number = ++begun, first = !panel, engine = await engineFor(model), structure = structuredClone(model.get("structure"));
    if (number < begun) { engine.end?.(); return; } // structure and program come together
    const before = panel, held = before && heldBy(before);
    before?.end();
    panel = new Panel(root, structure, engine, host);
    if (before) { // its design may be another one than that which the structure was made of
      const values = model.get("values");
      panel.put([...values, ...panel.values.slice(values.length)]);
      panel.history.now.values = values;
      follow(panel, before, held);
    }
    Object.assign(root.parentElement ?? {}, { camkit: panel });
    await dock();
    panel.say(model.get("message"));
    if (before) panel.showTab(before.tabs.shown?.name); // of a sheet
    moved(); // the design may have moved since the structure was made
    panel.goOn();
    if (first) void stand(panel, model.get("page"));
    session.ask();
    tell();
    if (panel.structure.measures.some((/** @type {any} */ m) => m.limit !== undefined)) model.send({ made: true });
    if (!known(model)) left();
  };
  const left = () => { if (panel) { panel.left = true; tell(); alone(panel, model.get("program").byteLength > 0); } };
  /** Whether the panel is of the make that the kernel shows: else another one is on its way. */
  const current = () => panel?.structure.make === model.get("structure").make;
  const moved = () => {
    const values = model.get("values"), shown = panel?.values ?? [];
    if (panel && current() && values.length === panel.structure.quantities.length && values.some((/** @type {number} */ v, /** @type {number} */ k) => v !== shown[k])) panel.load(values);
  };
  const briefly = (/** @type {string} */ sentence) => {
    panel.say(sentence);
    setTimeout(() => { if (panel.note.textContent === sentence) panel.say(""); }, SAID);
  };
  const tell = () => panel?.made.hear(model.get("made") ?? {}); // a notebook of before has none
  const heard = {
    "change:structure": begin, // and with it the program, which may be the same
    "change:program": begin,
    "change:tabs": dock,
    "change:made": tell,
    "change:opened": () => { void ready.then(dock).then(() => panel?.showTab(model.get("opened"))); },
    "change:values": moved,
    "change:message": () => panel?.say(model.get("message")),
    "msg:custom": (/** @type {any} */ message, /** @type {DataView[]} */ buffers) => {
      if (message.file && saving) { saving = false; download(message.file, new Blob([buffers[0]])); if (message.file.endsWith(".html")) briefly(TRUST); else if (panel.note.textContent === TRUST) panel.say(""); } // not in every view
      if (message.offer !== undefined) session.offer(message.offer);
      if (message.named) void ready.then(() => panel.names.hear(message.named));
      if (message.stand) void ready.then(() => stand(panel, message.stand));
      if (message.pinned) void ready.then(() => pinDrawn(panel, message, arrays(buffers)));
      if (message.sought !== undefined) panel?.pull.hear();
      if (message.still) panel?.redraw(message.pictures, arrays(buffers), message.values);
    },
    "comm_live_update": left, // it happens once more after the beginning: at the end
  };
  const session = new Session(root, model, () => panel);
  for (const [event, act] of Object.entries(heard)) model.on(event, act);
  const unhear = atTheEnd(model, left);
  await begin();
  return () => { leaving.abort(); unhear(); session.end(); panel?.end(); docks.end(); for (const [event, act] of Object.entries(heard)) model.off(event, act); };
}

export default movable(view);
