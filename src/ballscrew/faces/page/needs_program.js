// What stands in a view that the modules in the browser do not answer: the command that does, and the case for it.

import { tomlOf } from "./case_alone.js";
import { button } from "./controls.js";
import { currentCase } from "./designs.js";
import { element } from "./dom.js";
import { save } from "./saving.js";

/** Commands by the names of the places of cards. @type {Record<string, string>} */
const COMMANDS = {
  axis: "ballscrew axis case.toml",
  duty: "ballscrew duty case.toml",
  "warm-up": "ballscrew warm-up case.toml --hours 4",
  choose: "ballscrew select need.toml",
  reversal: "ballscrew reversal case.toml",
  ripple: "ballscrew ripple case.toml",
  sensitivity: "ballscrew sensitivity case.toml",
  calibration: "ballscrew fit log.csv --case case.toml",
  service: "ballscrew service log.csv --case case.toml",
  condition: "ballscrew condition tests.csv --case case.toml",
  optimise: "ballscrew optimise need.toml",
  "hand-over": "ballscrew hand-over case.toml",
  "own-nut": 'ballscrew catalogue own "d0=40 mm, lead=10 mm, turns=2x2.5" --case',
};
/** Cards whose command takes no case. */
const WITHOUT_CASE = ["choose", "optimise", "own-nut"];
/** Where the program serves the same page. */
const SERVED = "http://127.0.0.1:8017/";

/** Test whether a card needs the program. @param {string} name */
export function needsProgram(name) {
  return Object.hasOwn(COMMANDS, name);
}

/**
 * A card in whose place stands what the program has to be asked.
 *
 * @param {HTMLElement} holder
 */
export function setUp(holder) {
  const link = element("a", { target: "_blank", rel: "noopener" }, "Open the case in the program");
  const said = element("span", { role: "status" });
  const written = async () => tomlOf(await currentCase());
  const saving = async () => save(".toml", new Blob([await written()], { type: "application/toml" }));
  const copying = async () => {
    try {
      await navigator.clipboard.writeText(await written());
      said.textContent = "copied";
    } catch {
      said.textContent = "not copied: the browser does not allow it";
    }
  };
  const line = element(
    "p",
    { class: "row" },
    button("Save the case", saving),
    " ",
    button("Copy the case", copying),
    " ",
    link,
    ", which ",
    element("code", {}, "ballscrew serve"),
    " serves ",
    said,
  );
  holder.replaceChildren(
    element("p", {}, "This page has no server; the program answers this: ", element("code", {}, COMMANDS[holder.id])),
    ...(WITHOUT_CASE.includes(holder.id) ? [] : [line]),
  );
  return {
    follow() {
      link.href = `${SERVED}${location.hash}`;
    },
  };
}
