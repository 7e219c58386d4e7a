// The answer in numbers and words: torque and efficiency, verdicts, contacts, with each warning beside its subject.

import { inHeadline, isStarved } from "./bath.js";
import { verdict } from "./checks.js";
import { opened } from "./controls.js";
import { byId, element, table, update, write } from "./dom.js";
import { RESULTS } from "./names.js";
import { asRead } from "./sentence.js";
import * as units from "./units.js";

/** Results of a contact in words. @type {Record<string, string>} */
const OF_CONTACTS = {
  film_parameter: "film parameter λ",
  friction_coefficient: "friction coefficient",
  maximum_pressure: "greatest pressure",
  minimum_film_thickness: "film thickness",
  pure_rolling_offset: "pure-rolling offset Y",
  semi_major_axis: "semi-axis across",
  semi_minor_axis: "semi-axis along",
  spin_parameter: "spin parameter",
};

/** Results of the first table. */
const FIRST = /** @type {const} */ ([
  "screw_torque",
  "drive_torque",
  "efficiency",
  "back_driving_efficiency",
  "holding_torque",
  "friction_coefficient",
  "friction_angle",
  "friction_power",
  "preload_drag",
]);
/** Results of the ball whose contacts are worst. */
const OF_BALL = /** @type {const} */ ([
  "maximum_pressure",
  "largest_contact_load",
  "minimum_film_parameter",
  "minimum_film_thickness",
  "ball_to_ball_force",
]);
/** Results of the table of contacts. */
const OF_CONTACT = /** @type {const} */ ([
  "maximum_pressure",
  "minimum_film_thickness",
  "film_parameter",
  "friction_coefficient",
  "semi_major_axis",
  "semi_minor_axis",
  "pure_rolling_offset",
  "spin_parameter",
]);
/** The verdict that compares the model with the rule of the maker of the screw. */
const RULE_OF_MAKER = "verdict.rule_of_maker";
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
export function data(name, value, shown = units.formatted(name, value)) {
  return element("data", { value: String(value ?? ""), "data-name": name }, shown);
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
  return OF_CONTACT.some((name) => name === record.subject);
}

/**
 * The name of a verdict or a warning in words.
 *
 * @param {{ id: string }} record
 */
export function nameOf({ id }) {
  return id.slice(id.indexOf(".") + 1).replaceAll(/[._]/g, " ");
}

/**
 * The ends of a result in a band, in the unit that is displayed.
 *
 * @param {BandAnswer | undefined} answer
 * @param {string} name
 */
function endsOf(answer, name) {
  /** @type {Record<string, any>} */
  const outputs = answer?.band ?? {};
  const { low, high } = outputs[name] ?? {};
  if (typeof low !== "number" || typeof high !== "number") return null;
  return { low: units.inDisplayUnit(name, low), high: units.inDisplayUnit(name, high) };
}

/**
 * A result as text, as it is without a band, and the ends of its band.
 *
 * @param {string} name
 * @param {number | null | undefined} value
 * @param {BandAnswer | undefined} band
 * @returns {{ text: string, interval?: string }}
 */
export function rounded(name, value, band) {
  const ends = endsOf(band, name);
  const written = units.formatted(name, value);
  if (!ends || typeof value !== "number" || ends.high <= ends.low) return { text: written };
  const [low, high] = units.ends(ends.low, ends.high);
  const unit = units.unitOf(name);
  const end = unit ? `\u00a0${units.symbol(unit)}` : "";
  return { text: written, interval: `${low} to ${high}${end}` };
}

/** The ends of a band with what they are of. @param {string} interval @param {BandAnswer} known */
function ofCauses(interval, { band }) {
  return Object.keys(band.laws).length ? `inputs and laws: ${interval}` : `inputs alone: ${interval}`;
}

/** Why a torque lies outside its band, for the headline. @param {number | null} torque @param {BandAnswer | undefined} band */
function outsideBand(torque, band) {
  const { low, high } = band?.band.screw_torque ?? {};
  if (torque === null) return "";
  if (typeof low === "number" && torque < low) return " It lies below its band: most other inputs and laws give more.";
  return typeof high === "number" && torque > high
    ? " It lies above its band: most other inputs and laws give less."
    : "";
}

/** What screen readers are told of the answer. @type {{ words: string, timer?: ReturnType<typeof setTimeout> }} */
const told = { words: "" };

/** Tell a text once typing has come to rest. @param {string} words */
function announce(words) {
  if (words === told.words) return;
  told.words = words;
  clearTimeout(told.timer);
  told.timer = setTimeout(() => {
    byId("said").textContent = words;
  }, ANNOUNCE_AFTER);
}

/**
 * Show everything of one answer but its charts.
 *
 * @param {Run} answer
 * @param {{ band: Band | null, checks?: import("./checks.js").Judged }} beside its band and its checks, as far as they are there
 * @param {(place: Element) => boolean} isWanted where it is shown: everywhere, or in what is seen alone
 */
