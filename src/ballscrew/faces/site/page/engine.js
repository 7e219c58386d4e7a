// The model: modules of WebAssembly, each the recording of a model and a kind of nut with all its numbers as inputs.
// Nothing is computed here but places in memory.

/**
 * A function of a module, as the contents name it.
 * @typedef {{function: string, inputs: string[], outputs: string[], constants: Record<string, number>}} Spec
 */

/** Bytes of a page of memory, of a number, and of the stack of a module. */
const PAGE = 65536;
const NUMBER = 8;
const STACK = 4 * PAGE;

/** One module, ready to run. */
export class Kernel {
  /**
   * @param {WebAssembly.Instance} instance
   * @param {WebAssembly.Memory} memory
   */
  constructor(instance, memory) {
    this.instance = instance;
    this.memory = memory;
  }

  /**
   * @param {WebAssembly.Module} module
   */
  static async of(module) {
    const memory = new WebAssembly.Memory({ initial: STACK / PAGE });
    const stack = new WebAssembly.Global({ value: "i32", mutable: true }, STACK);
    const env = { __linear_memory: memory, __stack_pointer: stack };
    return new Kernel(await WebAssembly.instantiate(module, { env }), memory);
  }

  /**
   * The outputs of a function at so many points. An input is a number, or an array with one for each point.
   * @param {Spec} spec
   * @param {Record<string, number | ArrayLike<number>>} values
   * @param {number} count
   * @returns {Record<string, Float64Array>}
   */
  evaluate(spec, values, count) {
    const { inputs, outputs } = spec;
    const tables = STACK;
    const arrays = tables + 4 * (inputs.length + outputs.length + 2);
    const first = (arrays + NUMBER - 1 - ((arrays + NUMBER - 1) % NUMBER)) / NUMBER;
    const end = NUMBER * (first + count * (inputs.length + outputs.length));
    const missing = end - this.memory.buffer.byteLength;
    if (missing > 0) this.memory.grow((missing + PAGE - 1 - ((missing + PAGE - 1) % PAGE)) / PAGE);
    // views are made after the memory has grown, which detaches those before
    const numbers = new Float64Array(this.memory.buffer);
    const addresses = new Uint32Array(this.memory.buffer);
    const places = [...inputs, ...outputs].map((_, i) => first + i * count);
    places.forEach((place, i) => {
      addresses[tables / 4 + i] = NUMBER * place;
    });
    inputs.forEach((name, i) => {
      const value = values[name];
      if (value === undefined) throw new Error(`no value of ${name}`);
      if (typeof value === "number") numbers.fill(value, places[i], places[i] + count);
      else numbers.set(value, places[i]);
    });
    const run = /** @type {Function} */ (this.instance.exports[spec.function]);
    run(count, 1, count, tables, tables + 4 * inputs.length);
    /** @type {Record<string, Float64Array>} */
    const found = {};
    outputs.forEach((name, i) => {
      const place = places[inputs.length + i];
      found[name] = numbers.slice(place, place + count);
    });
    for (const [name, value] of Object.entries(spec.constants)) found[name] = new Float64Array(count).fill(value);
    return found;
  }
}

/** All modules of the page: loaded when they are first asked for, and kept. */
export class Engine {
  /** @type {Map<string, Promise<Kernel>>} */
  #kernels = new Map();
  /** @type {Map<string, Kernel>} */
  #ready = new Map();

  /**
   * @param {{structures: Record<string, Spec & {file: string}>, oils: {file: string, grades: Record<string, Spec>}}} contents
   * @param {(file: string) => Promise<WebAssembly.Module>} module the compiled module of a file
   */
  constructor(contents, module) {
    this.contents = contents;
    this.module = module;
  }

  /**
   * Load what a structure and the oils need; evaluating needs no waiting then.
   * @param {string} structure
   */
  async load(structure) {
    const files = [this.contents.structures[structure].file, this.contents.oils.file];
    await Promise.all(files.map((file) => this.#kernel(file)));
  }

  /** @param {string} structure */
  isReady(structure) {
    return this.#ready.has(this.contents.structures[structure].file);
  }

  /**
   * The outputs of a model with a kind of nut at so many points; all numbers in SI.
   * @param {string} structure
   * @param {Record<string, number | ArrayLike<number>>} values
   * @param {number} count
   */
  evaluate(structure, values, count) {
    const spec = this.contents.structures[structure];
    return this.#loaded(spec.file).evaluate(spec, values, count);
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

  /** @param {string} file */
  #loaded(file) {
    const kernel = this.#ready.get(file);
    if (kernel === undefined) throw new Error(`${file} is not loaded`);
    return kernel;
  }

  /** @param {string} file */
  #kernel(file) {
    const known = this.#kernels.get(file);
    if (known !== undefined) return known;
    const made = this.module(file)
      .then((module) => Kernel.of(module))
      .then((kernel) => {
        this.#ready.set(file, kernel);
        return kernel;
      });
    this.#kernels.set(file, made);
    made.catch(() => this.#kernels.delete(file)); // asked for again, it may be there
    return made;
  }
}
