// How far off the numbers of a case may be: the ends between which most samples lie, and a fan over the speed.

import { element } from "../../web/page/dom.js";
import { SPEED, TORQUE } from "./bands.js";
import { axisOf, bathCurve, BEGIN, endOf, torqueCurve, torqueTitle } from "./charts.js";
import { evenly, inShownUnit, inSiUnit, View } from "./view.js";
import { digitsOf, signOf } from "./words.js";

/** @typedef {import("../../web/page/figure.js").Mark} Mark */
/** @typedef {import("./view.js").Scene} Scene */

/** Points of the line in the middle, and the least of them while a slider moves. */
const POINTS_OF_LINE = 81;
const LEAST_OF_LINE = 9;
/** Digits of an end, which is rounded outwards. */
const DIGITS = 4;
/** What has ends at the operating point, as the names of outputs with their words. */
const WITH_ENDS = [
  ["screw_torque", "friction torque"],
  ["drive_torque", "drive torque"],
  ["efficiency", "efficiency"],
];

/** The speeds of the fan, in the unit that they are shown in. @param {Scene} scene */
export function speedsOfFan(scene) {
  const { bands } = scene.case.contents;
  const end = endOf(scene, SPEED);
  return evenly(end * BEGIN, end, bands.speeds["by_ball" in scene.case.spec ? "by_ball" : "usual"]);
}

/** A number with its unit, and two of them. @param {Scene} scene @param {string} name @param {import("./bands.js").Ends} ends */
export function wordsOfEnds(scene, name, { low, high }) {
  const { factor, offset, shown_in: unit } = scene.case.contents.results[name];
  const isShare = name.endsWith("efficiency");
  const shown = [low, high].map((value, place) => {
    return digitsOf(outwards(((value - offset) / factor) * (isShare ? 100 : 1), place === 1), DIGITS);
  });
  return `${shown[0]} to ${shown[1]} ${isShare ? "%" : signOf(unit)}`.trim();
}

/** A number of so many digits that is not inside of this one. @param {number} value @param {boolean} isHigh */
function outwards(value, isHigh) {
  const near = Number(value.toPrecision(DIGITS));
  if (!Number.isFinite(value) || (isHigh ? near >= value : near <= value)) return near;
  const [, exponent] = near.toExponential().split("e");
  return near + (isHigh ? 1 : -1) * Number(`1e${Number(exponent) - DIGITS + 1}`);
}

/** The level of the ends, such as 95 %. @param {Scene} scene */
export function levelOf(scene) {
  return `${Math.round(100 * scene.case.contents.bands.level)} %`;
}

export class Fan extends View {
  /** @param {Scene} scene @param {string} id */
  constructor(scene, id) {
    super(scene, id, { heading: "How far off the torque may be" });
    this.ends = element("dl", { class: "ends" });
    this.said = element("p", { class: "hint" });
    this.hint.replaceWith(this.ends);
    this.section.append(this.said);
  }

  paint() {
    const { scene } = this;
    const { fields, results } = scene.case.contents;
    const end = endOf(scene, SPEED);
    const x = evenly(end * BEGIN, end, scene.count(POINTS_OF_LINE, LEAST_OF_LINE));
    const along = { [SPEED]: inSiUnit(x, fields[SPEED]) };
    const found = scene.evaluate(along, x.length);
    const { fan, point } = scene.banded();
    const [now] = inShownUnit([scene.outputs[TORQUE]], results[TORQUE]);
    /** @type {Mark[]} */
    const marks = [
      torqueCurve(x, inShownUnit(found[TORQUE], results[TORQUE])),
      ...bathCurve(scene, x, along),
      ...this.marksOf(x, found, scene.case.shown(SPEED), now),
    ];
    if (fan) {
      const [low, high] = [fan.lows, fan.highs].map((row) => inShownUnit(row, results[TORQUE]));
      const speeds = inShownUnit(fan.speeds, fields[SPEED]);
      marks.unshift({ kind: "band", name: levelOf(scene), x: speeds, low, high, colour: "accent", solid: false });
    }
    const ends = point?.ends[TORQUE];
    this.show(
      { x: { title: axisOf(scene, SPEED), zero: true }, y: { title: torqueTitle(), zero: true }, marks },
      { across: SPEED, said: ends ? `${levelOf(scene)}, inputs alone: ${wordsOfEnds(scene, TORQUE, ends)}` : "" },
    );
    this.sayShaded(found);
    this.#sayEnds();
  }

  #sayEnds() {
    const { scene } = this;
    const { point, isMissing } = scene.banded();
    const screwDrives = scene.inputs.axial_load < 0 === scene.inputs[SPEED] < 0;
    const items = WITH_ENDS.map(([name, words]) => {
      const shown = name === "efficiency" && !screwDrives ? "back_driving_efficiency" : name;
      const ends = point?.ends[shown];
      const text = ends ? wordsOfEnds(scene, shown, ends) : isMissing ? "–" : "…";
      return element("div", {}, element("dt", {}, words), element("dd", {}, text));
    });
    this.ends.replaceChildren(...items);
    this.said.textContent = this.#words();
  }

  #words() {
    const { point, inputs = 0, makers = [], isMissing } = this.scene.banded();
    if (isMissing) return "There is no band here for this model or these numbers: take the case to the program.";
    if (!point) return "";
    const level = levelOf(this.scene);
    const sentences = [
      `Between the ends lie ${level} of ${point.count} samples of ${inputs} inputs that are rarely known, by the usual uncertainties of the program.`,
    ];
    if (makers.length) {
      sentences.push(`Drawn with them is what makers ask for: ${makers.join(", ")}.`);
    }
    sentences.push(
      "The inputs alone are drawn: without the other laws that the program draws as well the low end is usually 5 to 25 % higher, at high speeds up to twice as high.",
    );
    if (point.invalid > 0) {
      const share = `${digitsOf(100 * point.invalid, 2)} %`;
      sentences.push(`Outside the model's validity lie ${share} of the samples.`);
    }
    return sentences.join(" ");
  }
}
