// The texts of the language that is shown: by key, and English sentences of the program found again in the English
// catalogue; as daemon/languages has it.

const SENTENCES = ["alert.", "said."];

let texts = {};
// the English sentences that can be found again, the longest first; none where English is shown
let patterns = [];
// what English words are in this language
let words = new Map();
const found = new Map();

const split = (text) => text.split(/\{(\w+)\}/);

// Shows these texts from now on; `english` is the catalogue in which sentences are found again, none where it is the same.
export function use(own, english) {
  texts = own;
  found.clear();
  words = new Map(Object.entries(english ?? {}).filter(([key]) => key.startsWith("word.")).map(([key, text]) => [text, own[key]]));
  patterns = Object.entries(english ?? {})
    .filter(([key]) => SENTENCES.some((group) => key.startsWith(group)))
    .map(([key, text]) => ({ key, parts: split(text) }))
    .sort((a, b) => plain(b) - plain(a));
}

const plain = ({ parts }) => parts.filter((_, k) => k % 2 === 0).join("").length;

export function filled(text, values) {
  return split(text).map((part, k) => (k % 2 === 0 ? part : String(values[part] ?? ""))).join("");
}

// A text of the page with its values.
export const t = (key, values = {}) => filled(texts[`page.${key}`] ?? key, values);

// What a word of the interface, `dead_reckoning`, is in this language.
export const word = (code) => texts[`word.${code}`] ?? String(code).replaceAll("_", " ");

// A text of the page as it is written, by the key of its English.
export const written = (key) => texts[key];

// An English sentence of the program in this language; itself where the catalogue does not have it.
export function said(english) {
  if (!english || patterns.length === 0) return english ?? "";
  if (!found.has(english)) {
    // what varies without end must not be kept without end
    if (found.size > 2000) found.clear();
    again(english);
  }
  return found.get(english) ?? english;
}

// It ends, as what stands in a place is shorter than what it stands in; and nothing is looked for twice.
function again(english) {
  if (!found.has(english)) found.set(english, lookedFor(english));
  return found.get(english);
}

function lookedFor(english) {
  for (const { key, parts } of patterns) {
    const values = {};
    if (fits(parts, 0, english, values)) return filled(texts[key] ?? english, values);
  }
  return null;
}

// Whether the rest of a text is what the parts from this one on say; parts with odd numbers are places.
function fits(parts, at, text, values) {
  const [before, place] = [parts[at], parts[at + 1]];
  if (!text.startsWith(before)) return false;
  const rest = text.slice(before.length);
  if (place === undefined) return rest === "";
  return ends(parts[at + 2], at + 3 === parts.length, rest).some((end) => {
    const value = taken(place, rest.slice(0, end));
    if (value === null) return false;
    values[place] = value;
    return fits(parts, at + 2, rest.slice(end), values);
  });
}

// Where what stands in a place may end, given what follows; it is never empty.
function ends(next, isLast, text) {
  if (isLast && next === "") return text === "" ? [] : [text.length];
  const all = [];
  for (let end = text.indexOf(next, 1); end > 0; end = text.indexOf(next, end + 1)) all.push(end);
  return all;
}

// What stands in a place: a sentence or a word, a number or anything.
function taken(place, value) {
  if (place.endsWith("_text")) return again(value) ?? words.get(value) ?? null;
  if (place.endsWith("_n")) return /^[+\-−.,:\u2009\u202f\d]*\d[+\-−.,:\u2009\u202f\d]*$/.test(value) ? value : null;
  return value;
}
