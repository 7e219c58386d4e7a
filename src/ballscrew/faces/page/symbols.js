// Symbols of quantities, written in TeX in the schema, as elements.

import { element } from "./dom.js";

/** @type {Record<string, string>} */
const LETTERS = {
  alpha: "α",
  beta: "β",
  Delta: "Δ",
  delta: "δ",
  eta: "η",
  kappa: "κ",
  lambda: "λ",
  Lambda: "Λ",
  mu: "µ",
  nu: "ν",
  omega: "ω",
  phi: "φ",
  varphi: "φ",
  Phi: "Φ",
  pi: "π",
  rho: "ρ",
  sigma: "σ",
  tau: "τ",
  theta: "θ",
};

/**
 * A symbol of one letter and an index; nothing where it has more.
 *
 * @param {string | undefined} tex
 */
export function symbol(tex) {
  if (!tex) return null;
  const text = tex.replace(/\\([A-Za-z]+)/g, (whole, name) => LETTERS[name] ?? whole);
  const parts = /^([^_{}\\^]+)(?:_(?:\{([^_{}\\^]+)\}|([^_{}\\^]+)))?$/.exec(text);
  if (!parts) return null;
  const index = parts[2] ?? parts[3];
  const letters = element("i", {}, parts[1].trim());
  return element("span", { class: "symbol", "aria-hidden": "true" }, letters, index ? element("sub", {}, index) : null);
}
