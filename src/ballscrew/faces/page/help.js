// Help for the field that has the focus: what its annotation says, and the page of the theory.

import { element } from "./dom.js";
import { labelIn } from "./fields.js";
import { fieldOf } from "./schema.js";
import { symbol } from "./symbols.js";
import { vocabulary } from "./vocabulary.js";

/** Headings of the pages of the theory. @type {Record<string, string>} */
const PAGES_IN_WORDS = {
  balance: "The balance of the ball, and the torques on screw and nut",
  efficiency: "Efficiency, back-driving, self-locking",
  film: "The film, and the film parameter",
  friction: "Sliding friction: asperities and film share the load",
  geometry: "Geometry and kinematics",
  hertz: "Hertz contact",
  life: "Ratings, life, and heat",
  nut: "The nut: preload, and the load of each ball",
  rolling: "Rolling resistance: oil and steel",
  slip: "Slip in the contact",
};

/** Pages of the theory, by field, or else by section. @type {Record<string, string>} */
const PAGES = {
  operation: "efficiency",
  screw: "geometry",
  "screw.screw_conformity": "hertz",
  "screw.nut_conformity": "hertz",
  "screw.ball_material": "hertz",
  "screw.screw_material": "hertz",
  "screw.nut_material": "hertz",
  "screw.ball_roughness": "film",
  "screw.screw_roughness": "film",
  "screw.nut_roughness": "film",
  "screw.dynamic_load_rating": "life",
  "screw.static_load_rating": "life",
  nut: "nut",
  lubricant: "film",
  model: "balance",
  "model.frame": "geometry",
  "model.hertz": "hertz",
  "model.film": "film",
  "model.film_parameter": "film",
  "model.inlet": "film",
  "model.friction": "friction",
  "model.full_film": "friction",
  "model.rolling": "rolling",
  "model.elastic_resistance": "rolling",
  "model.slip": "slip",
  "model.pure_rolling_offset": "slip",
  "model.ideal_torque": "efficiency",
  losses: "nut",
  installation: "life",
  limits: "life",
  bodies: "nut",
  deviations: "nut",
};

/**
 * The place of the help, at the lower end of the form.
 *
 * @param {HTMLElement} form
 */
export function placeIn(form) {
  const before = form.querySelector("#help");
  if (before) return before;
  const place = element("aside", { id: "help", "aria-label": "Help", hidden: true });
  form.addEventListener("focusin", ({ target }) => follow(place, target));
  return place;
}

/** @param {HTMLElement} place @param {EventTarget | null} target */
function follow(place, target) {
  const field = target instanceof Element ? target.closest("[data-path]") : null;
  const path = field instanceof HTMLElement ? field.dataset.path : undefined;
  if (path) show(place, path);
  else if (!(target instanceof Node && place.contains(target))) place.hidden = true;
}

/**
 * Show the help of a field.
 *
 * @param {HTMLElement} place
 * @param {string} path
 */
function show(place, path) {
  const { description = "", "x-symbol": tex, "x-hint": hint } = fieldOf(path) ?? {};
  const help = description;
  const advice = hint ?? "";
  place.hidden = false;
  place.replaceChildren(
    element("p", {}, element("strong", {}, labelIn(path)), symbol(tex), help ? `: ${help}` : ""),
    advice ? element("p", {}, advice) : "",
    element("p", {}, theoryOf(path)),
  );
}

/** The page of the theory of a field: a link where the documentation has an address. @param {string} path */
function theoryOf(path) {
  const [section, field] = path.split(".");
  const page = PAGES[`${section}.${field}`] ?? PAGES[section];
  if (!page) return "";
  return documented(`theory/${page}`, `Theory: ${PAGES_IN_WORDS[page] ?? page}`);
}

/**
 * A page of the documentation by its name: a link where the documentation has an address, else the words alone.
 *
 * @param {string} page
 * @param {string} words
 */
export function documented(page, words) {
  const { documentation } = vocabulary;
  if (!documentation) return words;
  const address = `${documentation.replace(/\/$/, "")}/${page}.html`;
  return element("a", { href: address, target: "_blank", rel: "noreferrer" }, words);
}
