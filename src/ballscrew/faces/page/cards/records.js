// Verdicts and warnings of a card.

import { element } from "../dom.js";
import { sentence } from "../sentence.js";

/**
 * Verdicts, and below them what to beware of.
 *
 * @param {VerdictRecord[]} verdicts
 * @param {VerdictRecord[]} warnings
 */
export function lines(verdicts, warnings) {
  const [firstVerdicts, firstWarnings] = [once(verdicts), once(warnings)];
  const said = new Set(firstVerdicts.map((one) => one.text));
  return [
    ...firstVerdicts.map((record) =>
      element(
        "p",
        {
          class: record.severity === "info" ? "verdict" : "verdict careful",
          "data-record": record.id,
        },
        sentence(record.text),
      ),
    ),
    ...firstWarnings
      .filter((record) => !said.has(record.text))
      .map((record) =>
        element(
          "p",
          { class: "warning", "data-record": record.id },
          element("strong", {}, "Beware: "),
          element("span", {}, sentence(record.text)),
        ),
      ),
  ];
}

/** Records without those that say the same again. @param {VerdictRecord[]} records */
function once(records) {
  return [...new Map(records.map((record) => [record.text, record])).values()];
}
