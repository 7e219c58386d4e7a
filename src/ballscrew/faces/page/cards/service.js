// The card of a service: two logs, the preload that is left in the nut, and what else could explain them.

import { labelled, textField } from "../controls.js";
import * as designs from "../designs.js";
import * as units from "../units.js";
import { buttonCard } from "./button_card.js";
import { caseFile, dropZone, exampleButton } from "./log_parts.js";

/** Share of the preload that may be lost, in percent, where nothing else is typed. */
const TOLERANCE = "10";

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {Record<string, import("./log_parts.js").SentFile>} */
  const logs = {};
  const zones = ["new", "worn"].map((name) =>
    dropZone(`service-${name}`, name === "new" ? "Log when new (may be missing)" : "Log of now", (file) => {
      logs[name] = file;
      card.follow();
    }),
  );
  const example = exampleButton("service", (found) => {
    for (const [place, file] of found.entries()) zones[place].use(file);
  });
  const tolerance = textField(TOLERANCE, () => card.follow(), { id: "service-tolerance", size: "5" });
  const share = () => Number(units.withPoint(tolerance.value)) / 100;
  const card = buttonCard(holder, {
    name: "service",
    words: "Find the preload",
    parts: [
      ...zones.map(({ zone }) => zone),
      example,
      labelled(tolerance, "share of the preload that may be lost", "%"),
    ],
    apart: ["tolerance"],
    body: async () => ({
      case: await designs.currentCase(),
      ...logs,
      tolerance: Number.isFinite(share()) ? share() : -1,
    }),
    line: () => {
      if (!logs.worn) return [];
      const names = ["new", "worn"].flatMap((name) => (logs[name] ? [logs[name].name] : []));
      const option = tolerance.value === TOLERANCE ? [] : ["--tolerance", String(share())];
      return [...names, "--case", caseFile(), ...option];
    },
    isOfFiles: true,
  });
  return card;
}
