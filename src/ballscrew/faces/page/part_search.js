// The search over screws: by a size, by a part of a name, or by an order code of a maker.

/** What is searched of a screw: nominal diameter, lead and ball in mm among it. @typedef {{ source: string, kind: string, sizes: number[] }} Searched */

/** Sizes as they are written, diameter x lead with perhaps the ball: 40x10, x10, 40x10x6. */
const SIZES = /^(\d+(?:\.\d+)?)?x(\d+(?:\.\d+)?)?(?:x(\d+(?:\.\d+)?))?$/;
/** Order codes with diameter and lead in them: BNF4010-5, R40-10K5-FSC; and those of a maker without. */
const CODES = [/^[a-z]+(\d{2})(\d{2})(?:-|$)/, /^r?(\d{2,3})-(\d{1,2})[a-z]/];
const CODE_WITHOUT_SIZE = /^r15\d\d/;

/**
 * The screws that some words are about: sizes, parts of names and sources, or an order code, which is that of no row.
 *
 * @param {string} text
 * @param {Record<string, Searched>} screws
 * @returns {{ names: string[], isCode: boolean }}
 */
export function screwsFor(text, screws) {
  const words = text
    .toLowerCase()
    .trim()
    .replace(/(?<=\d)\s*[x×*]\s*(?=\d)/g, "x")
    .replace("×", "x");
  const names = (/** @type {string[]} */ asked) =>
    Object.keys(screws).filter((name) => asked.every((word) => isAbout(name, screws[name], word)));
  const found = words ? names(words.split(/\s+/)) : [];
  if (found.length) return { names: found, isCode: false };
  const [, diameter, lead] = CODES.map((code) => code.exec(words)).find((match) => match) ?? [];
  if (diameter) return { names: names([`${Number(diameter)}x${Number(lead)}`]), isCode: true };
  return { names: CODE_WITHOUT_SIZE.test(words) ? names(["rexroth"]) : [], isCode: CODE_WITHOUT_SIZE.test(words) };
}

/** @param {string} name @param {Searched} screw @param {string} word */
function isAbout(name, { source, kind, sizes }, word) {
  const [isSize, ...asked] = SIZES.exec(word) ?? [];
  if (isSize && word !== "x") return asked.every((one, place) => one === undefined || Number(one) === sizes[place]);
  return `${name} ${source} ${kind}`.toLowerCase().includes(word);
}
