// Sheets: what people see of an answer, block by block in the order of reading. No question is known here: a sheet has its
// numbers in SI with their units, and they are shown in those of the page.

import { jump } from "./cards.js";
import { button, opened } from "./controls.js";
import { csv, element, scrollingTable } from "./dom.js";
import { between } from "./figure_words.js";
import { save } from "./saving.js";
import { draw, slug } from "./sheet_charts.js";
import { sentence } from "./sentence.js";
import * as units from "./units.js";

/** @typedef {import("./units.js").Quantity} Quantity */
/**
 * A cell: a text, a number, a share, or nothing that is known.
 *
 * @typedef {string | null | Quantity & { value: number | null, digits: number, toward?: number, infinite?: boolean, band?: Ends } | { share: number | null, bar: boolean, is_change: boolean, band?: Ends }} Cell
 */
/** @typedef {[number | null, number | null]} Ends */
/** @typedef {{ text: string, kind: "plain" | "verdict" | "warning" | "small", name: string, is_bad: boolean }} Line */
/** @typedef {{ name: string, title: string, columns: string[], rows: Cell[][], notes: string[], fields: string[] }} Table */
/** @typedef {{ name: string, values: (number | string | null)[], quantity: Quantity | null }} Column */
/** @typedef {{ kind: string } & Record<string, any>} Block */
/** @typedef {{ title: string, blocks: Block[] }} Sheet */
/** A control beside a row of a table, by their name and place. @typedef {(table: string, row: number) => HTMLElement | undefined} Beside */

/** Kinds of blocks that are charts. */
const CHARTS = ["chart", "bars", "map"];
/** Columns of a table that leaves room for another one beside it. */
const NARROW = 3;
/** Classes of lines, by their kinds. */
const CLASSES = { plain: "", verdict: "verdict", warning: "warning", small: "small" };

/**
 * Places for sheets: the ``head`` has the title and the verdicts, which stand above the form of the question, the ``place``
 * the rest. ``show`` shows one, and shows it again in other units. Charts keep their places from one sheet to the next.
 *
 * @param {string} id begins the ids of its charts
 * @param {Beside} [beside]
 */
export function sheetPlace(id, beside = () => undefined) {
  /** Charts with their titles, by the ids of their places. @type {Map<string, HTMLElement>} */
  let figures = new Map();
  const head = element("div", { class: "sheet-head", id: `${id}-head` });
  const place = element("div", { class: "sheet", id: `${id}-sheet` });

  /** @param {string} name @param {Block} block */
  function figureOf(name, block) {
    const chart = element("div", { id: name, class: "chart low", hidden: true });
    const width = block.kind === "bars" ? "whole-width" : "half";
    return element("figure", { class: width }, element("figcaption", {}, block.title), chart);
  }

  /** @param {Sheet} sheet */
  function show({ title, blocks }) {
    const before = figures;
    figures = new Map();
    /** @type {[string, Block][]} */
    const charts = [];
    const verdicts = blocks.filter(isOfVerdicts);
    const others = blocks.filter((block) => !isOfVerdicts(block));
    const contents = others.flatMap((block) => {
      if (!CHARTS.includes(block.kind)) return contentOf(block, beside);
      const first = `${id}-chart-${slug(block.title)}`;
      const name = figures.has(first) ? `${first}-${charts.length}` : first; // two of one title
      const figure = before.get(name) ?? figureOf(name, block);
      figures.set(name, figure);
      charts.push([name, block]);
      return figure;
    });
    head.replaceChildren(element("h3", {}, sentence(title)), ...verdicts.flatMap(({ lines }) => lines.map(lineOf)));
    place.replaceChildren(...contents);
    for (const [name, block] of charts) draw(name, block);
  }

  return { head, place, show };
}

/** Test whether a block is the verdicts of a sheet. @param {Block} block */
function isOfVerdicts({ kind, lines }) {
  return kind === "lines" && lines.some((/** @type {Line} */ line) => line.kind === "verdict");
}

/** What is shown of a block that is no chart. @param {Block} block @param {Beside} beside @returns {HTMLElement[]} */
function contentOf(block, beside) {
  switch (block.kind) {
    case "lines": {
      const lines = block.lines.map(lineOf);
      return [block.detail ? opened("Details", ...lines) : element("div", {}, ...lines)];
    }
    case "table":
      return [tableOf(/** @type {any} */ (block), beside)];
    default:
      return [columnsOf(block.name, block.columns)];
  }
}

/** @param {Line} line */
function lineOf({ text: words, kind, name, is_bad: isBad }) {
  const shown = sentence(words);
  if (kind !== "warning") return element("p", { class: `${CLASSES[kind]}${isBad ? " careful" : ""}` }, shown);
  return element("p", { class: "warning", "data-record": name }, element("strong", {}, "Beware: "), shown);
}

