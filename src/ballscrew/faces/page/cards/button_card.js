// The card of a question that is asked by its button alone: what is given, its options, the command that does the same, and
// the answer.

import { primaryButton } from "../controls.js";
import { element } from "../dom.js";
import { vocabulary } from "../vocabulary.js";
import { commandLine, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { question } from "./question.js";

/** @typedef {Parameters<typeof question>[0]} Question */
/**
 * What a card has of its own: the address of its question and its button; what stands above the options, and those that
 * have a place there; what is asked beside them, and the command for it, which is empty where nothing can be asked yet.
 *
 * @typedef {object} Parts
 * @property {Question["address"]} name
 * @property {string} [id] of the button
 * @property {string} words
 * @property {Node[]} parts
 * @property {string[]} [apart]
 * @property {() => Promise<object>} body
 * @property {() => string[]} line
 * @property {boolean} [isOfFiles] whether it is asked about files, which are too large to keep answers by them
 */

/**
 * @param {HTMLElement} holder
 * @param {Parts & Partial<Question>} parts
 */
export function buttonCard(
  holder,
  { name, id = `${name}-start`, words, parts, apart = [], body, line, isOfFiles = false, ...more },
) {
  const problems = element("div");
  const command = element("div");
  const options = (vocabulary.options[name] ?? []).filter((one) => !apart.includes(one.name));
  /** What is given of them. @type {import("./option_fields.js").Given} */
  const chosen = {};
  const asked = question({
    address: name,
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      // what other files told is no answer below a fault
      if (isOfFiles) asked.head.hidden = asked.result.hidden = faults.length > 0;
      return undefined;
    },
    isLarge: () => isOfFiles,
    ...more,
  });
  const start = primaryButton(id, words, async () => asked.follow(await whole(), 0));
  start.disabled = true;
  holder.replaceChildren(
    asked.head,
    ...parts,
    options.length ? optionFields(name, options, chosen, follow) : "",
    element("p", { class: "card-start" }, start),
    command,
    asked.line,
    problems,
    asked.result,
  );
  asked.resume();

  async function whole() {
    return { ...(await body()), ...chosen };
  }

  async function follow() {
    const found = await whole();
    const given = line();
    start.disabled = !given.length;
    const all = ["ballscrew", name, ...given, ...flags(options, chosen)];
    command.replaceChildren(...(given.length ? [commandLine(all)] : []));
    asked.compare(found);
  }

  return { follow, problems };
}
