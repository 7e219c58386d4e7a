// The card of a reversal: friction over the angle of the screw after it has turned round, by mechanism, and the numbers
// of models for controllers. It takes some seconds, so that it is asked for by its button.

import { element, scrollingTable } from "../dom.js";
import { documented } from "../help.js";
import { draw, layout } from "../plot.js";
import { text, textOr } from "../texts.js";
import * as units from "../units.js";
import { askedByButton } from "./asked_by_button.js";
import { ANGLE, data, GROWTH, quantity, TORQUE } from "./quantities.js";

/** @typedef {ReversalAnswer["results"]} Results */
/** @typedef {(number | null)[]} Values */

const CHART = "reversal-chart";
/** Colours of the parts, as the command draws with. @type {Record<string, string>} */
const COLOURS = {
  rolling: "#56B4E9",
  spin_and_curvature: "#D55E00",
  helix: "#0072B2",
  ball_to_ball: "#CC79A7",
  losses: "#009E73",
};
const STIFFNESS = quantity("N m/rad", "N m/rad");
const DAMPING = quantity("N m s/rad", "N m s/rad");

/** The name of a part. @param {string} name */
function part(name) {
  return textOr(`reversal.part.${name}`, name);
}

/** A share in percent. @param {number | null} share */
function percent(share) {
  return `${units.digits(100 * Number(share), 2)}\u00a0%`;
}

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const chart = element("div", { id: CHART, class: "chart low", hidden: true });
  const page = documented("howto/reversal", `${text("reversal.how_to")}.`);
  const about = [`${text("reversal.hypothesis")} `, page];
  return askedByButton(holder, "reversal", about, "reversal.start", [chart], ({ results }) => {
    draw(CHART, picture(results));
    return [swing(results), models(results)];
  });
}

/**
 * The parts and all friction over the angle, which is logarithmic: what is at angle zero stands in the numbers alone.
 *
 * @param {Results} results
 * @returns {import("../plot.js").Chart}
 */
function picture(results) {
  const { screw_angle: angle, screw_torque: torque, travel } = results;
  const parts = Object.entries(results.contributions);
  const there = parts.filter(([, values]) => values.some(Boolean));
  const x = ANGLE.titled(text("reversal.angle"));
  const y = TORQUE.titled(text("reversal.torque"));
  /** @param {Values} values */
  const drawn = (values) => values.filter((_, place) => Number(angle[place]) > 0);
  const angles = ANGLE.all(drawn(angle));
  /** @param {string} name @param {Values} values @param {string} colour @param {number} width */
  const line = (name, values, colour, width) => ({
    x: angles,
    y: TORQUE.all(drawn(values)),
    name,
    mode: "lines",
    line: { color: colour, width },
    hovertemplate: "%{y:.4g}",
  });
  return {
    name: "friction_after_a_reversal",
    caption: text("reversal.caption"),
    description: text("reversal.description", {
      angle: ANGLE.text(angle.at(-1), 3),
      first: TORQUE.text(torque[0], 3),
      last: TORQUE.text(torque.at(-1), 3),
    }),
    figure: (colours) => ({
      traces: [
        ...there.map(([name, values]) => line(part(name), values, COLOURS[name], 2)),
        line(text("reversal.all"), torque, colours.ink, 3),
      ],
      layout: layout(colours, x, y, { xaxis: { type: "log", dtick: 1 }, yaxis: { rangemode: "normal" } }),
    }),
    legend: (colours) => [
      ...there.map(([name]) => ({ kind: "line", name: part(name), colour: COLOURS[name] })),
      { kind: "line", name: text("reversal.all"), colour: colours.ink },
    ],
    numbers: () => [
      [
        x,
        GROWTH.titled(text("reversal.travel")),
        ...there.map(([name]) => TORQUE.titled(part(name))),
        TORQUE.titled(text("reversal.all")),
      ],
      angle.map((at, place) => [
        ANGLE.convert(at),
        GROWTH.convert(travel[place]),
        ...there.map(([, values]) => TORQUE.convert(values[place])),
        TORQUE.convert(torque[place]),
      ]),
    ],
  };
}

/** Where shares of the swing are back, of all friction and by mechanism. @param {Results} results */
function swing(results) {
  const { swing: whole } = results;
  const parts = Object.entries(results.swing_by_mechanism);
  /** @param {string} name @param {string} label @param {Results["swing"]} places */
  const row = (name, label, places) => [
    label,
    ...places.map(({ share, screw_angle: angle }) =>
      data(
        `${name}-${Math.round(100 * Number(share))}`,
        angle,
        angle === 0 ? text("reversal.at_once") : ANGLE.text(angle, 3),
      ),
    ),
  ];
  const rows = [
    row("all", text("reversal.all"), whole),
    ...parts.map(([name, places]) => row(name, part(name), places)),
  ];
  const caption = text("reversal.swing");
  return scrollingTable(caption, [text("reversal.of"), ...whole.map((one) => percent(one.share))], rows);
}

/** The models that are fitted, each with its largest error. @param {Results} results */
function models(results) {
  const { dahl_first: first, dahl, lugre, slip_elements: elements } = results;
  /** @param {string} name @param {string} label @param {Results["dahl"] | Results["lugre"]} fit */
  const row = (name, label, { model, error }) => [
    label,
    data(`${name}-stiffness`, model.presliding_stiffness, STIFFNESS.text(model.presliding_stiffness, 3)),
    TORQUE.text(model.coulomb_torque, 3),
    percent(error.largest),
  ];
  const damping = DAMPING.text(lugre.model.micro_damping, 3);
  const slope = DAMPING.text(lugre.model.viscous_slope, 3);
  const rows = [
    ...(first ? [row("dahl_first", text("reversal.dahl_first"), first)] : []),
    row("dahl", text("reversal.dahl"), dahl),
    row("lugre", text("reversal.lugre", { damping, slope }), lugre),
    ...elements.map(({ elements: all, error }) => [
      text("reversal.elements", { count: all.length }),
      all.map((one) => STIFFNESS.text(one.stiffness, 3)).join("; "),
      all.map((one) => TORQUE.text(one.slip_torque, 3)).join("; "),
      percent(error.largest),
    ]),
  ];
  const caption = text("reversal.models");
  const headings = [text("reversal.model"), text("reversal.stiffness"), text("reversal.sliding"), text("reversal.off")];
  const beside = text("reversal.beside", { torque: TORQUE.text(results.at_once, 3) });
  return element("div", {}, scrollingTable(caption, headings, rows), element("p", { class: "small" }, beside));
}
