// The editor of a motion of segments: a table with a row for each, which are added, deleted and moved by keys.

import { button, menu, textField } from "../controls.js";
import { element, scrolling } from "../dom.js";
import * as units from "../units.js";

/** Fields of a segment and what is done with it. @type {Record<string, string>} */
const IN_WORDS = {
  acceleration: "acceleration",
  delete: "delete",
  distance: "distance",
  down: "move down",
  duration: "time",
  force: "force against it",
  speed: "speed",
  temperature: "oil",
  up: "move up",
};
/** Kinds of segments. @type {Record<string, string>} */
const KINDS_IN_WORDS = {
  move: "move",
  rest: "rest",
  stretch: "constant speed",
};

/** @typedef {import("../schema.js").SchemaNode} SchemaNode */
/** @typedef {Record<string, string>} Segment */
/** @typedef {"move" | "stretch" | "rest"} Kind */

/** Fields that each kind of segment has, besides its name. @type {Record<Kind, string[]>} */
const FIELDS = {
  move: ["distance", "speed", "acceleration", "force", "temperature"],
  stretch: ["duration", "speed", "force", "temperature"],
  rest: ["duration", "force", "temperature"],
};
const COLUMNS = ["distance", "duration", "speed", "acceleration", "force", "temperature"];
/** What a new segment has, and one whose kind was changed where it has nothing. @type {Segment} */
const USUAL = { distance: "100 mm", duration: "1 s", speed: "10 m/min" };
/** @type {Record<Kind, string[]>} */
const NEEDED = { move: ["distance", "speed"], stretch: ["duration", "speed"], rest: ["duration"] };

/** @param {Segment} segment @returns {Kind} */
export function kindOf(segment) {
  if (segment.distance !== undefined) return "move";
  return units.parse(segment.speed ?? "0 m/s", "m/s")?.number === 0 ? "rest" : "stretch";
}

/**
 * A segment as one of another kind: what both have stays.
 *
 * @param {Segment} segment
 * @param {Kind} kind
 * @returns {Segment}
 */
export function asKind(segment, kind) {
  const kept = Object.entries(segment).filter(([name]) => name === "name" || FIELDS[kind].includes(name));
  const usual = NEEDED[kind].map((name) => [name, USUAL[name]]);
  return { ...Object.fromEntries(usual), ...Object.fromEntries(kept) };
}

/**
 * The table of segments. Typing does not make it anew, so that each edit begins from what the segments are by then.
 *
 * @param {() => Segment[]} current the segments as they are now
 * @param {Record<string, SchemaNode>} nodes schemas of the fields of a segment
 * @param {(segments: Segment[], edited: { place: number, name: string, isAnew: boolean }) => void} onChange ``isAnew``
 *   where the table has to be made anew, with the focus on this field
 */
export function editor(current, nodes, onChange) {
  const { length } = current();
  /** @param {number} place @param {number} by */
  const move = (place, by) => {
    const to = place + by;
    if (to < 0 || to >= length) return;
    const found = current().toSpliced(place, 1).toSpliced(to, 0, current()[place]);
    onChange(found, { place: to, name: by < 0 ? "up" : "down", isAnew: true });
  };
  const rows = current().map((segment, place) => row(segment, place, { current, nodes, onChange, move }));
  const add = () => {
    onChange([...current(), asKind({}, "rest")], { place: length, name: "name", isAnew: true });
  };
  const headings = ["no.", "order", "name", "kind", ...COLUMNS.map((name) => heading(name, nodes[name]))];
  const content = element(
    "table",
    { class: "segments" },
    element("caption", {}, "segments of the motion, one after the other"),
    element("thead", {}, element("tr", {}, ...headings.map((words) => element("th", { scope: "col" }, words)))),
    element("tbody", {}, ...rows),
  );
  return element(
    "div",
    {},
    scrolling("segments of the motion, one after the other", content),
    button("Add a segment", add, { id: "segment-add" }),
    element("span", { class: "small" }, " Alt with an arrow key up or down moves the segment with the cursor."),
  );
}

/** @param {SchemaNode | undefined} node */
function unitOf(node) {
  return units.inSystem(node?.["x-unit"] ?? "");
}

