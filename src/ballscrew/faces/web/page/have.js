// The first view: what somebody has, be it a part number, a need, a log or a file.

import { namedButton } from "./controls.js";
import * as designs from "./designs.js";
import { byId, element } from "./dom.js";
import { rowLabel } from "./form.js";
import { text } from "./texts.js";
import * as views from "./views.js";
import { vocabulary } from "./vocabulary.js";

/** Rows that are listed at most. */
const MOST_ROWS = 6;

/** @typedef {Vocabulary["rows"][number]} Row */

/**
 * Test whether all words stand somewhere in a row, in any order: its name, its source or its kind of nut.
 *
 * @param {Row} row
 * @param {string[]} words
 */
function has({ name, source, nut }, words) {
  const all = `${name} ${source} ${nut}`.toLowerCase();
  return words.every((word) => all.includes(word));
}

/**
 * One thing that somebody may have: a title, and what is done with it.
 *
 * @param {string} title
 * @param {(Node | string)[]} rest
 */
function tile(title, ...rest) {
  const found = element("div", { class: "tile" }, element("h3", {}, title), ...rest);
  found.classList.toggle("short", rest.length === 1 && rest[0] instanceof HTMLButtonElement);
  return found;
}

/** The search over all rows of the catalogue. @returns {Node[]} */
function partNumber() {
  const found = element("ul", { class: "found" });
  const count = element("p", { class: "small", id: "have-count", role: "status" });
  const input = element("input", {
    type: "search",
    id: "have-part",
    autocomplete: "off",
    "aria-describedby": "have-hint",
    oninput: () => show(),
  });

  /** @param {Row} row */
  const item = (row) =>
    element(
      "li",
      {},
      element(
        "button",
        { type: "button", "data-row": row.name, onclick: () => designs.startFrom(row.name) },
        rowLabel(row),
      ),
      element("span", { class: "small" }, row.source),
    );

  function show() {
    const typed = input.value.trim().toLowerCase();
    const words = typed.split(/\s+/).filter(Boolean);
    const all = vocabulary.rows;
    const matching = words.length ? all.filter((row) => has(row, words)) : [];
    found.replaceChildren(...matching.slice(0, MOST_ROWS).map(item));
    const isNone = words.length > 0 && !matching.length;
    count.textContent = isNone
      ? text("have.part.none", { words: input.value.trim() })
      : text("have.part.found", { count: words.length ? matching.length : all.length, total: all.length });
  }

  show();
  return [
    element("label", { for: "have-part", class: "hidden" }, text("have.part.label")),
    input,
    element("p", { class: "small", id: "have-hint" }, text("have.part.hint")),
    count,
    found,
  ];
}

/** Cases to start from. @returns {Node[]} */
function examples() {
  return Object.entries(vocabulary.starts).map(([name, { title }]) =>
    element("button", { type: "button", "data-start": name, onclick: () => designs.startFrom(name) }, title),
  );
}

/** Build the view: it stays as it is, whatever is chosen in it. */
export function setUp() {
  byId("have").replaceChildren(
    element("h2", {}, text("have.heading")),
    tile(text("have.part"), ...partNumber()),
    tile(
      text("have.own"),
      namedButton("have-own", "have.own.do", () => views.go("start.own")),
    ),
    tile(
      text("have.need"),
      namedButton("have-need", "have.need.do", () => views.go("choose")),
    ),
    tile(
      text("have.log"),
      namedButton("have-log", "have.log.do", () => views.go("measure")),
    ),
    tile(
      text("have.file"),
      namedButton("have-file", "have.file.do", () => byId("open").click()),
    ),
    tile(text("have.example"), element("p", { class: "examples" }, ...examples())),
  );
  byId("have-torque").addEventListener("click", () => views.go("torque"));
}
