// The card of the axis: a sketch whose parts are the inputs, and what gives way between motor and table over the stroke.

import { sketch } from "../axis_sketch.js";
import * as designs from "../designs.js";
import { element, redraw, scrolling, table } from "../dom.js";
import { documented } from "../help.js";
import { draw, hide, layout, watch } from "../plot.js";
import * as schema from "../schema.js";
import * as states from "../state.js";
import { store } from "../store.js";
import { text } from "../texts.js";
import * as units from "../units.js";
import { inPanes } from "../views.js";
import { fieldset, placeFaults, showValues } from "./case_fields.js";
import { caseFile, commandLine, faultLines } from "./log_parts.js";
import { data, FORCE, GROWTH, POSITION, quantity, TURNING } from "./quantities.js";
import { question } from "./question.js";
import { lines } from "./records.js";

/** @typedef {ChainAnswer["results"]} Results */
/** @typedef {import("../state.js").Tables} Tables */
/** @typedef {readonly (number | null)[]} Values */

/** Springs of the chain with their colours, as the command draws them. @type {[Spring, string][]} */
const SPRINGS = [
  ["nut", "#0072B2"],
  ["shaft", "#E69F00"],
  ["bearings", "#009E73"],
  ["mount", "#888888"],
  ["torsion", "#CC79A7"],
];
/** @typedef {"nut" | "shaft" | "bearings" | "mount" | "torsion"} Spring */
/** The charts, and the panes in which they are. @type {[string, string][]} */
const CHARTS = [
  ["axis-rigidity", "axis.stroke"],
  ["axis-shares", "axis.stroke"],
  ["axis-lost", "axis.limits"],
  ["axis-speed", "axis.limits"],
  ["axis-buckling", "axis.limits"],
];
const LIMIT = "#D55E00";
const SHADE = "#80808033";
const RIGIDITY = quantity("N/m", "N/um");
const BUCKLING = quantity("N", "kN");
/** Fields of the elements of an axis that has them. @type {[string, string, string[]][]} */
const ELEMENTS = [
  ["bearings.fixed", "bearings", ["rigidity", "preload"]],
  ["guides", "guides", ["friction_coefficient", "seal_force", "carriages"]],
];

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const picture = inPanes(element("div"), "axis.parts");
  const editor = inPanes(element("div", { class: "card-inputs" }), "axis.parts");
  const command = inPanes(element("div"), "axis.parts");
  const problems = element("div");
  const words = inPanes(element("div", { class: "half" }), "axis.stroke");
  const weakest = inPanes(element("div", { class: "half" }), "axis.stroke");
  const assumed = inPanes(element("div", { class: "half" }), "axis.limits");
  const places = CHARTS.map(([id, pane]) => inPanes(element("div", { id, class: "chart low", hidden: true }), pane));
  const result = element("div", { class: "card-result", hidden: true }, ...places, weakest, words, assumed);
  /** @type {Tables} */
  let tables = {};
  /** @type {ChainAnswer | undefined} */
  let answer;
  let system = "";
  /** What the fields show, as text. */
  let shown = "";
  const asked = question({
    address: "axis",
    isShort: true,
    result,
    show,
    place: (faults) => {
      problems.replaceChildren(...faultLines(placeFaults(editor, faults)));
      return undefined;
    },
  });
  holder.replaceChildren(picture, editor, command, asked.line, problems, result);
  for (const place of places) watch(place);

  /** @param {import("../fields.js").Change} change */
  function onChange({ path = "", text: typed = "", unit }) {
    if (unit !== undefined) {
      designs.chooseUnit(path, unit);
      return;
    }
    const [section] = path.split(".");
    tables = states.tables(tables, { [path]: typed }, schema.fieldOf);
    shown = keyOf();
    designs.setTables({ [section]: tables[section] ?? {} }, path);
  }

  function keyOf() {
    const { fields, show: design } = store.state;
    return JSON.stringify([tables.bearings, tables.guides, fields, design, units.currentSystem()]);
  }

  async function follow() {
    const design = designs.current();
    const found = await designs.currentCase();
    if (design !== designs.current()) return; // another one was chosen in the meantime, and is followed on its own
    tables = found;
    drawSketch();
    if (keyOf() !== shown) {
      shown = keyOf();
      editor.replaceChildren(...elements());
    }
    if (answer) showValues(editor, answer.inputs);
    command.replaceChildren(commandLine(["ballscrew", "axis", caseFile()]), about());
    if (answer && system !== units.currentSystem()) show(answer);
    asked.follow({ case: tables });
  }

  /** The sketch; the focus stays at the part where it is. */
  function drawSketch() {
    redraw(picture, sketch(tables, /** @type {Tables} */ (answer?.inputs ?? {})));
  }

  /** The fields of bearings and guides that the case has. */
  function elements() {
    return ELEMENTS.filter(([path]) => states.valueAt(tables, path) !== undefined).map(([path, section, names]) =>
      fieldset(path, schema.OF_CARDS[section], names, { state: store.state, tables, onChange }),
    );
  }

  /** @param {ChainAnswer} found */
  function show(found) {
    answer = found;
    system = units.currentSystem();
    const { results, verdicts, warnings } = found;
    result.hidden = false;
    drawSketch();
    showValues(editor, found.inputs);
    words.replaceChildren(...lines(verdicts, warnings));
    draw("axis-rigidity", rigidity(results));
    draw("axis-shares", shares(results));
    if (isKnown(results.lost_motion)) draw("axis-lost", lostMotion(results));
    else hide("axis-lost");
    draw("axis-speed", against(results, "speed", results.critical_speed, results.largest_speed, TURNING));
    draw("axis-buckling", against(results, "buckling", results.buckling_load, results.largest_load, BUCKLING));
    const list = element("ul", {}, ...found.assumed.map((one) => element("li", {}, one)));
    weakest.replaceChildren(softest(results));
    assumed.replaceChildren(element("details", { open: "" }, element("summary", {}, text("axis.assumed")), list));
  }

  return { follow };
}