/** @param {Table} table @param {Beside} beside */
function tableOf({ name, title, columns, rows, notes, fields }, beside) {
  const controls = rows.map((_, row) => beside(name, row));
  const hasControls = controls.some(Boolean);
  const contents = rows.map((cells, row) => {
    const isHeading = cells.slice(1).every((cell) => cell === "");
    const shown = cells.map((cell, column) => {
      if (column) return cellOf(cell);
      const path = fields[row];
      if (path) return element("button", { type: "button", class: "sort", onclick: () => jump(path) }, cellOf(cell));
      return isHeading ? element("strong", {}, cellOf(cell)) : cellOf(cell);
    });
    return hasControls ? [...shown, controls[row]] : shown;
  });
  const below = notes.map((one) => element("p", { class: "small" }, sentence(one)));
  const width = columns.length > NARROW ? "" : "half";
  const headings = hasControls ? [...columns, "what to do"] : columns;
  const content = scrollingTable(title, headings, contents);
  const isText = columns.map((_, column) => rows.every((cells) => typeof cells[column] === "string" || !cells[column]));
  for (const row of content.querySelectorAll("tr")) {
    for (const [column, cell] of [...row.children].entries()) cell.classList.toggle("words", isText[column] ?? false);
  }
  return element("div", { class: width }, content, ...below);
}

/** A cell as people read it; a number as it is for programs. @param {Cell} cell */
function cellOf(cell) {
  if (cell === null) return "–";
  if (typeof cell === "string") return cell;
  if ("share" in cell) return shareOf(cell);
  const { value, digits, band, toward = 0, infinite = false } = cell;
  const number = infinite ? "infinite" : units.withPowers(units.digits(units.converted(value, cell), digits, toward));
  const words = value === null ? number : `${number}\u00a0${units.symbolOf(cell)}`.trim();
  const [low, high] = (band ?? []).map((end) => units.converted(end, cell));
  const ends = isBand(low, high) ? ` (${inBand(low, high, (end, to) => units.digits(end, digits, to))})` : "";
  return element("data", { value: String(value ?? "") }, `${words}${ends}`);
}

/** A share in per cent, as a bar where it is one. @param {{ share: number | null, bar: boolean, is_change: boolean, band?: Ends }} cell */
function shareOf({ share, bar, is_change: isChange, band }) {
  if (share === null) return "–";
  const percent = (/** @type {number} */ one, to = 0) => `${tenths(100 * one, to)}\u00a0%`;
  const [low, high] = band ?? [];
  const ends = isBand(low, high) ? ` (${inBand(low, high, percent)})` : "";
  const sign = isChange && share > 0 ? "+" : "";
  const number = element("data", { value: String(share) }, `${sign}${percent(share)}${ends}`);
  if (!bar) return number;
  const fill = element("span");
  fill.style.setProperty("width", `${100 * Math.min(1, Math.max(0, share))}%`);
  return element("span", { class: "used" }, element("span", { class: "bar", "aria-hidden": "true" }, fill), number);
}

/** A number of per cent to a tenth: to the nearest, or down or up. @param {number} value @param {number} toward */
function tenths(value, toward) {
  const steps = Number((10 * value).toPrecision(12));
  const [down, near, up] = [Math.floor(steps), Math.round(steps), Math.ceil(steps)];
  return ((toward < 0 ? down : toward > 0 ? up : near) / 10).toFixed(1);
}

/** @param {number | null | undefined} low @param {number | null | undefined} high @returns {high is number} */
function isBand(low, high) {
  return typeof low === "number" && typeof high === "number" && high > low;
}

/**
 * The ends of a band, rounded outward.
 *
 * @param {number | null | undefined} low
 * @param {number} high
 * @param {(end: number, toward: number) => string} written
 */
function inBand(low, high, written) {
  return between(written(Number(low), -1), written(high, 1));
}

/** A button that saves columns as a table, in the units of the page. @param {string} name @param {Column[]} columns */
function columnsOf(name, columns) {
  const write = () => {
    const headings = columns.map(({ name: words, quantity }) => (quantity ? units.titled(words, quantity) : words));
    const values = columns.map((column) => column.values.map((value) => units.converted(value, column.quantity)));
    const rows = (values[0] ?? []).map((_, row) => values.map((column) => column[row]));
    save(`-${slug(name)}.csv`, new Blob([csv(headings, rows)], { type: "text/csv" }));
  };
  const words = `Save as CSV: ${name}`;
  return element("p", { class: "card-start" }, button(words, write, { "data-columns": name }));
}
