// Candidates for a need: the ranked list with filters, and the picture of the Pareto front.

import * as designs from "../designs.js";
import { box, button, menu, textField } from "../controls.js";
import { element, redraw, scrollingTable } from "../dom.js";
import { draw } from "../chart_place.js";
import { LETTERS } from "../state.js";
import { store } from "../store.js";
import { nameOfCheck } from "../names.js";
import * as units from "../units.js";

/** Objectives in words. @type {Record<string, string>} */
const IN_WORDS = {
  brake: "brake holds",
  drive_torque: "drive torque",
  inertia: "inertia",
  life: "life",
  loss: "loss",
  motor_peak: "motor, largest torque",
  motor_rms: "motor, RMS torque",
  preload_torque: "drag torque",
  price_index: "price index",
  reflected_mass: "mass of the inertia",
  rigidity: "rigidity",
};
/** Fields by which candidates are chosen. @type {Record<string, string>} */
const FIELDS_IN_WORDS = {
  diameter: "diameter",
  lead: "lead",
  nut: "nut",
  words: "words of maker, row or oil",
};

/** Candidates in the list before more are asked for. */
const FIRST = 25;
const DIGITS_OF_SHARE = 3;
/** Display units, by SI unit. @type {Record<string, string>} */
const SHOWN_IN = {
  "kg m^2": "kg cm^2",
  s: "h",
  "N/m": "N/um",
  N: "kN",
  Pa: "MPa",
  "rad/s": "rpm",
  "m rad/s": "mm rpm",
};
/** Objectives of the list and of the picture, with their SI units. @type {Record<string, string>} */
const OBJECTIVES = {
  loss: "W",
  inertia: "kg m^2",
  life: "s",
  rigidity: "N/m",
  drive_torque: "N m",
  preload_torque: "N m",
  reflected_mass: "kg",
  price_index: "1",
  motor_peak: "N m",
  motor_rms: "N m",
  brake: "N m",
};
/** Where a candidate with a motion has its torques. @type {Record<string, ["motor_torque" | "brake", string]>} */
const OF_MOTION = {
  motor_peak: ["motor_torque", "torque_peak"],
  motor_rms: ["motor_torque", "torque_rms"],
  brake: ["brake", "holding_torque"],
};
const IN_LIST = ["loss", "inertia", "life", "rigidity", "drive_torque", ...Object.keys(OF_MOTION), "price_index"];
/** Objectives that are better when larger: their column begins with the largest. */
const LARGER = ["life", "rigidity"];

/** @typedef {Select["candidates"][number]} Candidate */

/** @param {string} name */
export function objective(name) {
  return IN_WORDS[name] ?? name.replaceAll("_", " ");
}

/** @param {string} name */
function unitOf(name) {
  const si = OBJECTIVES[name];
  return si === "1" ? "" : units.inSystem(SHOWN_IN[si] ?? si);
}

/**
 * A number of a candidate in SI.
 *
 * @param {Candidate} candidate
 * @param {string} name
 * @returns {number | null | undefined}
 */
function valueIn(candidate, name) {
  const [section, key] = OF_MOTION[name] ?? ["objectives", name];
  return /** @type {any} */ (candidate)[section]?.[key];
}

/**
 * A number of a candidate in the unit in which it is shown; none where it is not known or without end.
 *
 * @param {Candidate} candidate
 * @param {string} name
 */
function numberOf(candidate, name) {
  const value = valueIn(candidate, name);
  return value === null || value === undefined ? null : units.fromSI(value, unitOf(name), OBJECTIVES[name]);
}

/** @param {string} name */
function heading(name) {
  const unit = unitOf(name);
  return unit ? `${objective(name)} (${units.symbol(unit)})` : objective(name);
}

/** @typedef {{ label: string, fits: boolean, worst: number | null, objectives: Record<string, number | null> }} Row */

/**
 * The candidates that are known by now, before they have ranks: those that fail nothing first, by their loss.
 *
 * @param {HTMLElement} holder
 * @param {Row[]} rows
 */
