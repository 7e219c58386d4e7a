// Warnings of a card.

import { element } from "../dom.js";
import { sentence } from "../sentence.js";

/** What to beware of, each once. @param {VerdictRecord[]} warnings */
export function warningLines(warnings) {
  const once = [...new Map(warnings.map((record) => [record.text, record])).values()];
  return once.map(({ id, text }) => {
    const beware = element("strong", {}, "Beware: ");
    return element("p", { class: "warning", "data-record": id }, beware, element("span", {}, sentence(text)));
  });
}
