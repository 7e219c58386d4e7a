// The pointer over a chart: what it reads, a part that it draws larger, and the operating point that it takes along.

import { readingAt } from "./figure_words.js";

/** @import { Figure, Frame, Ranges } from "./figure.js" */
/** @import { Reading } from "./figure_words.js" */
/**
 * The chart that a pointer is over: what is drawn there, and what it does.
 *
 * @typedef {object} Pointed
 * @property {HTMLElement} plot
 * @property {() => { figure: Figure, frame: Frame, canDrag: boolean } | undefined} drawn
 * @property {(reading: Reading | undefined, x: number, y: number) => void} read
 * @property {(ends: [number, number, number, number] | undefined) => void} select a part, from corner to corner
 * @property {(ranges: Ranges) => void} enlarge
 * @property {(at: [number, number]) => void} drag the operating point, in the values of the axes
 * @property {(isDropped: boolean) => void} drop
 */

/** Pixels around the operating point within which it is taken, and along which a part begins. */
const [REACH, BEGIN] = [22, 8];

/** Let a pointer read a chart, and move what can be moved. @param {Pointed} pointed */
export function follow({ plot, drawn, read, select, enlarge, drag, drop }) {
  /** Where a part begins, or the operating point is held. @type {[number, number] | "point" | undefined} */
  let from;

  /** @param {PointerEvent} event @returns {[number, number]} */
  function placeOf(event) {
    const { left, top } = plot.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  /** @param {[number, number]} place */
  function isNear([x, y]) {
    const there = drawn();
    const point = there?.canDrag && there.figure.marks.find(({ kind }) => kind === "point");
    if (!there || !point || point.kind !== "point") return false;
    return Math.hypot(there.frame.x.pixel(point.x) - x, there.frame.y.pixel(point.y) - y) < REACH;
  }

  /** @param {[number, number]} place */
  function isInside([x, y]) {
    const box = drawn()?.frame.box;
    return Boolean(box && x > box.left && x < box.right && y > box.top && y < box.bottom);
  }

  plot.addEventListener("pointerdown", (event) => {
    const place = placeOf(event);
    const there = drawn();
    if (event.button !== 0 || !there) return;
    if (isNear(place)) from = "point";
    else if (event.pointerType === "touch") {
      read(readingAt(there.figure, there.frame, ...place), ...place);
      return;
    } else if (isInside(place) && !there.figure.y.names) from = place;
    else return;
    read(undefined, 0, 0);
    plot.setPointerCapture(event.pointerId);
    event.preventDefault();
  });

  plot.addEventListener("pointermove", (event) => {
    const place = placeOf(event);
    const there = drawn();
    if (!there) return;
    if (from === "point") drag([there.frame.x.value(place[0]), there.frame.y.value(place[1])]);
    else if (from) select([...from, ...place]);
    else {
      const near = isNear(place);
      plot.classList.toggle("near", near);
      read(near ? undefined : readingAt(there.figure, there.frame, ...place), ...place);
    }
  });

  plot.addEventListener("pointerup", (event) => {
    const [begun, there] = [from, drawn()];
    from = undefined;
    if (begun === "point") drop(true);
    else if (begun && there) {
      select(undefined);
      const [[x, y], [toX, toY]] = [begun, placeOf(event)];
      const along = (/** @type {import("./scale.js").Scale} */ scale, /** @type {number[]} */ ends) =>
        /** @type {[number, number]} */ (ends.map((end) => scale.value(end)).sort((one, other) => one - other));
      const ranges = {
        ...(Math.abs(toX - x) > BEGIN && { x: along(there.frame.x, [x, toX]) }),
        ...(Math.abs(toY - y) > BEGIN && { y: along(there.frame.y, [y, toY]) }),
      };
      if (Object.keys(ranges).length) enlarge(ranges);
    }
  });

  plot.addEventListener("pointercancel", () => {
    if (from === "point") drop(false);
    else if (from) select(undefined);
    from = undefined;
  });
  plot.addEventListener("pointerleave", () => read(undefined, 0, 0));
  plot.addEventListener("dblclick", () => enlarge({}));
}
