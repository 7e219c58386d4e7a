// The answer in numbers and words: torque and efficiency, verdicts, contacts, with each warning beside its subject.

import { byId, element, table } from "./dom.js";
import * as units from "./units.js";

/** Results of the first table. @type {Record<string, string>} */
const FIRST = {
  screw_torque: "friction torque",
  drive_torque: "drive torque",
  holding_torque: "holding torque",
  efficiency: "efficiency, screw drives",
  back_driving_efficiency: "efficiency, load drives",
  friction_coefficient: "friction coefficient µ of the thread",
  friction_angle: "friction angle ρ of the thread",
  friction_power: "heat",
  preload_drag: "torque without load",
};
/** Results of the table of contacts. @type {Record<string, string>} */
const OF_CONTACT = {
  maximum_pressure: "greatest pressure",
  minimum_film_thickness: "film thickness",
  film_parameter: "film parameter λ",
  friction_coefficient: "friction coefficient",
  semi_major_axis: "semi-axis across",
  semi_minor_axis: "semi-axis along",
  pure_rolling_offset: "pure-rolling offset Y",
  spin_parameter: "spin parameter",
};
const ANNOUNCE_AFTER = 700;

/** @typedef {Record<string, any>} Numbers results by name */

/**
 * The band beside an answer: pending, failed, or there.
 *
 * @typedef {{ state: "pending" } | { state: "failed", lines: string[] } | { state: "done", answer: BandAnswer }} Band
 */

/** Results of any kind of screw by name. @param {Run} answer @returns {Numbers} */
export function numbersOf(answer) {
  return answer.results;
}

/**
 * The exact value of a result, for programs, displayed in its unit.
 *
 * @param {string} name
 * @param {number | null | undefined} value
 */
export function data(name, value) {
  return element("data", { value: String(value ?? ""), "data-name": name }, units.formatted(name, value));
}

/**
 * The lubrication regime of a film parameter.
 *
 * @param {number} film
 */
function regime(film) {
  if (film < 1) return "boundary: the asperities carry much of the load";
  return film < 3 ? "mixed: film and asperities share the load" : "full film";
}

/** True where a record stands beside the contacts. @param {VerdictRecord} record */
function isOfContact(record) {
  return record.subject in OF_CONTACT;
}

/**
 * The name of a verdict or a warning in words.
 *
 * @param {VerdictRecord} record
 */
export function nameOf({ id }) {
  return id.slice(id.indexOf(".") + 1).replaceAll(/[._]/g, " ");
}

/**
 * The interval of a result in the band.
 *
 * @param {Band | null} band
 * @param {string} name
 */
function interval(band, name) {
  /** @type {Record<string, any>} */
  const outputs = band?.state === "done" ? band.answer.band : {};
  const one = outputs[name];
  if (typeof one?.low !== "number") return null;
  const low = units.digits(units.inDisplayUnit(name, one.low));
  return element("span", { class: "interval" }, `${low} to ${units.formatted(name, one.high)}`);
}

/** @type {ReturnType<typeof setTimeout>} */
let announcement;

/**
 * Announce a text to screen readers, once typing has come to rest.
 *
 * @param {string} text
 */
function announce(text) {
  clearTimeout(announcement);
  announcement = setTimeout(() => {
    byId("said").textContent = text;
  }, ANNOUNCE_AFTER);
}

/**
 * Show everything of one answer but its charts.
 *
 * @param {Run} answer
 * @param {Band | null} band
 */
export function show(answer, band) {
  const { results, display, warnings } = answer;
  const numbers = numbersOf(answer);
  byId("case").textContent = units.filled(display.title);
  const torque = units.formatted("screw_torque", results.screw_torque);
  const summary = `Friction torque ${torque}, efficiency ${units.digits(results.efficiency)}.`;
  byId("summary").textContent = summary;
  if (!byId("results").classList.contains("stale")) {
    announce(summary);
    document.title = `${torque} · ballscrew`;
  }
  showVerdicts(answer);
  const rows = Object.entries(FIRST)
    .filter(([name]) => numbers[name] !== undefined)
    .map(([name, words]) =>
      element("div", {}, element("dt", {}, words), element("dd", {}, data(name, numbers[name]), interval(band, name))),
    );
  byId("numbers").replaceChildren(element("dl", {}, ...rows));
  showContacts(answer, warnings.filter(isOfContact));
  showAssumptions(answer);
  showBand(answer, band);
}

