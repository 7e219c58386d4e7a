// The card of a sensitivity: the uncertain inputs that the band of a result comes from, as bars about its mean, the one
// that matters most first, and what to find out to halve the band.

import { jump } from "../cards.js";
import { menu } from "../controls.js";
import { element, scrolling, table } from "../dom.js";
import { documented } from "../help.js";
import { draw, layout } from "../plot.js";
import { text, textOr } from "../texts.js";
import * as units from "../units.js";
import { askedByButton } from "./asked_by_button.js";
import { data, quantity } from "./quantities.js";

/** @typedef {SensitivityAnswer["sensitivity"]["inputs"][number]} Indices */
/** @typedef {SensitivityAnswer["display"]["inputs"][number]} Shown */
/** @typedef {Indices & Shown} Input */
/** A bar of an input: the change of the output, in SI, and the ends of its interval. @typedef {{ value: number, low: number, high: number }} Bar */

const CHART = "sensitivity-chart";
/** Results that are asked about, and methods. */
const OUTPUTS = ["screw_torque", "drive_torque", "efficiency", "friction_power"];
const METHODS = ["sobol", "morris", "local"];
/** Bars that are drawn; the others are in the table. */
const MOST_BARS = 10;
/** Letters of a name in one line of the axis. */
const LINE = 24;
const [LIGHT, DARK] = ["#56B4E9", "#0072B2"];

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const chart = element("div", { id: CHART, class: "chart tall whole-width", hidden: true });
  const about = [`${text("sensitivity.about")} `, documented("howto/halve_the_band", `${text("sensitivity.how_to")}.`)];
  return askedByButton(holder, "sensitivity", about, "sensitivity.start", [chart], show, {
    names: ["output", "method"],
    fields: (given, change) => [
      element(
        "p",
        { class: "card-start" },
        ...optionMenu("output", OUTPUTS, (name) => textOr(`results.${name}`, name), given, change),
        ...optionMenu("method", METHODS, (name) => textOr(`sensitivity.method.${name}`, name), given, change),
      ),
    ],
  });
}

/**
 * A menu of an option, whose first entry is its default.
 *
 * @param {"output" | "method"} name
 * @param {string[]} values
 * @param {(value: string) => string} words
 * @param {import("./option_fields.js").Given} given
 * @param {() => void} change
 */
function optionMenu(name, values, words, given, change) {
  const id = `sensitivity-${name}`;
  /** @type {[string, string][]} */
  const options = values.map((value) => [value, words(value)]);
  const take = (/** @type {string} */ value) => {
    if (value === values[0]) delete given[name];
    else given[name] = value;
    change();
  };
  return [element("label", { for: id }, text(`sensitivity.${name}`)), menu(options, values[0], take, { id })];
}

/** @param {SensitivityAnswer} found */
function show(found) {
  const { sensitivity: indices, display } = found;
  const shown = new Map(display.inputs.map((one) => [one.name, one]));
  const inputs = indices.inputs.map((one) => /** @type {Input} */ ({ ...one, ...shown.get(one.name) }));
  draw(CHART, picture(found, inputs));
  return [inputsTable(found, inputs), element("p", { class: "small" }, text("sensitivity.laws_stay"))];
}

/** The quantity of the output. @param {SensitivityAnswer} found */
function ofOutput({ display }) {
  return quantity(display.unit, display.shown_in);
}

/**
 * The bars of an input: the change of the output in its unit. Of the shares of a variance it is the standard deviation
 * that goes with them, the root of the share times that of the output.
 *
 * @param {SensitivityAnswer} found
 * @param {Indices} input
 * @returns {Bar[]}
 */
function barsOf({ sensitivity: indices }, input) {
  const { effect, first_order: first, total } = input;
  if (effect) return [asBar(effect, (value) => value)];
  /** @param {number} share */
  const spread = (share) => Math.sqrt(Math.max(share, 0)) * Number(indices.standard_deviation);
  return [total, first].flatMap((one) => (one ? [asBar(one, spread)] : []));
}

/** @param {{ value: number | null, low: number | null, high: number | null }} estimate @param {(value: number) => number} change */
function asBar({ value, low, high }, change) {
  return { value: change(Number(value)), low: change(Number(low)), high: change(Number(high)) };
}

/** The names of the bars. @param {string} method */
function namesOf(method) {
  return method === "sobol"
    ? [text("sensitivity.total"), text("sensitivity.first_order")]
    : [text("sensitivity.effect")];
}

