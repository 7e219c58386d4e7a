// The card of an optimisation: what a screw for a need would look like, whose sizes are free within what is made: the
// front of the best, each design by the full model, and as a design to take. The need is that of the card of choosing.

import * as designs from "../designs.js";
import { button, primaryButton } from "../controls.js";
import { element, scrolling, table } from "../dom.js";
import { labelOf } from "../messages.js";
import { FIELDS } from "../needs.js";
import { draw, hide, layout, watch } from "../plot.js";
import { LETTERS } from "../state.js";
import { store } from "../store.js";
import { text, textOr } from "../texts.js";
import * as units from "../units.js";
import * as views from "../views.js";
import { vocabulary } from "../vocabulary.js";
import { heading, numberOf, objective, verdictOf } from "./candidates.js";
import { commandLine, faultLines } from "./log_parts.js";
import { tables } from "./need_tables.js";
import { flags, optionFields } from "./option_fields.js";
import { data, quantity } from "./quantities.js";
import { question } from "./question.js";
import { lines } from "./records.js";

/** @typedef {OptimiseAnswer["candidates"][number]} Member */

const CHART = "optimise-chart";
/** Objectives of a search, those that are usual first. */
const OBJECTIVES = ["loss", "inertia", "life", "rigidity", "drive_torque", "preload_torque", "reflected_mass"];
const USUAL = OBJECTIVES.slice(0, 2);
const OPEN = "#8a8f96";
/** Sizes that are free, with the units in which they are shown. @type {Record<string, { convert: (value: number) => number | null, titled: (words: string) => string }>} */
const SIZES = {
  pitch_circle_diameter: quantity("m", "mm"),
  lead: quantity("m", "mm"),
  ball_diameter: quantity("m", "mm"),
};

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {Record<string, any>} */
  let need = {};
  let isOwn = false;
  /** @type {OptimiseAnswer | undefined} */
  let answer;
  let system = "";
  const asks = element("div", {});
  const problems = element("div", {});
  const command = element("div", {});
  const words = element("div", {});
  const axes = element("p", { class: "filters" });
  const chart = element("div", { id: CHART, class: "chart low whole-width", hidden: true });
  const rest = element("div", {});
  const result = element("div", { class: "card-result", hidden: true }, words, axes, chart, rest);
  const taken = element("p", { role: "status" });
  const asked = question({
    address: "optimise",
    result,
    show: (found) => show(found),
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      return undefined;
    },
  });
  const options = vocabulary.options.optimise.filter(({ name }) => name !== "objectives");
  /** @type {import("./option_fields.js").Given} */
  const chosen = {};
  const boxes = OBJECTIVES.map((name) => {
    const box = element("input", { type: "checkbox", checked: USUAL.includes(name), value: name });
    box.addEventListener("change", () => {
      isOwn = true;
      follow();
    });
    return box;
  });
  const start = primaryButton("optimise-start", "optimise.start", async () => {
    need = await tables(store.state.need);
    asked.follow(body(), 0);
  });
  holder.replaceChildren(
    asks,
    element(
      "fieldset",
      { class: "card-fields" },
      element("legend", {}, text("optimise.objectives")),
      element(
        "div",
        { class: "filters" },
        ...boxes.map((box) => element("label", {}, box, ` ${objective(box.value)}`)),
      ),
    ),
    optionFields("optimise", options, chosen, follow),
    element("p", { class: "card-start" }, start),
    command,
    asked.line,
    problems,
    taken,
    result,
  );
  watch(chart);
  asked.resume();

  function body() {
    const objectives = boxes.filter((box) => box.checked).map((box) => box.value);
    return { need, objectives, ...chosen };
  }

  async function follow() {
    need = await tables(store.state.need);
    asks.replaceChildren(element("p", {}, `${text("optimise.need")} ${summary()}`), element("p", {}, toNeed()));
    const listed = need.optimise?.objectives;
    // those of the need, until others are chosen here
    if (!isOwn) for (const box of boxes) box.checked = (Array.isArray(listed) ? listed : USUAL).includes(box.value);
    const { objectives } = body();
    start.disabled = !objectives.length;
    const names =
      JSON.stringify(objectives) === JSON.stringify(listed ?? USUAL) ? [] : ["--objectives", objectives.join(",")];
    command.replaceChildren(commandLine(["ballscrew", "optimise", "need.toml", ...names, ...flags(options, chosen)]));
    if (answer && system !== units.currentSystem()) show(answer);
    asked.compare(body());
  }

  /** @param {OptimiseAnswer} found */
  function show(found) {
    answer = found;
    system = units.currentSystem();
    result.hidden = false;
    const { candidates, search, notes, warnings } = found;
    const counts = text("optimise.counts", {
      shown: candidates.length,
      front: search.front,
      designs: search.evaluations,
    });
    words.replaceChildren(
      element("p", { class: candidates.length ? "verdict" : "verdict careful", "data-record": "optimise" }, counts),
      ...(candidates.length ? [] : [element("p", {}, text("optimise.none"))]),
      element("p", { class: "small" }, notes.join("; ")),
      element("p", { class: "small" }, text("optimise.shapes")),
      ...lines([], warnings),
    );
    if (candidates.length) front(found);
    else {
      for (const place of [axes, rest]) place.replaceChildren();
      hide(CHART);
    }
  }

  /** The menus of the axes, the chart and the table. @param {OptimiseAnswer} found */
  function front(found) {
    const names = found.objectives.map(({ name }) => name);
    /** @param {string} id @param {"choose.across" | "choose.up"} key @param {number} place */
    const axis = (id, key, place) =>
      element(
        "select",
        { id, "aria-label": text(key), onchange: () => picture() },
        ...names.map((name, at) => element("option", { value: name, selected: at === place }, objective(name))),
      );
    const x = axis("optimise-x", "choose.across", 0);
    const y = axis("optimise-y", "choose.up", Math.min(1, names.length - 1));
    axes.replaceChildren(text("choose.across"), " ", x, " ", text("choose.up"), " ", y);
    const picture = () => draw(CHART, pictureOf(found, x.value, y.value));
    rest.replaceChildren(tableOf(found, names));
    picture();
  }

  /** A design as a row of the table, with the button that takes it. @param {OptimiseAnswer} found @param {string[]} names */
  function tableOf(found, names) {
    const caption = text("optimise.caption");
    const sizes = Object.keys(SIZES);
    const headings = [
      text("optimise.design"),
      ...sizes.map((name) => SIZES[name].titled(labelOf(name))),
      text("optimise.turns"),
      text("optimise.preload"),
      ...names.map(heading),
      text("choose.verdict"),
      text("files.actions"),
    ];
    const rows = found.candidates.map((one, place) => {
      const name = text("optimise.name", { number: place + 1 });
      const takes = element("button", { type: "button", onclick: () => take(one, name) }, text("files.take"));
      takes.setAttribute("aria-label", text("files.take_row", { name }));
      return [
        one.pareto ? element("span", {}, name, element("em", {}, ` ${text("choose.pareto")}`)) : name,
        ...sizes.map((size) => units.digits(SIZES[size].convert(Number(one.variables[size])))),
        units.digits(one.variables.loaded_turns),
        units.digits(one.variables.preload === undefined ? null : 100 * Number(one.variables.preload)),
        ...names.map((each) =>
          data(`${place}-${each}`, one.objectives[each], units.digits(numberOf(asCandidate(one), each))),
        ),
        verdictOf(asCandidate(one)),
        takes,
      ];
    });
    return scrolling(caption, table(caption, headings, rows));
  }

  /** @param {Member} member @param {string} name */
  async function take(member, name) {
    if (!designs.hasRoom()) {
      taken.textContent = text("files.full", { most: LETTERS.length });
      return;
    }
    designs.add([await designs.ofCase(member.case, { name })]);
    taken.textContent = text("choose.taken", { name, letter: LETTERS[store.state.show] });
  }

  return { follow };
}

