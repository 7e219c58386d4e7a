// The card of a condition: the tests of a nut over its life, from a table or from a log each, the preload that is left in
// each, the trend, and the alarm.

import { button } from "../controls.js";
import * as designs from "../designs.js";
import { element } from "../dom.js";
import { buttonCard } from "./button_card.js";
import { caseFile, dropZone, exampleButton } from "./log_parts.js";

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
  const card = buttonCard(holder, {
    name: "condition",
    words: "Find the condition",
    parts: [zone.zone, list, example],
    body: async () => ({ case: await designs.currentCase(), tests }),
    line: () => (tests.length ? [...tests.map(({ name }) => name), "--case", caseFile()] : []),
    isOfFiles: true,
  });

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
      card.problems.replaceChildren(
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
          button(words, onclick, { disabled, "aria-label": `${words}: ${name}` });
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
    card.follow();
  }

  return card;
}
