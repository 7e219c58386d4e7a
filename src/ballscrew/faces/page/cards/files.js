// The card of files: designs by name, projects, screws of one's own, and what stays in this browser.

import * as designs from "../designs.js";
import { button, textField } from "../controls.js";
import { byId, element, scrollingTable } from "../dom.js";
import { keeping, WHEN } from "../keeping.js";
import { takeRow } from "../opening.js";
import { save } from "../saving.js";
import { linesOf, send } from "../server.js";
import { LETTERS } from "../state.js";
import { store } from "../store.js";
import { NOT_KEPT } from "../names.js";

/** Kinds of project files. */
const KINDS = ["toml", "json"];

/** @param {HTMLElement} holder */
export function setUp(holder) {
  const list = element("div", { id: "design-list" });
  const rows = element("div", { id: "own-rows" });
  const works = element("div", { id: "kept-list" });
  const said = element("p", { id: "files-words", "aria-live": "polite" });
  /** @param {string} words */
  const say = (words) => {
    said.textContent = words;
  };
  const projects = KINDS.map((kind) =>
    button(`Project as ${kind.toUpperCase()}`, () => saveProject(kind, say), { class: "of-server" }),
  );
  holder.replaceChildren(
    element(
      "p",
      { class: "small" },
      "A case (TOML, JSON), a project, or a table of your own screws (CSV, XLSX) can also be dropped anywhere on the page. Undo takes back all of it.",
    ),
    button("Open file …", () => byId("open").click()),
    list,
    element("p", { class: "actions" }, ...projects),
    said,
    rows,
    element("h3", {}, "Kept in this browser"),
    works,
  );
  /** The letters and titles that the list was made of. */
  let shown = "";
  /** The table whose screws are listed. @type {typeof store.state.table} */
  let listed;
  const follow = () => {
    const { designs: all, show } = store.state;
    const key = JSON.stringify([
      all.map((one) => [designs.titleOf({ ...one, name: "" }), Object.keys(one.aside ?? {})]),
      show,
    ]);
    if (key !== shown) list.replaceChildren(listOfDesigns());
    shown = key;
    for (const [place, one] of all.entries()) {
      const field = /** @type {HTMLInputElement} */ (byId(`name-${LETTERS[place]}`));
      if (field !== document.activeElement) field.value = one.name ?? "";
    }
    if (store.state.table !== listed) showOwnRows(rows, say);
    listed = store.state.table;
    showKept(works);
  };
  keeping.addEventListener("change", () => showKept(works));
  follow();
  return { follow };
}

function listOfDesigns() {
  const { designs: all, show } = store.state;
  const rows = all.map((one, place) => {
    const letter = LETTERS[place];
    const asides = Object.keys(one.aside ?? {});
    /** @param {string} words @param {() => void} action @param {boolean} disabled */
    const act = (words, action, disabled) => button(words, action, { disabled, "aria-label": `${words} ${letter}` });
    const field = textField(one.name ?? "", (typed) => designs.rename(place, typed.trim()), {
      id: `name-${letter}`,
      maxlength: 80,
      "aria-label": `name of design ${letter}`,
    });
    return [
      letter,
      field,
      element(
        "span",
        {},
        designs.titleOf({ ...one, name: "" }),
        asides.length ? element("span", { class: "small" }, ` (kept aside: ${asides.join(", ")})`) : null,
      ),
      element(
        "span",
        { class: "actions" },
        act("Show", () => designs.show(place), place === show),
        act("Copy", () => designs.duplicate(place), !designs.hasRoom()),
        act("Delete", () => designs.remove(place), all.length === 1),
      ),
    ];
  });
  const found = scrollingTable("designs on this page", ["design", "name", "starts from", "what to do"], rows);
  found.querySelector("table")?.classList.add("left");
  return found;
}

/**
 * @param {string} kind
 * @param {(words: string) => void} say
 */
async function saveProject(kind, say) {
  try {
    const response = await send(`project?kind=${kind}`, { designs: await designs.forProject() });
    save(`-project.${kind}`, await response.blob());
    say(`Project as ${kind.toUpperCase()} saved`);
  } catch (error) {
    say(linesOf(error).join("; "));
  }
}

/**
 * The screws of the table that was opened, each to be taken as a design.
 *
 * @param {HTMLElement} holder
 * @param {(words: string) => void} say
 */
function showOwnRows(holder, say) {
  const { table } = store.state;
  if (!table) {
    holder.replaceChildren();
    return;
  }
  const items = table.opened.designs.map((row) => {
    const take = async () =>
      say((await takeRow(row)) ? "" : `The page holds ${LETTERS.length} designs: delete one first.`);
    const label = `Take ${row.name} as design`;
    return element("li", {}, `${row.name} `, button("Take as design", take, { "aria-label": label }));
  });
  holder.replaceChildren(element("h3", {}, `Screws of ${table.file.name}`), element("ul", { class: "rows" }, ...items));
}

/** @param {HTMLElement} holder */
function showKept(holder) {
  const works = keeping.kept();
  const why = keeping.whyNot();
  const items = works.map(({ id, fragment, title, saved }) => {
    const when = WHEN.format(saved);
    const mine = id === keeping.own();
    const label = `Open the work of ${when}`;
    const open = button("Open", () => keeping.show(fragment), { disabled: mine, "aria-label": label });
    const forget = button("Delete", () => keeping.forget([id]), {
      "aria-label": `Delete the work of ${when}`,
    });
    return element("li", {}, `${when}: ${title} `, mine ? element("em", {}, "on this page") : null, " ", open, forget);
  });
  holder.replaceChildren(
    element("p", { class: "small" }, why ? NOT_KEPT[why] : "Each tab keeps its own work, until it is deleted here."),
    works.length ? element("ul", { class: "rows" }, ...items) : element("p", {}, "Nothing is kept yet."),
  );
}