function about() {
  return element("p", { class: "small" }, documented("howto/axis", text("axis.how_to")));
}

/** @param {Values} values */
function isKnown(values) {
  return values.some((one) => one !== null);
}

/** The name of a spring. @param {Spring} name */
function nameOf(name) {
  return text(`axis.${name}`);
}

/** The springs of an answer that are known, with their values in SI. @param {Results} results */
function known(results) {
  return SPRINGS.filter(([name]) => isKnown(results[name])).map(([name, colour]) => ({
    name,
    colour,
    values: results[name],
  }));
}

/** What all charts have: the place of the nut, and its travel as an area. @param {Results} results */
function overPlace({ position, travel }) {
  const [x0, x1] = POSITION.all(travel);
  return {
    title: POSITION.titled(text("axis.place")),
    x: POSITION.all(position),
    shapes: [
      { type: "rect", yref: "paper", y0: 0, y1: 1, x0, x1, fillcolor: SHADE, line: { width: 0 }, layer: "below" },
    ],
    entry: { kind: "area", name: text("axis.travel"), colour: SHADE },
  };
}

/** @param {(number | null)[]} x @param {(number | null)[]} y @param {string} name @param {string} color @param {number} width */
function curve(x, y, name, color, width) {
  return { x, y, name, mode: "lines", line: { color, width }, hovertemplate: "%{y:.4g}" };
}

/**
 * The whole rigidity and that of each part over the place of the nut.
 *
 * @param {Results} results
 * @returns {import("../plot.js").Chart}
 */
function rigidity(results) {
  const { title, x, shapes, entry } = overPlace(results);
  const y = RIGIDITY.titled(text("axis.rigidity"));
  const springs = known(results);
  const all = text("axis.total");
  return {
    name: "axis_rigidity",
    caption: text("axis.rigidity_caption"),
    description: text("axis.rigidity_description", {
      least: RIGIDITY.text(results.softest.total, 4),
      place: POSITION.text(results.softest.position, 4),
    }),
    figure: (colours) => ({
      traces: [
        ...springs.map(({ name, colour, values }) => curve(x, RIGIDITY.all(values), nameOf(name), colour, 1.6)),
        curve(x, RIGIDITY.all(results.total), all, colours.ink, 3),
      ],
      layout: layout(colours, title, y, { shapes, yaxis: { type: "log", rangemode: "normal" } }),
    }),
    legend: (colours) => [
      { kind: "line", name: all, colour: colours.ink },
      ...springs.map(({ name, colour }) => ({ kind: "line", name: nameOf(name), colour })),
      entry,
    ],
    numbers: () => [
      [title, RIGIDITY.titled(all), ...springs.map(({ name }) => RIGIDITY.titled(nameOf(name)))],
      x.map((at, place) => [
        at,
        RIGIDITY.convert(results.total[place]),
        ...springs.map(({ values }) => RIGIDITY.convert(values[place])),
      ]),
    ],
  };
}

/**
 * The share of each part in what gives way.
 *
 * @param {Results} results
 * @returns {import("../plot.js").Chart}
 */
