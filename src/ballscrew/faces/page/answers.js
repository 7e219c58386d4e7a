// Answers: one request for all designs, whose lines are drawn as they come. Numbers come first.

import * as bath from "./bath.js";
import { isVisible, move, showFailure, showWords } from "./chart_place.js";
import * as charts from "./charts.js";
import * as checks from "./checks.js";
import { showDesigns } from "./compare.js";
import { caseOf, titleOf } from "./designs.js";
import { byId, NARROW, update } from "./dom.js";
import * as drawings from "./drawing.js";
import { hotAndCold as hot } from "./hot_and_cold.js";
import * as inputs from "./inputs.js";
import { localEngine } from "./local_engine.js";
import { inWords, labelOf } from "./messages.js";
import * as moving from "./moving.js";
import * as nutPicture from "./nut_picture.js";
import * as nutUnrolled from "./nut_unrolled.js";
import { dragged } from "./operating_point.js";
import { askPatiently, goOn, isOutOfTime, sendPatiently } from "./long_work.js";
import { powerFlow } from "./power_flow.js";
import * as quadrants from "./quadrants.js";
import * as results from "./results.js";
import { withoutCards } from "./schema.js";
import { sheetPlace } from "./sheet.js";
import { alone, keep, known, Latest, linesOf, Problem, sendLines } from "./server.js";
import { isSame, LETTERS } from "./state.js";
import * as stiffness from "./stiffness.js";
import { store } from "./store.js";
import * as temperatures from "./temperatures.js";
import { isSeen } from "./views.js";
import { vocabulary } from "./vocabulary.js";

/** Every how many points of the curve over the speed have a band: of a screw, and of a whole nut. */
const STEP_OF_BAND = { screw: 2, nut: 4 };
const BAND_DELAY = 400;
/** Milliseconds to wait where the server has too much to do, as it says itself. */
const BUSY_DELAY = 1000;
/** Milliseconds after which what was moved rests, and the server is asked. */
const REST = 200;
/** Milliseconds after a frame of numbers until the curves that were left out of it. */
const REST_OF_CURVES = 30;
/** Milliseconds that the curves of one frame may take: the others follow when it rests. */
const TIME_OF_CURVES = 30;
/** Curves are drawn with the numbers where this many points take less than this many milliseconds. */
const MOST_POINTS = 500;
const TIME_IN_FRAME = 8;
/** Milliseconds after which a page in the background counts as painted. */
const PAINT_TIMEOUT = 500;

/** @typedef {{ case: Record<string, unknown> }} Body */
/**
 * Inputs that are moved, whether axes stay as they are, when it began, and the case where that has them already.
 *
 * @typedef {{ values: import("./engine.js").Values, isHeld: boolean, start: number, body?: Body }} Moved
 */
/**
 * Everything on the page: the case, its answer and band, the sweeps of its charts, the other designs and models.
 *
 * @typedef {object} Displayed
 * @property {Body} [body] without what only cards ask about
 * @property {Body} [whole] the case as a file has it
 * @property {string} [key]
 * @property {Run} [answer]
 * @property {checks.Judged} [checks]
 * @property {results.Band | null} band
 * @property {string[]} starts
 * @property {Record<string, any>} curves what is drawn beside it, by the names of the lines of an answer: sweeps, and the drawing
 * @property {Sweep | string} [bandAlongSpeed] the band of the torque over the speed, or why there is none
 * @property {import("./compare.js").Answers} [designs]
 * @property {Question} [asked] what the designs answer
 * @property {Compare} [models]
 */

/**
 * What is asked: the case on the page, without what only cards ask about and as a file has it; the designs side by side,
 * of which those ``beside`` are sent with it, as far as nothing is known of them.
 *
 * @typedef {object} Question
 * @property {Body} body
 * @property {Body} whole
 * @property {Body[]} designs
 * @property {Body[]} beside
 * @property {boolean} band
 * @property {number} start
 * @property {AbortSignal} signal
 */

/**
 * Ask for each design by itself where the case on the page is refused. Returns why designs have no answers.
 *
 * @param {Question} asked
 * @param {unknown} error of the case on the page
 */
