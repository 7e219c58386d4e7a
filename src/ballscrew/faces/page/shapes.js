// Shapes of SVG: elements with attributes and children, as dom.js has those of HTML.

/** @typedef {Record<string, string | number | null | undefined>} Attributes */

const NAMESPACE = "http://www.w3.org/2000/svg";

/**
 * A shape with attributes and children; texts are texts, never markup.
 *
 * @template {keyof SVGElementTagNameMap} Name
 * @param {Name} name
 * @param {Attributes} [attributes] an attribute that is null or undefined is left out
 * @param {(SVGElement | string)[]} children
 * @returns {SVGElementTagNameMap[Name]}
 */
export function shape(name, attributes = {}, ...children) {
  const found = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined) continue;
    found.setAttribute(key, typeof value === "number" ? String(Math.round(value * 100) / 100) : value);
  }
  found.append(...children);
  return found;
}

/**
 * A line from one point to another.
 *
 * @param {[number, number]} from
 * @param {[number, number]} to
 * @param {Attributes} [attributes]
 */
export function line([x1, y1], [x2, y2], attributes = {}) {
  return shape("line", { x1, y1, x2, y2, ...attributes });
}

/**
 * A closed polygon.
 *
 * @param {[number, number][]} points
 * @param {Attributes} [attributes]
 */
export function polygon(points, attributes = {}) {
  return shape("polygon", {
    points: points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" "),
    ...attributes,
  });
}

/**
 * An arrow from one point along the x axis to another.
 *
 * @param {number} from
 * @param {number} to
 * @param {number} y
 * @param {string} name of its class
 */
export function arrow(from, to, y, name) {
  const way = Math.sign(to - from);
  const head = HEAD * way;
  return shape(
    "g",
    { class: name },
    line([from, y], [to - head, y]),
    polygon([
      [to, y],
      [to - head, y - HEAD / 2],
      [to - head, y + HEAD / 2],
    ]),
  );
}

/** Length of the head of an arrow, in units of its drawing. */
const HEAD = 11;
