// The page: what is chosen, what is computed at once, and what is drawn when.

import { drawOnPaper, drawOnScreen } from "../../web/page/chart_place.js";
import { byId, element, saveFile } from "../../web/page/dom.js";
import { Banding } from "./banding.js";
import { Case } from "./case.js";
import { EfficiencyMap, OverSpeed, Parts, Quadrants, Temperatures } from "./charts.js";
import { Controls } from "./controls.js";
import { Engine } from "../../web/page/engine.js";
import { Fan, speedsOfFan } from "./fan.js";
import { Headline } from "./headline.js";
import { BallView, Checks } from "./judged.js";
import { judgedAt, recordsOf, textOf } from "./judgements.js";
import { keepOffline, moduleOf, site } from "./modules.js";
import { screwsFor } from "../../web/page/part_search.js";
import { forget } from "../../web/page/palette.js";
import { floodedTorqueIn } from "../../web/page/starvation.js";
import { Taking } from "./taking.js";
import { inSiUnit } from "./view.js";
import { inPlace, keep, kept, useSymbols } from "./words.js";

/** Milliseconds after the last change that the hand is at rest. */
const REST = 160;
/** Milliseconds of computing for one chart while a slider moves, and when it rests. */
const BUDGET = 8;
const BUDGET_AT_REST = 80;
/** Milliseconds of a point that was not measured yet: of a nut whose balls are solved one by one, and of others. */
const USUAL_PACE = [2, 0.01];
const SCHEME_KEPT = "ballscrew-site-scheme";
const SCHEMES = ["light", "dark"];

const { contents, digest, worker } = site();
useSymbols(contents.symbols);
/** Modules that are compiled, which the worker is sent, too. @type {Map<string, Promise<WebAssembly.Module>>} */
const compiled = new Map();
const engine = new Engine(contents, compiledOf);
const shownCase = new Case(contents, (grade, kelvin) => engine.oil(grade, kelvin, 1));
const controls = new Controls(shownCase, edit);
/** Milliseconds of a point, by structure. @type {Map<string, number>} */
const pace = new Map();
/** True when there are numbers to show. */
let isThere = false;
let isMoving = false;
let wasThinned = false;
let isFrameAsked = false;
let isIdleAsked = false;
let restTimer = 0;
/** Counts what was chosen, so that of two only the later is shown. */
let choices = 0;

const banding = new Banding(engine, contents, { worker, moduleOf: compiledOf, heard: showBand });
/** @type {import("./view.js").Scene} */
const scene = {
  case: shownCase,
  inputs: {},
  outputs: {},
  judged: undefined,
  banded: () => banding.banded,
  save: (name, content) => saveFile(`ballscrew${name}`, content),
  evaluate(changes, count) {
    const began = performance.now();
    const found = engine.evaluate(shownCase.structure, { ...scene.inputs, ...changes }, count);
    const own = (performance.now() - began) / count;
    if (count > 4) pace.set(shownCase.structure, ((pace.get(shownCase.structure) ?? own) + own) / 2);
    return found;
  },
  oil: (kelvin) => engine.oil(shownCase.state.grade, kelvin, kelvin.length),
  count(whole, least) {
    const usual = USUAL_PACE["by_ball" in shownCase.spec ? 0 : 1];
    const most = Math.floor((isMoving ? BUDGET : BUDGET_AT_REST) / (pace.get(shownCase.structure) ?? usual));
    if (isMoving && most < whole) wasThinned = true;
    return Math.max(least, Math.min(whole, most));
  },
  range: (name) => controls.range(name),
  change(name, shown) {
    edit(name, controls.snapped(name, shown));
    controls.show(name);
  },
  floodedTorque() {
    const records = scene.judged ? [...scene.judged.verdicts, ...scene.judged.warnings] : [];
    return floodedTorqueIn(records);
  },
  give(name, shown) {
    if (shown === undefined) delete shownCase.state.given[name];
    else shownCase.state.given[name] = shown;
    changed();
  },
};

