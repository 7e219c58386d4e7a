// The inputs of the card of a duty: a motion of any kind, the axis that moves, and its motor.

import { button, menu, textField } from "../controls.js";
import { element } from "../dom.js";
import * as schema from "../schema.js";
import * as units from "../units.js";
import { fieldset } from "./case_fields.js";
import { editor, idOf, kindOf } from "./segments.js";

/** Kinds of motion. @type {Record<string, string>} */
const KINDS_IN_WORDS = {
  "s-curve": "stroke with limited jerk",
  segments: "segments",
  sine: "sine",
  trapezoid: "stroke with constant acceleration",
};

/** @import { SchemaNode } from "../schema.js" */
/** @import { FrozenState as State, Tables } from "../state.js" */

const SEGMENTS = "segments";
const OF_AXIS = [
  "mass",
  "inclination",
  "inertia",
  "motor_inertia",
  "coupling_inertia",
  "screw_inertia",
  "counterweight",
  "counterforce",
  "guide_friction_coefficient",
  "guide_seal_force",
  "bearing_torque",
  "transmission_ratio",
  "transmission_efficiency",
  "brake_holds",
];
const OF_MOTOR = ["rated_torque", "peak_torque", "largest_speed", "torque_constant", "resistance", "holding_torque"];

/**
 * A change of the inputs: sections of the case, the field that was edited, and whether the inputs are made anew with the
 * focus on the element of an ``id``.
 *
 * @typedef {(sections: Tables, options: { path?: string, isAnew?: boolean, id?: string }) => void} Put
 */

/**
 * The schemas of the fields of a segment.
 *
 * @returns {Record<string, SchemaNode>}
 */
function nodesOfSegments() {
  const node = /** @type {{ items?: SchemaNode } | undefined} */ (schema.fieldOf("motion.segment"));
  return schema.definition(node?.items)?.properties ?? {};
}

/**
 * The inputs. They stay while somebody types, so that each edit begins from what the sections are by then.
 *
 * @param {() => Tables} current sections of the case as they are now
 * @param {State} state
 * @param {Record<string, string[]>} motions the fields of each kind of motion
 * @param {Tables | undefined} usualMotor the motor that a case without one is given
 * @param {{ put: Put, onChange: (change: import("../fields.js").Change) => void }} listeners
 */
export function inputs(current, state, motions, usualMotor, { put, onChange }) {
  const source = { state, tables: current(), onChange };
  return [
    motionFields(() => current().motion, motions, source, put),
    fieldset("axis", "Axis", OF_AXIS, source),
    ...motorFields(() => current().motor, usualMotor, source, put),
  ];
}

/**
 * @param {() => Tables} current
 * @param {Record<string, string[]>} motions
 * @param {Parameters<typeof fieldset>[3]} source
 * @param {Put} put
 */
function motionFields(current, motions, source, put) {
  const kind = String(current().kind ?? SEGMENTS);
  const id = "motion-kind";
  const select = menu(
    Object.keys(motions).map((name) => [name, KINDS_IN_WORDS[name] ?? name]),
    kind,
    (chosen) => put({ motion: asKind(current(), chosen, motions) }, { isAnew: true, id }),
    { id },
  );
  const names = (motions[kind] ?? []).filter((name) => name !== "segment" && name !== "kind");
  const fields = fieldset("motion", "Motion", names, source);
  const chosen = element(
    "div",
    { class: "field", "data-path": "motion.kind" },
    element("label", { for: id }, "kind of motion"),
    element("div", { class: "entry" }, select),
    element("p", { class: "fault" }),
  );
  fields.querySelector(".grid")?.prepend(chosen);
  if (kind === SEGMENTS) {
    const segments = () => current().segment ?? [];
    fields.append(
      editor(segments, nodesOfSegments(), (segment, { place, name, isAnew }) => {
        const path = isAnew ? undefined : `motion.segment ${place + 1}.${name}`;
        put({ motion: { ...current(), segment } }, { path, isAnew, id: idOf(place, name) });
      }),
    );
  }
  return fields;
}

/**
 * A motion as one of another kind: what both have stays, and what the other needs is a usual value.
 *
 * @param {Tables} motion
 * @param {string} kind
 * @param {Record<string, string[]>} motions
 */
function asKind(motion, kind, motions) {
  const { stroke, speed, dwell, segment } = motion;
  /** @type {Tables} */
  const found = { kind };
  /** @type {import("./segments.js").Segment[]} */
  const segments = Array.isArray(segment) ? segment : [];
  const first = segments.find((one) => kindOf(one) === "move");
  const known = { ...motion, stroke: stroke ?? first?.distance?.replace(/^[-−]/, ""), speed: speed ?? first?.speed };
  for (const name of motions[kind] ?? []) {
    const value = /** @type {Tables} */ (known)[name];
    const needed =
      ["stroke", "speed", "acceleration", "frequency"].includes(name) || (kind === "s-curve" && name === "jerk");
    if (value !== undefined && name !== "kind") found[name] = value;
    else if (needed) found[name] = schema.fieldOf(`motion.${name}`)?.examples?.[0];
  }
  if (kind === SEGMENTS && !found.segment) {
    const rest = dwell ? [{ name: "rest", duration: dwell }] : [];
    const ways = [stroke, `-${stroke}`].map((distance, way) => ({
      name: way ? "back" : "forth",
      distance,
      speed: speed ?? "10 m/min",
    }));
    found.segment = ways.flatMap((one) => [one, ...rest]);
  }
  return found;
}

/**
 * The motor, which a case may leave out.
 *
 * @param {() => Tables | undefined} current
 * @param {Tables | undefined} usualMotor
 * @param {Parameters<typeof fieldset>[3]} source
 * @param {Put} put
 */
function motorFields(current, usualMotor, source, put) {
  const motor = current();
  const id = "motor-toggle";
  const toggle = () => put({ motor: motor ? null : (usualMotor ?? {}) }, { isAnew: true, id });
  const turn = button(motor ? "Leave the motor out" : "Add a motor", toggle, { id });
  if (!motor) return [element("p", {}, "No motor is given: its torque is computed, and not judged. ", turn)];
  const fields = fieldset("motor", "Motor", OF_MOTOR, source);
  /** @type {string[][]} */
  const points = motor.curve ?? [];
  /** @param {string} typed */
  const read = (typed) => {
    const points = typed.split(";").map((point) => point.split(":").map((one) => units.inASCII(one.trim())));
    const { curve, ...others } = current() ?? {};
    put({ motor: typed.trim() ? { ...others, curve: points } : others }, { path: "motor.curve" });
  };
  const input = textField(points.map((point) => point.join(": ")).join("; "), read, {
    id: "f-motor-curve",
    spellcheck: "false",
    "aria-describedby": "f-motor-curve-about f-motor-curve-fault",
  });
  fields.append(
    element(
      "div",
      { class: "field", "data-path": "motor.curve" },
      element("label", { for: "f-motor-curve" }, "curve of the peak torque"),
      element("div", { class: "entry" }, input),
      element(
        "p",
        { class: "small", id: "f-motor-curve-about" },
        "speed: torque; speed: torque, such as 0 rpm: 50 N m; 2500 rpm: 30 N m",
      ),
      element("p", { class: "fault", id: "f-motor-curve-fault" }),
    ),
    turn,
  );
  return [fields];
}