function shares(results) {
  const { title, x, shapes, entry } = overPlace(results);
  const springs = known(results);
  const y = text("axis.share");
  /** @param {Spring} name */
  const percent = (name) => (results.shares[name] ?? []).map((one) => (one === null ? null : 100 * Number(one)));
  return {
    name: "axis_shares",
    caption: text("axis.share_caption"),
    description: text("axis.share_caption"),
    figure: (colours) => ({
      traces: springs.map(({ name, colour }) => ({
        ...curve(x, percent(name), nameOf(name), colour, 0),
        stackgroup: "all",
        fillcolor: colour,
        hovertemplate: "%{y:.3g} %",
      })),
      layout: layout(colours, title, y, { shapes, yaxis: { range: [0, 100] } }),
    }),
    legend: () => [...springs.map(({ name, colour }) => ({ kind: "area", name: nameOf(name), colour })), entry],
    numbers: () => [
      [title, ...springs.map(({ name }) => `${nameOf(name)} (%)`)],
      x.map((at, place) => [at, ...springs.map(({ name }) => percent(name)[place])]),
    ],
  };
}

/** @param {Results} results @returns {import("../plot.js").Chart} */
function lostMotion(results) {
  const { title, x, shapes, entry } = overPlace(results);
  const name = text("axis.lost_motion");
  const y = GROWTH.titled(name);
  const values = GROWTH.all(results.lost_motion);
  return {
    name: "axis_lost_motion",
    caption: text("axis.lost_caption", { friction: FORCE.text(results.guide_friction, 4) }),
    description: text("axis.lost_caption", { friction: FORCE.text(results.guide_friction, 4) }),
    figure: (colours) => ({
      traces: [curve(x, values, name, colours.accent, 2.5)],
      layout: layout(colours, title, y, { shapes }),
    }),
    legend: (colours) => [{ kind: "line", name, colour: colours.accent }, entry],
    numbers: () => [[title, y], x.map((at, place) => [at, values[place]])],
  };
}

/**
 * What the shaft stands over the place of the nut, and the largest that it has to.
 *
 * @param {Results} results
 * @param {"speed" | "buckling"} of
 * @param {Values} stands
 * @param {number | null} largest
 * @param {ReturnType<typeof quantity>} unit
 * @returns {import("../plot.js").Chart}
 */
function against(results, of, stands, largest, unit) {
  const { title, x, shapes, entry } = overPlace(results);
  const [name, most] = [text(`axis.${of}`), text(`axis.largest_${of}`)];
  const values = unit.all(stands);
  const limit = x.map(() => unit.convert(largest));
  const y = unit.titled(name);
  return {
    name: `axis_${of}`,
    caption: name,
    description: text("axis.against", { name, most, largest: unit.text(largest) }),
    figure: (colours) => ({
      traces: [
        curve(x, values, name, colours.accent, 2.5),
        { ...curve(x, limit, most, LIMIT, 1.8), line: { color: LIMIT, width: 1.8, dash: "dash" } },
      ],
      layout: layout(colours, title, y, { shapes, yaxis: { type: "log", rangemode: "normal" } }),
    }),
    legend: (colours) => [
      { kind: "line", name, colour: colours.accent },
      { kind: "dash", name: most, colour: LIMIT },
      entry,
    ],
    numbers: () => [[title, y, unit.titled(most)], x.map((at, place) => [at, values[place], limit[place]])],
  };
}

/** What gives way where the chain is softest, part by part, and what else is known there. @param {Results} results */
function softest(results) {
  const { softest: here, position } = results;
  const at = position.indexOf(here.position);
  const rows = [
    ...known(results).map(({ name }) => [
      nameOf(name),
      data(name, here[name], RIGIDITY.text(here[name], 4)),
      `${units.digits(100 * Number(results.shares[name]?.[at] ?? 0), 3)}\u00a0%`,
    ]),
    [element("strong", {}, text("axis.total")), data("total", here.total, RIGIDITY.text(here.total, 4)), "100\u00a0%"],
    [text("axis.lost_motion"), data("lost_motion", here.lost_motion, GROWTH.text(here.lost_motion, 4)), ""],
    [text("axis.speed"), data("critical_speed", here.critical_speed, TURNING.text(here.critical_speed, 4)), ""],
    [text("axis.buckling"), data("buckling_load", here.buckling_load, BUCKLING.text(here.buckling_load, 4)), ""],
  ];
  const caption = text("axis.softest", { place: POSITION.text(here.position, 4) });
  return scrolling(caption, table(caption, ["", text("axis.value"), text("axis.share_of")], rows));
}
