// Elements, tables and files: the little that the page needs of the document.

/** An element with attributes and children; texts are texts, never markup. */
export function element(name, attributes = {}, ...children) {
  const found = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) found.addEventListener(key.slice(2), value);
    else found.setAttribute(key, value === true ? "" : value);
  }
  found.append(...children.filter((child) => child !== null && child !== undefined));
  return found;
}

export function byId(id) { return document.getElementById(id); }

/** A table with a caption, headings above and, where asked for, beside. */
export function table(caption, headings, rows, { hidden = false, beside = true } = {}) {
  const head = element("tr", {}, ...headings.map((text) => (text ? element("th", { scope: "col" }, text) : element("td"))));
  const body = rows.map((cells) => element("tr", {}, ...cells.map((cell, place) =>
    place === 0 && beside ? element("th", { scope: "row" }, cell) : element("td", {}, cell))));
  return element("table", {}, element("caption", { class: hidden ? "hidden" : undefined }, caption),
    element("thead", {}, head), element("tbody", {}, ...body));
}

/** Save a file. */
export function save(name, content) {
  const address = URL.createObjectURL(content);
  const link = element("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Columns as CSV, as the rest of the world reads it. */
export function csv(headings, rows) {
  const cell = (value) => (/[",\n]/.test(String(value)) ? `"${String(value).replaceAll('"', '""')}"` : String(value ?? ""));
  return [headings, ...rows].map((row) => row.map(cell).join(",")).join("\r\n") + "\r\n";
}
