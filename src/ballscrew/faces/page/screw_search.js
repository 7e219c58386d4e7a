// The search over all screws of the catalogue, above the form: a size, a part of a name, or an order code.

import { button, namedButton } from "./controls.js";
import { byId, element } from "./dom.js";
import { rowLabel } from "./form.js";
import { startFrom } from "./inputs.js";
import { screwsFor } from "./part_search.js";
import * as views from "./views.js";
import { vocabulary } from "./vocabulary.js";

/** Rows that are listed at most. */
const MOST_ROWS = 8;

/** Build the search: it stays as it is, whatever is chosen in it. */
export function setUp() {
  const rows = new Map(vocabulary.rows.map((row) => [row.name, row]));
  const searched = Object.fromEntries(vocabulary.rows.map((row) => [row.name, { ...row, kind: row.nut }]));
  const list = element("ul", { class: "found" });
  const count = element("p", { class: "small", id: "search-count", role: "status" });
  const input = element("input", {
    type: "search",
    id: "search",
    autocomplete: "off",
    placeholder: "Search: 40x10, rexroth double",
    "aria-label": "Search all screws: a size, a part of a name, an order code",
    oninput: show,
  });
  input.addEventListener("keydown", (event) => {
    const first = matching().names.find((name) => !rows.get(name)?.refusal);
    if (event.key !== "Enter" || !first) return;
    event.preventDefault();
    take(first);
  });

  function matching() {
    return screwsFor(input.value, searched);
  }

  /** @param {string} name */
  function take(name) {
    startFrom(name);
    input.value = "";
    show();
    input.focus(); // the button is gone
  }

  /** @param {string} name */
  function item(name) {
    const row = rows.get(name);
    if (!row) return null;
    const choose = row.refusal
      ? element("span", {}, `${rowLabel(row)}: ${row.refusal}`)
      : button(rowLabel(row), () => take(name), { "data-row": name });
    return element("li", {}, choose, " ", element("span", { class: "small" }, row.source));
  }

  function show() {
    const words = input.value.trim();
    const { names, isCode } = matching();
    list.replaceChildren(...names.slice(0, MOST_ROWS).flatMap((name) => item(name) ?? []));
    if (!words) count.textContent = "";
    else if (!names.length) count.textContent = `No screw of the catalogue is about ${words}.`;
    else
      count.textContent = isCode
        ? `${words} is not in the catalogue; ${names.length} of its size are:`
        : `${names.length} of ${rows.size} screws${names.length > MOST_ROWS ? `; the first ${MOST_ROWS}:` : ""}`;
  }

  const own = namedButton("search-own", "A nut that is not listed …", () => views.go("choose.own"));
  byId("screw-search").replaceChildren(input, count, list, own);
}