/** A name in lines, for an axis. @param {string} name */
function inLines(name) {
  /** @type {string[]} */
  const lines = [];
  for (const word of name.split(" ")) {
    const last = lines.at(-1);
    if (last !== undefined && last.length + word.length < LINE) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines.join("<br>");
}

/**
 * A bar for each input about the mean of the output, the largest on top.
 *
 * @param {SensitivityAnswer} found
 * @param {Input[]} all
 * @returns {import("../plot.js").Chart}
 */
function picture(found, all) {
  const { sensitivity: indices } = found;
  const inputs = all.slice(0, MOST_BARS);
  const unit = ofOutput(found);
  const names = namesOf(indices.method);
  const places = inputs.map((_, place) => place);
  const x = titleOf(found);
  const mean = Number(unit.convert(indices.mean));
  const zero = Number(unit.convert(0));
  /** @param {number} value */
  const size = (value) => Number(unit.convert(value)) - zero;
  const colours = names.length > 1 ? [LIGHT, DARK] : [DARK];
  const first = inputs[0] && barsOf(found, inputs[0])[0];
  return {
    name: "sensitivity",
    caption: text("sensitivity.caption"),
    description: text("sensitivity.description", {
      count: inputs.length,
      first: inputs[0] ? inputs[0].meaning : "–",
      change: first ? changeOf(found, Math.abs(first.value)) : "–",
      mean: unit.text(indices.mean, 3),
    }),
    figure: (palette) => ({
      traces: names.map((name, bar) => ({
        type: "bar",
        orientation: "h",
        y: places,
        x: inputs.map((one) => 2 * Math.abs(size(barsOf(found, one)[bar].value))),
        base: inputs.map((one) => mean - Math.abs(size(barsOf(found, one)[bar].value))),
        customdata: inputs.map(
          (one) => `${one.meaning}: ± ${changeOf(found, Math.abs(barsOf(found, one)[bar].value))}`,
        ),
        name,
        width: bar ? 0.4 : 0.75,
        marker: { color: colours[bar] },
        hovertemplate: "%{customdata}<extra></extra>",
      })),
      layout: layout(palette, x, "", {
        barmode: "overlay",
        hovermode: "closest",
        margin: { l: 160, r: 26, t: 8, b: 42 },
        shapes: [
          { type: "line", x0: mean, x1: mean, yref: "paper", y0: 0, y1: 1, line: { color: palette.ink, width: 1.5 } },
        ],
        xaxis: { rangemode: "normal" },
        yaxis: {
          range: [inputs.length - 0.5, -0.5],
          tickvals: places,
          ticktext: inputs.map((one) => inLines(one.meaning)),
          tickmode: "array",
          zeroline: false,
        },
      }),
    }),
    legend: ({ ink }) => [
      ...names.map((name, bar) => ({ kind: "area", name, colour: colours[bar] })),
      {
        kind: "line",
        name: text(indices.method === "local" ? "sensitivity.at_medians" : "sensitivity.mean"),
        colour: ink,
      },
    ],
    numbers: () => [
      [text("sensitivity.input"), ...names.map((name) => withUnit(found, name))],
      all.map((one) => [one.meaning, ...barsOf(found, one).map(({ value }) => size(value))]),
    ],
    click: (place) => jump(inputs[place].path),
  };
}

/** Words with the unit of the output; a plain number has none. @param {SensitivityAnswer} found @param {string} words */
function withUnit(found, words) {
  return found.display.unit === "1" ? words : ofOutput(found).titled(words);
}

/** The title of the axis. @param {SensitivityAnswer} found */
function titleOf(found) {
  const { output } = found.sensitivity;
  return withUnit(found, textOr(`results.${output}`, found.display.meaning));
}

/** A change of the output as text. @param {SensitivityAnswer} found @param {number} change */
function changeOf(found, change) {
  return ofOutput(found).text(change, 3);
}

/**
 * All inputs: each with a button to its field, its interval, who says so, and its bars.
 *
 * @param {SensitivityAnswer} found
 * @param {Input[]} inputs
 */
function inputsTable(found, inputs) {
  const names = namesOf(found.sensitivity.method);
  const hasLeft = found.sensitivity.method !== "morris";
  const rows = inputs.map((one) => {
    const go = element("button", { type: "button", class: "sort", onclick: () => jump(one.path) }, one.meaning);
    const bars = barsOf(found, one);
    return [
      go,
      intervalOf(one),
      sourceOf(one),
      ...bars.map((bar, place) => data(`${one.name}-${place}`, bar.value, withEnds(found, bar))),
      ...(hasLeft ? [one.left_if_known === null ? "–" : percent(one.left_if_known)] : []),
    ];
  });
  const caption = text("sensitivity.caption");
  const headings = [
    text("sensitivity.input"),
    text("sensitivity.interval"),
    text("sensitivity.source"),
    ...names,
    ...(hasLeft ? [text("sensitivity.left")] : []),
  ];
  return scrolling(caption, table(caption, headings, rows));
}

/** The interval of an input that holds 95 % of it. @param {Input} input */
function intervalOf({ low, high, unit, shown_in: metric }) {
  const { text: written } = quantity(unit, metric);
  return `${written(low, 3)} – ${written(high, 3)}`;
}

/** Who says how uncertain an input is. @param {Input} input */
function sourceOf({ given, source }) {
  if (given && source === "given") return text("sensitivity.given");
  return source === "judgement" ? text("sensitivity.judgement") : source;
}

/** @param {number} share */
function percent(share) {
  return `${units.digits(100 * share, 2)}\u00a0%`;
}

/** A bar as text with its interval, where it has one. @param {SensitivityAnswer} found @param {Bar} bar */
function withEnds(found, { value, low, high }) {
  const written = changeOf(found, value);
  return low === high ? written : `${written} (${changeOf(found, low)} – ${changeOf(found, high)})`;
}
