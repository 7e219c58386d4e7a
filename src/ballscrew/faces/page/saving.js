// Files that the page saves. Their names begin with that of the design.

import { current, fileName } from "./designs.js";
import { saveFile } from "./dom.js";

/**
 * Save a file.
 *
 * @param {string} name what follows the name of the design
 * @param {Blob} content
 */
export function save(name, content) {
  saveFile(`ballscrew-${fileName(current())}${name}`, content);
}
