// Parts that cards with logs share: a place to drop a log, its faults in words, and the command that does the same.

import { jump } from "../cards.js";
import * as designs from "../designs.js";
import { button, namedButton } from "../controls.js";
import { element } from "../dom.js";
import { inWords, labelOf, withPlace } from "../messages.js";
import { sent, tooLarge } from "../opening.js";
import * as schema from "../schema.js";
import { get } from "../server.js";

/** Bytes of a log that the server takes, with its third more for the request. */
const MOST_BYTES = 3_000_000;
/** Letters that a shell reads also within quotes, and those that need quotes. */
const OF_SHELLS = /[$\u0060]/g;
/** The kind of a fault of a nut whose balls differ. */
const ONE_BY_ONE = "one_by_one";
const SPECIAL = /[^\w@%+=:,./-]/;

/** @typedef {{ name: string, text?: string, base64?: string }} SentFile */

/**
 * A place to drop a log or to choose one; it takes nothing beside its own area.
 *
 * @param {string} id
 * @param {string} label
 * @param {(file: SentFile) => void} take
 * @param {{ multiple?: boolean, most?: number }} options whether several files may be given at once, each of which is taken;
 *   bytes at most
 */
export function dropZone(id, label, take, { multiple = false, most = MOST_BYTES } = {}) {
  const said = element("span", { id: `${id}-name`, "aria-live": "polite" });
  const input = element("input", {
    type: "file",
    id,
    hidden: true,
    multiple,
    accept: ".csv,.txt,.tsv,.xlsx,.xls,.ods,.mat",
  });
  const choose = button("Choose a file", () => input.click(), { "aria-label": `Choose a file: ${label}` });
  /** @param {File | undefined} file */
  const read = async (file) => {
    if (!file) return;
    const fault = tooLarge(file, most);
    if (fault) said.textContent = fault;
    else use(await sent(file));
  };
  /** @param {FileList | null | undefined} files */
  const readAll = (files) => {
    for (const file of [...(files ?? [])].slice(0, multiple ? undefined : 1)) read(file);
  };
  /** @param {SentFile} file */
  const use = (file) => {
    said.textContent = `${file.name}`;
    take(file);
  };
  input.addEventListener("change", () => {
    readAll(input.files);
    input.value = ""; // the same file can be chosen again
  });
  const zone = element("div", { class: "drop" }, element("span", {}, label), choose, input, said);
  for (const kind of ["dragenter", "dragover"]) {
    zone.addEventListener(kind, (event) => {
      event.preventDefault();
      zone.classList.add("over");
    });
  }
  zone.addEventListener("dragleave", () => zone.classList.remove("over"));
  zone.addEventListener("drop", (event) => {
    event.preventDefault(); // the page would open it as a case
    zone.classList.remove("over");
    readAll(event.dataTransfer?.files);
  });
  return { zone, use, readAll };
}

/**
 * A button that takes an example: its case as a design, and its logs.
 *
 * @param {"condition" | "fit" | "service"} name
 * @param {(logs: SentFile[], free: string[]) => void} take also takes the numbers to fit
 */
export function exampleButton(name, take) {
  const onclick = async () => {
    /** @type {Examples} */
    const examples = await get("examples");
    const { case: sections, file, logs, free } = examples[name];
    const left = designs.add([await designs.ofCase(sections, { file })]);
    said.textContent = left ? "There is no place for one more design: remove one first." : "";
    if (!left) take(logs, free);
  };
  const said = element("span", { role: "status" });
  const example = namedButton(`${name}-example`, "Try with an example log", onclick);
  return element(
    "p",
    { class: "card-start" },
    example,
    said,
    element(
      "span",
      { class: "small" },
      "A log is read by the server, answered and removed; it is not part of the link.",
    ),
  );
}

/**
 * A line for each fault: a button to the field of the form, or the words on the log.
 *
 * @param {FaultLine[]} faults
 */
export function faultLines(faults) {
  return faults.map((fault) => {
    if (fault.id === ONE_BY_ONE) return elasticLine(fault);
    if (schema.fieldOf(fault.where)) {
      const words = `${labelOf(fault.where)}: ${inWords(fault)}`;
      return element(
        "p",
        { class: "fault" },
        button(words, () => jump(fault.where)),
      );
    }
    return element("p", { class: "fault" }, withPlace(fault));
  });
}

/**
 * A line with a button that takes elastic bodies and deviations of balls out of the design; Undo brings them back.
 *
 * @param {FaultLine} fault
 */
function elasticLine(fault) {
  const line = element("p", { class: "fault" }, withPlace(fault), " ");
  line.append(
    button("Take rigid bodies and equal balls in this design", () => {
      line.remove();
      designs.setTables({ bodies: null, deviations: null });
    }),
  );
  return line;
}

/**
 * The command that does the same as a card.
 *
 * @param {string[]} words
 */
export function commandLine(words) {
  const quoted = words.map((word) => (SPECIAL.test(word) ? JSON.stringify(word).replaceAll(OF_SHELLS, "\\$&") : word));
  const intro = "On the command line, with the case saved under “Hand over”:";
  return element("p", { class: "small" }, `${intro} `, element("code", {}, quoted.join(" ")));
}

/** The name of the case file that belongs to a command. */
export function caseFile() {
  return `${designs.fileName(designs.current())}.toml`;
}
