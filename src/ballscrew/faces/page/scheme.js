// The colours of the page, light or dark: those of the system until others are chosen here, and light ones on paper.

import { drawOnScreen } from "./chart_place.js";
import { byId } from "./dom.js";

const KEPT = "ballscrew-scheme";
const SYSTEM = matchMedia("(prefers-color-scheme: dark)");
const SCHEMES = ["light", "dark"];

/** What was chosen; nothing where the browser keeps nothing. */
function chosen() {
  try {
    return localStorage.getItem(KEPT) ?? "";
  } catch {
    return "";
  }
}

function show() {
  const kept = chosen();
  const scheme = SCHEMES.includes(kept) ? kept : SCHEMES[Number(SYSTEM.matches)];
  if (document.documentElement.dataset.scheme === scheme) return;
  document.documentElement.dataset.scheme = scheme;
  drawOnScreen();
}

/** Follow the system, and the button. */
export function followScheme() {
  show();
  SYSTEM.addEventListener("change", show);
  byId("scheme").addEventListener("click", () => {
    const other = SCHEMES[Number(document.documentElement.dataset.scheme === "light")];
    try {
      localStorage.setItem(KEPT, other);
    } catch {
      document.documentElement.dataset.scheme = other; // until the page is closed
      drawOnScreen();
    }
    show();
  });
}
