// The card of the axis: a sketch whose parts are the inputs, and what gives way between motor and table over the stroke.

import { sketch } from "../axis_sketch.js";
import * as designs from "../designs.js";
import { element, redraw } from "../dom.js";
import { documented } from "../help.js";
import * as schema from "../schema.js";
import * as states from "../state.js";
import { store } from "../store.js";
import * as units from "../units.js";
import { fieldset, placeFaults, showValues } from "./case_fields.js";
import { caseFile, commandLine, faultLines } from "./log_parts.js";
import { question } from "./question.js";

/** @typedef {import("../state.js").Tables} Tables */

/** Fields of the elements of an axis that has them. @type {[string, string, string[]][]} */
const ELEMENTS = [
  ["bearings.fixed", "bearings", ["rigidity", "preload"]],
  ["guides", "guides", ["friction_coefficient", "seal_force", "carriages"]],
];

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const picture = element("div");
  const editor = element("div", { class: "card-inputs" });
  const command = element("div");
  const problems = element("div");
  /** @type {Tables} */
  let tables = {};
  /** What counted in the answer. @type {Tables | undefined} */
  let inputs;
  /** What the fields show, as text. */
  let shown = "";
  const asked = question({
    address: "axis",
    isShort: true,
    show: ({ inputs: found }) => {
      inputs = found;
      drawSketch();
      showValues(editor, found);
    },
    place: (faults) => {
      problems.replaceChildren(...faultLines(placeFaults(editor, faults)));
      return undefined;
    },
  });
  holder.replaceChildren(asked.head, picture, editor, command, asked.line, problems, asked.result);

  /** @param {import("../fields.js").Change} change */
  function onChange({ path = "", text: typed = "", unit }) {
    if (unit !== undefined) {
      designs.chooseUnit(path, unit);
      return;
    }
    const [section] = path.split(".");
    tables = states.tables(tables, { [path]: typed }, schema.fieldOf);
    shown = keyOf();
    designs.setTables({ [section]: tables[section] ?? {} }, path);
  }

  function keyOf() {
    const { fields, show: design } = store.state;
    return JSON.stringify([tables.bearings, tables.guides, fields, design, units.currentSystem()]);
  }

  async function follow() {
    const design = designs.current();
    const found = await designs.currentCase();
    if (design !== designs.current()) return; // another one was chosen in the meantime, and is followed on its own
    tables = found;
    drawSketch();
    if (keyOf() !== shown) {
      shown = keyOf();
      editor.replaceChildren(...elements());
    }
    if (inputs) showValues(editor, inputs);
    command.replaceChildren(commandLine(["ballscrew", "axis", caseFile()]), about());
    asked.follow({ case: tables });
  }

  /** The sketch; the focus stays at the part where it is. */
  function drawSketch() {
    redraw(picture, sketch(tables, inputs ?? {}));
  }

  /** The fields of bearings and guides that the case has. */
  function elements() {
    return ELEMENTS.filter(([path]) => states.valueAt(tables, path) !== undefined).map(([path, section, names]) =>
      fieldset(path, schema.OF_CARDS[section], names, { state: store.state, tables, onChange }),
    );
  }

  return { follow };
}

function about() {
  return element(
    "p",
    { class: "small" },
    documented("howto/axis", "How an axis with bearings and guides is written, and how rigid its parts are."),
  );
}