const headline = new Headline(scene);
const taking = new Taking(shownCase);
const first = new Parts(scene, "over-speed", {
  over: "screw_speed",
  heading: "Where the torque comes from, over the speed",
  hint: "Drag the point, or move a slider.",
  hasValues: true,
});
const fan = new Fan(scene, "fan");
const others = [
  new Checks(scene, "checks"),
  fan,
  new BallView(scene, "ball", engine),
  new Parts(scene, "over-load", { over: "axial_load", heading: "The parts over the load", hint: "" }),
  new EfficiencyMap(scene, "map"),
  new OverSpeed(scene, "stribeck", {
    heading: "Stribeck curve",
    hint: "",
    output: "friction_coefficient",
    title: "friction coefficient",
  }),
  new OverSpeed(scene, "film", {
    heading: "Film over the speed",
    hint: "Above 3 the film carries, below 1 the asperities carry much of the load.",
    output: "film_parameter",
    title: "film parameter λ",
    hasLog: true,
  }),
  new Temperatures(scene, "temperatures"),
  new Quadrants(scene, "quadrants"),
];
const views = [first, ...others];

/** The compiled module of a file: asked for again where it could not be had. @param {string} file */
function compiledOf(file) {
  const made = compiled.get(file) ?? moduleOf(file);
  compiled.set(file, made);
  made.catch(() => compiled.delete(file));
  return made;
}

/** A number was changed. @param {string} name @param {number} shown */
function edit(name, shown) {
  shownCase.state.edits[name] = shown;
  isMoving = true;
  changed();
}

/** Compute the numbers of the operating point at once; the rest is drawn when there is time. */
function changed() {
  banding.drop();
  delete document.documentElement.dataset.band;
  compute();
  for (const view of views) view.isDirty = true;
  clearTimeout(restTimer);
  restTimer = setTimeout(rest, REST);
  askFrame();
}

function compute() {
  scene.inputs = shownCase.inputs();
  const found = engine.evaluate(shownCase.structure, scene.inputs, 1);
  scene.outputs = Object.fromEntries(Object.entries(found).map(([name, [value]]) => [name, value]));
  scene.judged = undefined;
  if (!(isMoving && "by_ball" in shownCase.spec)) judge();
  show();
}

/** Judge the operating point: of a nut whose balls are solved one by one when the hand rests. */
function judge() {
  const inputs = { ...shownCase.unchanged(), ...scene.inputs };
  const point = { structure: shownCase.structure, start: shownCase.state.start, inputs, given: shownCase.given() };
  const judged = judgedAt(engine, contents, point);
  scene.judged = { ...recordsOf(contents, judged), derived: judged.derived };
}

/** Ask for the band of the case as it is. */
function askBand() {
  const { grade, edits } = shownCase.state;
  banding.ask({
    structure: shownCase.structure,
    start: shownCase.state.start,
    inputs: scene.inputs,
    grade,
    temperature: grade ? shownCase.temperature() : Number.NaN,
    kept: Object.keys(edits),
    speeds: Array.from(inSiUnit(speedsOfFan(scene), contents.fields.screw_speed)),
  });
}

/** Show what was found of the band. @param {import("./banding.js").Banded} banded */
function showBand(banded) {
  /** @type {any} */ (globalThis).ballscrewBand = banded;
  document.documentElement.dataset.band = banded.isMissing ? "none" : banded.fan ? "fan" : "point";
  headline.writeBand();
  fan.isDirty = true;
  askIdle();
}

/** What other programs may read of the page. */
function show() {
  const said = (/** @type {import("./judgements.js").JudgedRecord[]} */ records) =>
    records.map((one) => ({ ...one, text: textOf(contents, one.message, inPlace) }));
  const { judged } = scene;
  /** @type {any} */ (globalThis).ballscrew = {
    case: shownCase.tables(),
    inputs: { ...scene.inputs },
    outputs: scene.outputs,
    verdicts: judged ? said([judged.all, ...judged.verdicts, ...judged.warnings]) : undefined,
    checks: judged ? said(judged.checks) : undefined,
  };
}

function askFrame() {
  if (!isThere || isFrameAsked) return;
  isFrameAsked = true;
  requestAnimationFrame(() => {
    isFrameAsked = false;
    headline.write();
    if (first.isDirty) first.draw();
    document.documentElement.dataset.ready = "true";
    askIdle();
  });
}

