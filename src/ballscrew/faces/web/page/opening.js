// Files that are opened or dropped: cases, projects and needs become designs; a table of screws is kept to choose from.

import * as designs from "./designs.js";
import { linesOf, sendJson } from "./server.js";
import { LETTERS, OF_SCREW } from "./state.js";
import { text } from "./texts.js";

/** Bytes of a file that the server takes, with its third more for the request. */
const MOST_BYTES = 700_000;
/** Names that a notice has at most. */
const MOST_NAMES = 5;

/** @typedef {{ file: { name: string, base64: string }, opened: Opened }} OwnTable */

/** The table of screws that was opened last. @type {OwnTable | undefined} */
let table;
/** The need that was opened last. @type {{ name: string, tables: Record<string, any> } | undefined} */
let need;
/** Told of tables and needs. @type {Set<() => void>} */
const listeners = new Set();

export function ownTable() {
  return table;
}

export function openedNeed() {
  return need;
}

/** @param {() => void} listener */
export function follow(listener) {
  listeners.add(listener);
}

/**
 * The designs in a file, as the server reads it.
 *
 * @param {{ name: string, base64: string }} file
 * @returns {Promise<Opened>}
 */
function read(file) {
  return sendJson("open", { file });
}

/** True of a file that the server takes. @param {File} file */
export function isSmall(file) {
  return file.size <= MOST_BYTES;
}

/** That a file is too large. @param {File} file */
export function tooLarge(file) {
  return text("open.large", { file: file.name, size: Math.round(MOST_BYTES / 1000) });
}

/** A file as a request has it. @param {File} file */
export async function sent(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return { name: file.name, base64: btoa(binary) };
}

/**
 * Open files one after the other.
 *
 * @param {Iterable<File>} files
 * @returns {Promise<string[]>} what is to be said of them
 */
export async function open(files) {
  const lines = [];
  for (const file of files) {
    if (!isSmall(file)) {
      lines.push(tooLarge(file));
      continue;
    }
    try {
      const one = await sent(file);
      lines.push(...(await take(one, await read(one))));
    } catch (error) {
      lines.push(`${file.name}: ${linesOf(error).join("; ")}`);
    }
  }
  return lines;
}

/**
 * @param {{ name: string, base64: string }} file
 * @param {Opened} opened
 */
async function take(file, opened) {
  const { kind, designs: found, comments, notes } = opened;
  const lines = notes.map((note) => `${file.name}: ${note}`);
  if (comments) lines.push(text("open.comments", { file: file.name, count: comments }));
  if (kind === "table" || kind === "need") {
    if (kind === "table") table = { file, opened };
    else need = { name: file.name, tables: found[0].case };
    for (const listener of listeners) listener();
    return [text(kind === "table" ? "open.table" : "open.need", { file: file.name, count: found.length }), ...lines];
  }
  const more = await Promise.all(
    found.map(({ name, case: sections, aside }) =>
      designs.ofCase(sections, {
        name: kind === "project" ? name : undefined,
        file: file.name,
        ...(Object.keys(aside).length && { aside }),
      }),
    ),
  );
  const before = designs.all().designs.length;
  const left = designs.add(more);
  if (left) {
    const none = found.slice(found.length - left).map(({ name }) => name);
    lines.push(text("open.no_room", { names: listed(none), most: LETTERS.length }));
  }
  const { designs: now } = designs.all();
  const letters = LETTERS.slice(now.length > before || left ? now.length - (found.length - left) : 0, now.length);
  if (letters.length) lines.unshift(text("open.done", { file: file.name, letters: letters.join(", ") }));
  const asides = [...new Set(found.flatMap(({ aside }) => Object.keys(aside)))];
  if (asides.length) lines.push(text("open.aside", { names: listed(asides) }));
  return lines;
}

/** @param {string[]} names */
function listed(names) {
  return names.slice(0, MOST_NAMES).join(", ") + (names.length > MOST_NAMES ? ", …" : "");
}

/**
 * A screw of the table as a design, used as the current one is.
 *
 * @param {Opened["designs"][number]} row
 */
export async function takeRow({ name, case: sections }) {
  const use = Object.entries(await designs.currentCase()).filter(([section]) => !OF_SCREW.includes(section));
  const both = { ...sections, ...Object.fromEntries(use) };
  if (sections.losses) both.losses = { ...both.losses, .../** @type {object} */ (sections.losses) };
  const one = await designs.ofCase(both, { name, file: table?.file.name });
  return designs.add([one]) === 0;
}
