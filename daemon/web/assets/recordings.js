// Raw recordings: a list of files to fetch, asked for when somebody wants it.

import { byId, make, setAttr, setText, show } from "./dom.js";
import { bytes, datetime } from "./format.js";
import { said, t } from "./texts.js";

// As many as a hand scrolls through.
const SHOWN = 50;

let wanted = false;

export function startRecordings() {
  byId("recordings-switch").addEventListener("click", () => { wanted = !wanted; relabelRecordings(); ask(); });
}

export function relabelRecordings() {
  setText(byId("recordings-switch"), t(wanted ? "recordings_hide" : "recordings_show"));
  setAttr(byId("recordings-switch"), "aria-pressed", wanted);
}

export function recordings(data) {
  show(byId("recordings-tools"), Boolean(data.recording));
}

async function ask() {
  const list = byId("recordings");
  show(list, false);
  setText(byId("recordings-outcome"), "");
  if (!wanted) return;
  const answer = await fetch("api/v1/recordings").catch(() => null);
  const told = answer ? await answer.json().catch(() => null) : null;
  if (!answer?.ok || !told) { setText(byId("recordings-outcome"), told?.error ? said(told.error) : t("recordings_unread")); return; }
  if (told.length === 0) { setText(byId("recordings-outcome"), t("recordings_none")); return; }
  list.replaceChildren(...told.slice(0, SHOWN).map(row));
  show(list, wanted);
}

function row(file) {
  const written = datetime(file.written_s && new Date(1000 * file.written_s).toISOString());
  const link = make("a", { href: `api/v1/recordings/${encodeURIComponent(file.name)}`, download: file.name }, file.name);
  return make("li", {}, link, make("small", {}, `${bytes(file.bytes)} \u00b7 ${written} UTC`));
}
