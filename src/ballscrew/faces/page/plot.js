// Charts of the page: their files have the name of the design, their operating point is that of its fields.

import * as places from "./chart_place.js";
import * as point from "./operating_point.js";
import { save } from "./saving.js";

/** @typedef {Omit<places.Chart, "save" | "drag"> & { drag?: point.Handle }} Chart */

/** Draw a chart in its place: at once where that is seen, else when it is. @param {string} id @param {Chart} chart */
export function draw(id, { drag: handle, ...chart }) {
  const drag = handle && {
    place: handle.place,
    moved: (/** @type {[number, number]} */ at) => point.isFollowed(handle, at),
    dropped: (/** @type {[number, number]} */ at) => point.take(handle, at),
    left: point.letGo,
  };
  places.draw(id, { ...chart, save, drag });
}
