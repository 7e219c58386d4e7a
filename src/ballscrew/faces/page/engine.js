// The model: modules of WebAssembly, each the recording of a model and a kind of nut with all its numbers as inputs.
// Nothing is computed here but places in memory, and which ball is the greatest.

/**
 * A function of a module, as the contents name it.
 * @typedef {{function: string, inputs: string[], outputs: string[], constants: Record<string, number | null>}} Spec
 * Numbers by name: one for all points, or one for each; null is none.
 * @typedef {Record<string, number | ArrayLike<number> | null>} Values
 * @typedef {Record<string, Float64Array>} Found
 * A nut whose balls are solved one by one.
 * @typedef {{
 *   halves: number, four_contacts: boolean, swells: boolean, numbers: Spec, points: Spec, behind: Spec,
 *   ball: {function: string, inputs: [string, string][], outputs: string[], reduced: string[]},
 *   reductions: [string, string, number | null][], tile: number, solver: string[],
 * }} ByBall
 * @typedef {{file: string, by_ball?: ByBall} & Spec} Structure
 */

/** Bytes of a page of memory, of a number, and of the stack of a module. */
const PAGE = 65536;
const NUMBER = 8;
const STACK = 4 * PAGE;
/** Room of the solver, numbers for each ball. */
const ROOM_OF_BALL = 16;
/** What each ball has of the solved loads, and what the nut has, in the order of the solver. */
const OF_BALLS = ["forward_load", "backward_load", "forward_angle", "backward_angle"];
const OF_STATE = ["deflection", "rigidity", "remaining_preload"];
/** The search for the load that lifts off: steps at most, and how near to it, in units of itself. */
const LIFT_OFF = { steps: 60, tolerance: 1e-10 };

/**
 * A whole number that is no less than this one, and a multiple.
 * @param {number} number
 * @param {number} multiple
 */
function upTo(number, multiple) {
  return multiple * Math.floor((number + multiple - 1) / multiple);
}

/** One module, ready to run. */
export class Kernel {
  /**
   * @param {WebAssembly.Instance} instance
   * @param {WebAssembly.Memory} memory
   * @param {number} free the first byte that the module leaves alone
   */
  constructor(instance, memory, free) {
    this.instance = instance;
    this.memory = memory;
    this.free = free;
  }

  /**
   * A module of the compiler of the model.
   * @param {WebAssembly.Module} module
   */
  static async of(module) {
    const memory = new WebAssembly.Memory({ initial: STACK / PAGE });
    const stack = new WebAssembly.Global({ value: "i32", mutable: true }, STACK);
    const env = { __linear_memory: memory, __stack_pointer: stack };
    return new Kernel(await WebAssembly.instantiate(module, { env }), memory, STACK);
  }

  /**
   * The solver of the balls, which has a stack of its own.
   * @param {WebAssembly.Module} module
   */
  static async ofSolver(module) {
    const memory = new WebAssembly.Memory({ initial: STACK / PAGE });
    const instance = await WebAssembly.instantiate(module, { env: { memory } });
    const base = /** @type {WebAssembly.Global} */ (instance.exports.__heap_base);
    return new Kernel(instance, memory, upTo(base.value, NUMBER));
  }

  /**
   * Call a function with tables of arrays: inputs that are numbers are spread over the points.
   * @param {string} name
   * @param {(number | ArrayLike<number>)[]} inputs
   * @param {number[]} sizes of the outputs
   * @param {number} count of the points
   * @param {(inputs: number, outputs: number, room: number) => number[]} argumentsOf by the addresses of tables and room
   * @param {number} room numbers of work space
   */
  call(name, inputs, sizes, count, argumentsOf, room = 0) {
    const tables = this.free;
    const lengths = [...inputs.map((value) => (typeof value === "number" ? count : value.length)), ...sizes, room];
    let end = upTo(tables + 4 * lengths.length, 2 * NUMBER);
    const addresses = lengths.map((length) => {
      const start = end;
      end += NUMBER * length;
      return start;
    });
    const missing = end - this.memory.buffer.byteLength;
    if (missing > 0) this.memory.grow(upTo(missing, PAGE) / PAGE);
    // views are made after the memory has grown, which detaches those before
    const numbers = new Float64Array(this.memory.buffer);
    new Uint32Array(this.memory.buffer, tables, lengths.length).set(addresses);
    inputs.forEach((value, i) => {
      const place = addresses[i] / NUMBER;
      if (typeof value === "number") numbers.fill(value, place, place + count);
      else numbers.set(value, place);
    });
    const run = /** @type {Function} */ (this.instance.exports[name]);
    run(...argumentsOf(tables, tables + 4 * inputs.length, addresses[lengths.length - 1]));
    return sizes.map((size, i) => {
      const place = addresses[inputs.length + i] / NUMBER;
      return numbers.slice(place, place + size);
    });
  }

