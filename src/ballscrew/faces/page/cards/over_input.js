// A result over any input: one curve for each design, all at one load and speed or each at its own.

import * as parts from "../chart_parts.js";
import { draw, showFailure } from "../chart_place.js";
import * as designs from "../designs.js";
import { menu, textField } from "../controls.js";
import { element } from "../dom.js";
import { linesByValidity, pointAt } from "../figure_parts.js";
import { yesOrNo } from "../figure_words.js";
import { inWords } from "../messages.js";
import { labelIn } from "../fields.js";
import { numbersOf } from "../results.js";
import { definition, fieldOf, SECTIONS } from "../schema.js";
import { Latest, linesOf, Problem } from "../server.js";
import { askPatiently, sendPatiently } from "../long_work.js";
import { LETTERS, valueAt } from "../state.js";
import { store } from "../store.js";
import { RESULTS } from "../names.js";
import * as units from "../units.js";

const CHART = "over-input-chart";
/** Points of a curve; fewer for a nut whose balls are computed one by one. */
const POINTS = 31;
const POINTS_OF_NUT = 13;
/** Milliseconds after the last key. */
const DELAY = 300;
/** Sections whose numbers can be varied, and the shares of a value from which to which they are. @type {Record<string, [number, number]>} */
const VARIED = {
  operation: [0.02, 2],
  screw: [0.8, 1.2],
  nut: [0.1, 2],
  lubricant: [0.25, 2],
  model: [0.5, 1.5],
};
/** A cold start and a hot machine, K. */
const TEMPERATURES = [273.15, 353.15];
/** What catalogues and data sheets state: no friction follows from it alone. */
const STATED = [
  "screw.dynamic_load_rating",
  "screw.static_load_rating",
  "screw.root_diameter",
  "lubricant.kinematic_viscosity_40",
  "lubricant.kinematic_viscosity_100",
  "lubricant.density_15",
  "lubricant.pour_point",
  "lubricant.lowest_temperature",
  "lubricant.highest_temperature",
];
/** The greatest value, in the unit that is shown, of an input that is nothing; the fewest steps of a whole number. */
const FOR_NOTHING = 100;
const FEWEST = 4;
const OUTPUTS = /** @type {const} */ (["screw_torque", "drive_torque", "efficiency", "friction_power"]);
const STYLES = ["line", "dashed", "dotted", "dashdot"];
/** Colours of designs, on light and on dark. */
const COLOURS = ["accent", "second", "green", "#A3569B"];

/**
 * A curve of a design, or the reason why it has none.
 *
 * @typedef {{ letter: string, run?: Run, at?: number, swept?: Sweep, reason?: string }} Curve
 */
/** @typedef {{ path: string, output: typeof OUTPUTS[number], from?: number, to?: number }} Question */

/**
 * Set the card up in its place, which has the place of its chart.
 *
 * @param {HTMLElement} holder
 */
export function setUp(holder) {
  /** @type {Question} */
  const question = { path: "", output: "screw_torque" };
  /** @type {ReturnType<typeof setTimeout>} */
  let timer;
  const requests = new Latest();
  /** @param {Partial<Question>} found */
  const change = (found) => {
    Object.assign(question, found);
    show();
  };
  const again = { from: undefined, to: undefined };
  const input = menu([], "", (path) => change({ path, ...again }), { id: "over-input-of" });
  const output = menu(
    OUTPUTS.map((name) => [name, RESULTS[name]]),
    question.output,
    (name) => change({ output: /** @type {Question["output"]} */ (name) }),
    { id: "over-input-result" },
  );
  /** @param {"from" | "to"} end */
  const field = (end) => {
    /** @param {string} typed */
    const read = (typed) => {
      const number = Number(units.withPoint(units.inASCII(typed)));
      question[end] = typed.trim() !== "" && Number.isFinite(number) ? inSI(question.path, number) : undefined;
      later();
    };
    return textField("", read, { inputmode: "decimal", id: `over-input-${end}` });
  };
  const [from, to] = [field("from"), field("to")];
  const unit = element("span");
  const reasons = element("div", { role: "status" });
  /** @param {HTMLElement} control @param {string} words */
  const labelled = (control, words) => element("p", {}, element("label", { for: control.id }, words), control);
  holder.prepend(
    element(
      "div",
      { class: "choices" },
      labelled(output, "Result"),
      labelled(input, "over"),
      labelled(from, "from"),
      labelled(to, "to"),
      unit,
    ),
  );
  holder.append(reasons);

  function later() {
    clearTimeout(timer);
    timer = setTimeout(show, DELAY);
  }

  async function show() {
    clearTimeout(timer);
    const signal = requests.begin();
    holder.setAttribute("aria-busy", "true");
    try {
      const runs = await runsOf(signal);
      if (signal.aborted) return;
      const paths = inputsOf(runs);
      if (!paths.includes(question.path)) question.path = usual(paths);
      showInputs(paths);
      if (!question.path) {
        showFailure(CHART, runs.map(({ reason }) => reason).join("; "));
        return;
      }
      const [low, high] = rangeOf(question, runs);
      showEnd(from, low);
      showEnd(to, high);
      unit.textContent = units.symbol(unitOf(question.path));
      const curves = await Promise.all(runs.map((one) => curveOf(one, question, low, high, signal)));
      if (signal.aborted) return;
      const failed = curves.filter(({ reason }) => reason);
      reasons.replaceChildren(
        ...failed.map(({ letter, reason }) => element("p", { class: "warning" }, `Design ${letter}: ${reason}`)),
      );
      if (failed.length < curves.length) chart(curves, question);
      else showFailure(CHART, failed[0].reason ?? "");
    } catch (error) {
      if (signal.aborted) return;
      showFailure(CHART, linesOf(error).join("; "));
    } finally {
      if (!signal.aborted) holder.setAttribute("aria-busy", "false");
    }
  }

  /** @param {string[]} paths */
  function showInputs(paths) {
    /** @type {Map<string, string[]>} */
    const groups = new Map();
    for (const path of paths) {
      const [section] = path.split(".");
      groups.set(section, [...(groups.get(section) ?? []), path]);
    }
    const options = [...groups].map(([section, members]) =>
      element(
        "optgroup",
        { label: SECTIONS[section] },
        ...members.map((path) => element("option", { value: path }, labelIn(path))),
      ),
    );
    input.replaceChildren(...options);
    input.value = question.path;
  }

  /** @param {HTMLInputElement} control @param {number} value */
  function showEnd(control, value) {
    if (document.activeElement !== control) control.value = units.digits(shown(question.path, value));
  }

  return { follow: later };
}

