// A sketch of the axis from the motor to the support bearing, not to scale: each part shows its input and leads to it.

import { jump } from "./cards.js";
import { element } from "./dom.js";
import { labelIn } from "./fields.js";
import { fieldOf } from "./schema.js";
import { line, polygon, shape } from "./shapes.js";
import { valueAt } from "./state.js";
import * as units from "./units.js";

/** Parts of the axis in words. @type {Record<string, string>} */
const PARTS_IN_WORDS = {
  counterweight: "counterweight",
  coupling: "coupling and inertia",
  ends: "ends of the shaft",
  fixed: "fixed bearing",
  guides: "guides",
  inclination: "inclination",
  load: "axial load",
  motor: "motor",
  mount: "housing",
  nut: "nut, preload",
  shaft: "shaft, free length",
  table: "table, moved mass",
};

/** @typedef {import("./state.js").Tables} Tables */
/**
 * A part of the axis: the fields that may say something of it, the first one that the case has before the others, and
 * where its picture is.
 *
 * @typedef {{ name: string, paths: string[], draw: (found: Found) => SVGElement[] }} Part
 */
/** What a part shows. @typedef {{ path: string, value: string | undefined, tables: Tables, inputs: Tables }} Found */

/** Slots of the drawing, the middle line of the shaft, and the foot of the guides. */
const SLOT = 140;
const WIDTH = 6 * SLOT;
const HEIGHT = 190;
const SHAFT = 92;
const RAIL = 150;
/** Where the nut is, and where the shaft ends. */
const NUT = 3.5 * SLOT;
const FIRST = 2.5 * SLOT;
const LAST = 5.5 * SLOT;

/** The middle of a slot. @param {number} slot */
function middle(slot) {
  return (slot + 0.5) * SLOT;
}

/** @param {number} x @param {number} y @param {number} width @param {number} height */
function box(x, y, width, height) {
  return shape("rect", { x, y, width, height, rx: 2 });
}

/** A bearing: two boxes with a cross, above and below the shaft. @param {number} x @param {boolean} isFixed */
function bearing(x, isFixed) {
  const rows = isFixed ? [x - 18, x + 2] : [x - 8];
  return rows.flatMap((left) =>
    [SHAFT - 30, SHAFT + 8].flatMap((top) => [
      box(left, top, 16, 22),
      line([left, top], [left + 16, top + 22]),
      line([left + 16, top], [left, top + 22]),
    ]),
  );
}

/** Kinds of ends whose first bearing is not fixed, and those whose far end is free or fixed. */
const OF_ENDS = { supportedFirst: "supported-supported", free: "fixed-free", fixedLast: "fixed-fixed" };

/** How the ends of the shaft are held, by the answer or the case. @param {Found} found */
function endsOf({ tables, inputs }) {
  return String(valueAt(tables, "installation.ends") ?? valueAt(inputs, "installation.ends") ?? "");
}

/** Parts in the row above the drawing, and in that below it. @type {{ above: Part[], below: Part[] }} */
const PARTS = {
  above: [
    { name: "motor", paths: ["motor.rated_torque"], draw: () => [box(middle(0) - 45, SHAFT - 32, 80, 64)] },
    {
      name: "coupling",
      paths: ["axis.inertia"],
      draw: () => [box(middle(1) - 22, SHAFT - 16, 18, 32), box(middle(1) + 4, SHAFT - 16, 18, 32)],
    },
    {
      name: "fixed",
      paths: ["bearings.fixed.rigidity", "installation.bearing_rigidity"],
      draw: (found) => bearing(FIRST, endsOf(found) !== OF_ENDS.supportedFirst),
    },
    { name: "table", paths: ["axis.mass"], draw: () => [box(NUT - 75, RAIL - 136, 150, 24)] },
    { name: "load", paths: ["operation.axial_load"], draw: (found) => process(found) },
    {
      name: "ends",
      paths: ["installation.ends"],
      draw: (found) => (endsOf(found) === OF_ENDS.free ? [] : bearing(LAST - 40, endsOf(found) === OF_ENDS.fixedLast)),
    },
  ],
  below: [
    { name: "inclination", paths: ["axis.inclination"], draw: (found) => slope(found) },
    {
      name: "mount",
      paths: ["installation.mount_rigidity"],
      draw: () => [box(FIRST - 26, SHAFT + 32, 52, RAIL - SHAFT - 32)],
    },
    {
      name: "shaft",
      paths: ["installation.unsupported_length"],
      draw: () => [box(middle(0) + 35, SHAFT - 7, LAST - 20 - middle(0) - 35, 14), ...thread()],
    },
    {
      name: "nut",
      paths: ["nut.preload"],
      draw: () => [box(NUT - 42, SHAFT - 24, 84, 48), line([NUT, SHAFT - 24], [NUT, SHAFT + 24])],
    },
    {
      name: "guides",
      paths: ["guides.friction_coefficient", "axis.guide_friction_coefficient", "axis.guide_seal_force"],
      draw: () => [
        box(middle(3) - 190, RAIL, 380, 9),
        box(NUT - 70, RAIL - 16, 34, 16),
        box(NUT + 36, RAIL - 16, 34, 16),
        line([NUT - 60, RAIL - 112], [NUT - 60, RAIL - 16]),
        line([NUT + 60, RAIL - 112], [NUT + 60, RAIL - 16]),
      ],
    },
    {
      name: "counterweight",
      paths: ["axis.counterweight"],
      draw: () => [line([NUT + 75, RAIL - 124], [middle(5) + 20, RAIL - 124]), box(middle(5) + 20, RAIL - 136, 30, 24)],
    },
  ],
};