  /**
   * The outputs of a function at so many points.
   * @param {Spec} spec
   * @param {Values} values
   * @param {number} count
   * @returns {Found}
   */
  evaluate(spec, values, count) {
    const inputs = spec.inputs.map((name) => inputOf(values, name));
    const sizes = spec.outputs.map(() => count);
    const arrays = this.call(spec.function, inputs, sizes, count, (i, o) => [count, 1, count, i, o]);
    /** @type {Found} */
    const found = {};
    spec.outputs.forEach((name, i) => {
      found[name] = arrays[i];
    });
    for (const [name, value] of Object.entries(spec.constants)) {
      found[name] = new Float64Array(count).fill(value ?? Number.NaN);
    }
    return found;
  }
}

/**
 * @param {Values} values
 * @param {string} name
 */
function inputOf(values, name) {
  const value = values[name];
  if (value === undefined) throw new RangeError(name);
  return value ?? Number.NaN; // what is not given
}

/**
 * A nut whose balls are solved one by one: its numbers, the loads of its balls, what each point has, what each ball has,
 * and what follows from sums over the balls.
 * @param {Kernel} kernel
 * @param {Kernel} solver
 * @param {ByBall} parts
 * @param {Values} values
 * @param {number} count
 * @returns {Found}
 */
function evaluateByBall(kernel, solver, parts, values, count) {
  const { ball, behind, points } = parts;
  const loads = loadsOf(kernel, solver, parts, values, count);
  const ofPoints = { ...values, ...loads.ofNut };
  const tables = kernel.evaluate(points, ofPoints, count);
  const inputs = ball.inputs.map(([source, name]) => (source === "columns" ? tables[name] : loads.ofBalls[name]));
  // a sum has room for a vector more
  const sizes = ball.outputs.map((name) => (ball.reduced.includes(name) ? count + 2 : loads.balls * count));
  const arrays = kernel.call(ball.function, inputs, sizes, count, (i, o) => [count, loads.balls, parts.tile, i, o]);
  const results = Object.fromEntries(ball.outputs.map((name, i) => [name, arrays[i]]));
  /** @type {Float64Array[]} */
  const reduced = [];
  for (const [what, name, place] of parts.reductions) {
    const array = results[name];
    if (what === "argmax") reduced.push(placesOfGreatest(array, loads.balls, count));
    else if (what === "take") reduced.push(taken(array, reduced[place ?? 0], count));
    else reduced.push(array.subarray(0, count));
  }
  const named = Object.fromEntries(reduced.map((array, i) => [`reduced_${i}`, array]));
  return kernel.evaluate(behind, { ...ofPoints, ...named }, count);
}

/**
 * The loads of the balls: solved once where points differ in nothing that they depend on.
 * @param {Kernel} kernel
 * @param {Kernel} solver
 * @param {ByBall} parts
 * @param {Values} values
 * @param {number} count
 */
function loadsOf(kernel, solver, parts, values, count) {
  const varying = parts.numbers.inputs.filter((name) => typeof inputOf(values, name) !== "number");
  /** @type {Map<string, number>} */
  const known = new Map();
  /** @type {number[]} */
  const first = [];
  const places = Array.from({ length: count }, (_, point) => {
    const key = varying.map((name) => /** @type {ArrayLike<number>} */ (values[name])[point]).join(" ");
    const place = known.get(key) ?? known.size;
    if (place === known.size) {
      known.set(key, place);
      first.push(point);
    }
    return place;
  });
  const those = first.length;
  const some = { ...values };
  for (const name of varying) {
    some[name] = first.map((point) => /** @type {ArrayLike<number>} */ (values[name])[point]);
  }
  const numbers = kernel.evaluate(parts.numbers, some, those);
  const ofHalf = Math.round(numbers.balls[0]);
  const balls = parts.halves * ofHalf;
  const given = parts.solver.map((name) => numbers[name]);
  const sizes = [...OF_BALLS.map(() => balls * those), ...OF_STATE.map(() => those), those];
  const flags = [parts.halves, ofHalf, parts.four_contacts ? 1 : 0, parts.swells ? 1 : 0];
  const found = solver.call(
    "loads",
    given,
    sizes,
    those,
    (i, o, room) => [those, ...flags, i, o, room],
    ROOM_OF_BALL * balls,
  );
  /** @type {Found} */
  const ofBalls = {};
  OF_BALLS.forEach((name, k) => {
    ofBalls[name] = spread(found[k], places, those, balls, count);
  });
  /** @type {Found} */
  const ofNut = {};
  [...OF_STATE, "residual"].forEach((name, k) => {
    ofNut[name] = spread(found[OF_BALLS.length + k], places, those, 1, count);
  });
  return { balls, ofBalls, ofNut };
}

