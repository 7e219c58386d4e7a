// Balls of a nut for its pictures: each at its place on the helix, with its load by the answer. Geometry alone is worked
// out here: loads and sizes are those of the answer, and what stands for a size that it has not is said.

import { vocabulary } from "./vocabulary.js";

/**
 * A place for a ball on the helix: the half of the nut, the angle about the screw and the way along it from the first
 * ball (rad, m). A spacer ball carries nothing.
 *
 * @typedef {object} Ball
 * @property {number} half
 * @property {number} angle
 * @property {number} along
 * @property {boolean} isSpacer
 * @property {number} forward normal load on the flank that a positive load presses on, N
 * @property {number} backward that on the other flank, N
 * @property {number} load the greater of both
 */
/**
 * The balls of a nut and what is drawn around them, m and rad.
 *
 * @typedef {object} Nut
 * @property {Ball[]} balls
 * @property {number} halves
 * @property {number} turns loaded turns of a half
 * @property {boolean} isAlike whether all balls of a half carry the same
 * @property {number} pitch diameter of the circle of the centres
 * @property {number} ball diameter of a ball
 * @property {number} lead
 * @property {number} starts
 * @property {number} between distance of the halves, last ball to first ball; that of a lead where there is one body
 * @property {number} root diameter of the core
 * @property {number} outer diameter of the thread
 * @property {number} width outer diameter of the nut
 * @property {string[]} notes what is assumed, in words
 */

const TURN = 2 * Math.PI;
/** Balls that are drawn at most: more than those of any nut whose balls are computed one by one. */
export const MOST_BALLS = 1000;
/** Depth of a groove against the ball, from the centre of the ball outwards, of usual threads. */
const THREAD = 1 / 3;
/** Outer diameter of a nut over the pitch circle, where it is not given: that of the bodies of a nut. */
const WIDTH = 1.5;

/**
 * Balls from light to dark: told apart with any colour vision, and in print, as the curves of one growing parameter.
 */
export const COLOURS = ["#7FB8DA", "#3C8DBC", "#8A6FB0", "#B0457B", "#5B1A3A"];

/**
 * The nut of an answer; nothing where it has too many balls to be drawn, or no number of them.
 *
 * @param {Run} answer
 * @returns {Nut | undefined}
 */
export function nutOf(answer) {
  const inputs = /** @type {Record<string, Record<string, any>>} */ (answer.inputs);
  const { screw, nut = {}, bodies = {} } = inputs;
  const { pitch_circle_diameter: pitch, lead, ball_diameter: ball, loaded_balls: loaded, starts = 1 } = screw;
  const halves = vocabulary.nuts[nut.type ?? ""]?.halves ?? 1;
  if (![pitch, lead, ball, loaded].every((one) => typeof one === "number" && one > 0)) return undefined;
  if (loaded * halves > MOST_BALLS) return undefined;
  if (halves > 1 && !listedLoads(answer)) return undefined;
  const notes = [
    "balls that touch along one helix, without returns, flange and seals: turns and length are those of the loaded balls",
  ];
  /** @param {unknown} given @param {number} usual @param {string} words */
  const size = (given, usual, words) => {
    if (typeof given === "number") return given;
    notes.push(words);
    return usual;
  };
  const slope = Math.atan(lead / (Math.PI * pitch));
  const step = (2 * ball * Math.cos(slope)) / pitch;
  const isSpaced = nut.spacer_balls === true;
  const carrying = Math.floor(isSpaced ? loaded / 2 : loaded);
  const all = placesOfHalf(loaded, carrying, { step, starts, lead, isSpaced });
  const last = all.filter((one) => !one.isSpacer).at(-1) ?? all[0];
  const between = nut.spacing || lead;
  if (halves > 1 && !nut.spacing) notes.push("halves one lead apart: their distance is not given");
  const loads = loadsOf(answer, halves, carrying);
  const balls = Array.from({ length: halves }, (_, half) => {
    let place = 0;
    return all.map((one) => {
      const [forward, backward] = one.isSpacer ? [0, 0] : loads(half, place++);
      return {
        half,
        angle: one.angle + half * (last.angle + (TURN * between) / lead),
        along: one.along + half * (last.along + between),
        isSpacer: one.isSpacer,
        forward,
        backward,
        load: Math.max(forward, backward),
      };
    });
  }).flat();
  return {
    balls,
    halves,
    turns: (Math.ceil(loaded / starts) * step) / TURN,
    isAlike: !isOneByOne(answer, halves, carrying),
    pitch,
    ball,
    lead,
    starts,
    between,
    root: size(
      screw.root_diameter ?? bodies.screw_diameter,
      pitch - ball,
      "a root diameter of the pitch circle less a ball",
    ),
    outer: size(
      undefined,
      pitch - THREAD * ball,
      "an outer diameter of the thread of the pitch circle less a third of a ball",
    ),
    width: size(
      bodies.nut_outer_diameter,
      WIDTH * pitch,
      "an outer diameter of the nut of one and a half pitch circles",
    ),
    notes,
  };
}

