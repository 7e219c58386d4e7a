// Files to take away: the case, the answer, the curve, the drawing, the report.

import { byId, element, save } from "./dom.js";
import { send } from "./server.js";

const KINDS = [
  ["TOML", "case file for the command line"], ["JSON", "all results in SI"], ["CSV", "torque and its parts over speed"],
  ["SVG", "drawing of the ball"], ["PDF", "report to file"], ["HTML", "report to read"],
];

/** Buttons for all kinds; ``current()`` gives the case, the answer and the name of the design. */
export function build(current) {
  byId("downloads").replaceChildren(...KINDS.map(([kind, words]) =>
    element("button", { type: "button", title: words, "aria-label": `${kind}: ${words}`, onclick: () => take(kind, current()) }, kind)));
}

async function take(kind, { body, answer, name, csv }) {
  const say = (text) => { byId("download-words").textContent = text; };
  if (byId("results").classList.contains("stale")) return say("The input is at fault: mend it first.");
  try {
    if (kind === "JSON") {
      const { words, ...document } = answer;
      save(`${name}.json`, new Blob([JSON.stringify(document, null, 2)], { type: "application/json" }));
    } else if (kind === "CSV") csv();
    else {
      say(`making the ${kind} …`);
      const address = { TOML: "toml", SVG: "drawing", PDF: "report?kind=pdf", HTML: "report?kind=html" }[kind];
      save(`${name}.${kind.toLowerCase()}`, await (await send(address, body)).blob());
    }
    say(`${kind} saved`);
  } catch (problem) {
    say(problem.lines?.join("; ") ?? String(problem));
  }
}
