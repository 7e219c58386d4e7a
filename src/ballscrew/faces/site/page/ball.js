// The ball between its grooves in the section across the path: the module knows the places, here they are drawn.

/** @typedef {Record<string, number>} Places */

const FLANKS = ["loaded", "other"];
/** Of the height of the picture: the radius of the ball, and how far the bodies reach beyond it. */
const BALL = 0.3;
const BODY = 0.16;
const FONT_OF_WORDS = '12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
const SMALL = 3;

/**
 * The places of the most loaded ball and its grooves, in metres from its middle.
 *
 * @param {import("../../web/page/engine.js").Engine} engine
 * @param {Record<string, any>} contents
 * @param {{ structure: string, inputs: Record<string, any>, outputs: Record<string, any> }} point
 * @returns {Places}
 */
export function ballAt(engine, { judging }, { structure, inputs, outputs }) {
  const isRow = structure.endsWith("/row");
  const found = engine.judge(judging.drawing[isRow ? "row" : "nut"], { ...inputs, ...outputs });
  return Object.fromEntries(Object.entries(found).map(([name, [value]]) => [name, value]));
}

/**
 * Draw the ball and its grooves.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {{ width: number, height: number }} size
 * @param {Places} places
 * @param {{ ink: string, soft: string, body: string, accent: string }} colours
 * @param {{ screw: string, nut: string, angle: string }} words
 */
export function drawBall(pen, { width, height }, places, colours, words) {
  const scale = (BALL * height) / places.ball_radius;
  const middle = { x: width / 2, y: height / 2 };
  const x = (/** @type {number} */ metres) => middle.x + scale * metres;
  const y = (/** @type {number} */ metres) => middle.y - scale * metres;
  const at = (/** @type {string} */ name) => `${x(places[`${name}.x`])} ${y(places[`${name}.y`])}`;
  const half = Math.min(width / 2 - 1, 1.55 * BALL * height);
  pen.clearRect(0, 0, width, height);
  pen.lineJoin = "round";
  for (const body of ["nut", "screw"]) {
    const isNut = body === "nut";
    const outer = isNut ? middle.y - (BALL + BODY) * height : middle.y + (BALL + BODY) * height;
    const flanks = isNut ? ["other", "loaded"] : ["loaded", "other"]; // from left to right
    const [left, right] = flanks.map((flank) => ({
      edge: at(`${body}.${flank}.edge`),
      bottom: at(`${body}.${flank}.bottom`),
      radius: scale * places[`${body}.${flank}.radius`],
    }));
    const land = y(isNut ? places.land : -places.land);
    const sweep = isNut ? 1 : 0;
    const groove = `A ${left.radius} ${left.radius} 0 0 ${sweep} ${left.bottom} L ${right.bottom} A ${right.radius} ${right.radius} 0 0 ${sweep} ${right.edge}`;
    const outline = `M ${middle.x - half} ${outer} L ${middle.x - half} ${land} L ${left.edge} ${groove} L ${middle.x + half} ${land} L ${middle.x + half} ${outer}`;
    pen.fillStyle = colours.body;
    pen.fill(new Path2D(`${outline} Z`));
    pen.strokeStyle = colours.ink;
    pen.lineWidth = 1.6;
    pen.stroke(new Path2D(`M ${middle.x - half} ${land} L ${left.edge} ${groove} L ${middle.x + half} ${land}`));
    pen.fillStyle = colours.soft;
    pen.font = FONT_OF_WORDS;
    pen.textAlign = "left";
    pen.fillText(words[isNut ? "nut" : "screw"], middle.x - half + 6, isNut ? outer + 14 : outer - 6);
  }
  pen.lineWidth = 1.4;
  pen.stroke(new Path2D(circle(middle.x, middle.y, scale * places.ball_radius)));
  for (const flank of FLANKS) {
    if (places[`${flank}.touches`] === 1) contacts(pen, places, flank, { at, scale, colours });
  }
  pen.fillStyle = colours.ink;
  pen.textAlign = "center";
  pen.fillText(words.angle, middle.x, middle.y + 0.72 * BALL * height);
}

/**
 * The line through both contacts of a pair of flanks, and the contacts, as wide as they are.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {Places} places
 * @param {string} flank
 * @param {{ at: (name: string) => string, scale: number, colours: Record<string, string> }} options
 */
function contacts(pen, places, flank, { at, scale, colours }) {
  pen.strokeStyle = colours.soft;
  pen.lineWidth = 1;
  pen.setLineDash([9, 3, 2, 3]);
  pen.stroke(new Path2D(`M ${at(`nut.${flank}.contact`)} L ${at(`screw.${flank}.contact`)}`));
  pen.setLineDash([]);
  pen.strokeStyle = colours.accent;
  pen.lineWidth = 5;
  for (const body of ["nut", "screw"]) {
    const name = `${body}.${flank}`;
    if (!(places[`${flank}.load`] > 0) || !Number.isFinite(places[`${name}.from.x`])) continue;
    const radius = scale * places[`${name}.radius`];
    const sweep = flank === "loaded" ? 1 : 0;
    pen.stroke(new Path2D(`M ${at(`${name}.from`)} A ${radius} ${radius} 0 0 ${sweep} ${at(`${name}.to`)}`));
  }
  pen.fillStyle = colours.ink;
  for (const body of ["nut", "screw"]) {
    const [across, down] = at(`${body}.${flank}.contact`).split(" ").map(Number);
    pen.fill(new Path2D(circle(across, down, SMALL)));
  }
}

/** @param {number} x @param {number} y @param {number} radius */
function circle(x, y, radius) {
  const arc = `A ${radius} ${radius} 0 1 1`;
  return `M ${x - radius} ${y} ${arc} ${x + radius} ${y} ${arc} ${x - radius} ${y} Z`;
}
