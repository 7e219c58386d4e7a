// The friction torque over the speed, cold and hot: curves at the temperatures of the table, drawn once they are seen.

import { plain } from "./case_values.js";
import * as parts from "./chart_parts.js";
import { draw, hide, showFailure } from "./chart_place.js";
import { byId } from "./dom.js";
import { linesByValidity, pointAt } from "./figure_parts.js";
import { yesOrNo } from "./figure_words.js";
import { localEngine, pointsOf } from "./local_engine.js";
import { Latest, linesOf, sendJson } from "./server.js";
import * as units from "./units.js";

/** @typedef {{ case: Record<string, unknown> }} Body */
/** The torque, SI, and whether it is valid, at one temperature. @typedef {{ torque: (number | null)[], valid: boolean[] }} Curve */
/**
 * What is shown: the curves of a case at temperatures, K, over speeds, rad/s.
 *
 * @typedef {object} Wanted
 * @property {Body} body
 * @property {Run} answer
 * @property {number[]} temperatures
 * @property {number[]} speeds
 * @property {boolean} [isAsked]
 * @property {Curve[]} [curves]
 */

const ID = "hot-chart";
const TEMPERATURE = "temperature";

/**
 * The curves of the module in the browser; none where it does not know the oil.
 *
 * @param {Wanted} wanted
 * @returns {Curve[] | undefined}
 */
function computedHere({ body, answer, temperatures, speeds }) {
  const values = temperatures.map((one) => localEngine.valuesAt(body, one));
  const points = pointsOf(parts.operationOf(answer), { screw_speed: speeds });
  /** @type {Curve[]} */
  const curves = [];
  for (const one of values) {
    if (!one) return undefined;
    const found = localEngine.at(one, points);
    curves.push({
      torque: Array.from(found.screw_torque, plain),
      valid: Array.from(found.valid, Boolean),
    });
  }
  return curves;
}

/**
 * The curves of the server.
 *
 * @param {Wanted} wanted
 * @param {AbortSignal} signal
 * @returns {Promise<Curve[]>}
 */
async function computedThere({ body, temperatures, speeds }, signal) {
  const vary = { temperature: `${temperatures.join(", ")} K`, screw_speed: `${speeds.join(", ")} rad/s` };
  const { outputs } = await sendJson("sweep", { ...body, vary, outputs: ["screw_torque"] }, signal);
  return temperatures.map((_, place) => ({
    torque: /** @type {number[][]} */ (outputs.screw_torque.values)[place],
    valid: /** @type {boolean[][]} */ (outputs.valid.values)[place],
  }));
}

/** The chart of a case, which is computed when it is first seen. */
class HotAndCold {
  /** @type {Wanted | undefined} */
  #wanted;
  #isSeen = false;
  #requests = new Latest();

  constructor() {
    new IntersectionObserver(([entry]) => {
      this.#isSeen = entry.isIntersecting;
      if (this.#isSeen) this.#compute();
    }).observe(byId("temperatures"));
  }

  /**
   * Show the curves of a case whose oil follows the temperature.
   *
   * @param {Body} body
   * @param {Run} answer
   * @param {Sweep} table its sweep over the temperature
   * @param {Sweep} alongSpeed its sweep over the speed
   */
  show(body, answer, table, alongSpeed) {
    const temperatures = parts.valuesOf(table.axes[TEMPERATURE]);
    const speeds = parts.valuesOf(alongSpeed.axes.screw_speed);
    this.#requests.cancel();
    this.#wanted = { body, answer, temperatures, speeds };
    if (this.#isSeen) this.#compute();
  }

  /** There is nothing to compare. */
  leaveOut() {
    this.#requests.cancel();
    this.#wanted = undefined;
    hide(ID);
  }

  /** Show it again, in other units. */
  redisplay() {
    if (this.#wanted?.curves) drawCurves(this.#wanted, this.#wanted.curves);
  }

  async #compute() {
    const wanted = this.#wanted;
    if (!wanted || wanted.isAsked) return; // also where it comes into view again meanwhile
    wanted.isAsked = true;
    const signal = this.#requests.begin();
    try {
      wanted.curves = computedHere(wanted) ?? (await computedThere(wanted, signal));
    } catch (error) {
      if (signal.aborted) return;
      byId(ID).hidden = false;
      showFailure(ID, linesOf(error).join("; "));
      return;
    }
    if (!signal.aborted) drawCurves(wanted, wanted.curves);
  }
}

/**
 * @param {Wanted} wanted
 * @param {Curve[]} curves
 */
function drawCurves({ answer, temperatures, speeds }, curves) {
  const { screw_speed: speed, axial_load: load } = parts.operationOf(answer);
  const names = temperatures.map((one) => units.formattedIn(one, "degC", "K"));
  const shown = parts.converted("screw_speed", { values: speeds });
  const torques = curves.map(({ torque }) => parts.converted("screw_torque", { values: torque }));
  const x = units.heading("screw_speed", "speed of the screw");
  const y = units.heading("screw_torque", "friction torque");
  const now = answer.results.screw_torque;
  /** The coldest, the hottest, and between them that of the case. @param {number} place */
  const colour = (place) => (place === 0 ? "accent" : place === temperatures.length - 1 ? "second" : "ink");
  draw(ID, {
    name: "torque_cold_and_hot",
    caption: `friction torque over speed at ${units.formatted("axial_load", load)}, cold and hot`,
    description: `Friction torque against speed with the oil from ${names[0]} to ${names.at(-1) ?? ""}. At the operating point ${units.formatted("screw_torque", now)}.`,
    figure: {
      x: { title: x },
      y: { title: y, zero: true },
      marks: [
        ...curves.flatMap(({ valid }, place) =>
          linesByValidity(shown, torques[place], valid, names[place], colour(place)),
        ),
        pointAt(units.inDisplayUnit("screw_speed", speed), units.inDisplayUnit("screw_torque", now)),
      ],
    },
    numbers: () => [
      [x, ...names.map((name) => units.heading("screw_torque", name)), ...names.map((name) => `valid at ${name}`)],
      shown.map((at, i) => [
        at,
        ...torques.map((values) => values[i]),
        ...curves.map(({ valid }) => yesOrNo(valid[i])),
      ]),
    ],
  });
}

export const hotAndCold = new HotAndCold();