/**
 * The places of a half: balls touch their neighbours, which may be spacer balls, and are shared out over the starts.
 *
 * @param {number} loaded
 * @param {number} carrying
 * @param {{ step: number, starts: number, lead: number, isSpaced: boolean }} thread
 */
function placesOfHalf(loaded, carrying, { step, starts, lead, isSpaced }) {
  const stride = isSpaced ? 2 * step : step;
  /** @param {number} place @param {boolean} isSpacer @param {number} behind */
  const at = (place, isSpacer, behind) => {
    const way = Math.floor(place / starts) * stride + behind;
    return { angle: way + (place % starts) * (TURN / starts), along: (way * lead) / TURN, isSpacer };
  };
  const carriers = Array.from({ length: carrying }, (_, place) => at(place, false, 0));
  // of an odd number one carries in turn: it stands behind the last
  const spacers = Array.from({ length: loaded - carrying }, (_, place) => at(place, true, place < carrying ? step : 0));
  return [...carriers, ...spacers].sort((one, other) => one.along - other.along);
}

/** @param {Run} answer */
function listedLoads(answer) {
  /** @type {Record<string, any> | undefined} */
  const loads = answer.loads;
  const { forward_load: forward, backward_load: backward } = loads?.balls ?? {};
  return Array.isArray(forward) && Array.isArray(backward) ? { forward, backward } : undefined;
}

/** @param {Run} answer @param {number} halves @param {number} carrying */
function isOneByOne(answer, halves, carrying) {
  return carrying > 1 && listedLoads(answer)?.forward.length === halves * carrying;
}

/**
 * The loads of a ball on both flanks by its half and its place in it; a list of kinds has one entry for each half.
 *
 * @param {Run} answer
 * @param {number} halves
 * @param {number} carrying
 * @returns {(half: number, place: number) => [number, number]}
 */
function loadsOf(answer, halves, carrying) {
  const listed = listedLoads(answer);
  const alone = answer.results.contact_load ?? answer.results.largest_contact_load;
  if (!listed) return () => [Number(alone ?? 0), 0];
  const isSingly = isOneByOne(answer, halves, carrying);
  return (half, place) => {
    const entry = isSingly ? half * carrying + place : Math.min(half, listed.forward.length - 1);
    return [Number(listed.forward[entry] ?? 0), Number(listed.backward[entry] ?? 0)];
  };
}

/**
 * Least and greatest load of the balls that carry.
 *
 * @param {Ball[]} balls
 * @returns {[number, number]}
 */
export function rangeOf(balls) {
  const loads = balls.filter((one) => !one.isSpacer).map((one) => one.load);
  return loads.length ? [Math.min(...loads), Math.max(...loads)] : [0, 0];
}
