// The language of the page: the configured one, unless another was chosen here. It changes while the page is shown.

import { byId, keep, make, recall } from "./dom.js";
import { use, written } from "./texts.js";
import { load } from "./stream.js";

// Texts that the page is written with, and where they go: nodes and attributes.
const places = [];
const catalogues = new Map();

// Pause before texts that did not come are asked for again, ms.
const PAUSE = 1500;

async function sure(path) {
  for (;;) {
    try { return await load(path); } catch { await new Promise((done) => { setTimeout(done, PAUSE); }); }
  }
}

const catalogue = async (code) => {
  if (!catalogues.has(code)) catalogues.set(code, await sure(`api/v1/texts/${code}`));
  return catalogues.get(code);
};

// Waits for the texts; `onChange` is told that another language is shown.
export async function startLanguage(onChange) {
  const [{ configured, languages }, english] = await Promise.all([sure("api/v1/texts"), catalogue("en")]);
  collect(english);
  const select = byId("language");
  select.replaceChildren(...languages.map(({ code, name }) => make("option", { value: code, lang: code }, name)));
  const chosen = recall("localStorage", "language");
  select.value = languages.some(({ code }) => code === chosen) ? chosen : configured;
  await show(select.value, english);
  select.addEventListener("change", async () => {
    keep("localStorage", "language", select.value);
    await show(select.value, english);
    onChange();
  });
}

async function show(code, english) {
  const own = await catalogue(code);
  use(own, code === "en" ? null : english);
  document.documentElement.lang = code;
  places.forEach(({ key, put }) => put(written(key)));
}

// Finds what is written in the page, as long as it is English.
function collect(english) {
  const keys = new Map(Object.entries(english).filter(([key]) => key.startsWith("html.")).map(([key, text]) => [text, key]));
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const text = node.data;
    const key = keys.get(text.trim());
    if (!key || node.parentElement.closest("[translate=no]")) continue;
    const [, before, after] = /^(\s*)[^]*?(\s*)$/.exec(text);
    const own = node;
    places.push({ key, put: (other) => { own.data = before + other + after; } });
  }
  for (const node of document.querySelectorAll("[aria-label]")) {
    const key = keys.get(node.getAttribute("aria-label"));
    if (key) places.push({ key, put: (other) => node.setAttribute("aria-label", other) });
  }
}