async function others({ body, beside, signal }, error) {
  /** @type {Map<Body, unknown>} */
  const refused = new Map([[body, error]]);
  for (const one of beside) {
    try {
      await askPatiently("run", one, signal);
      await askPatiently("check", one, signal);
    } catch (reason) {
      if (!known("run", one)) refused.set(one, reason);
    }
  }
  return refused;
}

/**
 * All designs at the load and the speed of the first one, or each at its own.
 *
 * @param {Body[]} bodies
 * @param {boolean} own
 */
function atOnePoint(bodies, own) {
  const { operation } = bodies[0].case;
  return own || !operation ? bodies : bodies.map((one) => ({ case: { ...one.case, operation } }));
}

/** Why a design has no answer, in words. @param {unknown} error */
function reasonOf(error) {
  const [fault] = error instanceof Problem ? error.faults : [];
  return fault ? `${labelOf(fault.where)}: ${inWords(fault)}` : linesOf(error)[0];
}

/** True where a case has a cycle, which is judged in place of its operating point. @param {Body} body */
function isMoving({ case: { axis, motion } }) {
  return Boolean(axis && motion && !alone.answers);
}

/**
 * The checks over the cycle of a case; none where they cannot be computed.
 *
 * @param {Body} body
 * @param {AbortSignal} signal
 * @returns {Promise<checks.Judged | undefined>}
 */
async function checksOfCycle(body, signal) {
  try {
    return checks.ofCycle(await askPatiently("duty", body, signal));
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    return undefined;
  }
}

/** Wait until what was drawn is on the screen: a task queued within a frame runs after it. */
function painted() {
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve));
    setTimeout(resolve, PAINT_TIMEOUT);
  });
}

/**
 * Measure the time until something is on the screen.
 *
 * @param {string} name
 * @param {number} start
 * @param {AbortSignal} signal
 * @param {Promise<unknown>} shown done when it is there
 */
async function measurePaint(name, start, signal, shown = painted()) {
  await shown;
  if (!signal.aborted) performance.measure(name, { start });
}

/**
 * Wait; until then somebody may have moved on.
 *
 * @param {number} time
 */
function wait(time) {
  return new Promise((resolve) => {
    setTimeout(resolve, time);
  });
}

/** Let the browser show what was drawn and handle what was typed. */
function nextTask() {
  return new Promise((resolve) => {
    setTimeout(resolve);
  });
}

/**
 * Do something after a while, unless it is cancelled until then.
 *
 * @param {number} delay
 * @param {AbortSignal} signal
 * @param {() => void} work
 */
function after(delay, signal, work) {
  const timer = setTimeout(work, delay);
  signal.addEventListener("abort", () => clearTimeout(timer));
}

/** The line of a curve that took too long for a request. @typedef {Extract<AnswerLine, { problem: unknown }>} Late */

/** What shows an error that nobody waits for, unless its question is over. @param {AbortSignal} signal */
function fail(signal) {
  return (/** @type {unknown} */ error) => {
    if (!signal.aborted) results.fail(results.refusal(linesOf(error)));
  };
}

/** Test whether a curve goes on as a job. @param {Late} line */
function isLate({ problem, sweep }) {
  return Boolean(sweep) && isOutOfTime(new Problem(problem));
}

/** Tell other programs, and those who look from outside. @param {Body | undefined} body @param {Run} answer */
function tell(body, answer) {
  Object.assign(globalThis, { ballscrew: { case: body?.case, inputs: answer.inputs, outputs: answer.results } });
}

/** Show where the power of an answer goes. @param {Run} answer */
function showPower(answer) {
  update(byId("power"), powerFlow(answer, vocabulary.mechanisms));
}

/** What is drawn of an answer beside its numbers, by the places. @type {[string, (answer: Run) => unknown][]} */
const PICTURES = [
  ["power", showPower],
  ["quadrants", quadrants.show],
  ["nut-picture", nutPicture.show],
  ["nut-unrolled", nutUnrolled.show],
  ["stiffness", stiffness.show],
  ["balls-chart", stiffness.showBalls],
];

/** The answers to the state of the page, as far as they are there. */
class Answers {
  #requests = new Latest();
  #bands = new Latest();
  /** Those of the checks: an edit of a card asks for them alone. */
  #judging = new Latest();
  /** @type {Displayed} */
  #displayed = { band: null, starts: [], curves: {} };

