// Sentences.

/** A sentence with its capital letter and its full stop. @param {string} words */
export function sentence(words) {
  const line = words.trim();
  const isWord = /^[a-z]+(?=[\s,:;–]|$)/.test(line); // the name of a file stays as it is
  return `${isWord ? line.charAt(0).toUpperCase() : line.charAt(0)}${line.slice(1)}${/[.:]$/.test(line) ? "" : "."}`;
}