export function asTheyCome(holder, rows) {
  /** @param {Row} row */
  const key = (row) => (row.fits ? (row.objectives.loss ?? 0) : Number.MAX_VALUE);
  const shown = rows.toSorted((one, other) => key(one) - key(other)).slice(0, FIRST);
  const lines = shown.map((row) => {
    const loss = units.formattedIn(row.objectives.loss, unitOf("loss"), OBJECTIVES.loss);
    return element("li", {}, row.fits ? `${row.label}: ${loss}` : `${row.label}: some check fails`);
  });
  holder.replaceChildren(element("ul", { id: "choose-coming" }, ...lines));
}

/**
 * The list and the picture of an answer.
 *
 * @param {HTMLElement} holder
 * @param {Select} found
 */
export function candidates(holder, found) {
  const { candidates: all } = found;
  const known = Object.keys(OBJECTIVES).filter((name) => all.some((one) => Number.isFinite(numberOf(one, name))));
  const names = found.objectives.map(({ name }) => objective(name));
  const list = element("div", {});
  const words = element("p", { "aria-live": "polite" });
  const chart = element("div", { id: "choose-chart", class: "chart low" });
  let most = FIRST;
  /** The column that sorts, and whether it begins with the largest. */
  let order = { column: "rank", down: false };
  const filter = filters(all, () => show());

  function show() {
    const kept = sorted(all.filter(filter.holds), order);
    const shown = kept.slice(0, most);
    const more = button(`Show all ${kept.length}`, () => {
      most = kept.length;
      show();
    });
    redraw(list, tableOf(shown, known, order, sortBy, say), kept.length > shown.length ? more : "");
    picture(kept, x.value, y.value, found);
  }

  /** @param {string} column */
  function sortBy(column) {
    order = { column, down: order.column === column ? !order.down : LARGER.includes(column) };
    show();
  }

  /** @param {string} line */
  function say(line) {
    words.textContent = line;
  }

  /** @param {string} id @param {string} label @param {string} chosen */
  function axis(id, label, chosen) {
    return menu(
      known.map((name) => [name, objective(name)]),
      chosen,
      show,
      { id, "aria-label": label },
    );
  }

  const x = axis("choose-x", "across", "loss");
  const y = axis("choose-y", "up", known.includes("inertia") ? "inertia" : known[0]);
  holder.replaceChildren(
    element("p", { class: "small" }, [.../** @type {string[]} */ (found.need.assumed), ...found.notes].join("; ")),
    filter.fields,
    words,
    element(
      "p",
      { class: "small" },
      `The list begins with those of which no check fails: within the model's validity before outside, the front before others, then by ${names[0]}; those that fail follow by how much, and last those that their loads alone rule out. The front is what no other such candidate beats in ${names.join(", ")} taken together. A heading sorts by its column.`,
    ),
    list,
    element("p", { class: "filters" }, "across", " ", x, " ", "up", " ", y),
    chart,
  );
  show();
}

/**
 * Fields that leave candidates out of the list and of the picture.
 *
 * @param {Candidate[]} all
 * @param {() => void} follow
 */
