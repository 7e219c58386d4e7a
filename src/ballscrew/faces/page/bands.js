// The band of a case: random numbers, the values that they stand for, torques of these, and the ends between which
// most of them lie. It goes on in steps, so that what has waited meanwhile can be done between them. Modules make values
// and torques, tables say which inputs are uncertain; here whole numbers are combined, and samples are put in order.

/**
 * An input that is uncertain: the form of its uncertainty with the numbers of that; ``above`` it is switched on, and
 * ``from`` and ``to`` where the form holds.
 * @typedef {{
 *   name: string, form: string, numbers: Record<string, number>, above?: number, from?: number, to?: number, oil?: string,
 * }} Uncertain
 */
/**
 * @typedef {{
 *   file: string, functions: Record<string, import("./engine.js").Spec>, level: number, tails: number[],
 *   outputs: string[], drawn: string[], makers: Record<string, Makers>, samples: Record<string, Record<string, number>>,
 *   uncertain: Record<string, Uncertain[]>, sobol: Record<string, { unit: number, first: number[], turns: number[][] }>,
 * }} Bands
 */
/**
 * What makers' torques ask for, which is drawn beside a model: the inputs that each sets, their names by start where they
 * are not all, and values of inputs: where one has another, none is drawn.
 * @typedef {import("./engine.js").Structure & {
 *   calibrations: Record<string, Record<string, number>>, of_starts: Record<string, string[]>, values: Record<string, number>,
 * }} Makers
 */
/**
 * What a band is asked of: all inputs in SI, the oil with its temperature in kelvin, the inputs that were changed, which
 * the oil does not set; whether at the operating point or over speeds, and those in SI.
 * @typedef {{
 *   structure: string, start: string, inputs: Record<string, any>, grade: string, temperature: number, kept: string[],
 *   kind: "point" | "fan", speeds: number[],
 * }} Question
 */
/** @typedef {{ low: number, high: number }} Ends */
/**
 * The band at the operating point, by output; or at each speed of the fan, of the friction torque.
 * @typedef {{ kind: "point", count: number, ends: Record<string, Ends>, invalid: number }} PointBand
 * @typedef {{ kind: "fan", count: number, speeds: number[], lows: number[], highs: number[], invalid: number[] }} FanBand
 */
/** @typedef {Record<string, Float64Array>} Drawn */

export const TORQUE = "screw_torque";
export const SPEED = "screw_speed";
const TEMPERATURE = "temperature";
/** Points of a step before it is known how long one takes. */
const FIRST_POINTS = 16;
/** Of what a step took before, at most so many times more. */
const GROWTH = 4;

/**
 * The inputs that are uncertain in a case; nothing where the page has no band for it.
 *
 * @param {Bands} bands
 * @param {Question} question
 * @returns {Uncertain[] | undefined}
 */
export function uncertainIn(bands, question) {
  const rows = bands.uncertain[question.structure];
  if (rows === undefined) return undefined;
  const oil = question.grade ? "grade" : "viscosity";
  const found = rows.filter((row) => {
    if (row.oil !== undefined && row.oil !== oil) return false;
    return row.above === undefined || centralOf(question, row.name) > row.above;
  });
  const isWithin = found.every(({ name, from, to }) => {
    const value = centralOf(question, name);
    return (from === undefined || value >= from) && (to === undefined || value <= to);
  });
  const slots = makersIn(bands, question).length ? 1 : 0;
  return isWithin && Object.hasOwn(bands.sobol, found.length + slots) ? found : undefined;
}

/** The structure with the numbers of makers. @param {Question} question */
export function calibratedOf({ structure }) {
  return `${structure}/makers`;
}

/**
 * The names of the calibrations of makers that are drawn beside the model of a case.
 *
 * @param {Bands} bands
 * @param {Question} question
 */
export function makersIn(bands, question) {
  const makers = bands.makers[calibratedOf(question)];
  if (makers === undefined || !(question.inputs.preload > 0)) return [];
  if (Object.entries(makers.values).some(([name, value]) => question.inputs[name] !== value)) return [];
  return makers.of_starts[question.start] ?? Object.keys(makers.calibrations);
}