export function show(answer, { band, checks }, isWanted = () => true) {
  const { results, words, warnings } = answer;
  const known = band?.state === "done" ? band.answer : undefined;
  const wants = (/** @type {string} */ id) => isWanted(byId(id));
  update(byId("case"), words.title);
  const torque = rounded("screw_torque", results.screw_torque, known);
  const isDriven = results.efficiency === null && results.back_driving_efficiency !== null;
  const efficiency = isDriven ? "back_driving_efficiency" : "efficiency";
  const shown = rounded(efficiency, results[efficiency], known).text;
  const numbersInWords = `Friction torque ${torque.text}${torque.interval && known ? ` (${ofCauses(torque.interval, known)})` : ""}, drive torque ${rounded("drive_torque", results.drive_torque, known).text}, efficiency ${isDriven ? `${shown} (the load drives)` : shown}.`;
  const beside = `${outsideBand(results.screw_torque, known)}${inHeadline(answer)}`;
  const inShort = `${beside}${checks ? ` ${verdict(checks)}` : ""}`;
  const summary = `${numbersInWords}${inShort}`;
  write("summary", summary);
  write("in-short", inShort.trim()); // the numbers stand above it
  if (!byId("results").classList.contains("stale")) {
    announce(summary);
    const title = `${torque.text} · ballscrew`;
    if (document.title !== title) document.title = title;
  }
  if (wants("verdicts")) showVerdicts(answer);
  if (wants("numbers")) showResults(answer, known, band !== null);
  if (wants("rules")) showRules(answer);
  if (wants("vendor-rows")) showVendorRows(answer);
  if (wants("ball-numbers")) showBall(answer);
  if (wants("contacts")) showContacts(answer, warnings.filter(isOfContact));
  if (wants("assumed")) showAssumptions(answer);
  if (wants("band-words")) showBand(answer, band);
}

/**
 * The table of results.
 *
 * @param {Run} answer
 * @param {BandAnswer | undefined} known its band, where that is there
 * @param {boolean} isBanded whether there is one, or will be
 */
function showResults(answer, known, isBanded) {
  const numbers = numbersOf(answer);
  // without a load there is nothing to hold, as the verdict says
  const unloaded = answer.verdicts.some(({ id }) => id === "verdict.no_load");
  const isShown = (/** @type {string} */ name) =>
    numbers[name] !== undefined && !(unloaded && name === "holding_torque");
  const rows = FIRST.filter(isShown).map((name, place) => {
    const { text: shown, interval } = rounded(name, numbers[name], known);
    const isOfInputs = place === 0 && interval && known && !Object.keys(known.band.laws).length;
    // the place of an interval that is still computed is kept
    const ends =
      interval || isBanded
        ? element("span", { class: "interval" }, interval ?? "\u00a0", isOfInputs ? ", inputs alone" : "")
        : null;
    return element(
      "div",
      {},
      element("dt", {}, RESULTS[name]),
      element("dd", {}, data(name, numbers[name], shown), ends),
    );
  });
  update(byId("numbers"), element("dl", {}, ...rows));
}

/** The numbers of the most loaded ball. @param {Run} answer */
function showBall(answer) {
  const { screw, nut } = answer.results;
  /** @type {Numbers} */
  const numbers = {
    ...answer.results,
    maximum_pressure: greatestPressure(answer),
    minimum_film_parameter: answer.results.minimum_film_parameter ?? leastFilm(answer),
    minimum_film_thickness: Math.min(screw.minimum_film_thickness ?? NaN, nut.minimum_film_thickness ?? NaN),
  };
  const rows = OF_BALL.filter((name) => Number.isFinite(numbers[name])).map((name) =>
    element("div", {}, element("dt", {}, RESULTS[name]), element("dd", {}, data(name, numbers[name]))),
  );
  update(byId("ball-numbers"), element("dl", {}, ...rows));
}

/**
 * How the model stands against the vendor's rows that are most like this nut.
 *
 * @param {Run} answer
 */
function showVendorRows({ vendor_rows: near }) {
  const place = byId("vendor-rows");
  place.parentElement?.toggleAttribute("hidden", !near);
  if (!near) return;
  const ratio = units.digits(near.mean_ratio, 2);
  const spread = units.digits(near.std_ratio, 1);
  const { calibration, maker, set } = near;
  const how = calibration ? `with the calibration ${calibration}` : "without calibration";
  write(
    "vendor-rows",
    `Drag torque without seals, model / ${maker}: ${ratio} ± ${spread} ${how}, for the rows of ${maker} (${set}) most like this nut: ${near.rows.join(", ")}.`,
  );
  write("calibrate", calibration ? "Remove the calibration" : `Calibrate to ${maker}`);
}