/** What the need asks for, in words. */
function summary() {
  const { texts, duty } = store.state.need;
  const given = Object.keys(FIELDS).flatMap((name) =>
    texts[name] ? [`${labelOf(FIELDS[name] || `need.${name}`)}: ${texts[name]}`] : [],
  );
  return [...given, ...(duty ? [text("choose.duty")] : [])].join("; ") || text("optimise.empty");
}

/** A button to the card that has the fields of the need. */
function toNeed() {
  return button(text("optimise.to_need"), () => views.go("choose.rows"));
}

/**
 * A design as a candidate of a selection, whose verdict is written alike.
 *
 * @param {Member} member
 * @returns {any}
 */
function asCandidate(member) {
  const fails = member.checks.filter((check) => check.holds === false);
  const lost = /** @type {Record<string, any>} */ (member).rigid_lift_off_load ?? null;
  return { ...member, fails, complete: true, starved: false, rigid_lift_off_load: lost };
}

/**
 * The front by two objectives: all designs of the search, and those that were evaluated in full.
 *
 * @param {OptimiseAnswer} found
 * @param {string} x
 * @param {string} y
 * @returns {import("../plot.js").Chart}
 */
function pictureOf(found, x, y) {
  const { candidates: all, picture } = found;
  const fails = (/** @type {Member} */ one) => one.checks.some((check) => check.holds === false);
  const value = (/** @type {Member} */ one, /** @type {string} */ name) => numberOf(asCandidate(one), name);
  /** @param {string} name */
  const ofSearch = (name) =>
    picture.front[name].map((one) => numberOf(/** @type {any} */ ({ objectives: { [name]: one } }), name));
  /** @param {{ second: string, accent: string }} colours */
  const groups = ({ second, accent }) => [
    { key: "choose.fail", symbol: "x-thin-open", colour: OPEN, of: all.filter(fails) },
    { key: "choose.fit", symbol: "circle", colour: accent, of: all.filter((one) => !fails(one) && !one.pareto) },
    { key: "optimise.front", symbol: "diamond", colour: second, of: all.filter((one) => one.pareto) },
  ];
  /** @param {Member} one */
  const name = (one) => text("optimise.name", { number: all.indexOf(one) + 1 });
  return {
    name: "front",
    caption: text("optimise.caption"),
    description: text("optimise.picture", { x: objective(x), y: objective(y), count: all.length }),
    figure: (colours) => ({
      traces: [
        {
          x: ofSearch(x),
          y: ofSearch(y),
          mode: "markers",
          name: text("optimise.search"),
          marker: { size: 4, color: OPEN },
          hoverinfo: "skip",
        },
        ...groups(colours).map(({ key, symbol, colour, of }) => ({
          x: of.map((one) => value(one, x)),
          y: of.map((one) => value(one, y)),
          text: of.map(name),
          mode: "markers",
          name: textOr(key, key),
          marker: { symbol, color: colour, size: 9, line: { color: colour, width: 1.5 } },
          hovertemplate: "%{text}<br>%{x:.4g}, %{y:.4g}<extra></extra>",
        })),
      ],
      layout: layout(colours, heading(x), heading(y), { hovermode: "closest" }),
    }),
    legend: (colours) => [
      { kind: "point", name: text("optimise.search"), colour: OPEN },
      ...groups(colours).map(({ key, colour }) => ({ kind: "point", name: textOr(key, key), colour })),
    ],
    numbers: () => [
      [text("optimise.design"), heading(x), heading(y), text("choose.front_column"), text("checks.holds")],
      all.map((one) => [name(one), value(one, x), value(one, y), one.pareto, one.holds]),
    ],
  };
}
