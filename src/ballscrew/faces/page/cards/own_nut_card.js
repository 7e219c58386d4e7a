// The card of a nut of one's own, which becomes a design.

import * as designs from "../designs.js";
import { byId, element } from "../dom.js";
import { ownNut } from "../own_nut.js";
import { LETTERS } from "../state.js";
import { store } from "../store.js";

/** @param {HTMLElement} holder */
export function setUp(holder) {
  const place = element("div");
  const words = element("p", { "aria-live": "polite" });
  holder.replaceChildren(place, words);
  const { follow } = ownNut(place, async (tables, name) => {
    const left = designs.add([await designs.ofCase(tables, { name })]);
    words.textContent = left
      ? `The page holds ${LETTERS.length} designs. There was no place for ${name}.`
      : `Added as design ${LETTERS[store.state.show]}: ${name}.`;
    if (!left) byId("results").scrollIntoView();
  });
  return { follow };
}