/** @param {string} name @param {SchemaNode | undefined} node */
function heading(name, node) {
  return `${IN_WORDS[name] ?? name} (${units.symbol(unitOf(node))})`;
}

/**
 * @typedef {object} Table
 * @property {() => Segment[]} current
 * @property {Record<string, SchemaNode>} nodes
 * @property {Parameters<typeof editor>[2]} onChange
 * @property {(place: number, by: number) => void} move
 */

/**
 * @param {Segment} segment
 * @param {number} place
 * @param {Table} all
 */
function row(segment, place, { current, nodes, onChange, move }) {
  const kind = kindOf(segment);
  const title = `segment ${place + 1}`;
  /** @param {Segment} found @param {string} name */
  const put = (found, name, isAnew = false) => onChange(current().with(place, found), { place, name, isAnew });
  /** @param {string} name @param {string} value */
  const set = (name, value) => {
    const { [name]: _, ...others } = current()[place];
    put(value === "" ? others : { ...others, [name]: value }, name);
  };
  /** @param {string} name */
  const named = (name) => ({
    id: idOf(place, name),
    "aria-label": `${title}: ${IN_WORDS[name] ?? name}`,
  });
  const names = textField(segment.name ?? "", (typed) => set("name", typed), named("name"));
  const kinds = menu(
    Object.keys(FIELDS).map((one) => [one, KINDS_IN_WORDS[one] ?? one]),
    kind,
    (chosen) => put(asKind(current()[place], /** @type {Kind} */ (chosen)), "kind", true),
    named("kind"),
  );
  const cells = COLUMNS.map((name) => {
    if (!FIELDS[kind].includes(name)) return element("td", { class: "none" });
    return cell(place, name, nodes[name], segment[name], `${title}: ${heading(name, nodes[name])}`, (value) =>
      set(name, value),
    );
  });
  const remove = () =>
    onChange(current().toSpliced(place, 1), { place: Math.max(0, place - 1), name: "delete", isAnew: true });
  const last = current().length - 1;
  const found = element(
    "tr",
    { "data-path": `motion.segment ${place + 1}` },
    element("th", { scope: "row" }, String(place + 1), element("p", { class: "fault" })),
    element(
      "td",
      { class: "order" },
      button("↑", () => move(place, -1), { ...named("up"), disabled: place === 0 }),
      button("↓", () => move(place, 1), { ...named("down"), disabled: place === last }),
      button("×", remove, { ...named("delete"), disabled: last === 0 }),
    ),
    element("td", {}, names),
    element("td", {}, kinds),
    ...cells,
  );
  found.addEventListener("keydown", (event) => {
    if (!event.altKey || (event.key !== "ArrowUp" && event.key !== "ArrowDown")) return;
    event.preventDefault();
    event.stopPropagation();
    move(place, event.key === "ArrowUp" ? -1 : 1);
  });
  return found;
}

/** @param {number} place @param {string} name */
export function idOf(place, name) {
  return `segment-${place + 1}-${name}`;
}

/**
 * A cell with a number in the unit of its column, or a text with a unit of its own.
 *
 * @param {number} place
 * @param {string} name
 * @param {SchemaNode | undefined} node
 * @param {string | undefined} value
 * @param {string} label
 * @param {(value: string) => void} onInput
 */
function cell(place, name, node, value, label, onInput) {
  const id = idOf(place, name);
  const fault = `${id}-fault`;
  const digits = value === undefined ? "" : units.digitsIn(value, unitOf(node), node?.["x-si-unit"]);
  /** @param {string} shown */
  const read = (shown) => {
    const typed = units.inASCII(shown.trim());
    const isBare = typed !== "" && /^[\s\d.,'eE+±-]*$/.test(typed);
    onInput(isBare ? `${typed} ${unitOf(node)}` : typed);
  };
  const attributes = { inputmode: "decimal", id, "aria-label": label, "aria-describedby": fault };
  const input = textField(digits ?? String(value), read, attributes);
  const path = `motion.segment ${place + 1}.${name}`;
  return element("td", { "data-path": path }, input, element("p", { class: "fault", id: fault }));
}
