// The card of a service: two logs, the preload that is left in the nut, and what else could explain them.

import * as designs from "../designs.js";
import { labelled, primaryButton, textField } from "../controls.js";
import { element, scrollingTable } from "../dom.js";
import { draw, layout, watch } from "../plot.js";
import { text } from "../texts.js";
import * as units from "../units.js";
import { vocabulary } from "../vocabulary.js";
import { caseFile, commandLine, dropZone, exampleButton, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { data, FORCE, TEMPERATURE, TORQUE, TURNING } from "./quantities.js";
import { question } from "./question.js";
import { lines } from "./records.js";

const CHART = "service-chart";
/** Share of the preload that may be lost, in percent, where nothing else is typed. */
const TOLERANCE = "10";

/** @typedef {{ speed: number[], torque: number[], measured_speed: number[], measured: number[] }} Curve */

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {Record<string, import("./log_parts.js").SentFile>} */
  const logs = {};
  /** @type {import("../state.js").Tables} */
  let tables = {};
  /** @type {ServiceAnswer | undefined} */
  let answer;
  let system = "";
  const problems = element("div");
  const words = element("div");
  const chart = element("div", { id: CHART, class: "chart low", hidden: true });
  const result = element("div", { class: "card-result" }, words, element("div", {}, chart));
  const asked = question({
    address: "service",
    result,
    show: (found) => show(found),
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      result.hidden = faults.length > 0; // what another log told is no answer below a fault
      return undefined;
    },
    isLarge: () => true,
  });
  const zones = ["new", "worn"].map((name) =>
    dropZone(`service-${name}`, text(name === "new" ? "service.new" : "service.worn"), (file) => {
      logs[name] = file;
      follow();
    }),
  );
  const example = exampleButton("service", (found) => {
    for (const [place, file] of found.entries()) zones[place].use(file);
  });
  const tolerance = textField(TOLERANCE, () => follow(), { id: "service-tolerance", size: "5" });
  const start = primaryButton("service-start", "service.start", async () => {
    tables = await designs.currentCase();
    asked.follow(body(), 0);
  });
  start.disabled = true;
  const command = element("div");
  const options = vocabulary.options.service.filter(({ name }) => name !== "tolerance"); // it has its own place
  /** What is given of them. @type {import("./option_fields.js").Given} */
  const chosen = {};
  const more = optionFields("service", options, chosen, () => follow());
  holder.replaceChildren(
    ...zones.map(({ zone }) => zone),
    example,
    labelled(tolerance, text("service.tolerance"), "%", start),
    more,
    command,
    asked.line,
    problems,
    result,
  );
  watch(chart);
  asked.resume();

  function share() {
    return Number(units.withPoint(tolerance.value)) / 100;
  }

  function body() {
    return { case: tables, ...logs, tolerance: Number.isFinite(share()) ? share() : -1, ...chosen };
  }

  async function follow() {
    tables = await designs.currentCase();
    start.disabled = !logs.worn;
    const names = ["new", "worn"].flatMap((name) => (logs[name] ? [logs[name].name] : []));
    const option = tolerance.value === TOLERANCE ? [] : ["--tolerance", String(share())];
    const commandWords = ["ballscrew", "service", ...names, "--case", caseFile(), ...option, ...flags(options, chosen)];
    command.replaceChildren(...(logs.worn ? [commandLine(commandWords)] : []));
    if (answer && system !== units.currentSystem()) show(answer);
    asked.compare(body());
  }

  /** @param {ServiceAnswer} found */
  function show(found) {
    answer = found;
    system = units.currentSystem();
    const { verdicts, words: texts, warnings, results } = found;
    const ratio = /** @type {{ value: number, low: number, high: number } | undefined} */ (results.ratio);
    words.replaceChildren(
      ...lines(verdicts.slice(0, 1), []),
      ...(ratio ? [left(ratio)] : []),
      preloads(results),
      ...texts.causes.map((one) => element("p", { class: "small" }, one)),
      ...(verdicts.length > 1 ? [element("h3", {}, text("service.others"))] : []),
      ...lines(verdicts.slice(1), warnings),
    );
    draw(CHART, picture(/** @type {Record<string, Curve>} */ (found.picture)));
  }

  /** @param {{ value: number, low: number, high: number }} ratio */
  function left({ value, low, high }) {
    /** @param {number} one */
    const percent = (one) => `${units.digits(100 * one, 2)}\u00a0%`;
    return element(
      "div",
      { class: "numbers" },
      element(
        "dl",
        {},
        element(
          "div",
          {},
          element("dt", {}, text("service.left")),
          element("dd", {}, data("ratio", value, percent(value)), ` (${percent(low)} – ${percent(high)})`),
        ),
      ),
    );
  }

  /** @param {ServiceAnswer["results"]} results */
  function preloads(results) {
    const rows = ["new", "worn"].flatMap((name) => {
      const one = name === "worn" ? results.worn : results.new;
      if (!one) return [];
      return [
        [
          text(name === "worn" ? "service.now" : one.rows === null ? "service.nominal" : "service.then"),
          FORCE.text(one.preload),
          `${FORCE.text(one.low)} – ${FORCE.text(one.high)}`,
          one.rows ?? "–",
          TEMPERATURE.text(one.temperature),
        ],
      ];
    });
    const names = [
      text("service.preload"),
      text("service.interval"),
      text("service.rows"),
      text("service.temperature"),
    ];
    const caption = text("service.caption");
    return scrollingTable(caption, ["", ...names], rows);
  }

  /** @param {Record<string, Curve>} curves @returns {import("../plot.js").Chart} */
  function picture(curves) {
    const names = Object.keys(curves);
    /** @param {string} name */
    const words = (name) => text(name === "worn" ? "service.now" : "service.then");
    /** @param {import("../plot.js").Colours} colours @param {string} name */
    const colourOf = (colours, name) => (name === "worn" ? colours.second : colours.accent);
    const [speed, torque] = [TURNING.titled(text("chart.speed")), TORQUE.titled(text("chart.torque"))];
    return {
      name: "service",
      caption: text("service.chart_caption"),
      description: text("service.chart_description"),
      figure: (colours) => ({
        traces: names.flatMap((name) => {
          const one = curves[name];
          const colour = colourOf(colours, name);
          return [
            {
              x: TURNING.all(one.measured_speed),
              y: TORQUE.all(one.measured),
              mode: "markers",
              name: words(name),
              marker: { size: 4, color: colour, opacity: 0.5 },
              hovertemplate: "%{x:.4g}, %{y:.4g}",
            },
            {
              x: TURNING.all(one.speed),
              y: TORQUE.all(one.torque),
              mode: "lines",
              name: words(name),
              line: { color: colour, width: 2, dash: name === "worn" ? "dash" : "solid" },
              hovertemplate: "%{y:.4g}",
            },
          ];
        }),
        layout: layout(colours, speed, torque, { hovermode: "closest" }),
      }),
      legend: (colours) =>
        names.map((name) => ({
          kind: name === "worn" ? "dash" : "line",
          name: words(name),
          colour: colourOf(colours, name),
        })),
      numbers: () => [
        [text("service.log"), speed, torque],
        names.flatMap((name) =>
          curves[name].speed.map((x, place) => [
            words(name),
            TURNING.convert(x),
            TORQUE.convert(curves[name].torque[place]),
          ]),
        ),
      ],
    };
  }

  return { follow };
}
