// The card of an optimisation: what a screw for a need would look like, whose sizes are free within what is made: the
// front of the best, each design by the full model, and as a design to take. The need is that of the card of choosing.

import { button, framed } from "../controls.js";
import * as designs from "../designs.js";
import { element } from "../dom.js";
import { labelOf } from "../messages.js";
import { FIELDS } from "../needs.js";
import { isSame, LETTERS } from "../state.js";
import { store } from "../store.js";
import * as views from "../views.js";
import { buttonCard } from "./button_card.js";
import { objective } from "./candidates.js";
import { leftOut, tables } from "./need_tables.js";

/** @typedef {OptimiseAnswer["candidates"][number]} Member */

/** Objectives of a search, those that are usual first. */
const OBJECTIVES = ["loss", "inertia", "life", "rigidity", "drive_torque", "preload_torque", "reflected_mass"];
const USUAL = OBJECTIVES.slice(0, 2);
/** The table of the sheet that has a row for each design. */
const FRONT = "front";

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** The objectives of the need, until others are chosen here. */
  let usual = USUAL;
  let isOwn = false;
  /** @type {OptimiseAnswer | undefined} */
  let answer;
  const asks = element("div", {});
  const taken = element("p", { role: "status" });
  const boxes = OBJECTIVES.map((name) => {
    const box = element("input", { type: "checkbox", checked: USUAL.includes(name), value: name });
    box.addEventListener("change", () => {
      isOwn = true;
      follow();
    });
    return box;
  });
  const fields = OBJECTIVES.map((name, place) => element("label", {}, boxes[place], ` ${objective(name)}`));
  const card = buttonCard(holder, {
    name: "optimise",
    words: "Search the front",
    parts: [asks, framed("Objectives", element("div", { class: "filters" }, ...fields)), taken],
    apart: ["objectives"],
    body: async () => ({ need: await tables(store.state.need), objectives: objectives() }),
    line: () => {
      const names = objectives();
      return names.length ? ["need.toml", ...(isSame(names, usual) ? [] : ["--objectives", names.join(",")])] : [];
    },
    beside: (table, row) => (table === FRONT ? takes(row) : undefined),
    show: (found) => {
      answer = found;
    },
  });

  function objectives() {
    return boxes.filter((box) => box.checked).map((box) => box.value);
  }

  async function follow() {
    const { optimise } = await tables(store.state.need);
    usual = Array.isArray(optimise?.objectives) ? optimise.objectives : USUAL;
    asks.replaceChildren(element("p", {}, `The need: ${summary()}`), element("p", {}, toNeed()));
    // those of the need, until others are chosen here
    if (!isOwn) for (const box of boxes) box.checked = usual.includes(box.value);
    await card.follow();
  }

  /** The button that takes a design of the front. @param {number} row */
  function takes(row) {
    const name = `Optimum ${row + 1}`;
    const onclick = () => answer && take(answer.candidates[row], name);
    return button("Take as design", onclick, { "aria-label": `Take ${name} as design` });
  }

  /** @param {Member} member @param {string} name */
  async function take(member, name) {
    if (!designs.hasRoom()) {
      taken.textContent = `The page holds ${LETTERS.length} designs: delete one first.`;
      return;
    }
    designs.add([await designs.ofCase(member.case, { name })]);
    taken.textContent = `${name} is design ${LETTERS[store.state.show]}.`;
  }

  return { follow };
}

/** What the need asks for, in words. */
function summary() {
  const { texts, duty } = store.state.need;
  const closed = leftOut(store.state.need);
  const given = Object.keys(FIELDS).flatMap((name) =>
    texts[name] && !closed.includes(name) ? [`${labelOf(FIELDS[name] || `need.${name}`)}: ${texts[name]}`] : [],
  );
  return (
    [...given, ...(duty ? ["by the duty of the design on the page, in place of force and feed"] : [])].join("; ") ||
    "nothing is given yet"
  );
}

/** A button to the card that has the fields of the need. */
function toNeed() {
  return button("Change the need", () => views.go("choose.rows"));
}