/**
 * The answers of all designs, which the page has asked for already; at the load and the speed of the first one, unless
 * each is compared at its own.
 *
 * @param {AbortSignal} signal
 * @returns {Promise<(Curve & { body?: { case: Record<string, unknown> } })[]>}
 */
async function runsOf(signal) {
  const { designs: all, own } = store.state;
  const cases = await Promise.all(all.map(designs.caseOf));
  const { operation } = cases[0];
  return Promise.all(
    cases.map(async (one, place) => {
      const body = { case: own || !operation ? one : { ...one, operation } };
      const letter = LETTERS[place];
      try {
        return { letter, body, run: await askPatiently("run", body, signal) };
      } catch (error) {
        return { letter, body, reason: linesOf(error).join("; ") };
      }
    }),
  );
}

/**
 * The paths of the numbers that all designs together have, and that can be varied.
 *
 * @param {Curve[]} runs
 */
function inputsOf(runs) {
  /** @type {Set<string>} */
  const found = new Set();
  for (const { run } of runs) {
    for (const section of Object.keys(VARIED)) {
      const table = /** @type {Record<string, any>} */ (run?.inputs[section] ?? {});
      for (const [name, value] of Object.entries(table)) {
        if (typeof value === "number") found.add(`${section}.${name}`);
        if (value?.law) {
          for (const [inner, one] of Object.entries(value)) {
            if (typeof one === "number") found.add(`${section}.${name}.${inner}`);
          }
        }
      }
    }
  }
  return [...found].filter((path) => fieldOf(path) && !STATED.includes(path));
}

/** The input to begin with. @param {string[]} paths */
function usual(paths) {
  const wanted = ["nut.preload", "lubricant.temperature", "operation.axial_load"];
  return wanted.find((path) => paths.includes(path)) ?? paths[0] ?? "";
}

/** The unit that an input is shown in. @param {string} path */
function unitOf(path) {
  return units.inSystem(definition(fieldOf(path))?.["x-unit"] ?? "");
}

/** @param {string} path @param {number} value in SI */
function shown(path, value) {
  return units.fromSI(value, unitOf(path), fieldOf(path)?.["x-si-unit"]);
}

/** @param {string} path @param {number} number in the unit that is shown */
function inSI(path, number) {
  return units.toSI(number, unitOf(path), fieldOf(path)?.["x-si-unit"]);
}

/**
 * From where to where an input is varied, in SI: as given, or around the values of the designs and within its bounds.
 *
 * @param {Question} question
 * @param {Curve[]} runs
 * @returns {[number, number]}
 */
