// Charts of a cycle: its motion, the torque of the motor by cause, and the torque over speed on the motor's curve.

import { draw, layout } from "../plot.js";
import { text } from "../texts.js";
import { POSITION, SPEED, TIME, TORQUE, TURNING } from "./quantities.js";

/** @typedef {DutyAnswer["results"]} Results */

const DASHED = { dash: "dash", width: 1.5 };
const DOTTED = { dash: "dot", width: 1.5 };

/** The places of the charts. */
export const PLACES = ["duty-motion-chart", "duty-torque-chart", "duty-curve-chart"];

/**
 * @param {Results} results
 * @param {Vocabulary["causes"]} causes
 */
export function show(results, causes) {
  motion(results);
  torque(results, causes);
  curve(results);
}

/**
 * The torques by mechanics, as the states have them, where the numbers above may be by the rule of catalogues.
 *
 * @param {Results} results
 * @returns {{ torque_rms: number, torque_peak: number }}
 */
function byMechanics(results) {
  return /** @type {Record<string, any>} */ (results).rules.mechanics;
}

/** Position and speed over the time of a cycle. @param {Results} results */
function motion({ cycle }) {
  const time = TIME.all(cycle.time);
  const lines = [
    { name: text("duty.speed"), values: SPEED.all(cycle.speed), titled: SPEED.titled },
    { name: text("duty.position"), values: POSITION.all(cycle.position), titled: POSITION.titled },
  ];
  const [speed, position] = lines;
  draw("duty-motion-chart", {
    name: "motion",
    caption: text("duty.motion_caption"),
    description: text("duty.motion_description", { time: TIME.text(cycle.time.at(-1)) }),
    figure: (colours) => ({
      traces: [
        {
          x: time,
          y: speed.values,
          name: speed.name,
          mode: "lines",
          line: { color: colours.accent, width: 2 },
          hovertemplate: "%{y:.4g}",
        },
        {
          x: time,
          y: position.values,
          name: position.name,
          yaxis: "y2",
          mode: "lines",
          line: { color: colours.second, ...DASHED },
          hovertemplate: "%{y:.4g}",
        },
      ],
      layout: layout(colours, TIME.titled(text("duty.time")), speed.titled(speed.name), {
        margin: { l: 72, r: 72, t: 8, b: 42 },
        yaxis: { rangemode: "normal" },
        yaxis2: {
          title: { text: position.titled(position.name), standoff: 6 },
          overlaying: "y",
          tickmode: "auto",
          side: "right",
          showgrid: false,
          zeroline: false,
          linecolor: colours.line,
          tickformat: ".6~g",
          nticks: 7,
        },
      }),
    }),
    legend: (colours) => [
      { kind: "line", name: speed.name, colour: colours.accent },
      { kind: "dash", name: position.name, colour: colours.second },
    ],
    numbers: () => [
      [TIME.titled(text("duty.time")), ...lines.map(({ name, titled }) => titled(name))],
      time.map((at, place) => [at, ...lines.map(({ values }) => values[place])]),
    ],
  });
}

/**
 * The torque of the motor over the time of a cycle, by cause.
 *
 * @param {Results} results
 * @param {Vocabulary["causes"]} causes
 */
function torque(results, causes) {
  const { cycle } = results;
  const { torque_rms: rms } = byMechanics(results);
  const time = TIME.all(cycle.time);
  const parts = Object.entries(cycle.torque_by).map(([name, values]) => ({
    name: causes[name]?.words ?? name,
    values: TORQUE.all(values),
    colour: causes[name]?.colour,
  }));
  const sum = { name: text("duty.motor_torque"), values: TORQUE.all(cycle.torque) };
  const level = TORQUE.convert(rms);
  const ends = [time[0], time.at(-1) ?? null];
  draw("duty-torque-chart", {
    name: "torque_of_the_motor",
    caption: text("duty.torque_caption"),
    description: text("duty.torque_description", { rms: TORQUE.text(rms) }),
    figure: (colours) => ({
      traces: [
        ...parts.map(({ name, values, colour }) => ({
          x: time,
          y: values,
          name,
          mode: "lines",
          line: { color: colour, width: 1.5 },
          hovertemplate: "%{y:.4g}",
        })),
        {
          x: time,
          y: sum.values,
          name: sum.name,
          mode: "lines",
          line: { color: colours.ink, width: 2 },
          hovertemplate: "%{y:.4g}",
        },
        {
          x: ends,
          y: [level, level],
          name: text("duty.rms"),
          mode: "lines",
          line: { color: colours.ink, ...DOTTED },
          hoverinfo: "skip",
        },
      ],
      layout: layout(colours, TIME.titled(text("duty.time")), TORQUE.titled(text("duty.torque")), {
        yaxis: { rangemode: "normal" },
      }),
    }),
    legend: (colours) => [
      { kind: "line", name: sum.name, colour: colours.ink },
      ...parts.map(({ name, colour }) => ({ kind: "line", name, colour })),
      { kind: "dash", name: `${text("duty.rms")} ${TORQUE.text(rms)}`, colour: colours.ink },
    ],
    numbers: () => [
      [TIME.titled(text("duty.time")), ...[sum, ...parts].map(({ name }) => TORQUE.titled(name))],
      time.map((at, place) => [at, ...[sum, ...parts].map(({ values }) => values[place])]),
    ],
  });
}

