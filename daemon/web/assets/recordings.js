// Raw recordings: a list of files to fetch, asked for when somebody wants it.

import { byId, make, setAttr, setText, show } from "./dom.js";
import { bytes, datetime } from "./format.js";
import { said, t } from "./texts.js";

// As many as a hand scrolls through.
const SHOWN = 50;
// How often it is asked whether a report is there.
const AGAIN_MS = 1000;

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
  const told = make("small", {}, `${bytes(file.bytes)} \u00b7 ${written} UTC`);
  const report = make("button", { type: "button" }, t("recordings_report"));
  report.addEventListener("click", () => order(report, `${link.getAttribute("href")}/report?language=${document.documentElement.lang}`));
  return make("li", {}, link, told, report);
}

// A report takes as long as it takes: asked for until it is there, and then a link to it stands in place of the button.
async function order(button, address) {
  const outcome = byId("recordings-outcome");
  button.disabled = true;
  setText(outcome, t("recordings_report_making"));
  const answer = await made(address);
  button.disabled = false;
  if (answer?.ok) {
    button.replaceWith(make("a", { href: address, target: "_blank", rel: "noopener" }, t("recordings_report_open")));
    setText(outcome, "");
    return;
  }
  const told = answer ? await answer.json().catch(() => null) : null;
  setText(outcome, told?.error ? said(told.error) : t("recordings_report_unread"));
}

async function made(address) {
  for (;;) {
    const answer = await fetch(address).catch(() => null);
    if (answer?.status !== 202) return answer;
    await new Promise((done) => { setTimeout(done, AGAIN_MS); });
  }
}
