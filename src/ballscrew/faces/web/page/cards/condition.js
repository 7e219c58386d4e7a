// The card of a condition: the tests of a nut over its life, from a table or from a log each, the preload that is left in
// each, the trend, and the alarm.

import * as designs from "../designs.js";
import { primaryButton } from "../controls.js";
import { element, scrolling, table } from "../dom.js";
import { draw, layout, watch } from "../plot.js";
import { text } from "../texts.js";
import * as units from "../units.js";
import { vocabulary } from "../vocabulary.js";
import { caseFile, commandLine, dropZone, exampleButton, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { data, HOURS, TEMPERATURE, TORQUE } from "./quantities.js";
import { question } from "./question.js";
import { lines } from "./records.js";

/** @typedef {ConditionAnswer["results"]} Results */
/** @typedef {Results["states"][number]} State */

const CHART = "condition-chart";
const SUMS = "condition-sums-chart";
/** Seconds of a day, and from which a time is in days, and not in hours. */
const DAY = 86400;
const LONG = 90 * DAY;
/** Logs at most: more tests stand in a table. */
const MOST = 100;
const GREEN = "#009E73";
const RED = "#c62828";

/** @param {{ name: string }} one @param {{ name: string }} other */
function byName(one, other) {
  return one.name.localeCompare(other.name, "en", { numeric: true });
}

/** Test whether tests stand in the order of their names. @param {{ name: string }[]} tests */
function isByName(tests) {
  return tests.every((one, place) => !place || byName(tests[place - 1], one) <= 0);
}

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {import("./log_parts.js").SentFile[]} */
  let tests = [];
  /** @type {import("../state.js").Tables} */
  let tables = {};
  /** @type {ConditionAnswer | undefined} */
  let answer;
  let system = "";
  const problems = element("div", {});
  const words = element("div", {});
  const rest = element("div", {});
  const charts = [CHART, SUMS].map((id) => element("div", { id, class: "chart low", hidden: true }));
  const result = element("div", { class: "card-result", hidden: true }, words, ...charts, rest);
  const asked = question({
    address: "condition",
    result,
    show: (found) => show(found),
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      result.hidden = faults.length > 0; // what other tests told is no answer below a fault
      return undefined;
    },
    isLarge: () => true,
  });
  const list = element("ol", { class: "rows", id: "condition-tests" });
  const zone = dropZone("condition-log", text("condition.drop"), (file) => add([file]), { multiple: true });
  const example = exampleButton("condition", (logs) => {
    tests = [];
    add(logs);
  });
  const start = primaryButton("condition-start", "condition.start", async () => {
    tables = await designs.currentCase();
    asked.follow(body(), 0);
  });
  start.disabled = true;
  const command = element("div", {});
  const options = vocabulary.options.condition;
  /** @type {import("./option_fields.js").Given} */
  const chosen = {};
  holder.replaceChildren(
    zone.zone,
    list,
    example,
    optionFields("condition", options, chosen, follow),
    element("p", { class: "card-start" }, start),
    command,
    asked.line,
    problems,
    result,
  );
  for (const chart of charts) watch(chart);
  asked.resume();

  /** Add logs, in the order of their names, as dates in them sort. @param {import("./log_parts.js").SentFile[]} files */
  function add(files) {
    const names = files.map(({ name }) => name);
    const others = tests.filter(({ name }) => !names.includes(name));
    const all = [...others, ...files];
    if (isByName(others)) all.sort(byName); // an order that was given by hand stays
    tests = all.slice(0, MOST);
    showTests();
    const left = all.slice(MOST).map(({ name }) => name);
    if (left.length)
      problems.replaceChildren(
        element("p", { class: "warning" }, text("condition.most", { most: MOST, names: left.join(", ") })),
      );
  }

  /** The tests in their order, each with buttons that move it or leave it out. */
  function showTests() {
    /** @param {number} place @param {number} by */
    const move = (place, by) => {
      tests.splice(place + by, 0, ...tests.splice(place, 1));
      showTests();
    };
    list.replaceChildren(
      ...tests.map(({ name }, place) => {
        /** @param {import("../texts.js").Key} key @param {() => void} onclick @param {boolean} disabled */
        const act = (key, onclick, disabled = false) =>
          element("button", { type: "button", disabled, "aria-label": `${text(key)}: ${name}`, onclick }, text(key));
        const leave = () => {
          tests.splice(place, 1);
          showTests();
        };
        return element(
          "li",
          {},
          element("span", {}, name),
          element(
            "span",
            { class: "actions" },
            act("condition.earlier", () => move(place, -1), place === 0),
            act("condition.later", () => move(place, 1), place === tests.length - 1),
            act("condition.leave_out", leave),
          ),
        );
      }),
    );
    follow();
  }

  function body() {
    return { case: tables, tests, ...chosen };
  }

  async function follow() {
    tables = await designs.currentCase();
    start.disabled = !tests.length;
    const names = tests.map(({ name }) => name);
    const line = ["ballscrew", "condition", ...names, "--case", caseFile(), ...flags(options, chosen)];
    command.replaceChildren(...(tests.length ? [commandLine(line)] : []));
    if (answer && system !== units.currentSystem()) show(answer);
    asked.compare(body());
  }

  /** @param {ConditionAnswer} found */
  function show(found) {
    answer = found;
    system = units.currentSystem();
    result.hidden = false;
    const { verdicts, warnings } = found;
    words.replaceChildren(...lines(verdicts, warnings));
    draw(CHART, preloads(found));
    draw(SUMS, sums(found));
    rest.replaceChildren(states(found));
  }

  return { follow };
}