/** @param {Run} answer */
function showVerdicts({ verdicts, warnings, display }) {
  const lines = verdicts.map(({ severity }, place) =>
    element("p", { class: severity === "info" ? "verdict" : "verdict careful" }, units.filled(display.verdicts[place])),
  );
  const ofContacts = warnings.filter(isOfContact);
  if (ofContacts.length) {
    const onclick = () => byId("contacts").scrollIntoView({ block: "center" });
    const names = [...new Set(ofContacts.map(nameOf))].join(", ");
    lines.unshift(
      element(
        "p",
        { class: "warning" },
        element("strong", {}, "Outside the model's validity: "),
        `${names}. `,
        element("button", { type: "button", onclick }, "Why"),
      ),
    );
  }
  const others = warnings.filter((record) => !isOfContact(record));
  byId("verdicts").replaceChildren(...lines, ...others.map(warning));
}

/** @param {VerdictRecord} record */
function warning(record) {
  return element("p", { class: "warning" }, element("strong", {}, `Beware, ${nameOf(record)}: `), record.text);
}

/** @param {Run} answer */
function showAssumptions({ display, provenance }) {
  const { model, version, references } = provenance;
  byId("assumed").replaceChildren(
    element("ul", {}, ...display.assumed.map((one) => element("li", {}, units.filled(one)))),
    element("p", { class: "small" }, `Model ${model}, ballscrew ${version}; sources: ${references.join(", ")}.`),
  );
}

/**
 * @param {Run} answer
 * @param {VerdictRecord[]} warnings
 */
function showContacts(answer, warnings) {
  const { screw, nut } = answer.results;
  /** @type {Numbers} */
  const ofScrew = screw;
  /** @type {Numbers} */
  const ofNut = nut;
  const rows = Object.entries(OF_CONTACT)
    .filter(([name]) => ofScrew[name] !== undefined && ofScrew[name] !== null)
    .map(([name, words]) => [words, data(name, ofScrew[name]), data(name, ofNut[name])]);
  const film = leastFilm(answer);
  const caption = answer.loads ? "contacts of the most loaded ball" : "contacts of each ball";
  byId("contacts").replaceChildren(
    element(
      "p",
      { class: "regime" },
      Number.isFinite(film) ? `λ = ${units.digits(film, 3)} at the least: ${regime(film)}` : "no film",
    ),
    table(caption, ["", "ball and screw", "ball and nut"], rows),
    ...warnings.map(warning),
  );
}

/** The lesser film parameter of the two contacts; NaN where there is none. @param {Run} answer */
export function leastFilm({ results: { screw, nut } }) {
  return Math.min(screw.film_parameter ?? Number.NaN, nut.film_parameter ?? Number.NaN);
}

/** The greater pressure of the two contacts, or of all balls. @param {Run} answer */
export function greatestPressure({ results }) {
  const { screw, nut } = results;
  return results.maximum_pressure ?? Math.max(screw.maximum_pressure ?? 0, nut.maximum_pressure ?? 0);
}

/**
 * @param {Run} answer
 * @param {Band | null} band
 */
function showBand(answer, band) {
  const place = byId("band-words");
  if (!band) place.replaceChildren();
  else if (band.state === "pending") place.replaceChildren(element("p", {}, "computing the band …"));
  else if (band.state === "failed") {
    place.replaceChildren(element("p", { class: "warning" }, band.lines.join("; ")));
  } else {
    const { display, words, warnings } = band.answer;
    const shown = new Set(answer.warnings.map((record) => record.id));
    const others = warnings.filter((record) => !shown.has(record.id));
    place.replaceChildren(
      ...display.sentences.map((one) => element("p", {}, units.filled(one))),
      element("p", { class: "small" }, words.inputs),
      ...others.map(({ text }) => element("p", { class: "small" }, text)),
    );
  }
}

/**
 * Show why there is no valid answer, and dim the one before.
 *
 * @param {string[]} lines
 */
export function fail(lines) {
  const place = byId("faults");
  const before = byId("case").textContent;
  byId("results").classList.add("stale");
  byId("results").classList.toggle("empty", !before);
  document.title = "not computed · ballscrew";
  const words = before ? [...lines, "What stands below is of the input before."] : lines;
  if ([...place.children].map((one) => one.textContent).join("\n") === words.join("\n")) return;
  place.replaceChildren(...words.map((line) => element("p", {}, line)));
  announce(words.join(" "));
}

export function succeed() {
  byId("results").classList.remove("stale", "empty");
  byId("faults").replaceChildren();
}