/**
 * The size of the load of this sign at which the last ball of a nut leaves the flank that the load relieves: a search
 * along the deflection of the ball that is pressed the most there, which falls nearly in a straight line.
 * @param {Kernel} kernel
 * @param {Kernel} solver
 * @param {ByBall} parts
 * @param {Values} values at one point
 */
function liftOffLoad(kernel, solver, parts, values) {
  const preload = kernel.evaluate(parts.numbers, values, 1).preload[0];
  if (!(preload > 0)) return 0;
  const isBackwards = Number(values.axial_load) < 0;
  /** @param {number} size */
  const pressed = (size) => {
    const { ofBalls } = loadsOf(kernel, solver, parts, { ...values, axial_load: isBackwards ? -size : size }, 1);
    return Math.max(...ofBalls[isBackwards ? "forward_load" : "backward_load"]) ** (2 / 3);
  };
  let [before, low, high] = [0, preload / 2, Number.POSITIVE_INFINITY];
  let [pressedBefore, pressedLow] = [pressed(before), pressed(low)];
  for (let step = 0; step < LIFT_OFF.steps; step++) {
    const along = low + (pressedLow * (low - before)) / (pressedBefore - pressedLow);
    // every other step halves the bracket, which the line may miss for long
    const isOnLine = along > low && along < high && (step % 2 === 0 || high === Number.POSITIVE_INFINITY);
    const size = isOnLine ? along : (low + Math.min(high, 2 * low)) / 2;
    if (Math.min(size, high) - low <= LIFT_OFF.tolerance * size) return size;
    const left = pressed(size);
    if (left > 0) [before, pressedBefore, low, pressedLow] = [low, pressedLow, size, left];
    else high = size;
  }
  return (low + high) / 2;
}

/**
 * Rows over some points as rows over all of them.
 * @param {Float64Array} array
 * @param {number[]} places of all points among these
 * @param {number} those
 * @param {number} rows
 * @param {number} count
 */
function spread(array, places, those, rows, count) {
  const found = new Float64Array(rows * count);
  for (let row = 0; row < rows; row++) {
    if (those === 1) found.fill(array[row], row * count, (row + 1) * count);
    else for (let point = 0; point < count; point++) found[row * count + point] = array[row * those + places[point]];
  }
  return found;
}

/**
 * The row of the greatest number at each point, the first of several; of a NaN before all others.
 * @param {Float64Array} array
 * @param {number} rows
 * @param {number} count
 */
function placesOfGreatest(array, rows, count) {
  const found = new Float64Array(count);
  for (let point = 0; point < count; point++) {
    let greatest = array[point];
    for (let row = 1; row < rows && !Number.isNaN(greatest); row++) {
      const value = array[row * count + point];
      if (!(value <= greatest)) {
        greatest = value;
        found[point] = row;
      }
    }
  }
  return found;
}

/**
 * The number at a row of each point.
 * @param {Float64Array} array
 * @param {Float64Array} rows
 * @param {number} count
 */
function taken(array, rows, count) {
  return Float64Array.from({ length: count }, (_, point) => array[rows[point] * count + point]);
}

/** All modules of the page: loaded when they are first asked for, and kept. */
export class Engine {
  /** @type {Map<string, Promise<Kernel>>} */
  #loading = new Map();
  /** @type {Map<string, Kernel>} */
  #ready = new Map();

  /**
   * @param {{
   *   structures: Record<string, Structure>, oils: {file: string, grades: Record<string, Spec>}, solver: string,
   *   judging: {file: string, checked_as: Record<string, string>}, bands: {file: string, makers: Record<string, Structure>},
   * }} contents
   * @param {(file: string) => Promise<WebAssembly.Module>} moduleOf the compiled module of a file
   */
  constructor(contents, moduleOf) {
    this.contents = contents;
    this.moduleOf = moduleOf;
  }

