// Sentences of answers, as the page says them.

import { labelOf } from "./messages.js";
import { fieldOf } from "./schema.js";

/** Fields as a case file has them: by their path, or written out with a value. */
const PATH = /\b[a-z]+(?:\.[a-z_]+)+\b/g;
const ENTRY = /\[([a-z]+)\] ([a-z_]+) = "([^"]*)"/g;
const POWERS = { 2: "²", 3: "³" };

/** Words with the labels of fields in place of their keys, and with the powers of units raised. @param {string} words */
export function asRead(words) {
  return words
    .replace(ENTRY, (_, section, field, value) => `${labelOf(`${section}.${field}`)} ${value}`)
    .replace(PATH, (path) => (fieldOf(path) ? labelOf(path) : path))
    .replace(/(?<=[a-z])\^([23])/g, (_, power) => POWERS[/** @type {2 | 3} */ (power)]);
}

/** A sentence with its capital letter and its full stop. @param {string} words */
export function sentence(words) {
  const line = asRead(words.trim());
  const isWord = /^[a-z]+(?=[\s,:;–]|$)/.test(line); // the name of a file stays as it is
  return `${isWord ? line.charAt(0).toUpperCase() : line.charAt(0)}${line.slice(1)}${/[.:]$/.test(line) ? "" : "."}`;
}