function filters(all, follow) {
  const words = textField("", follow, { id: "choose-words" });
  /**
   * @param {string} id
   * @param {(candidate: Candidate) => string} value
   */
  const choice = (id, value) => {
    const values = [...new Set(all.map(value))].sort(
      (one, other) => Number.parseFloat(one) - Number.parseFloat(other) || one.localeCompare(other),
    );
    return menu([["", "any"], ...values.map((one) => /** @type {[string, string]} */ ([one, one]))], "", follow, {
      id,
    });
  };
  /** @param {number | null} length */
  const size = (length) => units.formattedIn(length, "mm", "m");
  const chosen = [
    { key: "diameter", value: (/** @type {Candidate} */ { row }) => size(row.nominal_diameter) },
    { key: "lead", value: (/** @type {Candidate} */ { row }) => size(row.lead) },
    { key: "nut", value: (/** @type {Candidate} */ { nut }) => nut },
  ].map((one) => ({ ...one, select: choice(`choose-${one.key}`, one.value) }));
  let mustHold = false;
  const holding = (/** @type {boolean} */ isChecked) => {
    mustHold = isChecked;
    follow();
  };
  /** @param {string} key @param {Node} field */
  const labelled = (key, field) => element("label", {}, `${FIELDS_IN_WORDS[key] ?? key} `, field);
  const fields = element(
    "div",
    { class: "filters" },
    labelled("words", words),
    ...chosen.map(({ key, select }) => labelled(key, select)),
    box("only those that hold", mustHold, holding, { id: "choose-holding" }),
  );
  /** @param {Candidate} one */
  const holds = (one) =>
    (!mustHold || one.holds) &&
    chosen.every(({ select, value }) => !select.value || value(one) === select.value) &&
    words.value
      .toLowerCase()
      .split(/\s+/)
      .every((word) => `${one.label} ${one.row.source}`.toLowerCase().includes(word));
  return { fields, holds };
}

/**
 * Candidates by a column; what has no number there comes last.
 *
 * @param {Candidate[]} kept
 * @param {{ column: string, down: boolean }} order
 */
function sorted(kept, { column, down }) {
  const sign = down ? -1 : 1;
  if (column === "candidate") return kept.toSorted((one, other) => sign * one.label.localeCompare(other.label));
  /** @param {Candidate} one */
  const value = (one) => {
    if (column === "rank") return one.rank;
    return column === "verdict" ? one.worst : numberOf(one, column);
  };
  return kept.toSorted((one, other) => {
    const [first, second] = [value(one), value(other)];
    if (typeof first === "number" && typeof second === "number") return sign * (first - second);
    return Number(typeof second === "number") - Number(typeof first === "number");
  });
}

/**
 * @param {Candidate[]} shown
 * @param {string[]} known
 * @param {{ column: string, down: boolean }} order
 * @param {(column: string) => void} sortBy
 * @param {(line: string) => void} say
 */
function tableOf(shown, known, order, sortBy, say) {
  const columns = IN_LIST.filter((name) => known.includes(name));
  /** @type {[string, string][]} */
  const headings = [
    ["rank", "rank"],
    ["candidate", "row, nut, preload, oil"],
    ["verdict", "checks"],
    ...columns.map((name) => /** @type {[string, string]} */ ([name, heading(name)])),
  ];
  const sorting = headings.map(([column, words]) =>
    button(words, () => sortBy(column), { class: "sort", id: `choose-sort-${column}`, "data-sort": column }),
  );
  const rows = shown.map((one) => [
    String(one.rank),
    element("span", {}, one.label, one.pareto ? element("em", {}, " front") : null),
    verdictOf(one),
    ...columns.map((name) =>
      element("data", { value: String(valueIn(one, name) ?? "") }, units.digits(numberOf(one, name))),
    ),
    button("Take as design", () => take(one, say), { "aria-label": `Take ${one.label} as design` }),
  ]);
  const found = scrollingTable("candidates, ranked", [...sorting, "what to do"], rows);
  const by = headings.findIndex(([column]) => column === order.column);
  const direction = order.down ? "descending" : "ascending";
  if (by >= 0) found.querySelectorAll("th")[by].setAttribute("aria-sort", direction);
  for (const [place, row] of [...found.querySelectorAll("tr")].slice(1).entries()) {
    row.dataset.rank = String(shown[place].rank);
    for (const cell of [...row.cells].slice(1, 3)) cell.classList.add("words");
  }
  return found;
}

/** @param {number | null | undefined} share */
function multiple(share) {
  return share === null || share === undefined ? "" : ` ${units.digits(share, DIGITS_OF_SHARE)} times the limit`;
}

/**
 * What holds, what fails and by how much; all checks where it is opened.
 *
 * @param {Candidate} candidate
 */
