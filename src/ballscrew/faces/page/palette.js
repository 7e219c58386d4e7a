// Colours of charts: those of the page, which has two sets of them, of paper, and of what sheets name.

/** Colours by name. @typedef {Record<string, string>} Palette */

/** Colours that sheets name, but for ink; told apart with any colour vision. @type {Palette} */
const OF_SHEETS = {
  grey: "#888888",
  blue: "#0072B2",
  orange: "#E69F00",
  green: "#009E73",
  purple: "#CC79A7",
  sky: "#56B4E9",
  red: "#D55E00",
  yellow: "#C9B800",
};
const OF_PAGE = ["ink", "soft", "line", "panel", "accent", "second", "careful"];
/** Colours of what is printed or saved: light, whatever the screen is. @type {Palette} */
export const PAPER = {
  ...OF_SHEETS,
  ink: "#1c2127",
  soft: "#535c66",
  line: "#d5dade",
  panel: "#ffffff",
  accent: "#0062a0",
  second: "#a34a00",
  careful: "#8f2d00",
};

/** The colours of the screen, once they were read. @type {{ palette?: Palette }} */
const screen = {};

/** The colours of the screen, which are read once for each set of them. @returns {Palette} */
export function ofScreen() {
  screen.palette ??= readScreen();
  return screen.palette;
}

/** @returns {Palette} */
function readScreen() {
  const style = getComputedStyle(document.documentElement);
  const own = OF_PAGE.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]);
  return { ...OF_SHEETS, ...Object.fromEntries(own) };
}

/** Read the colours of the screen again. */
export function forget() {
  screen.palette = undefined;
}

/** The colour of a name of the palette, or itself. @param {string} colour @param {Palette} palette */
export function shade(colour, palette) {
  return palette[colour] ?? colour;
}

/** A colour between those of a scale. @param {number} share @param {string[]} colours #rrggbb */
export function colourAt(share, colours) {
  const place = Math.min(1, Math.max(0, share)) * (colours.length - 1);
  const first = Math.min(colours.length - 2, Math.floor(place));
  const channel = (/** @type {number} */ start) => {
    const [low, high] = [colours[first], colours[first + 1]].map((colour) =>
      Number.parseInt(colour.slice(start, start + 2), 16),
    );
    return Math.round(low + (high - low) * (place - first))
      .toString(16)
      .padStart(2, "0");
  };
  return `#${channel(1)}${channel(3)}${channel(5)}`;
}

/** Test whether a text on a colour has to be light. @param {string} colour #rrggbb */
export function isDark(colour) {
  const [red, green, blue] = [1, 3, 5].map((start) => Number.parseInt(colour.slice(start, start + 2), 16));
  return 0.3 * red + 0.59 * green + 0.11 * blue < 128;
}
