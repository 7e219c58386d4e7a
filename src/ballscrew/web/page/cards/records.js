// Verdicts and warnings of a card.

import { element } from "../dom.js";
import { ofServer, text } from "../texts.js";

/**
 * Verdicts, and below them what to beware of.
 *
 * @param {VerdictRecord[]} verdicts
 * @param {VerdictRecord[]} warnings
 */
export function lines(verdicts, warnings) {
  return [
    ...verdicts.map(({ id, severity, text: words }) =>
      element(
        "p",
        { class: severity === "info" ? "verdict" : "verdict careful", "data-record": id, ...ofServer },
        sentence(words),
      ),
    ),
    ...warnings.map(({ id, text: words }) =>
      element(
        "p",
        { class: "warning", "data-record": id },
        element("strong", {}, `${text("card.beware")} `),
        element("span", ofServer, sentence(words)),
      ),
    ),
  ];
}

/** @param {string} words */
function sentence(words) {
  // a section and a key of a file, perhaps with a value
  const plain = words.replace(/\[(\w+)\] (\w+)(?: = "([^"]*)")?/g, (_, section, key, value) =>
    [`${key.replaceAll("_", " ")} (${section})`, value].filter(Boolean).join(" "),
  );
  return `${plain.charAt(0).toUpperCase()}${plain.slice(1)}.`;
}
