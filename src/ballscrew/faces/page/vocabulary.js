// The words of the server: models, cases to start from, units, and the names of results. Filled before anything is shown.

/** @type {Vocabulary} */
export const vocabulary = /** @type {any} */ ({});

/** @param {Vocabulary} words */
export function fill(words) {
  Object.assign(vocabulary, words);
}