function askIdle() {
  if (!isThere || isIdleAsked || !others.some((view) => view.isDirty && view.isSeen)) return;
  isIdleAsked = true;
  const idle = globalThis.requestIdleCallback ?? ((/** @type {() => void} */ run) => setTimeout(run, 1));
  idle(
    () => {
      isIdleAsked = false;
      const next = others.findIndex((view) => view.isDirty && view.isSeen);
      if (next < 0) return;
      const [view] = others.splice(next, 1);
      others.push(view); // so that each has its turn while a slider moves
      view.draw();
      askIdle();
    },
    { timeout: 100 },
  );
}

/** The hand rests: what was drawn with few points is drawn whole, and what needs no frame is written. */
function rest() {
  isMoving = false;
  if (!scene.judged) {
    judge();
    show();
    headline.write();
    for (const view of others) if (view instanceof Checks) view.draw();
  }
  if (wasThinned) {
    wasThinned = false;
    for (const view of views) view.isDirty = true;
    askFrame();
  }
  askBand();
  controls.refresh();
  taking.write();
  writeAddress();
}

function writeAddress() {
  const fragment = shownCase.fragment();
  try {
    if (fragment !== location.hash) history.replaceState(null, "", fragment);
  } catch {
    // some browsers keep the address of a file as it is
  }
}

/**
 * Show another state: what it needs is loaded first.
 *
 * @param {import("./case.js").State} state
 */
async function choose(state) {
  choices += 1;
  const own = choices;
  byId("page").setAttribute("aria-busy", "true");
  try {
    await engine.load(`${state.model}/${state.kind}`);
  } catch (error) {
    byId("trouble").textContent = `This part of the page could not be loaded: ${String(error)}`;
    byId("page").setAttribute("aria-busy", "false");
    showChoices();
    return;
  }
  if (own !== choices) return;
  byId("trouble").textContent = "";
  shownCase.with(state).prune();
  isThere = true;
  isMoving = true; // the first picture comes soon, a better one when the hand rests
  compute();
  build();
  changed();
  byId("page").setAttribute("aria-busy", "false");
}

/** Make all that has words or depends on what is chosen. */
function build() {
  showChoices();
  controls.build();
  headline.build();
  for (const view of views) view.prepare();
}

/** @param {string} id */
function selectById(id) {
  return /** @type {HTMLSelectElement} */ (byId(id));
}

/** The words of a start. @param {string} name */
function wordsOfStart(name) {
  const { title, make } = contents.starts[name];
  return name === "paper"
    ? "the screw of Olaru et al. (2005)"
    : [make, title === name ? "" : title].filter(Boolean).join(", ");
}

function showChoices() {
  const { start, model, kind, grade } = shownCase.state;
  const field = /** @type {HTMLInputElement} */ (byId("start"));
  field.value = start;
  byId("start-words").textContent = [wordsOfStart(start), contents.starts[start].source].filter(Boolean).join(" · ");
  byId("starts").replaceChildren(
    ...Object.keys(contents.starts).map((name) => element("option", { value: name }, wordsOfStart(name))),
  );
  const models = Object.keys(contents.models);
  fill(
    "model",
    models.map((name) => [name, name]),
    model,
  );
  fill(
    "kind",
    shownCase.kindsOf(model).map((name) => [name, contents.kinds[name].words]),
    kind,
  );
  const grades = Object.keys(contents.oils.grades);
  fill("grade", [["", "by its viscosity"], ...grades.map((name) => [name, name])], grade);
}

/** @param {string} id @param {string[][]} options @param {string} chosen */
function fill(id, options, chosen) {
  const menu = selectById(id);
  menu.replaceChildren(...options.map(([value, words]) => element("option", { value }, words)));
  menu.value = chosen;
}

/** Begin at a start, unless it is there. @param {string} name */
function beginAt(name) {
  byId("start-matches").replaceChildren();
  if (name !== shownCase.state.start) choose(shownCase.begin(name, shownCase.state.model));
}

/** Take the start that some words are about, or offer those that they may be about. @param {string} text */
function search(text) {
  if (!text.trim()) return;
  const { names, isCode } = screwsFor(text, { ...contents.starts, ...contents.rows });
  const isStart = (/** @type {string} */ name) => Object.hasOwn(contents.starts, name);
  const starts = names.filter(isStart);
  if (starts.length === 1 && !isCode) {
    beginAt(starts[0]);
    return;
  }
  const found = isCode
    ? `${text} is not in the list; these are of its size, or of its maker where it says no size:`
    : `${text} may be:`;
  const words = names.length ? found : `${text} is not in the list: write a size such as 40x10, or a part of a name.`;
  const buttons = names.map((name) => {
    if (!isStart(name)) return element("span", {}, `${name} (ballscrew check ${name})`);
    const button = element("button", { type: "button" }, name);
    button.addEventListener("click", () => beginAt(name));
    return button;
  });
  byId("start-matches").replaceChildren(words, ...buttons.flatMap((button) => [" ", button]));
}

