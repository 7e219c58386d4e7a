// The card of a duty: a cycle of the axis, what it asks of the motor, what happens without, and what it costs.

import * as designs from "../designs.js";
import { button, labelled, menu } from "../controls.js";
import { element, redraw } from "../dom.js";
import { MOST_BYTES } from "../opening.js";
import * as schema from "../schema.js";
import * as states from "../state.js";
import { store } from "../store.js";
import * as units from "../units.js";
import { vocabulary } from "../vocabulary.js";
import { placeFaults, showValues } from "./case_fields.js";
import { dropZone } from "./log_parts.js";
import { inputs as fieldsOf } from "./motion.js";
import { question } from "./question.js";

/** @typedef {import("../state.js").Tables} Tables */

/** The example whose motion is shown where a design has none. */
const EXAMPLE = "vertical-axis";
/** Sections that an example gives; those beside the first two may be missing. */
const OF_EXAMPLE = ["axis", "motion", "motor", "bearings", "guides"];
/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const note = element("p", { class: "small" });
  const editor = element("div", { class: "card-inputs" });
  const asked = question({
    address: "duty",
    show: ({ inputs: found }) => {
      inputs = found;
      showValues(editor, found);
    },
    place: (faults) => placeFaults(editor, faults),
    isLarge: (body) => "trace" in body,
  });
  const recorded = element("p", { class: "card-start" });
  const zone = dropZone("duty-trace", "A recorded motion (time, position or speed)", take, { most: MOST_BYTES });
  const begin = element("div", {}, examples(vocabulary.starts), zone.zone, recorded, note);
  holder.replaceChildren(asked.head, begin, editor, asked.line, asked.result);

  /** Sections of the case, with those of the example where it has none. @type {Tables} */
  let tables = {};
  let isExample = false;
  /** What the inputs show, as text. */
  let shown = "";
  /** A recorded motion, which is no part of the design. @type {import("./log_parts.js").SentFile | undefined} */
  let trace;
  /** What counted in the answer. @type {Tables | undefined} */
  let inputs;

  /** @param {Tables} found */
  function keyOf(found) {
    const { fields, show: design } = store.state;
    return JSON.stringify([found.axis, found.motion, found.motor, fields, design, units.currentSystem()]);
  }

  /** @type {import("./motion.js").Put} */
  function put(sections, { path, isAnew = false, id }) {
    tables = { ...tables, ...sections };
    // what was typed stands in its field; other changes are shown when the state is followed
    shown = isAnew ? "" : keyOf(tables);
    const given = isExample
      ? Object.fromEntries(["axis", "motion", "motor"].map((name) => [name, tables[name] ?? null]))
      : sections;
    designs.setTables(given, path).then(() => {
      if (isAnew && id) document.getElementById(id)?.focus();
    });
  }

  /** @param {import("../fields.js").Change} change */
  function onChange({ path = "", text: typed = "", unit }) {
    if (unit !== undefined) {
      designs.chooseUnit(path, unit);
      return;
    }
    const [section] = path.split(".");
    const found = states.tables(tables, { [path]: typed }, schema.fieldOf);
    put({ [section]: found[section] ?? {} }, { path });
  }

  async function follow() {
    const design = designs.current();
    const found = await designs.currentCase();
    if (design !== designs.current()) return; // another one was chosen in the meantime, and is followed on its own
    isExample = !found.motion || !found.axis;
    const example = vocabulary.starts[EXAMPLE].case;
    tables = isExample ? { ...found, axis: example.axis, motion: example.motion, motor: example.motor } : found;
    note.textContent = isExample
      ? "This design has no motion yet: what stands here is an example, a vertical axis, with this screw. The first change makes it part of the design."
      : otherParts();
    if (keyOf(tables) !== shown) {
      shown = keyOf(tables);
      const usual = /** @type {Tables} */ (example.motor);
      const fields = fieldsOf(() => tables, store.state, vocabulary.motions, usual, { put, onChange });
      redraw(editor, ...fields);
      if (inputs) showValues(editor, inputs);
    }
    asked.follow(trace ? { case: tables, trace } : { case: tables });
  }

  /** Take a recorded motion in place of that of the design, or none. @param {typeof trace} file */
  function take(file) {
    trace = file;
    const words = `${file?.name} counts in place of the motion below. It is no part of the link or of the case.`;
    const remove = () => {
      take(undefined);
      zone.zone.querySelector("button")?.focus(); // that which was pressed is gone
    };
    recorded.replaceChildren(
      element("span", { class: "small", role: "status" }, file ? words : ""),
      file ? button("Remove the recorded motion", remove, { id: "duty-trace-remove" }) : "",
    );
    return follow();
  }

  holder.addEventListener("drop", (event) => {
    if (!event.defaultPrevented) zone.readAll(event.dataTransfer?.files);
    event.preventDefault(); // the page does not open it as a case
  });

  /** What counts here, beside what is shown. */
  function otherParts() {
    const ofCase = "The bearings and guides of the case count too; their tables are changed in its file.";
    const loads = "Loads are those of mass and motion: load and speed of the operating point do not count here.";
    return tables.bearings || tables.guides ? `${loads} ${ofCase}` : loads;
  }

  /** @param {Vocabulary["starts"]} starts */
  function examples(starts) {
    const moving = Object.entries(starts).filter(([, { moves }]) => moves);
    const select = menu(
      moving.map(([name, { title }]) => [name, title]),
      "",
      () => {},
      { id: "duty-example" },
    );
    const take = () => {
      const example = /** @type {Tables} */ (starts[select.value].case);
      shown = "";
      designs.setTables(Object.fromEntries(OF_EXAMPLE.map((name) => [name, example[name] ?? null])));
    };
    return labelled(select, "Axis and motion of an example:", button("Use this example", take, { id: "duty-take" }));
  }

  return { follow };
}
