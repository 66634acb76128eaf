// SPDX-License-Identifier: MIT
// Which of some words another one may be meant for.

/** How many characters are to be inserted, deleted or replaced to make `b` of `a`: the distance of Levenshtein. */
function editDistance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j) {
      next.push(Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1)));
    }
    row = next;
  }
  return row[b.length];
}

/** The candidate that is most like `word`; null if none is similar: if more than a third of it would have to change. */
export function nearestWord(word, candidates) {
  const edits = candidates.map((candidate) => editDistance(word.toLowerCase(), candidate.toLowerCase()));
  const least = Math.min(...edits);
  return least <= Math.max(1, word.length / 3) ? candidates[edits.indexOf(least)] : null;
}
