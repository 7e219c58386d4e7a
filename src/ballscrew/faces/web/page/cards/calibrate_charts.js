// Charts of a calibration: the model against the log, and the residuals over speed, load, temperature or time.

import { labelled, menu } from "../controls.js";
import { byId, keepFocus } from "../dom.js";
import { draw, layout } from "../plot.js";
import { text } from "../texts.js";
import { nameOf } from "./log_columns.js";
import { FORCE, TEMPERATURE, TIME, TORQUE, TURNING } from "./quantities.js";

/** The places of the charts. */
export const PLACES = ["calibrate-model-chart", "calibrate-residual-chart"];
/** What residuals are shown over, if the log has it. @type {Record<string, typeof FORCE>} */
const OVER = { screw_speed: TURNING, axial_load: FORCE, temperature: TEMPERATURE, time: TIME };
const KINDS = ["fitted", "held_out", "outlier"];
/** The menu of what the residuals are shown over, and what that is at first. */
const MENU = "calibrate-over";
const USUAL = "screw_speed";

/** @typedef {{ kinds: string[], measured: number[], predicted: number[] } & Record<string, number[]>} Picture */

/** @param {FitAnswer} found */
export function show(found) {
  const picture = /** @type {Picture} */ (/** @type {unknown} */ (found.picture));
  const { measured, predicted } = picture;
  const shown = { measured: TORQUE.all(measured), predicted: TORQUE.all(predicted) };
  const top = Math.max(...predicted, ...measured);
  const ends = TORQUE.all([0, top]);
  draw(PLACES[0], {
    name: "log_and_model",
    caption: text("calibrate.model_caption"),
    description: text("calibrate.model_description", { rms: TORQUE.text(found.residual_rms) }),
    figure: (colours) => ({
      traces: [
        ...dots(picture, shown.measured, shown.predicted, colours),
        {
          x: ends,
          y: ends,
          mode: "lines",
          name: text("calibrate.same"),
          line: { color: colours.ink, width: 1 },
          hoverinfo: "skip",
        },
      ],
      layout: layout(colours, TORQUE.titled(text("calibrate.measured")), TORQUE.titled(text("calibrate.predicted")), {
        hovermode: "closest",
      }),
    }),
    legend,
    numbers: () => [
      [TORQUE.titled(text("calibrate.measured")), TORQUE.titled(text("calibrate.predicted")), text("calibrate.kind")],
      picture.kinds.map((kind, place) => [shown.measured[place], shown.predicted[place], kind]),
    ],
  });
  const before = /** @type {HTMLSelectElement | null} */ (document.getElementById(MENU));
  residuals(found, picture, before?.value ?? USUAL);
}

/** @param {FitAnswer} found @param {Picture} picture @param {string} wanted what they are shown over, if the log has it */
function residuals(found, picture, wanted) {
  const there = Object.keys(OVER).filter((name) => name in picture);
  const over = there.includes(wanted) ? wanted : there[0];
  const quantity = OVER[over];
  const x = quantity.all(picture[over]);
  const off = TORQUE.all(picture.residual);
  const trend = found.residuals[over];
  const title = `${quantity.titled(nameOf(over))}`;
  draw(PLACES[1], {
    name: "residuals",
    caption: text("calibrate.residual_caption"),
    description: text("calibrate.residual_description", { over: nameOf(over) }),
    figure: (colours) => ({
      traces: [
        ...dots(picture, x, off, colours),
        ...(trend
          ? [
              {
                x: quantity.all(trend.values),
                y: TORQUE.all(trend.means),
                error_y: { array: TORQUE.all(trend.errors.map((error) => 2 * (error ?? 0))), color: colours.ink },
                mode: "lines+markers",
                name: text("calibrate.trend"),
                line: { color: colours.ink, width: 1.5 },
                hovertemplate: "%{y:.3g}",
              },
            ]
          : []),
      ],
      layout: layout(colours, title, TORQUE.titled(text("calibrate.off")), {
        hovermode: "closest",
        yaxis: { rangemode: "normal" },
      }),
    }),
    legend: (colours) => [...legend(colours), { kind: "line", name: text("calibrate.trend"), colour: colours.ink }],
    numbers: () => [
      [title, TORQUE.titled(text("calibrate.off")), text("calibrate.kind")],
      picture.kinds.map((kind, place) => [x[place], off[place], kind]),
    ],
  });
  showMenu(found, picture, there, over);
}

/** A menu of what the residuals are shown over. @param {FitAnswer} found @param {Picture} picture @param {string[]} there @param {string} over */
function showMenu(found, picture, there, over) {
  document.getElementById(MENU)?.closest("p")?.remove();
  const select = menu(
    there.map((name) => [name, nameOf(name)]),
    over,
    (name) => keepFocus(() => residuals(found, picture, name)),
    { id: MENU },
  );
  byId(PLACES[1]).after(labelled(select, text("calibrate.over")));
}

/** @param {import("../plot.js").Colours} colours @param {number} kind */
function colourOf(colours, kind) {
  return [colours.accent, colours.second, colours.ink][kind];
}

/**
 * @param {Picture} picture
 * @param {(number | null)[]} x
 * @param {(number | null)[]} y
 * @param {import("../plot.js").Colours} colours
 */
function dots({ kinds }, x, y, colours) {
  return KINDS.map((kind, number) => {
    const rows = kinds.flatMap((one, place) => (one === kind ? [place] : []));
    return {
      x: rows.map((place) => x[place]),
      y: rows.map((place) => y[place]),
      mode: "markers",
      name: nameOfKind(number),
      marker: { size: 4, color: colourOf(colours, number), symbol: ["circle", "diamond", "x"][number], opacity: 0.7 },
      hovertemplate: "%{x:.4g}, %{y:.4g}",
    };
  });
}

/** @param {number} kind */
function nameOfKind(kind) {
  return [text("calibrate.fitted"), text("calibrate.held_out"), text("calibrate.outlier")][kind];
}

/** @param {import("../plot.js").Colours} colours @returns {import("../plot.js").LegendEntry[]} */
function legend(colours) {
  return KINDS.map((_, number) => ({ kind: "point", name: nameOfKind(number), colour: colourOf(colours, number) }));
}
