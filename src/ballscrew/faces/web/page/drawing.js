// The drawing of the ball: beside each other where there is room, one below the other on a phone.

import { byId } from "./dom.js";
import { said } from "./messages.js";

/** Matches a window that is too narrow for both halves beside each other: another one needs the drawing anew. */
export const NARROW = matchMedia("(max-width: 46rem)");
/** From one line of a paragraph to the next, as svg.py has it. */
const LINE = 17;
/** Room before the title of the second half, and below the last line. */
const MARGIN = 6;

/** @param {DrawingAnswer} drawing */
export function show(drawing) {
  const found = new DOMParser().parseFromString(drawing.text, "image/svg+xml").documentElement;
  if (found.nodeName !== "svg") return;
  const whole = /** @type {SVGSVGElement} */ (/** @type {unknown} */ (document.importNode(found, true)));
  say(whole, drawing.messages);
  byId("drawing").replaceChildren(...(NARROW.matches ? halves(whole) : [whole]));
}

/**
 * Put the messages of a drawing into their places, in the units of the page.
 *
 * @param {SVGSVGElement} whole
 * @param {Message[]} messages
 */
function say(whole, messages) {
  /** @type {NodeListOf<SVGElement>} */
  const places = whole.querySelectorAll("[data-text]");
  for (const place of places) {
    const words = said(messages[Number(place.dataset.text)]);
    if (place.dataset.characters) sayLines(whole, place, lines(words, Number(place.dataset.characters)));
    else place.textContent = words;
  }
}

/**
 * The lines of a paragraph; the drawing grows with them.
 *
 * @param {SVGSVGElement} whole
 * @param {SVGElement} place
 * @param {string[]} words
 */
function sayLines(whole, place, words) {
  const first = /** @type {SVGElement} */ (place.firstElementChild);
  const top = Number(first.getAttribute("y"));
  place.replaceChildren(
    ...words.map((line, row) => {
      const one = /** @type {SVGElement} */ (first.cloneNode());
      one.setAttribute("y", String(top + LINE * row));
      one.textContent = line;
      return one;
    }),
  );
  const { width, height } = whole.viewBox.baseVal;
  const bottom = top + LINE * (words.length - 1) + MARGIN;
  whole.setAttribute("viewBox", `0 0 ${width} ${Math.max(height, bottom)}`);
}

/**
 * A paragraph in lines of so many characters, broken at blanks.
 *
 * @param {string} words
 * @param {number} characters
 */
function lines(words, characters) {
  /** @type {string[]} */
  const found = [];
  for (const word of words.split(" ")) {
    const line = `${found.at(-1) ?? ""} ${word}`.trim();
    if (found.length && line.length <= characters) found[found.length - 1] = line;
    else found.push(word);
  }
  return found;
}

/**
 * Both halves of a drawing as drawings of their own; the second one begins where its title does.
 *
 * @param {SVGSVGElement} whole
 */
function halves(whole) {
  const [, title] = [...whole.querySelectorAll("text")].filter((one) => one.getAttribute("font-weight"));
  const { width, height } = whole.viewBox.baseVal;
  const split = Number(title?.getAttribute("x")) - MARGIN;
  if (!(split > 0)) return [whole];
  const second = /** @type {SVGSVGElement} */ (whole.cloneNode(true));
  whole.setAttribute("viewBox", `0 0 ${split} ${height}`);
  second.setAttribute("viewBox", `${split} 0 ${width - split} ${height}`);
  second.setAttribute("aria-hidden", "true"); // the first one says both in words
  return [whole, second];
}