/**
 * The torque over the speed of the motor, within its curve where the case has a motor.
 *
 * @param {Results} results
 */
function curve(results) {
  const { cycle, motor } = results;
  const { torque_rms: rms, torque_peak: peak } = byMechanics(results);
  const speed = TURNING.all(cycle.motor_speed);
  const values = TORQUE.all(cycle.torque);
  const inBath = cycle.flooded_torque ? TORQUE.all(cycle.flooded_torque) : null;
  const level = TORQUE.convert(rms);
  const known = motor?.curve;
  const top = known ? Math.max(...known.speed) : Math.max(...cycle.motor_speed.map((one) => Math.abs(one ?? 0)));
  const ends = TURNING.all([-top, top]);
  // the curve for both directions, from one end of the speeds to the other
  const along = known ? TURNING.all([...known.speed.map((one) => -one).toReversed(), ...known.speed]) : [];
  const limit = known ? TORQUE.all([...known.peak_torque.toReversed(), ...known.peak_torque]) : [];
  const rated = TORQUE.convert(known?.rated_torque);
  const names = {
    cycle: text("duty.states"),
    peak: text("duty.peak"),
    rated: text("duty.rated"),
    rms: text("duty.rms"),
    largest: text("duty.largest"),
    bath: text("bath.line"),
  };
  const sizes = cycle.torque.map((one) => Math.abs(one ?? 0));
  const worst = sizes.indexOf(Math.max(...sizes));
  const x = TURNING.titled(text("duty.motor_speed"));
  const y = TORQUE.titled(text("duty.torque"));
  /** @param {number | null} value */
  const opposite = (value) => (value === null ? null : -value);
  draw("duty-curve-chart", {
    name: "torque_over_speed_of_the_motor",
    caption: text("duty.curve_caption"),
    description: text("duty.curve_description", { rms: TORQUE.text(rms), peak: TORQUE.text(peak) }),
    figure: (colours) => ({
      traces: [
        ...(known
          ? [1, -1].flatMap((sign) => [
              {
                x: along,
                y: sign > 0 ? limit : limit.map(opposite),
                name: names.peak,
                mode: "lines",
                showlegend: sign > 0,
                line: { color: "#D55E00", width: 2 },
                hoverinfo: "skip",
              },
              {
                x: ends,
                y: [rated, rated].map((one) => (sign > 0 ? one : opposite(one))),
                name: names.rated,
                mode: "lines",
                showlegend: sign > 0,
                line: { color: "#E69F00", ...DASHED },
                hoverinfo: "skip",
              },
            ])
          : []),
        {
          x: ends,
          y: [level, level],
          name: names.rms,
          mode: "lines",
          line: { color: colours.ink, ...DOTTED },
          hoverinfo: "skip",
        },
        ...(inBath
          ? [
              {
                x: speed,
                y: inBath,
                name: names.bath,
                mode: "markers",
                marker: { color: "#0072B2", size: 6, symbol: "circle-open" },
                hovertemplate: "%{x:.4g}, %{y:.4g}<extra></extra>",
              },
            ]
          : []),
        {
          x: speed,
          y: values,
          name: names.cycle,
          mode: "markers",
          marker: { color: colours.accent, size: 6 },
          hovertemplate: "%{x:.4g}, %{y:.4g}<extra></extra>",
        },
        {
          x: [speed[worst]],
          y: [values[worst]],
          name: names.largest,
          mode: "markers",
          marker: { symbol: "diamond", size: 11, color: colours.panel, line: { color: colours.ink, width: 2.5 } },
          hovertemplate: "%{x:.4g}, %{y:.4g}<extra></extra>",
        },
      ],
      layout: layout(colours, x, y, {
        hovermode: "closest",
        yaxis: { rangemode: "normal" },
        xaxis: { rangemode: "normal" },
      }),
    }),
    legend: (colours) => [
      { kind: "area", name: names.cycle, colour: colours.accent },
      ...(inBath ? [{ kind: "point", name: names.bath, colour: "#0072B2" }] : []),
      { kind: "point", name: `${names.largest} ${TORQUE.text(peak)}`, colour: colours.ink },
      { kind: "dash", name: `${names.rms} ${TORQUE.text(rms)}`, colour: colours.ink },
      ...(known
        ? [
            { kind: "line", name: `${names.peak} ${TORQUE.text(Math.max(...known.peak_torque))}`, colour: "#D55E00" },
            { kind: "dash", name: `${names.rated} ${TORQUE.text(known.rated_torque)}`, colour: "#E69F00" },
          ]
        : []),
    ],
    numbers: () => [
      [x, y, ...(inBath ? [`${y}, ${names.bath}`] : [])],
      speed.map((at, place) => [at, values[place], ...(inBath ? [inBath[place]] : [])]),
    ],
  });
}