/**
 * By what the calibrations of makers move the torque at each of some speeds, those that are valid where the model is;
 * the first leaves it as it is.
 *
 * @param {import("./engine.js").Engine} engine
 * @param {Bands} bands
 * @param {Question} question
 * @param {number[]} speeds
 * @returns {number[][]}
 */
function ratiosOf(engine, bands, question, speeds) {
  const found = speeds.map(() => [1]);
  const names = makersIn(bands, question);
  if (names.length === 0) return found;
  const here = { ...question.inputs, [SPEED]: speeds };
  const own = engine.evaluate(question.structure, here, speeds.length);
  const masks = Object.keys(own).filter((name) => name.startsWith("validity_"));
  const structure = calibratedOf(question);
  for (const name of names) {
    const other = engine.evaluate(structure, { ...here, ...bands.makers[structure].calibrations[name] }, speeds.length);
    const values = { torque: other[TORQUE], central: own[TORQUE] };
    const { ratio } = engine.draw(bands.functions.ratio, values, speeds.length);
    speeds.forEach((_, place) => {
      const isValid = masks.every((mask) => other[mask][place] === 1 || own[mask][place] !== 1);
      if (isValid && Number.isFinite(ratio[place]) && ratio[place] > 0) found[place].push(ratio[place]);
    });
  }
  return found;
}

/** @param {Question} question @param {string} name @returns {number} */
function centralOf(question, name) {
  return name === TEMPERATURE ? question.temperature : question.inputs[name];
}

/**
 * Evenly spread shares between 0 and 1, an array for each input: points of a Sobol sequence in the order of the Gray code.
 *
 * @param {{ unit: number, first: number[], turns: number[][] }} numbers
 * @param {number} count
 */
function sharesOf({ unit, first, turns }, count) {
  const least = unit / 4; // there are no quantiles at 0 and 1
  return first.map((begin, input) => {
    const found = new Float64Array(count);
    let whole = begin;
    for (let point = 0; point < count; point += 1) {
      if (point > 0) {
        let place = 0;
        while (!((point >> place) & 1)) place += 1;
        whole ^= turns[input][place];
      }
      found[point] = Math.max(least, Math.min(1 - least, whole * unit));
    }
    return found;
  });
}

/**
 * The values that are drawn of the uncertain inputs, by name.
 *
 * @param {import("./engine.js").Engine} engine
 * @param {Bands} bands
 * @param {Question} question
 * @param {Uncertain[]} rows
 * @param {Float64Array[]} shares
 * @returns {Drawn}
 */
function drawnOf(engine, bands, question, rows, shares) {
  const count = shares[0].length;
  /** @type {Drawn} */
  const found = {};
  rows.forEach(({ name, form, numbers }, place) => {
    const values = { ...numbers, u: shares[place], value: centralOf(question, name) };
    found[name] = engine.draw(bands.functions[form], values, count).drawn;
  });
  const { [TEMPERATURE]: temperatures, ...others } = found;
  if (temperatures === undefined) return others;
  const oil = engine.oil(question.grade, temperatures, count);
  const set = Object.entries(oil).filter(([name]) => name in question.inputs && !question.kept.includes(name));
  return { ...Object.fromEntries(set), ...others };
}

/**
 * The value with a share of the numbers below it: one that occurs; NaN where none is a number.
 *
 * @param {Float64Array} sorted without NaN
 * @param {number} share
 */
function quantileOf(sorted, share) {
  const place = Math.ceil(sorted.length * share) - 1;
  return sorted.length ? sorted[Math.max(0, place)] : Number.NaN;
}

/** The ends of the band. @param {Float64Array} values @param {number[]} tails @returns {Ends} */
function endsOf(values, tails) {
  const sorted = values.filter((value) => !Number.isNaN(value)).sort();
  const [low, high] = tails.map((share) => quantileOf(sorted, share));
  return { low, high };
}

