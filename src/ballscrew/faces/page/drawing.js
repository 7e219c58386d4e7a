// The drawing of the ball: beside each other where there is room, one below the other on a phone.

import { byId, NARROW } from "./dom.js";

/** Room before the title of the second half. */
const MARGIN = 6;

/** @param {DrawingAnswer} drawing */
export function show(drawing) {
  const found = new DOMParser().parseFromString(drawing.text, "image/svg+xml").documentElement;
  if (found.nodeName !== "svg") return;
  const whole = /** @type {SVGSVGElement} */ (/** @type {unknown} */ (document.importNode(found, true)));
  byId("drawing").replaceChildren(...(NARROW.matches ? halves(whole) : [whole]));
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
