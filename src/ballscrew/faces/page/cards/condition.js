// The card of a condition: the tests of a nut over its life, from a table or from a log each, the preload that is left in
// each, the trend, and the alarm.

import * as designs from "../designs.js";
import { primaryButton } from "../controls.js";
import { element } from "../dom.js";
import { vocabulary } from "../vocabulary.js";
import { caseFile, commandLine, dropZone, exampleButton, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { question } from "./question.js";

/** Logs at most: more tests stand in a table. */
const MOST = 100;

/** @param {{ name: string }} one @param {{ name: string }} other */
function byName(one, other) {
  return one.name.localeCompare(other.name, "en", { numeric: true });
}

/** Test whether tests stand in the order of their names. @param {{ name: string }[]} tests */
function isByName(tests) {
  return tests.every((one, place) => !place || byName(tests[place - 1], one) <= 0);
}

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {import("./log_parts.js").SentFile[]} */
  let tests = [];
  /** @type {import("../state.js").Tables} */
  let tables = {};
  const problems = element("div", {});
  const asked = question({
    address: "condition",
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      asked.head.hidden = asked.result.hidden = faults.length > 0; // what other tests told is no answer below a fault
      return undefined;
    },
    isLarge: () => true,
  });
  const list = element("ol", { class: "rows", id: "condition-tests" });
  const zone = dropZone(
    "condition-log",
    "Table with a row for each test, or a log of each test",
    (file) => add([file]),
    { multiple: true },
  );
  const example = exampleButton("condition", (logs) => {
    tests = [];
    add(logs);
  });
  const start = primaryButton("condition-start", "Find the condition", async () => {
    tables = await designs.currentCase();
    asked.follow(body(), 0);
  });
  start.disabled = true;
  const command = element("div", {});
  const options = vocabulary.options.condition;
  /** @type {import("./option_fields.js").Given} */
  const chosen = {};
  holder.replaceChildren(
    asked.head,
    zone.zone,
    list,
    example,
    optionFields("condition", options, chosen, follow),
    element("p", { class: "card-start" }, start),
    command,
    asked.line,
    problems,
    asked.result,
  );
  asked.resume();

  /** Add logs, in the order of their names, as dates in them sort. @param {import("./log_parts.js").SentFile[]} files */
  function add(files) {
    const names = files.map(({ name }) => name);
    const others = tests.filter(({ name }) => !names.includes(name));
    const all = [...others, ...files];
    if (isByName(others)) all.sort(byName); // an order that was given by hand stays
    tests = all.slice(0, MOST);
    showTests();
    const left = all.slice(MOST).map(({ name }) => name);
    if (left.length)
      problems.replaceChildren(
        element("p", { class: "warning" }, `${MOST} tests at most; left out: ${left.join(", ")}`),
      );
  }

  /** The tests in their order, each with buttons that move it or leave it out. */
  function showTests() {
    /** @param {number} place @param {number} by */
    const move = (place, by) => {
      tests.splice(place + by, 0, ...tests.splice(place, 1));
      showTests();
    };
    list.replaceChildren(
      ...tests.map(({ name }, place) => {
        /** @param {string} words @param {() => void} onclick @param {boolean} disabled */
        const act = (words, onclick, disabled = false) =>
          element("button", { type: "button", disabled, "aria-label": `${words}: ${name}`, onclick }, words);
        const leave = () => {
          tests.splice(place, 1);
          showTests();
        };
        return element(
          "li",
          {},
          element("span", {}, name),
          element(
            "span",
            { class: "actions" },
            act("Earlier", () => move(place, -1), place === 0),
            act("Later", () => move(place, 1), place === tests.length - 1),
            act("Leave out", leave),
          ),
        );
      }),
    );
    follow();
  }

  function body() {
    return { case: tables, tests, ...chosen };
  }

  async function follow() {
    tables = await designs.currentCase();
    start.disabled = !tests.length;
    const names = tests.map(({ name }) => name);
    const line = ["ballscrew", "condition", ...names, "--case", caseFile(), ...flags(options, chosen)];
    command.replaceChildren(...(tests.length ? [commandLine(line)] : []));
    asked.compare(body());
  }

  return { follow };
}