/** @param {number | null} share */
function percent(share) {
  return share === null ? null : 100 * share;
}

/** @param {number | null} share */
function inPercent(share) {
  return share === null ? "–" : `${units.digits(100 * share, 3)}\u00a0%`;
}

/** The times of the tests as they are shown, and the title of their axis. @param {ConditionAnswer} found */
function timesOf({ results: { states: all, trend } }) {
  const times = all.map(({ time }) => Number(time));
  if (trend.unit === "1") return { times, title: text("condition.test") };
  if (Number(times.at(-1)) - times[0] > LONG) {
    return { times: times.map((one) => one / DAY), title: text("condition.days") };
  }
  return { times: times.map((one) => Number(HOURS.convert(one))), title: HOURS.titled(text("condition.time")) };
}

/**
 * A vertical line where the alarm is, and a shade over the first tests.
 *
 * @param {Results} results
 * @param {number[]} times
 */
function marks({ alarm, baseline }, times) {
  const whole = { yref: "paper", y0: 0, y1: 1 };
  return [
    {
      type: "rect",
      ...whole,
      x0: times[0],
      x1: times[baseline - 1],
      fillcolor: "#80808033",
      line: { width: 0 },
      layer: "below",
    },
    ...(alarm === null
      ? []
      : [{ type: "line", ...whole, x0: times[alarm], x1: times[alarm], line: { color: RED, width: 2 } }]),
  ];
}

/** Entries of the legend for the marks. @param {Results} results @returns {import("../plot.js").LegendEntry[]} */
function entriesOfMarks({ alarm }) {
  return [
    { kind: "area", name: text("condition.baseline"), colour: "#80808055" },
    ...(alarm === null ? [] : [{ kind: "line", name: text("condition.alarm"), colour: RED }]),
  ];
}

/**
 * The preload that is left in each test with its band, the trend, what may be lost, and the alarm.
 *
 * @param {ConditionAnswer} found
 * @returns {import("../plot.js").Chart}
 */
