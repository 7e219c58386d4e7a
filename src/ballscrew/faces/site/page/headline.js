// The numbers that matter most, and what the model says of them.

import { byId, element } from "../../web/page/dom.js";
import { levelOf, wordsOfEnds } from "./fan.js";
import { textOf } from "./judgements.js";
import { reasonsIn } from "./view.js";
import { digitsOf, inPlace, signOf } from "./words.js";

/** @typedef {import("./view.js").Scene} Scene */

/** What stands below the friction torque, as the names of outputs with their words. */
const BESIDE = [
  ["drive_torque", "drive torque"],
  ["efficiency", "efficiency"],
  ["minimum_film_parameter", "film parameter λ"],
  ["maximum_pressure", "greatest pressure"],
  ["largest_contact_load", "load of a contact"],
  ["holding_torque", "holding torque"],
  ["rigidity", "rigidity"],
];

export class Headline {
  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    /** @type {Map<string, HTMLElement>} */
    this.values = new Map();
    this.said = "";
    this.judged = "";
  }

  /** Make what is filled in. */
  build() {
    const { spec } = this.scene.case;
    const known = BESIDE.filter(([name]) => spec.outputs.includes(name) || name in spec.constants);
    const items = known.map(([name, words]) => {
      const value = element("dd");
      this.values.set(name, value);
      return element("div", {}, element("dt", {}, words), value);
    });
    byId("beside").replaceChildren(...items);
    this.said = "";
    this.judged = "";
  }

  /** Write the numbers of the operating point. */
  write() {
    const { scene } = this;
    const { outputs, inputs } = scene;
    byId("torque").textContent = digitsOf(outputs.screw_torque);
    byId("torque-unit").textContent = signOf("N m");
    this.writeBand();
    const screwDrives = inputs.axial_load < 0 === inputs.screw_speed < 0;
    for (const [name, place] of this.values) {
      const shown = name === "efficiency" && !screwDrives ? "back_driving_efficiency" : name;
      place.textContent = this.#text(shown);
    }
    const flooded = scene.floodedTorque();
    byId("full-bath").hidden = flooded === undefined;
    if (flooded !== undefined)
      byId("full-bath").textContent = `in a full bath of oil ${digitsOf(flooded)} ${signOf("N m")}`;
    this.#writeVerdicts();
    const reasons = outputs.valid === 1 ? [] : reasonsIn(scene.case, Object.fromEntries(entriesOf(outputs)));
    const words = reasons.length
      ? `Outside the model's validity: ${reasons.join("; ")}.`
      : "All conditions of the model hold.";
    if (words === this.said) return;
    this.said = words;
    byId("verdict").textContent = words;
    byId("headline").classList.toggle("outside", reasons.length > 0);
  }

  /** Write the band of the torque; nothing stands there while it is computed, as that before is of another case. */
  writeBand() {
    const { point, isMissing } = this.scene.banded();
    const ends = point ? wordsOfEnds(this.scene, "screw_torque", point.ends.screw_torque) : isMissing ? "–" : "…";
    byId("band").textContent = `${levelOf(this.scene)}, inputs alone: ${ends}`;
    byId("band-laws").style.visibility = isMissing ? "hidden" : "";
  }

  /** The verdict on the checks, and those on the operating point; conditions of the model stand below. */
  #writeVerdicts() {
    const { judged } = this.scene;
    // while an elastic nut moves nothing is judged, and what was said of other numbers is not shown
    byId("whole").style.visibility = judged ? "" : "hidden";
    byId("verdicts").style.visibility = judged ? "" : "hidden";
    if (!judged) return;
    const others = judged.warnings.filter(({ id }) => !id.startsWith("validity."));
    const records = [...judged.verdicts, ...others];
    const texts = records.map(({ message }) => textOf(this.scene.case.contents, message, inPlace));
    const whole = `Checks: ${textOf(this.scene.case.contents, judged.all.message, inPlace)}`;
    const written = JSON.stringify([whole, texts]);
    if (written === this.judged) return;
    this.judged = written;
    const link = element("a", { href: "#checks", class: judged.all.severity }, whole);
    link.addEventListener("click", (event) => {
      event.preventDefault(); // the address is that of the case
      byId("checks").scrollIntoView();
    });
    byId("whole").replaceChildren(link);
    const lines = records.map(({ severity }, place) => element("li", { class: severity }, texts[place]));
    byId("verdicts").replaceChildren(...lines);
    byId("judged").hidden = lines.length === 0;
  }

  /** @param {string} name */
  #text(name) {
    const { factor, offset, shown_in: unit } = this.scene.case.contents.results[name];
    const value = (this.scene.outputs[name] - offset) / factor;
    if (name.endsWith("efficiency")) return `${digitsOf(100 * value, 3)} %`;
    return `${digitsOf(value, 3)} ${signOf(unit)}`.trim();
  }
}

/** @param {Record<string, number>} outputs @returns {[string, number[]][]} */
function entriesOf(outputs) {
  return Object.entries(outputs).map(([name, value]) => [name, [value]]);
}
