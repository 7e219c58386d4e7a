// The card of a service: two logs, the preload that is left in the nut, and what else could explain them.

import * as designs from "../designs.js";
import { labelled, primaryButton, textField } from "../controls.js";
import { element } from "../dom.js";
import * as units from "../units.js";
import { vocabulary } from "../vocabulary.js";
import { caseFile, commandLine, dropZone, exampleButton, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { question } from "./question.js";

/** Share of the preload that may be lost, in percent, where nothing else is typed. */
const TOLERANCE = "10";

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {Record<string, import("./log_parts.js").SentFile>} */
  const logs = {};
  /** @type {import("../state.js").Tables} */
  let tables = {};
  const problems = element("div");
  const asked = question({
    address: "service",
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      asked.head.hidden = asked.result.hidden = faults.length > 0; // what another log told is no answer below a fault
      return undefined;
    },
    isLarge: () => true,
  });
  const zones = ["new", "worn"].map((name) =>
    dropZone(`service-${name}`, name === "new" ? "Log when new (may be missing)" : "Log of now", (file) => {
      logs[name] = file;
      follow();
    }),
  );
  const example = exampleButton("service", (found) => {
    for (const [place, file] of found.entries()) zones[place].use(file);
  });
  const tolerance = textField(TOLERANCE, () => follow(), { id: "service-tolerance", size: "5" });
  const start = primaryButton("service-start", "Find the preload", async () => {
    tables = await designs.currentCase();
    asked.follow(body(), 0);
  });
  start.disabled = true;
  const command = element("div");
  const options = vocabulary.options.service.filter(({ name }) => name !== "tolerance"); // it has its own place
  /** What is given of them. @type {import("./option_fields.js").Given} */
  const chosen = {};
  const more = optionFields("service", options, chosen, () => follow());
  holder.replaceChildren(
    asked.head,
    ...zones.map(({ zone }) => zone),
    example,
    labelled(tolerance, "share of the preload that may be lost", "%", start),
    more,
    command,
    asked.line,
    problems,
    asked.result,
  );
  asked.resume();

  function share() {
    return Number(units.withPoint(tolerance.value)) / 100;
  }

  function body() {
    return { case: tables, ...logs, tolerance: Number.isFinite(share()) ? share() : -1, ...chosen };
  }

  async function follow() {
    tables = await designs.currentCase();
    start.disabled = !logs.worn;
    const names = ["new", "worn"].flatMap((name) => (logs[name] ? [logs[name].name] : []));
    const option = tolerance.value === TOLERANCE ? [] : ["--tolerance", String(share())];
    const commandWords = ["ballscrew", "service", ...names, "--case", caseFile(), ...option, ...flags(options, chosen)];
    command.replaceChildren(...(logs.worn ? [commandLine(commandWords)] : []));
    asked.compare(body());
  }

  return { follow };
}
