// The cards of questions that take some seconds and need nothing but the case and their options: a reversal, a ripple, a
// sensitivity. The answer is asked for by the button alone.

import * as designs from "../designs.js";
import { element } from "../dom.js";
import { documented } from "../help.js";
import { buttonCard } from "./button_card.js";
import { caseFile } from "./log_parts.js";

/** What the documentation of each says. @type {Record<string, string>} */
const HOW_TO = {
  reversal: "What speaks for it, and where it fails",
  ripple: "What decides, and what is left out",
  sensitivity: "How to halve the band",
};
/** What their buttons say. @type {Record<string, string>} */
const START = {
  reversal: "Compute the reversal",
  ripple: "Compute the ripple",
  sensitivity: "Find the sources",
};
/** What to know of each. @type {Record<string, string>} */
const ABOUT = {
  reversal: "This is a hypothesis, but for the friction in steady motion: no published ball screw shows it by itself.",
  ripple:
    "This is a hypothesis: room and grooves of the circuits are assumed, and no measured torque over the angle was compared.",
  sensitivity:
    "Uncertain inputs are those that the design gives with an interval, such as 0.54 ± 0.01, and those that are rarely known, each with its usual interval.",
};

/** Pages of the documentation on the questions. */
const PAGES = { reversal: "howto/reversal", ripple: "howto/ripple", sensitivity: "sensitivity" };

/**
 * Set up the card of the question that has the name of its place.
 *
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const name = /** @type {keyof typeof PAGES} */ (holder.id);
  const page = documented(PAGES[name], HOW_TO[name]);
  return buttonCard(holder, {
    name,
    words: START[name],
    parts: [element("p", { class: "small" }, `${ABOUT[name]} `, page)],
    body: async () => ({ case: await designs.currentCase() }),
    line: () => [caseFile()],
  });
}