/** @param {Run} answer */
function showVerdicts(answer) {
  const { verdicts, warnings, words } = answer;
  // the rule of its maker stands among the rules
  const shown = joined(verdicts.filter(({ id }) => id !== RULE_OF_MAKER || !words.rules.length));
  const lines = shown.map(({ severity, text }) =>
    element("p", { class: severity === "info" ? "verdict" : "verdict careful" }, asRead(text)),
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
  const said = new Set(verdicts.map((record) => record.text));
  const others = warnings.filter((record) => !isOfContact(record) && !said.has(record.text));
  update(byId("verdicts"), ...lines, ...others.map(warning));
}

/**
 * Verdicts, of which those that begin alike, as at speed and at rest, are one: what follows is said of both.
 *
 * @param {VerdictRecord[]} verdicts
 */
function joined(verdicts) {
  /** @type {Map<string, { severity: string, text: string }>} */
  const found = new Map();
  for (const { severity, text } of verdicts) {
    const [begin, ...rest] = text.split("; ");
    const before = found.get(begin);
    const worst = before && before.severity !== "info" ? before.severity : severity;
    found.set(begin, { severity: worst, text: before ? [before.text, ...rest].join("; ") : text });
  }
  return [...found.values()];
}

/** The rules of makers beside the model, and what is to know of that of its own maker. @param {Run} answer */
function showRules({ words, verdicts }) {
  const own = verdicts.filter(({ id }) => id === RULE_OF_MAKER).map(({ text }) => element("p", {}, asRead(text)));
  const said = words.rules.map((one) => element("p", { class: "small" }, asRead(one)));
  update(byId("rules"), ...said, said.length && own.length ? opened("The rule of its maker", ...own) : null);
}

/** @param {VerdictRecord} record */
function warning(record) {
  const subject = element("strong", {}, `Beware, ${nameOf(record)}: `);
  return element("p", { class: "warning" }, subject, element("span", {}, asRead(record.text)));
}

/** @param {Run} answer */
function showAssumptions({ words, provenance }) {
  const { model, version, references } = provenance;
  update(
    byId("assumed"),
    element("ul", {}, ...words.assumed.map((one) => element("li", {}, one))),
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
  const rows = OF_CONTACT.filter((name) => ofScrew[name] !== undefined && ofScrew[name] !== null).map((name) => [
    OF_CONTACTS[name],
    data(name, ofScrew[name]),
    data(name, ofNut[name]),
  ]);
  const film = leastFilm(answer);
  const caption = answer.loads ? "contacts of the most loaded ball" : "contacts of each ball";
  update(
    byId("contacts"),
    element(
      "p",
      { class: "regime" },
      Number.isFinite(film)
        ? isStarved(answer)
          ? `λ = ${units.digits(film)} at the least, for an inlet full of oil, which starved ones are not: ${regime(film)} there`
          : `λ = ${units.digits(film)} at the least: ${regime(film)}`
        : "no film",
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
    const { words, verdicts, warnings } = band.answer;
    const shown = new Set(answer.warnings.map((record) => record.id));
    const others = warnings.filter((record) => !shown.has(record.id));
    const [first, ...sentences] = verdicts.filter(({ id }) => id.startsWith("band."));
    const isOpen = place.querySelector("details")?.open ?? false;
    place.replaceChildren(
      element(
        "details",
        { open: isOpen },
        element("summary", {}, first.text),
        ...sentences.map((one) => element("p", {}, one.text)),
        element("p", { class: "small" }, words.inputs),
        ...others.map((record) => element("p", { class: "small" }, record.text)),
      ),
    );
  }
}

/**
 * Why there is no answer: lines to show, and all of it to be said.
 *
 * @typedef {{ lines: (string | Node)[], said: string }} Refusal
 */

/** @param {string[]} lines @returns {Refusal} */
export function refusal(lines) {
  return { lines, said: lines.join(" ") };
}

/**
 * Show why there is no valid answer, and dim the one before.
 *
 * @param {Refusal} refusal
 */
export function fail({ lines, said }) {
  const before = byId("case").textContent;
  byId("results").classList.remove("waiting");
  byId("results").classList.add("stale");
  byId("results").classList.toggle("empty", !before);
  document.title = "not computed · ballscrew";
  const standing = "The results below are those of the previous input.";
  const all = before ? [...lines, standing] : lines;
  byId("faults").replaceChildren(...all.map((line) => element("p", {}, line)));
  announce(before ? `${said} ${standing}` : said);
}

/** True where the answer on the page is not that of its case. */
export function isStale() {
  return byId("results").classList.contains("stale");
}

export function succeed() {
  byId("results").classList.remove("waiting");
  byId("results").classList.remove("stale", "empty");
  byId("faults").replaceChildren();
}
