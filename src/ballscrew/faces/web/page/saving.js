// Files that the page saves. Their names begin with that of the design.

import { current, fileName } from "./designs.js";
import { element } from "./dom.js";

/**
 * Save a file.
 *
 * @param {string} name what follows the name of the design
 * @param {Blob} content
 */
export function save(name, content) {
  const address = URL.createObjectURL(content);
  const link = element("a", { href: address, download: `ballscrew-${fileName(current())}${name}` });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