function verdictOf({ fails, checks, holds, valid, complete, starved, rigid_lift_off_load: limit }) {
  const open = checks.filter((check) => check.holds === null).length;
  const failing = fails.map((check) => `${nameOfCheck(check)}${multiple(check.utilisation)}`).join(", ");
  const words = failing
    ? complete
      ? `Fails: ${failing}.`
      : `cannot hold: ${failing}`
    : holds
      ? "holds"
      : "what was judged holds";
  const load = units.formattedIn(limit, "N", "N");
  const lost =
    limit === null ? null : element("strong", { class: "fails" }, ` Preload lost (rigid bodies: above ${load}).`);
  const others = [
    open ? `${open} not judged.` : "",
    valid ? "" : "Outside the model's validity.",
    starved ? "Starved of oil: ranked by the larger torque, in a full bath." : "",
  ];
  const summary = element(
    "summary",
    {},
    element("strong", { class: failing ? "fails" : "" }, words),
    lost,
    ` ${others.join(" ")}`,
  );
  const details = element("details", {}, summary);
  details.addEventListener("toggle", () => {
    if (details.childElementCount > 1) return;
    const lines = checks.map((check) => {
      const { name, unit, value, limit, utilisation } = /** @type {Record<string, any>} */ (check);
      /** @param {number | null} number */
      const shown = (number) => units.formattedIn(number, SHOWN_IN[unit] ?? unit, unit);
      const share = typeof utilisation === "number" ? ` (${units.digits(100 * utilisation, DIGITS_OF_SHARE)} %)` : "";
      const numbers = check.holds === null ? "not judged" : `${shown(value)} / ${shown(limit)}${share}`;
      return element("li", {}, `${nameOfCheck({ name })}: ${numbers}`);
    });
    details.append(element("ul", {}, ...lines));
  });
  return details;
}

/**
 * @param {Candidate} candidate
 * @param {(line: string) => void} say
 */
async function take({ case: sections, label }, say) {
  if (!designs.hasRoom()) {
    say(`The page holds ${LETTERS.length} designs: delete one first.`);
    return;
  }
  designs.add([await designs.ofCase(sections, { name: label })]);
  say(`${label} is design ${LETTERS[store.state.show]}.`);
}

/**
 * All candidates by two numbers: those that hold, those that fail, and the front.
 *
 * @param {Candidate[]} kept
 * @param {string} x
 * @param {string} y
 * @param {Select} found
 */
function picture(kept, x, y, { objectives }) {
  const known = kept.filter((one) => [x, y].every((name) => Number.isFinite(numberOf(one, name))));
  const fits = (/** @type {Candidate} */ one) => !one.fails.length;
  const names = objectives.map(({ name }) => objective(name)).join(", ");
  const groups = [
    { name: "some check fails", style: "crosses", colour: "soft", of: known.filter((one) => !fits(one)) },
    { name: "no check fails", style: "dots", colour: "accent", of: known.filter((one) => fits(one) && !one.pareto) },
    { name: `Pareto front of ${names}`, style: "circles", colour: "second", of: known.filter((one) => one.pareto) },
  ];
  draw("choose-chart", {
    name: "candidates",
    description: `${objective(y)} over ${objective(x)} of all candidates in the list`,
    caption: "candidates, ranked",
    figure: {
      x: { title: heading(x) },
      y: { title: heading(y) },
      marks: groups.map(({ name, style, colour, of }) => ({
        kind: "curve",
        name,
        x: of.map((one) => numberOf(one, x)),
        y: of.map((one) => numberOf(one, y)),
        colour,
        style,
        size: 8,
        words: of.map((one) => `${one.label}: ${units.digits(numberOf(one, y))}`),
      })),
    },
    numbers: () => [
      ["row, nut, preload, oil", heading(x), heading(y), "Pareto front", "holds"],
      known.map((one) => [one.label, numberOf(one, x), numberOf(one, y), one.pareto, one.holds]),
    ],
  });
}
