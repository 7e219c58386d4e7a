// The ball between its grooves in the section across the path: the module knows the places, here they are drawn.

import * as units from "./units.js";

/** @typedef {Record<string, number>} Places */

const FLANKS = ["loaded", "other"];
const [WIDTH, HEIGHT] = [600, 344];
/** Of the height of the picture: the radius of the ball, how far the bodies reach beyond it, and how wide they are. */
const BALL = 0.3;
const BODY = 0.16;
const BREADTH = 0.465;
const DOT = 3;

/**
 * The places of the most loaded ball and its grooves, in metres from its middle.
 *
 * @param {import("./engine.js").Engine} engine
 * @param {Record<string, any>} contents
 * @param {{ structure: string, inputs: Record<string, any>, outputs: Record<string, any> }} point
 * @returns {Places}
 */
export function ballAt(engine, { judging }, { structure, inputs, outputs }) {
  const isRow = structure.endsWith("/row");
  const places = engine.judge(judging.drawing[isRow ? "row" : "nut"], { ...inputs, ...outputs });
  return Object.fromEntries(Object.entries(places).map(([name, [value]]) => [name, value]));
}

/**
 * The drawing as SVG: the section to scale, how far the grooves reach is assumed.
 *
 * @param {Places} places
 */
export function ballDrawing(places) {
  const scale = (BALL * HEIGHT) / places.ball_radius;
  const [middleX, middleY] = [WIDTH / 2, HEIGHT / 2];
  const y = (/** @type {number} */ metres) => middleY - scale * metres;
  /** @param {string} name @returns {[number, number]} */
  const at = (name) => [middleX + scale * places[`${name}.x`], y(places[`${name}.y`])];
  const half = BREADTH * HEIGHT;
  const touched = FLANKS.filter((flank) => places[`${flank}.touches`] === 1);
  const loads = touched.map((flank) => places[`${flank}.load`]);
  const angles = touched.map((flank) => units.formattedIn(places[`${flank}.angle`], "deg", "rad"));
  const bodies = ["nut", "screw"].map((body) => {
    const isNut = body === "nut";
    const outer = isNut ? middleY - (BALL + BODY) * HEIGHT : middleY + (BALL + BODY) * HEIGHT;
    const [left, right] = isNut ? ["other", "loaded"] : ["loaded", "other"];
    const land = y(isNut ? places.land : -places.land);
    const sweep = isNut ? 1 : 0;
    const arc = (/** @type {string} */ flank, /** @type {string} */ end) => {
      const radius = scale * places[`${body}.${flank}.radius`];
      return `A ${radius} ${radius} 0 0 ${sweep} ${at(`${body}.${flank}.${end}`).join(" ")}`;
    };
    const [edge, bottom] = [at(`${body}.${left}.edge`), at(`${body}.${right}.bottom`)].map((place) => place.join(" "));
    const groove = `L ${edge} ${arc(left, "bottom")} L ${bottom} ${arc(right, "edge")} L ${middleX + half} ${land}`;
    const line = `M ${middleX - half} ${land} ${groove}`;
    return `<path d="${line} L ${middleX + half} ${outer} L ${middleX - half} ${outer} Z" fill="currentColor" fill-opacity="0.12"/>
<path d="${line}" fill="none" stroke="currentColor" stroke-width="1.6"/>
<text x="${middleX - half + 6}" y="${isNut ? outer + 14 : outer - 6}" fill="currentColor">${body}</text>`;
  });
  const contacts = touched.map((flank) => {
    const [nut, screw] = ["nut", "screw"].map((body) => at(`${body}.${flank}.contact`));
    const line = `<path d="M ${nut.join(" ")} L ${screw.join(" ")}" stroke="currentColor" stroke-dasharray="9 3 2 3"/>`;
    const widths = ["nut", "screw"]
      .filter((body) => Number.isFinite(places[`${body}.${flank}.from.x`]))
      .map((body) => {
        const name = `${body}.${flank}`;
        const radius = scale * places[`${name}.radius`];
        const [from, to] = [at(`${name}.from`), at(`${name}.to`)].map((place) => place.join(" "));
        return `<path d="M ${from} A ${radius} ${radius} 0 0 ${flank === "loaded" ? 1 : 0} ${to}" fill="none" stroke="#c8552b" stroke-width="5"/>`;
      });
    const dots = [nut, screw].map(([cx, cy]) => `<circle cx="${cx}" cy="${cy}" r="${DOT}" fill="currentColor"/>`);
    return [line, ...(places[`${flank}.load`] > 0 ? widths : []), ...dots].join("\n");
  });
  const force = loads.map((load) => units.formattedIn(load, "N", "N")).join(", ");
  const lines = loads.some((load) => load > 0)
    ? [`contact angle ${angles.join(", ")}`, `load of the ball ${force}`]
    : ["no load on the ball"];
  const words = lines.map(
    (line, place) => `<text x="${middleX + half + 8}" y="${middleY + 16 * place}" fill="currentColor">${line}</text>`,
  );
  // the angle stands in the ball where it has one
  const inside =
    angles.length === 1
      ? `<text x="${middleX}" y="${middleY + 0.72 * BALL * HEIGHT}" text-anchor="middle" fill="currentColor">α ${angles[0]}</text>`
      : "";
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" font-family="system-ui, sans-serif" font-size="12">
<title>The ball between its grooves: ${lines.join(", ")}</title>
${bodies.join("\n")}
<circle cx="${middleX}" cy="${middleY}" r="${scale * places.ball_radius}" fill="none" stroke="currentColor" stroke-width="1.4"/>
${contacts.join("\n")}
${inside}
${words.join("\n")}
</svg>`;
}