/** The thread of the shaft between its bearings. */
function thread() {
  const places = Array.from({ length: 19 }, (_, place) => FIRST + 36 + place * 16).filter((x) => x < LAST - 66);
  return places.map((x) => line([x, SHAFT - 7], [x + 7, SHAFT + 7]));
}

/** The load as an arrow at the table, in its direction. @param {Found} found */
function process({ inputs }) {
  const load = Number(valueAt(inputs, "operation.axial_load") ?? 1);
  const [from, to] = load < 0 ? [NUT + 85, NUT + 140] : [NUT + 140, NUT + 85];
  const head = to + Math.sign(from - to) * 10;
  const y = RAIL - 104;
  return [
    line([from, y], [head, y]),
    polygon([
      [to, y],
      [head, y - 5],
      [head, y + 5],
    ]),
  ];
}

/** The angle of positive motion above the horizontal. @param {Found} found */
function slope({ inputs }) {
  const angle = Number(valueAt(inputs, "axis.inclination") ?? 0);
  const [x, y, long] = [middle(0) - 40, RAIL + 26, 62];
  const end = /** @type {[number, number]} */ ([x + long * Math.cos(angle), y - long * Math.sin(angle)]);
  return [line([x, y], [x + long, y]), line([x, y], end), shape("circle", { cx: end[0], cy: end[1], r: 3 })];
}

/**
 * A value as people read it: a text with a unit in the units of the page, a number in SI, a name.
 *
 * @param {string} path
 * @param {unknown} value
 */
function inWords(path, value) {
  const node = fieldOf(path);
  const [si, unit] = [node?.["x-si-unit"], node?.["x-unit"] ?? ""];
  if (typeof value === "number") return si ? units.formattedIn(value, unit, si) : units.digits(value);
  const found = si ? units.parse(value, si) : null;
  if (found && si) return units.formattedIn(units.toSI(found.number, found.unit, si), unit, si);
  return String(value);
}

/**
 * The first field of a part that the case gives, with its value; else the last one that a field of the page has.
 *
 * @param {Part} part
 * @param {Tables} tables
 * @param {Tables} inputs
 * @returns {Found}
 */
function lookUp({ paths }, tables, inputs) {
  const given = paths.find((path) => ![undefined, ""].includes(/** @type {any} */ (valueAt(tables, path))));
  const path = given ?? paths.find((one) => !one.startsWith("bearings.") && !one.startsWith("guides.")) ?? paths[0];
  return { path, value: given && inWords(given, valueAt(tables, given)), tables, inputs };
}

/**
 * The sketch of the axis of a case, with a button for each part.
 *
 * @param {Tables} tables the case as it is given
 * @param {Tables} inputs of an answer in SI; empty before there is one
 * @returns {HTMLElement}
 */
export function sketch(tables, inputs) {
  /** @type {SVGElement[]} */
  const drawn = [];
  /** @param {Part} part */
  const made = (part) => {
    const found = lookUp(part, tables, inputs);
    const isGiven = found.value !== undefined;
    const group = shape("g", { class: isGiven ? "part" : "part absent", "data-part": part.name }, ...part.draw(found));
    group.addEventListener("click", () => jump(found.path));
    drawn.push(group);
    const name = PARTS_IN_WORDS[part.name];
    const value = found.value ?? "not given";
    /** @param {boolean} isOn */
    const mark = (isOn) => group.classList.toggle("pointed", isOn);
    return element(
      "button",
      {
        type: "button",
        class: isGiven ? "part-of-axis" : "part-of-axis absent",
        id: `axis-part-${part.name}`,
        "data-part": part.name,
        "data-to": found.path,
        title: labelIn(found.path),
        onclick: () => jump(found.path),
        onfocus: () => mark(true),
        onblur: () => mark(false),
        onpointerenter: () => mark(true),
        onpointerleave: () => mark(false),
      },
      element("span", {}, name),
      element("strong", {}, value),
    );
  };
  const above = PARTS.above.map(made);
  const below = PARTS.below.map(made);
  const picture = shape(
    "svg",
    {
      viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
      role: "img",
      "aria-label":
        "Sketch of the axis from left to right: motor, coupling, fixed bearing, screw with nut and table on its guides, support bearing. The buttons above and below it are its parts.",
    },
    // the shaft runs through the others
    ...drawn.toSorted((one, other) => Number(other.dataset.part === "shaft") - Number(one.dataset.part === "shaft")),
  );
  return element(
    "figure",
    { class: "axis-sketch" },
    element("figcaption", {}, "the axis, not to scale: a part leads to its input; what the case lacks is dashed"),
    element("div", { class: "parts-of-axis" }, ...above),
    picture,
    element("div", { class: "parts-of-axis" }, ...below),
  );
}