  /**
   * Load what a structure, the oils and what is judged need; evaluating needs no waiting then.
   * @param {string} structure
   */
  async load(structure) {
    await Promise.all(this.filesFor(structure).map((each) => this.#kernel(each)));
  }

  /** Load a module that is of no structure. @param {string} file */
  async loadFile(file) {
    await this.#kernel(file);
  }

  /** The files of a structure and of the oils. @param {string} structure */
  filesFor(structure) {
    return [this.contents.oils.file, ...this.#filesOf(structure)];
  }

  /** @param {string} structure */
  isReady(structure) {
    return this.#filesOf(structure).every((file) => this.#ready.has(file));
  }

  /** A structure, or one that is drawn beside it in a band. @param {string} name @returns {Structure} */
  #structure(name) {
    return this.contents.structures[name] ?? this.contents.bands.makers[name];
  }

  /** @param {string} structure */
  #filesOf(structure) {
    const { structures, solver, judging } = this.contents;
    const [model, kind] = structure.split("/");
    const { file, by_ball } = this.#structure(structure);
    const files = [file, ...(by_ball ? [solver] : [])];
    if (judging === undefined) return files; // where the server judges
    const checked = structures[`${model}/${judging.checked_as[kind]}`];
    return [...files, judging.file, ...(checked ? [checked.file] : [])];
  }

  /**
   * The outputs of a model with a kind of nut at so many points; all numbers in SI.
   * @param {string} structure
   * @param {Values} values
   * @param {number} count
   */
  evaluate(structure, values, count) {
    const one = this.#structure(structure);
    const kernel = this.#loaded(one.file);
    if (one.by_ball === undefined) return kernel.evaluate(one, values, count);
    return evaluateByBall(kernel, this.#loaded(this.contents.solver), one.by_ball, values, count);
  }

  /**
   * The load that lifts the balls of a nut with elastic bodies off; other nuts have it among their outputs.
   * @param {string} structure
   * @param {Values} values at one point
   * @returns {Record<string, number>}
   */
  liftOff(structure, values) {
    const { file, by_ball: parts } = this.#structure(structure);
    if (parts === undefined) return {};
    return { lift_off_load: liftOffLoad(this.#loaded(file), this.#loaded(this.contents.solver), parts, values) };
  }

  /**
   * The loads and contact angles of each ball of a nut with elastic bodies, by name; none of other nuts.
   * @param {string} structure
   * @param {Values} values at one point
   * @returns {Found | undefined}
   */
  balls(structure, values) {
    const { file, by_ball: parts } = this.#structure(structure);
    return parts && loadsOf(this.#loaded(file), this.#loaded(this.contents.solver), parts, values, 1).ofBalls;
  }

  /**
   * The numbers of an oil at temperatures in kelvin.
   * @param {string} grade
   * @param {number | ArrayLike<number>} temperature
   * @param {number} count
   */
  oil(grade, temperature, count) {
    const { file, grades } = this.contents.oils;
    return this.#loaded(file).evaluate(grades[grade], { temperature }, count);
  }

  /**
   * The outputs of a function of the module of what is judged, at one point; null is none.
   * @param {Spec} spec
   * @param {Values} values
   */
  judge(spec, values) {
    return this.#loaded(this.contents.judging.file).evaluate(spec, values, 1);
  }

  /**
   * What a function of the module of bands gives; null is none.
   * @param {Spec} spec
   * @param {Values} values
   * @param {number} count
   */
  draw(spec, values, count) {
    return this.#loaded(this.contents.bands.file).evaluate(spec, values, count);
  }

  /** @param {string} file */
  #loaded(file) {
    const kernel = this.#ready.get(file);
    if (kernel === undefined) throw new RangeError(file);
    return kernel;
  }

  /** @param {string} file */
  #kernel(file) {
    const known = this.#loading.get(file);
    if (known !== undefined) return known;
    const made = this.moduleOf(file)
      .then((module) => (file === this.contents.solver ? Kernel.ofSolver(module) : Kernel.of(module)))
      .then((kernel) => {
        this.#ready.set(file, kernel);
        return kernel;
      });
    this.#loading.set(file, made);
    made.catch(() => this.#loading.delete(file)); // asked for again, it may be there
    return made;
  }
}
