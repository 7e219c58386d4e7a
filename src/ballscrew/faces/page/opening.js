// Files that are opened or dropped: cases and projects become designs, a need that of the page; a table of screws is kept
// to choose from.

import * as designs from "./designs.js";
import { readNeed } from "./needs.js";
import { sendPatiently } from "./long_work.js";
import { linesOf } from "./server.js";
import { LETTERS, OF_SCREW } from "./state.js";
import { store } from "./store.js";

/** Bytes of a file that the server takes, with its third more for the request. */
export const MOST_BYTES = 700_000;
/** Names that a notice has at most. */
const MOST_NAMES = 5;

/**
 * The designs in a file, as the server reads it.
 *
 * @param {{ name: string, base64: string }} file
 * @returns {Promise<Opened>}
 */
function read(file) {
  return sendPatiently("open", { file });
}

/** That a file is too large for the server; empty where it is not. @param {File} file @param {number} [most] bytes */
export function tooLarge(file, most = MOST_BYTES) {
  if (file.size <= most) return "";
  return `${file.name} is too large: ${Math.round(most / 1000)} kB at most. The command line takes it.`;
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
    const fault = tooLarge(file);
    if (fault) {
      lines.push(fault);
      continue;
    }
    try {
      const one = await sent(file);
      lines.push(...(await take(one, await read(one))));
    } catch (error) {
      const said = linesOf(error).join("; ");
      lines.push(said.startsWith(`${file.name}: `) ? said : `${file.name}: ${said}`); // a fault of a file names it
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
  if (comments)
    lines.push(`${file.name} has ${comments} comments; they stay in that file and are not in those saved here.`);
  if (kind === "table" || kind === "need") {
    if (kind === "table") designs.useTable({ file, opened });
    else designs.setNeed(readNeed(found[0].case));
    return [
      kind === "table"
        ? `${file.name}: ${found.length} screws. Under “Files and designs” each can be taken as a design.`
        : `${file.name} is a need: it stands under “Choose a screw for a need”.`,
      ...lines,
    ];
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
  const before = store.state.designs.length;
  const left = designs.add(more);
  if (left) {
    const none = found.slice(found.length - left).map(({ name }) => name);
    lines.push(`The page holds ${LETTERS.length} designs. There was no place for ${listed(none)}.`);
  }
  const { designs: now } = store.state;
  const letters = LETTERS.slice(now.length > before || left ? now.length - (found.length - left) : 0, now.length);
  if (letters.length) lines.unshift(`${file.name} is open: design ${letters.join(", ")}.`);
  const asides = [...new Set(found.flatMap(({ aside }) => Object.keys(aside)))];
  if (asides.length)
    lines.push(
      `No case has these tables; they are not computed with, and are kept for the next file: ${listed(asides)}.`,
    );
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
  const one = await designs.ofCase(both, { name, file: store.state.table?.file.name });
  return designs.add([one]) === 0;
}