  /** What is shown of a change before the server has answered. @type {Moved | undefined} */
  #moved;
  /** The numbers of it that are on the page. @type {{ answer: Run, moved: Moved } | undefined} */
  #shown;
  /** Its next frame. @type {number | undefined} */
  #frame;
  /** Its next curves, where they do not fit into a frame. @type {ReturnType<typeof setTimeout> | undefined} */
  #curves;
  #never = new AbortController();
  /** All models and laws. */
  #models = sheetPlace("models");
  /** What draws the parts of the answer that nobody sees yet. @type {(() => unknown)[]} */
  #undrawn = [];

  constructor() {
    dragged.addEventListener("move", (event) => {
      if (this.#followPoint(/** @type {CustomEvent} */ (event).detail)) event.preventDefault();
    });
    NARROW.addEventListener("change", () => {
      if (this.#displayed.curves.drawing) drawings.show(this.#displayed.curves.drawing);
      if (this.#displayed.answer) nutPicture.show(this.#displayed.answer);
    });
  }

  /** The answer on the page, or none yet. */
  current() {
    return this.#displayed;
  }

  /**
   * Show the answer of the current case, and all designs side by side. Requests of the cases before are cancelled.
   */
  async update() {
    const { designs: listed, show, band, own } = store.state;
    const signal = this.#requests.begin();
    const start = performance.now();
    this.#bands.cancel();
    this.#judging.cancel();
    this.clearModels();
    this.#displayed.starts = listed.map(titleOf);
    byId("results").setAttribute("aria-busy", "true");
    try {
      const found = await Promise.all(listed.map(caseOf));
      if (signal.aborted) return;
      const bodies = found.map((one) => ({ case: withoutCards(one) }));
      const body = bodies[show];
      const designs = atOnePoint(bodies, own);
      const beside = designs.filter((one) => !isSame(one, body) && !(known("run", one) && known("check", one)));
      const asked = { body, whole: { case: found[show] }, designs, beside, band, start, signal };
      const values = this.#displayed.answer && !results.isStale() && localEngine.valuesOf(body);
      if (values) {
        this.#move({ values, isHeld: false, start, body });
        await wait(REST);
        if (signal.aborted) return;
      }
      try {
        await this.#follow(asked);
      } catch (error) {
        if (signal.aborted) return;
        if (this.#moved) this.#moveBack();
        const hasFaults = error instanceof Problem && error.faults.length;
        results.fail(hasFaults ? inputs.showFaults(error.faults) : results.refusal(linesOf(error)));
        await this.#showTable(asked, await others(asked, error));
      }
    } catch (error) {
      if (!signal.aborted) results.fail(results.refusal(linesOf(error)));
    } finally {
      if (!signal.aborted) byId("results").setAttribute("aria-busy", "false");
    }
  }

  /** Somebody is about to change something: have the module of the case at hand. */
  prepare() {
    const { body } = this.#displayed;
    localEngine.want();
    if (body) localEngine.learn(body);
  }

  /**
   * Show a change at once, by the module in the browser.
   *
   * @param {Moved} moved
   */
  #move(moved) {
    this.#moved = moved;
    this.#frame ??= requestAnimationFrame(() => this.#drawMoved());
  }

  #drawMoved() {
    this.#frame = undefined;
    const { answer: before, band } = this.#displayed;
    const moved = this.#moved;
    if (!moved || !before) return;
    const answer = moving.answerOf(before, moved.values);
    byId("results").classList.add("moving");
    results.show(answer, { band: band && { state: "pending" } }, isSeen);
    this.#shown = { answer, moved };
    tell(moved.body ?? this.#displayed.body, answer);
    // this is a frame: the next task runs once it is painted, and before the curves
    measurePaint("moved", moved.start, this.#never.signal, nextTask());
    const isQuick = localEngine.timeOf(MOST_POINTS) < TIME_IN_FRAME;
    if (isQuick) this.#drawMovedCurves(["over_speed"]);
    // the rest once the numbers, and the curve beside them, are painted
    this.#curves ??= setTimeout(() => {
      this.#curves = undefined;
      if (this.#shown && isSeen(byId("power"))) showPower(this.#shown.answer);
      this.#drawMovedCurves(isQuick ? ["over_load", "over_both"] : ["over_speed", "over_load", "over_both"]);
    }, REST_OF_CURVES);
  }

  /** Another pane is seen: show in it what was left out while it was not. */
  look() {
    this.#drawRest();
    if (this.#moved) this.#frame ??= requestAnimationFrame(() => this.#drawMoved());
  }

  /** Draw what was left out of the answer. */
  #drawRest() {
    for (const draw of this.#undrawn.splice(0)) draw();
  }

  /** Draw curves of the numbers that are shown. @param {string[]} names */
  #drawMovedCurves(names) {
    if (!this.#shown) return;
    const {
      answer,
      moved: { values, isHeld, start },
    } = this.#shown;
    /** @type {Record<string, string[]>} */
    const places = {
      over_speed: ["torque-chart", "film-chart"],
      over_load: ["pressure-chart"],
      over_both: ["map-chart"],
    };
    const { curves } = this.#displayed;
    const asked = names.filter((name) => curves[name] && places[name].some(isVisible));
    const before = Object.fromEntries(asked.map((name) => [name, curves[name]]));
    move(["torque-chart", "film-chart", "stribeck-chart", "hot-chart", "pressure-chart", "map-chart"], isHeld, () => {
      const found = moving.curvesOf(before, values, isHeld, TIME_OF_CURVES);
      if (found.over_speed) {
        charts.torque(found.over_speed, answer, vocabulary.mechanisms);
        charts.film(found.over_speed, answer);
      }
      if (found.over_load) charts.pressure(found.over_load, answer);
      if (found.over_both) charts.map(found.over_both, answer);
    });
    measurePaint("moved_curves", start, this.#never.signal);
  }

  /** What was moved is answered. */
  #rest() {
    if (this.#frame !== undefined) cancelAnimationFrame(this.#frame);
    clearTimeout(this.#curves);
    this.#frame = this.#curves = undefined;
    this.#moved = this.#shown = undefined;
    byId("results").classList.remove("moving");
  }

  /** Show the answer of before again. */
  #moveBack() {
    this.#rest();
    this.redisplay();
  }

  /**
   * Follow the operating point of a chart, which no field has taken over yet.
   *
   * @param {Record<string, number> | null} point where it is, null where it is let go and stays where it was
   */
  #followPoint(point) {
    const { body, answer } = this.#displayed;
    const values = body && answer && !results.isStale() && localEngine.valuesOf(body);
    if (!values) return false;
    if (point) this.#move({ values: { ...values, ...point }, isHeld: true, start: performance.now() });
    else this.#moveBack();
    return true;
  }

  /**
   * Keep the case for files, of which only what cards ask about has changed; its cycle is judged anew.
   *
   * @param {Record<string, unknown>} found
   */
  async keepWhole(found) {
    const before = this.#displayed.whole;
    this.#displayed.whole = { case: found };
    const { answer, body, whole } = this.#displayed;
    if (!answer || !body || !(isMoving(whole) || (before && isMoving(before)))) return;
    try {
      await this.#showChecks(body);
    } catch (error) {
      results.fail(results.refusal(linesOf(error)));
    }
  }

  /** Show all of it again in other units, without requests. */
  redisplay() {
    const found = this.#displayed;
    const { answer, curves, designs, models } = found;
    if (!answer) return;
    results.show(answer, found);
    for (const [, draw] of PICTURES) draw(answer);
    checks.show(found.checks);
    for (const [question, one] of Object.entries(curves)) {
      for (const draw of Object.values(this.#drawers[question])) draw(answer, one);
    }
    hot.redisplay();
    if (designs) showDesigns(designs, found.starts, vocabulary.mechanisms);
    if (models) this.#models.show(/** @type {any} */ (models.sheet));
  }

  /**
   * Compute and show the band where it is wanted, once typing has come to rest.
   *
   * @param {boolean} wanted
   */
  showBand(wanted) {
    this.#bands.cancel();
    const { answer, body, band } = this.#displayed;
    if (!answer || !body) return;
    if (!wanted) {
      if (!band && !this.#displayed.bandAlongSpeed) return;
      this.#displayBand(answer, null);
      this.#drawTorque(answer);
      return;
    }
    if (band && band.state !== "pending") return;
    this.#displayBand(answer, { state: "pending" });
    const signal = this.#bands.begin();
    after(BAND_DELAY, signal, () => this.#addBand(body, answer, signal));
  }

  /**
   * The bands of the designs side by side, or none of them.
   *
   * @param {boolean} wanted
   */
  showBandsOfDesigns(wanted) {
    const { designs, starts, asked } = this.#displayed;
    if (!designs || !asked || Object.keys(designs).length < 2) return;
    for (const one of Object.values(designs)) delete one.band;
    if (wanted) this.#addBands(asked);
    else showDesigns(designs, starts, vocabulary.mechanisms);
  }

  /** Compute and show the case with all models and laws. */
  async compareModels() {
    const { body } = this.#displayed;
    if (!body) return;
    byId("models").textContent = "computing …";
    try {
      const found = await sendPatiently("compare", body);
      if (body !== this.#displayed.body) {
        this.clearModels();
        return;
      }
      this.#displayed.models = found;
      byId("models").replaceChildren(this.#models.head, this.#models.place);
      this.#models.show(/** @type {any} */ (found.sheet));
    } catch (error) {
      byId("models").textContent = linesOf(error).join("; ");
    }
  }

  /** Remove the models and laws of another case. */
  clearModels() {
    delete this.#displayed.models;
    byId("models").textContent = "";
  }

  /**
   * Ask, and draw each line of the answer as it comes.
   *
   * @param {Question} asked
   */
  async #follow(asked) {
    const { body, beside, signal, start } = asked;
    /** Why a design has no answer. @type {Map<Body, unknown>} */
    const refused = new Map();
    let waiting = 2 * (1 + beside.length);
    let isWarm = false;
    /** @type {Promise<void> | undefined} */
    let judged;
    for await (const line of sendLines("answers", { ...body, beside: beside.map((one) => one.case) }, signal)) {
      if (signal.aborted) return;
      const { question, place } = line;
      if (question === "run" || question === "check") {
        const sent = place ? beside[place - 1] : body;
        if ("answer" in line) keep(question, sent, line.answer);
        else if (question === "run") refused.set(sent, new Problem(line.problem));
        waiting -= refused.has(sent) ? 2 : 1; // what is not run is not checked
      }
      if (place === 0) {
        if (question === "run") this.#showNumbers(/** @type {any} */ (line).answer, asked);
        else if (question === "check") judged = this.#showChecks(body);
        else await this.#drawLine(line, asked);
        if ("sweep" in line && isLate(line)) this.#goOn(line, asked).catch(fail(signal));
        isWarm ||= question === "cold_and_hot";
      }
      if (signal.aborted) return;
      if (waiting === 0) {
        waiting = -1;
        await this.#showTable(asked, refused);
      }
    }
    await judged;
    this.#drawRest();
    const { answer } = this.#displayed;
    if (signal.aborted || !answer) return;
    if (!isWarm) {
      temperatures.leaveOut(answer);
      hot.leaveOut();
    }
    await measurePaint("all", start, signal);
    if (signal.aborted) return;
    this.showBand(asked.band);
    localEngine.check(body, answer);
    localEngine.learn(body);
  }

  /**
   * Go on with a curve as a job, and draw it once it is there.
   *
   * @param {Late} line
   * @param {Question} asked
   */
  async #goOn({ question, place, sweep }, asked) {
    const { body, signal } = asked;
    /** @type {any} */
    let found;
    try {
      found = { answer: await goOn("sweep", { ...body, ...sweep }, signal) };
    } catch (error) {
      found = { problem: { title: "", lines: linesOf(error) } };
    }
    if (!signal.aborted) await this.#drawLine({ question, place, ...found }, asked);
  }

  /**
   * Show the numbers of the case.
   *
   * @param {Run} answer
   * @param {Question} asked
   */
  #showNumbers(answer, { body, whole, band: wanted, start, signal }) {
    const key = JSON.stringify(body);
    const { designs, asked, starts } = this.#displayed;
    /** @type {Displayed} */
    const before = this.#displayed.key === key ? this.#displayed : { band: null, starts, curves: {} };
    const { checks: checked, band, bandAlongSpeed } = before;
    this.#displayed = {
      body,
      whole,
      key,
      answer,
      checks: checked,
      band,
      bandAlongSpeed,
      designs,
      asked,
      starts,
      curves: {},
    };
    this.#rest();
    tell(body, answer);
    inputs.showAnswer(answer);
    results.succeed();
    if (wanted && !this.#displayed.band) this.#displayed.band = { state: "pending" };
    results.show(answer, this.#displayed);
    bath.show(answer);
    const isFirst = (/** @type {typeof PICTURES[number]} */ [id]) => isSeen(byId(id));
    for (const [, draw] of PICTURES.filter(isFirst)) draw(answer);
    this.#undrawn = PICTURES.filter((one) => !isFirst(one)).map(
      ([, draw]) =>
        () =>
          draw(answer),
    );
    const shown = painted();
    measurePaint("numbers", start, signal, shown);
    shown.then(() => this.#drawRest());
  }

  /**
   * Show the checks of the case, and the verdict that they lead to: those over its cycle, if it has one. Those that were
   * asked for before are cancelled.
   *
   * @param {Body} body
   */
  async #showChecks(body) {
    const signal = this.#judging.begin();
    const { answer, whole } = this.#displayed;
    if (!answer) return;
    /** @type {checks.Judged | undefined} */
    let checked = known("check", body);
    if (whole && isMoving(whole)) {
      try {
        checked = await checksOfCycle(whole, signal);
      } catch (error) {
        if (signal.aborted) return;
        throw error;
      }
      if (signal.aborted) return;
    }
    this.#displayed.checks = checked;
    results.show(answer, this.#displayed);
    checks.show(checked);
  }

  /** What draws a curve or the drawing, by its line and its places. @type {Record<string, Record<string, (answer: Run, found: any) => unknown>>} */
  #drawers = {
    over_speed: {
      "torque-chart": (answer) => this.#drawTorque(answer),
      "film-chart": (answer, found) => charts.film(found, answer),
      "stribeck-chart": (answer, found) => charts.stribeck(found, answer),
    },
    cold_and_hot: { temperatures: (answer, found) => temperatures.show(found, answer) },
    over_both: { "map-chart": (answer, found) => charts.map(found, answer) },
    over_load: { "pressure-chart": (answer, found) => charts.pressure(found, answer) },
    drawing: { drawing: (_, found) => drawings.show(found) },
  };

  /** @param {AnswerLine} line @param {Question} asked */
  async #drawLine(line, asked) {
    const { question } = line;
    // that of the case before
    if (question === "cold_and_hot" && ("problem" in line || !this.#displayed.curves.over_speed)) hot.leaveOut();
    for (const [id, draw] of Object.entries(this.#drawers[question])) {
      await this.#drawn(id, line, asked, (answer, found) => {
        this.#displayed.curves[question] = found;
        return draw(answer, found);
      });
      if (id === "torque-chart" && "answer" in line) measurePaint("chart", asked.start, asked.signal);
    }
    if (["over_speed", "cold_and_hot"].includes(question) && "answer" in line && !asked.signal.aborted) this.#showHot();
  }

  /**
   * Draw an answer, once what was drawn before is on the screen, or show why there is none.
   *
   * @param {string} id
   * @param {AnswerLine} line
   * @param {Question} asked
   * @param {(answer: Run, found: any) => unknown} draw
   */
  async #drawn(id, line, { signal }, draw) {
    if ("problem" in line) {
      if (isLate(line)) showWords(id, "Curve: goes on in the background …");
      else showFailure(id, new Problem(line.problem).lines.join("; "));
      return;
    }
    await nextTask();
    if (!signal.aborted && this.#displayed.answer) await draw(this.#displayed.answer, line.answer);
  }

  /**
   * Show all designs side by side, and add their bands where they are wanted.
   *
   * @param {Question} asked
   * @param {Map<Body, unknown>} refused why a design has no answer
   */
  async #showTable(asked, refused) {
    const { designs, body, band } = asked;
    /** @type {import("./compare.js").Answers} */
    const found = {};
    for (const [place, one] of designs.entries()) {
      const sent = isSame(one, body) ? body : one;
      found[LETTERS[place]] = refused.has(sent)
        ? { reason: reasonOf(refused.get(sent)) }
        : { run: known("run", one), ...(designs.length > 1 && { checks: known("check", one) }) };
    }
    this.#displayed.designs = found;
    this.#displayed.asked = asked;
    showDesigns(found, this.#displayed.starts, vocabulary.mechanisms);
    if (band && designs.length > 1 && !refused.has(body)) this.#addBands(asked);
  }

  /** Show the curves cold and hot, once the sweeps over the temperature and over the speed are both there. */
  #showHot() {
    const { body, answer, curves } = this.#displayed;
    const { cold_and_hot: table, over_speed: alongSpeed } = curves;
    if (body && answer && table && alongSpeed) hot.show(body, answer, table, alongSpeed);
  }

  /** Draw the torque over the speed, with its band where that is there. @param {Run} answer */
  #drawTorque(answer) {
    const { curves, band, bandAlongSpeed } = this.#displayed;
    const alongSpeed = curves.over_speed;
    return alongSpeed && charts.torque(alongSpeed, answer, vocabulary.mechanisms, band ? bandAlongSpeed : undefined);
  }

  /**
   * @param {Body} body
   * @param {Run} answer
   * @param {AbortSignal} signal
   */
  async #addBand(body, answer, signal) {
    /** @type {results.Band} */
    let found;
    try {
      found = { state: "done", answer: await askPatiently("band", body, signal) };
    } catch (error) {
      found = { state: "failed", lines: linesOf(error) };
      if (error instanceof Problem && error.isBusy && !signal.aborted) {
        after(BUSY_DELAY, signal, () => this.showBand(true)); // nobody has asked for it by hand
        return;
      }
    }
    if (signal.aborted) return;
    this.#displayBand(answer, found);
    if (found.state === "done") await this.#addBandAlongSpeed(body, answer, signal);
  }

  /** @param {Run} answer @param {results.Band | null} found */
  #displayBand(answer, found) {
    this.#displayed.band = found;
    results.show(answer, this.#displayed);
  }

  /**
   * The band of the torque over the speed, at some of the points of its curve.
   *
   * @param {Body} body
   * @param {Run} answer
   * @param {AbortSignal} signal
   */
  async #addBandAlongSpeed(body, answer, signal) {
    const alongSpeed = this.#displayed.curves.over_speed;
    if (!alongSpeed) return;
    const step = answer.loads ? STEP_OF_BAND.nut : STEP_OF_BAND.screw;
    const all = /** @type {number[]} */ (alongSpeed.axes.screw_speed.values);
    // counted from the ends of the chart, which have a band
    const speeds = all.filter((_, place) => Math.min(place, all.length - 1 - place) % step === 0);
    const vary = { screw_speed: `${speeds.join(", ")} rad/s` };
    /** @type {Sweep | string} */
    let found;
    try {
      found = await sendPatiently("sweep", { ...body, vary, outputs: ["screw_torque"], band: true }, signal);
    } catch (error) {
      if (signal.aborted) return;
      found = linesOf(error).join("; ");
    }
    if (signal.aborted || alongSpeed !== this.#displayed.curves.over_speed) return;
    this.#displayed.bandAlongSpeed = found;
    await this.#drawTorque(answer);
  }

  /**
   * The bands of the designs, one after the other, once typing has come to rest.
   *
   * @param {Question} asked
   */
  async #addBands({ designs, signal }) {
    await new Promise((resolve) => setTimeout(resolve, BAND_DELAY));
    for (const [place, body] of designs.entries()) {
      const one = this.#displayed.designs?.[LETTERS[place]];
      if (signal.aborted || !one?.run || !this.#displayed.band) continue;
      try {
        one.band = await askPatiently("band", body, signal);
      } catch {
        continue; // of this design there is none
      }
      const { designs: all, starts } = this.#displayed;
      if (!signal.aborted && all) showDesigns(all, starts, vocabulary.mechanisms);
    }
  }
}

export const answers = new Answers();
