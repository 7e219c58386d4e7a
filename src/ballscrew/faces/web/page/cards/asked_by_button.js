// A card of the case that takes some seconds: its options, and an answer that is asked for by its button alone.

import * as designs from "../designs.js";
import { primaryButton } from "../controls.js";
import { element } from "../dom.js";
import { watch } from "../plot.js";
import * as units from "../units.js";
import { vocabulary } from "../vocabulary.js";
import { caseFile, commandLine, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { question } from "./question.js";
import { lines } from "./records.js";

/** @typedef {{ reversal: ReversalAnswer, ripple: RippleAnswer, sensitivity: SensitivityAnswer }} Answers */
/**
 * Options that a card has in its own way: their names, and their fields, which write into what is given.
 *
 * @typedef {object} Own
 * @property {string[]} names
 * @property {(given: import("./option_fields.js").Given, change: () => void) => HTMLElement[]} fields
 */

/** @type {Own} */
const NO_OWN = { names: [], fields: () => [] };

/**
 * Set up the card of a question that has its address, its command and its options by one name. Above them stands what it is
 * about, on the button the text ``start``. Below the verdicts stand the charts, and what ``show`` gives back after it has drawn them.
 *
 * @template {keyof Answers} Name
 * @param {HTMLElement} holder
 * @param {Name} name
 * @param {(string | Node)[]} about
 * @param {import("../texts.js").Key} start
 * @param {HTMLElement[]} charts
 * @param {(found: Answers[Name]) => HTMLElement[]} show
 * @param {Own} [own]
 * @returns {import("../cards.js").Card}
 */
export function askedByButton(holder, name, about, start, charts, show, own = NO_OWN) {
  /** @type {import("../state.js").Tables} */
  let tables = {};
  /** @type {Answers[Name] | undefined} */
  let answer;
  let system = "";
  const problems = element("div");
  const words = element("div");
  const rest = element("div");
  const result = element("div", { class: "card-result", hidden: true }, words, ...charts, rest);
  const asked = question({
    address: name,
    result,
    show: (found) => shown(/** @type {Answers[Name]} */ (found)),
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      return undefined;
    },
  });
  const asks = primaryButton(`${name}-start`, start, async () => {
    tables = await designs.currentCase();
    asked.follow(body(), 0);
  });
  const command = element("div");
  const options = vocabulary.options[name];
  /** @type {import("./option_fields.js").Given} */
  const chosen = {};
  holder.replaceChildren(
    element("p", { class: "small" }, ...about),
    ...own.fields(chosen, () => follow()),
    optionFields(
      name,
      options.filter((option) => !own.names.includes(option.name)),
      chosen,
      () => follow(),
    ),
    element("p", { class: "card-start" }, asks),
    command,
    asked.line,
    problems,
    result,
  );
  for (const chart of charts) watch(chart);
  asked.resume();

  function body() {
    return { case: tables, ...chosen };
  }

  async function follow() {
    tables = await designs.currentCase();
    command.replaceChildren(commandLine(["ballscrew", name, caseFile(), ...flags(options, chosen)]));
    if (answer && system !== units.currentSystem()) shown(answer);
    asked.compare(body());
  }

  /** @param {Answers[Name]} found */
  function shown(found) {
    answer = found;
    system = units.currentSystem();
    result.hidden = false;
    words.replaceChildren(...lines(found.verdicts, found.warnings));
    rest.replaceChildren(...show(found));
  }

  return { follow };
}