/**
 * The factor of each sample: one of those in turn, all equally likely.
 *
 * @param {number[]} ratios
 * @param {Float64Array | undefined} shares
 * @param {number} count
 */
function factorsOf(ratios, shares, count) {
  if (shares === undefined) return new Float64Array(count).fill(1);
  return shares.map((share) => ratios[Math.min(ratios.length - 1, Math.floor(share * ratios.length))]);
}

/** The share that is not valid. @param {Float64Array} valid */
function invalidOf(valid) {
  return valid.filter((value) => value !== 1).length / valid.length;
}

/**
 * The band of a case: a value of the generator that is nothing is but a pause. Each step takes about so many milliseconds.
 *
 * @param {import("./engine.js").Engine} engine
 * @param {Bands} bands
 * @param {Question} question
 * @param {number} budget
 * @returns {Generator<PointBand | FanBand | undefined, void>}
 */
export function* bandsOf(engine, bands, question, budget) {
  const rows = uncertainIn(bands, question);
  if (rows === undefined) return;
  const { kind } = question;
  const isFan = kind === "fan";
  const count = bands.samples["by_ball" in engine.contents.structures[question.structure] ? "by_ball" : "usual"][kind];
  const speeds = isFan ? question.speeds : [question.inputs[SPEED]];
  const ratios = ratiosOf(engine, bands, question, speeds);
  const shares = sharesOf(bands.sobol[rows.length + (makersIn(bands, question).length ? 1 : 0)], count);
  const drawn = drawnOf(engine, bands, question, rows, shares);
  /** @type {Record<string, Float64Array>[]} */
  const found = speeds.map(() =>
    Object.fromEntries([...bands.drawn, "valid"].map((name) => [name, new Float64Array(count)])),
  );
  let points = FIRST_POINTS;
  for (let first = 0; first < count; ) {
    const some = Math.min(count - first, Math.max(1, Math.floor(points / speeds.length)));
    const began = performance.now();
    stepInto(engine, question, drawn, speeds, first, some, found);
    const pace = (performance.now() - began) / (some * speeds.length);
    points = Math.max(1, Math.min(GROWTH * some * speeds.length, Math.floor(budget / Math.max(pace, 1e-4))));
    first += some;
    yield;
  }
  const derived = found.map((one, place) => {
    const factor = factorsOf(ratios[place], shares[rows.length], count);
    return engine.draw(bands.functions.derived, { ...one, factor }, count);
  });
  if (!isFan) {
    const ends = Object.fromEntries(bands.outputs.map((name) => [name, endsOf(derived[0][name], bands.tails)]));
    yield { kind: "point", count, ends, invalid: invalidOf(found[0].valid) };
    return;
  }
  const ends = derived.map((one) => endsOf(one[TORQUE], bands.tails));
  const [lows, highs] = [ends.map(({ low }) => low), ends.map(({ high }) => high)];
  yield { kind: "fan", count, speeds, lows, highs, invalid: found.map(({ valid }) => invalidOf(valid)) };
}

/**
 * Evaluate some of the samples at all speeds: those of one sample share the loads of their balls.
 *
 * @param {import("./engine.js").Engine} engine
 * @param {Question} question
 * @param {Drawn} drawn
 * @param {number[]} speeds
 * @param {number} first
 * @param {number} some
 * @param {Record<string, Float64Array>[]} found
 */
function stepInto(engine, question, drawn, speeds, first, some, found) {
  const total = some * speeds.length;
  /** @type {Record<string, any>} */
  const values = { ...question.inputs };
  for (const [name, all] of Object.entries(drawn)) {
    const own = all.subarray(first, first + some);
    const repeated = new Float64Array(total);
    for (let place = 0; place < speeds.length; place += 1) repeated.set(own, place * some);
    values[name] = repeated;
  }
  values[SPEED] = Float64Array.from({ length: total }, (_, point) => speeds[Math.floor(point / some)]);
  const results = engine.evaluate(question.structure, values, total);
  found.forEach((one, place) => {
    for (const name of Object.keys(one)) one[name].set(results[name].subarray(place * some, (place + 1) * some), first);
  });
}
