// Units: what is kept is text with a unit, as it was typed; only what is shown is converted.

const NUMBER = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(.*?)\s*$/i;
const SPOKEN = { um: "µm", uin: "µin", degC: "°C", degF: "°F", deg: "°", "N m": "N·m", "N mm": "N·mm", "lbf in": "lbf·in",
  "mPa s": "mPa·s", "Pa s": "Pa·s", "N/um": "N/µm",
  "kg/m^3": "kg/m³", "W/(m K)": "W/(m·K)", "J/(kg K)": "J/(kg·K)", "1/m^2": "1/m²", "mm rpm": "mm·rpm", "m rad/s": "m·rad/s" };
const LIKE = { preload_drag: "screw_torque" };

let vocabulary;
let system = "metric";

export function learn(words) { vocabulary = words; }
export function setSystem(name) { system = Object.hasOwn(vocabulary.systems, name) ? name : "metric"; }
export function currentSystem() { return system; }

/** A unit as people write it. */
export function spoken(unit) { return SPOKEN[unit] ?? unit; }

/** The unit that takes the place of another one in the system chosen. */
export function unitHere(unit) { return vocabulary.systems[system][unit] ?? unit; }

/** The units people use for a quantity, by its SI unit. */
export function choices(si) { return (si && vocabulary.units[si]) || []; }

/** Whether a field, as the schema has it, can be shown in a unit. */
export function isUnit(unit, field) { return Boolean(field?.["x-si-unit"] && entry(unit, field["x-si-unit"])); }

function entry(unit, si) { return choices(si).find((one) => one.unit === unit); }

export function toSI(number, unit, si) {
  const one = entry(unit, si);
  return one ? number * one.factor + one.offset : number;
}

export function fromSI(value, unit, si) {
  const one = entry(unit, si);
  return one ? (value - one.offset) / one.factor : value;
}

/** A plain number with a unit, taken apart; nothing where it is something else (a distribution, say). */
export function taken(text, si) {
  const match = NUMBER.exec(String(text));
  if (!match) return null;
  const unit = match[2].replace("µ", "u").replace("°C", "degC").replace("°F", "degF").replace(/^°$/, "deg").replace("·", " ");
  return entry(unit, si) ? { number: Number(match[1]), digits: match[1], unit } : null;
}

/** The digits of a kept text in another unit; those that were typed where it is the unit they were typed in. */
export function digitsIn(text, unit, si) {
  const found = taken(text, si);
  if (!found) return null;
  if (found.unit === unit) return found.digits;
  return String(Number(fromSI(toSI(found.number, found.unit, si), unit, si).toPrecision(10)));
}

/** A number to so many digits, without needless zeros. */
export function digits(value, count = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const rounded = Number(value.toPrecision(count));
  return Math.abs(rounded) >= 1e6 || (rounded !== 0 && Math.abs(rounded) < 1e-4)
    ? rounded.toExponential().replace("e+", "e") : String(rounded);
}

/** What is known of a result; some go by the name of another one. */
function resultOf(name) { return vocabulary.results[LIKE[name] ?? name]; }

/** The unit in which a result is shown, and its value there. */
export function shownUnit(name) {
  const known = resultOf(name);
  return known && known.unit !== "1" ? unitHere(known.shown_in) : "";
}

export function inShownUnit(name, value) {
  const known = resultOf(name);
  if (!known || known.unit === "1" || value === null) return value;
  return fromSI(value, unitHere(known.shown_in), known.unit);
}

/** A result as text with its unit. */
export function shown(name, value, count = 4) {
  const unit = shownUnit(name);
  const text = digits(inShownUnit(name, value), count);
  return unit && text !== "–" ? `${text} ${spoken(unit)}` : text;
}

/** A sentence of the program in the units chosen: its numbers converted, its units as people write them. */
export function sentence(text) {
  const known = Object.keys(vocabulary.systems.inch).concat("µm").sort((a, b) => b.length - a.length);
  const pattern = new RegExp(`(?<![\\w.])([-+]?\\d+(?:\\.\\d+)?(?:e[-+]?\\d+)?) (${known.join("|")})(?![\\w/])`, "g");
  return text.replace(pattern, (_, number, written) => {
    const unit = written.replace("µ", "u"), here = unitHere(unit);
    const si = Object.keys(vocabulary.units).find((name) => entry(unit, name));
    return here === unit ? `${number.includes("e") ? digits(Number(number)) : number} ${spoken(unit)}` : `${digits(fromSI(toSI(Number(number), unit, si), here, si))} ${spoken(here)}`;
  });
}

/** A heading of an axis or a column: what it is and its unit. */
export function heading(name, words) {
  const unit = shownUnit(name);
  return unit ? `${words} (${spoken(unit)})` : words;
}