function followChoices() {
  const field = /** @type {HTMLInputElement} */ (byId("start"));
  // an empty field offers all starts; it shows the chosen one again when it is left
  field.addEventListener("focus", () => {
    field.placeholder = shownCase.state.start;
    field.value = "";
  });
  field.addEventListener("blur", () => {
    field.value = shownCase.state.start;
  });
  const take = () => {
    if (Object.hasOwn(contents.starts, field.value)) beginAt(field.value);
  };
  field.addEventListener("input", take);
  field.addEventListener("change", () => (Object.hasOwn(contents.starts, field.value) ? take() : search(field.value)));
  selectById("model").addEventListener("change", ({ target }) => {
    const model = /** @type {HTMLSelectElement} */ (target).value;
    const kinds = shownCase.kindsOf(model);
    const kind = kinds.includes(shownCase.state.kind) ? shownCase.state.kind : kinds[0];
    choose({ ...shownCase.state, model, kind });
  });
  selectById("kind").addEventListener("change", ({ target }) => {
    choose({ ...shownCase.state, kind: /** @type {HTMLSelectElement} */ (target).value });
  });
  selectById("grade").addEventListener("change", ({ target }) => {
    const grade = /** @type {HTMLSelectElement} */ (target).value;
    const edits = { ...shownCase.state.edits };
    // the oil goes on with the viscosity that it has
    if (!grade) edits.viscosity = Number(shownCase.inShown("viscosity", scene.inputs.viscosity).toPrecision(4));
    choose({ ...shownCase.state, grade, edits });
  });
  byId("reset").addEventListener("click", () => {
    choose({ ...shownCase.begin(shownCase.state.start, shownCase.state.model) });
  });
  globalThis.addEventListener("hashchange", () => {
    if (location.hash !== shownCase.fragment()) chooseLinked();
  });
}

/** The scheme of colours: that of the system until another is chosen. */
function followScheme() {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const show = () => {
    const chosen = kept(SCHEME_KEPT) ?? "";
    document.documentElement.dataset.scheme = SCHEMES.includes(chosen) ? chosen : SCHEMES[system.matches ? 1 : 0];
    drawOnScreen();
  };
  const redraw = () => {
    show();
    for (const view of views) view.isDirty = true;
    askFrame();
  };
  show();
  system.addEventListener("change", redraw);
  // paper is light, and has the charts that nobody has seen yet
  addEventListener("beforeprint", () => {
    document.documentElement.dataset.scheme = SCHEMES[0];
    forget();
    for (const view of views) view.draw();
    drawOnPaper();
  });
  addEventListener("afterprint", redraw);
  byId("scheme").addEventListener("click", () => {
    keep(SCHEME_KEPT, document.documentElement.dataset.scheme === "dark" ? "light" : "dark");
    redraw();
  });
}

/** Charts are drawn when they are seen, and again when their size changes. */
function followSizes() {
  const seen = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        const view = views.find(({ section }) => section === target);
        if (view) view.isSeen = isIntersecting;
      }
      askIdle();
    },
    { rootMargin: "300px" },
  );
  const sized = new ResizeObserver(() => {
    for (const view of views) view.isDirty = true;
    askFrame();
  });
  for (const { section } of views) {
    seen.observe(section);
    sized.observe(section);
  }
}

function begin() {
  byId("first").append(first.section);
  byId("others").append(...others.map(({ section }) => section));
  byId("version").textContent = `ballscrew ${contents.version} · ${digest}`;
  followScheme();
  followChoices();
  followSizes();
  chooseLinked();
}

/** Show the case of the address. */
async function chooseLinked() {
  const { state, unknown } = shownCase.stateIn(location.hash);
  await choose(state);
  if (unknown.length === 0) return;
  byId("trouble").textContent =
    `The link has what this page does not have, and is shown without it: ${unknown.join(", ")}.`;
}

begin();
keepOffline();
