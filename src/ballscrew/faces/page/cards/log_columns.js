// The columns of a log: what each was taken for, changed by a menu, and the numbers that are fitted to it.

import { box, framed, labelled, menu, opened } from "../controls.js";
import { element, scrollingTable } from "../dom.js";
import { withPlace } from "../messages.js";
import { COLUMNS } from "../names.js";
import * as units from "../units.js";

/** Numbers of a fit in words. @type {Record<string, string>} */
const NUMBERS = {
  boundary_friction_coefficient: "boundary friction coefficient",
  constant_torque: "constant torque (seals, bearings)",
  preload: "preload",
  torque_drift: "drift of the torque sensor",
  torque_offset: "zero error of the torque sensor",
};

/** Numbers to fit that are shown at once. */
const FIRST = 2;

/**
 * The columns of a log with a menu each; ``given`` are those that were chosen by hand, by name.
 *
 * @param {LogAnswer} found
 * @param {Record<string, string>} given
 * @param {(given: Record<string, string>) => void} change
 */
export function columns(found, given, change) {
  const names = found.known.map(({ name }) => name);
  const rows = found.columns.map((one, place) => [
    one.heading || "–",
    meaning(one, place),
    unitField(one, place),
    one.cells.join("; "),
  ]);
  /** @param {LogAnswer["columns"][number]} one @param {number} place */
  function meaning(one, place) {
    /** @type {[string, string][]} */
    const options = [
      ["", "not used, or as its heading says"],
      ...names.map((name) => /** @type {[string, string]} */ ([name, nameOf(name)])),
    ];
    const label = `${one.heading}: taken for`;
    const take = (/** @type {string} */ name) => choose(one, name, one.unit);
    return menu(options, one.taken_for, take, { id: `log-column-${place}`, "aria-label": label });
  }
  /** @param {LogAnswer["columns"][number]} one @param {number} place */
  function unitField(one, place) {
    const input = element("input", {
      type: "text",
      size: "8",
      id: `log-unit-${place}`,
      value: one.unit,
      disabled: !one.taken_for,
      "aria-label": `${one.heading}: unit`,
    });
    input.addEventListener("change", () => choose(one, one.taken_for, input.value));
    return input;
  }
  /** @param {LogAnswer["columns"][number]} one @param {string} name @param {string} unit */
  function choose(one, name, unit) {
    const others = Object.entries(given).filter(([other]) => other !== name && other !== one.taken_for);
    const known = found.known.find((each) => each.name === name);
    const written = `${one.bare_heading} [${unit || known?.shown_in}]`;
    change({ ...Object.fromEntries(others), ...(name && { [name]: written }) });
  }
  const caption = `columns of ${found.file}`;
  const headings = ["heading", "taken for", "unit", "first cells"];
  const content = scrollingTable(caption, headings, rows);
  content.firstElementChild?.classList.add("columns-of-log");
  const faults = found.faults.map((fault) => element("p", { class: "fault" }, withPlace(fault)));
  return element("div", {}, content, ...(found.moving ? [movingNote()] : faults), constants());

  /** Values that count in every row, for columns that the log lacks. */
  function constants() {
    const wanted = found.moving ? [] : [...new Set([...found.missing, ...Object.keys(found.constants)])];
    const fields = wanted
      .filter((name) => name !== "torque")
      .map((name) => {
        const known = found.known.find((one) => one.name === name);
        const input = element("input", {
          type: "text",
          id: `log-constant-${name}`,
          value: given[name] ?? "",
          placeholder: `0 ${known?.shown_in ?? ""}`,
        });
        input.addEventListener("change", () => {
          const others = Object.fromEntries(Object.entries(given).filter(([other]) => other !== name));
          change(input.value.trim() ? { ...others, [name]: input.value.trim() } : others);
        });
        return labelled(input, `${nameOf(name)}, the same in every row`);
      });
    return element("div", {}, ...fields);
  }
}

function movingNote() {
  return element(
    "p",
    { class: "warning" },
    "This is a log of a moving axis (positions over time). Its fit is on the command line: ballscrew fit.",
  );
}

/** @param {string} name */
export function nameOf(name) {
  return COLUMNS[name] ?? name.replaceAll("_", " ");
}

/**
 * Boxes for the numbers that may be fitted; the rare ones behind "more".
 *
 * @param {LogAnswer["free"]} free
 * @param {string[]} chosen
 * @param {(chosen: string[]) => void} change
 */
export function choices(free, chosen, change) {
  const boxes = free.map((one, place) => {
    const take = (/** @type {boolean} */ isChecked) => {
      const kept = free.filter(({ name }) => (name === one.name ? isChecked : chosen.includes(name)));
      change(kept.map(({ name }) => name));
    };
    const value = one.value === null ? "" : ` (${units.formattedIn(one.value, one.shown_in, one.unit)})`;
    const words = `${meaningOf(one.name, free)}${value}`;
    return box(words, chosen.includes(one.name), take, { id: `free-${place}` });
  });
  const more = opened("more numbers", ...lined(boxes.slice(FIRST)));
  more.open = free.slice(FIRST).some(({ name }) => chosen.includes(name));
  return framed("What is fitted", ...lined(boxes.slice(0, FIRST)), more);
}

/** @param {HTMLElement[]} boxes */
function lined(boxes) {
  return boxes.map((box) => element("p", { class: "card-start" }, box));
}

/**
 * What a number that may be fitted is, in words.
 *
 * @param {string} name
 * @param {LogAnswer["free"]} free
 */
function meaningOf(name, free) {
  const last = name.split(".").at(-1) ?? name;
  const known = free.find((one) => one.name === name);
  return NUMBERS[last] ?? known?.meaning ?? last.replaceAll("_", " ");
}