function rangeOf({ path, from, to }, runs) {
  const values = runs.map(({ run }) => valueAt(run?.inputs, path)).filter((value) => typeof value === "number");
  const sizes = values.map(Math.abs);
  const [first, last] = VARIED[path.split(".")[0]];
  let [low, high] = [Math.min(...sizes) * first, Math.max(...sizes) * last || inSI(path, FOR_NOTHING)];
  if (values.every((value) => value < 0)) [low, high] = [-high, -low];
  else if (values.some((value) => value < 0)) low = -high;
  if (path === "lubricant.temperature") {
    [low, high] = [Math.min(TEMPERATURES[0], ...values), Math.max(TEMPERATURES[1], ...values)];
  }
  const { type, minimum, maximum, exclusiveMinimum, exclusiveMaximum } = numberOf(path);
  if (type === "integer") [low, high] = [Math.round(low), Math.max(Math.round(high), Math.round(low) + FEWEST)];
  if (minimum !== undefined) low = Math.max(low, minimum);
  if (maximum !== undefined) high = Math.min(high, maximum);
  if (exclusiveMinimum !== undefined && low <= exclusiveMinimum) low = inside(exclusiveMinimum, high);
  if (exclusiveMaximum !== undefined && high >= exclusiveMaximum) high = inside(exclusiveMaximum, low);
  return [from ?? low, to ?? high];
}

/**
 * A value just inside a bound that is none itself.
 *
 * @param {number} bound
 * @param {number} other the other end of the range
 */
function inside(bound, other) {
  return bound + 0.02 * (other - bound);
}

/**
 * The part of the schema of a field that has its bounds, of a number without a unit.
 *
 * @param {string} path
 * @returns {import("../schema.js").SchemaNode & Partial<Record<"minimum" | "maximum" | "exclusiveMinimum" | "exclusiveMaximum", number>>}
 */
function numberOf(path) {
  const node = fieldOf(path) ?? {};
  return node.anyOf?.find(({ type }) => type === "number") ?? node;
}

/**
 * The sweep of a design over the input.
 *
 * @param {Curve & { body?: { case: Record<string, unknown> } }} one
 * @param {Question} question
 * @param {number} low
 * @param {number} high
 * @param {AbortSignal} signal
 * @returns {Promise<Curve>}
 */
async function curveOf({ letter, run, reason, body }, { path, output }, low, high, signal) {
  if (!run) return { letter, reason };
  const at = valueAt(run.inputs, path);
  if (typeof at !== "number") return { letter, reason: `this design has no ${labelIn(path)}` };
  const count = run.loads ? POINTS_OF_NUT : POINTS;
  const name = path.slice(path.indexOf(".") + 1);
  const node = numberOf(path);
  let axis = `${low}:${high}:${count} ${node["x-si-unit"] ?? ""}`.trim();
  if (node.type === "integer") {
    const step = Math.max(1, Math.round((high - low) / (count - 1)));
    const whole = Array.from({ length: count }, (_, place) => Math.round(low) + place * step);
    axis = whole.filter((value) => value <= Math.max(high, Math.round(low))).join(", ");
  }
  try {
    const swept = await sendPatiently("sweep", { ...body, vary: { [name]: axis }, outputs: [output] }, signal);
    return { letter, run, at, swept };
  } catch (error) {
    const [fault] = error instanceof Problem ? error.faults : [];
    return { letter, reason: fault ? inWords(fault) : linesOf(error).join("; ") };
  }
}

/**
 * The line of a design by its place: the next one where the colours begin again, so that no two designs look the same.
 *
 * @param {number} place
 */
function lineOf(place) {
  return (place + Math.floor(place / COLOURS.length)) % STYLES.length;
}

/**
 * @param {Curve[]} all
 * @param {Question} question
 */
function chart(all, { path, output }) {
  const curves = all.flatMap((one) => {
    const { letter, run, at, swept } = one;
    if (!run || !swept || at === undefined) return [];
    const axis = Object.values(swept.axes)[0];
    const number = numbersOf(run)[output];
    return [
      {
        name: `Design ${letter}`,
        place: LETTERS.indexOf(letter),
        x: parts.valuesOf(axis).map((value) => shown(path, value)),
        y: parts.converted(output, swept.outputs[output]),
        valid: parts.validAlong(swept),
        at: [shown(path, at), units.inDisplayUnit(output, number)],
      },
    ];
  });
  const unit = unitOf(path);
  const words = labelIn(path);
  const x = unit ? `${words} (${units.symbol(unit)})` : words;
  const y = units.heading(output, RESULTS[output]);
  const caption = `${RESULTS[output]} over ${words}`;
  draw(CHART, {
    name: "over_input",
    caption,
    description: `${caption}, curves of ${curves.length} designs.`,
    figure: {
      x: { title: x },
      y: { title: y, zero: true },
      marks: curves.flatMap(({ name, place, at, ...one }) => {
        const colour = COLOURS[place % COLOURS.length];
        const lines = linesByValidity(one.x, one.y, one.valid, name, colour, STYLES[lineOf(place)]);
        return [...lines, pointAt(at[0], at[1], colour)];
      }),
    },
    numbers: () => [
      [x, ...curves.flatMap(({ name }) => [`${y}, ${name}`, `valid, ${name}`])],
      curves[0].x.map((at, place) => [at, ...curves.flatMap((one) => [one.y[place], yesOrNo(one.valid[place])])]),
    ],
  });
}