function preloads(found) {
  const { results, picture } = found;
  const { states: all, alarm, tolerance } = results;
  const { times, title } = timesOf(found);
  /** @param {"value" | "low" | "high"} end */
  const values = (end) => all.map(({ preload }) => percent(preload[end]));
  const least = times.map(() => percent(1 - tolerance));
  const y = text("condition.preload");
  const last = /** @type {State} */ (all.at(-1));
  /** @param {(number | null)[]} ends @param {string} colour @param {object} more */
  const end = (ends, colour, more) => ({
    x: times,
    y: ends,
    mode: "lines",
    line: { color: colour, width: 1 },
    hoverinfo: "skip",
    ...more,
  });
  return {
    name: "preload_over_time",
    caption: text("condition.preload_caption"),
    description: text("condition.preload_description", {
      left: inPercent(last.preload.value),
      alarm: alarm === null ? text("condition.no_alarm") : all[alarm].label,
    }),
    figure: ({ ink, accent, second, ...others }) => ({
      traces: [
        end(values("low"), accent, {}),
        end(values("high"), accent, { fill: "tonexty", fillcolor: `${accent}33` }),
        {
          x: times,
          y: values("value"),
          mode: "lines+markers",
          name: y,
          text: all.map(({ label }) => label),
          marker: { color: accent, size: 6 },
          line: { color: accent, width: 1 },
          hovertemplate: "%{text}: %{y:.3g} %<extra></extra>",
        },
        { x: times, y: least, mode: "lines", line: { color: second, width: 1.5, dash: "dash" }, hoverinfo: "skip" },
        ...(picture.trend
          ? [
              {
                x: times,
                y: picture.trend.map(percent),
                mode: "lines",
                line: { color: ink, width: 2 },
                hoverinfo: "skip",
              },
            ]
          : []),
      ],
      layout: layout({ ink, accent, second, ...others }, title, y, {
        hovermode: "closest",
        shapes: marks(results, times),
      }),
    }),
    legend: ({ ink, accent, second }) => [
      { kind: "point", name: text("condition.left"), colour: accent },
      ...(picture.trend ? [{ kind: "line", name: text("condition.trend"), colour: ink }] : []),
      { kind: "dash", name: text("condition.tolerance", { least: inPercent(1 - tolerance) }), colour: second },
      ...entriesOfMarks(results),
    ],
    numbers: () => [
      [text("condition.test"), title, y, text("condition.low"), text("condition.high")],
      all.map(({ label }, place) => [
        label,
        times[place],
        values("value")[place],
        values("low")[place],
        values("high")[place],
      ]),
    ],
  };
}

/**
 * The sums of the changes of the torque with their limit: what the alarm comes from.
 *
 * @param {ConditionAnswer} found
 * @returns {import("../plot.js").Chart}
 */
function sums(found) {
  const { results } = found;
  const { times, title } = timesOf(found);
  const y = text("condition.sums");
  /** @param {"fall" | "rise" | "limit"} name */
  const values = (name) => results.states.map((one) => one[name]);
  /** @param {import("../plot.js").Colours} colours */
  const series = ({ accent, second }) => [
    { name: /** @type {const} */ ("fall"), colour: accent, dash: "solid" },
    { name: /** @type {const} */ ("rise"), colour: GREEN, dash: "dot" },
    { name: /** @type {const} */ ("limit"), colour: second, dash: "dash" },
  ];
  return {
    name: "sums_over_time",
    caption: text("condition.sums_caption"),
    description: text("condition.sums_description"),
    figure: (colours) => ({
      traces: series(colours).map(({ name, colour, dash }) => ({
        x: times,
        y: values(name),
        name: text(`condition.${name}`),
        mode: "lines",
        line: { color: colour, width: 2, dash },
        hovertemplate: "%{y:.3g}",
      })),
      layout: layout(colours, title, y, { shapes: marks(results, times) }),
    }),
    legend: (colours) => [
      ...series(colours).map(({ name, colour, dash }) => ({
        kind: dash === "solid" ? "line" : "dash",
        name: text(`condition.${name}`),
        colour,
      })),
      ...entriesOfMarks(results),
    ],
    numbers: () => [
      [text("condition.test"), title, text("condition.fall"), text("condition.rise"), text("condition.limit")],
      results.states.map(({ label, fall, rise, limit }, place) => [label, times[place], fall, rise, limit]),
    ],
  };
}

/** All tests as a table. @param {ConditionAnswer} found */
function states({ results }) {
  const caption = text("condition.caption");
  const rows = results.states.map((one, place) => [
    place === results.alarm ? `${one.label} (${text("condition.alarm")})` : one.label,
    one.temperature === null ? "–" : TEMPERATURE.text(one.temperature, 3),
    `${TORQUE.text(one.torque.value, 3)} (${TORQUE.text(one.torque.low, 3)} – ${TORQUE.text(one.torque.high, 3)})`,
    data(`preload-${place}`, one.preload.value, inPercent(one.preload.value)),
    `${inPercent(one.preload.low)} – ${inPercent(one.preload.high)}`,
  ]);
  const headings = [
    text("condition.test"),
    text("condition.temperature"),
    text("condition.torque"),
    text("condition.left"),
    text("condition.interval"),
  ];
  return scrolling(caption, table(caption, headings, rows));
}
