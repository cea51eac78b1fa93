// Alerts after IEC 62923: shape and colour tell the priority, the mark tells the state.

import { byId, keep, make, recall, setAttr, setClass, setText, show, svg } from "./dom.js";
import { clock, duration, words } from "./format.js";
import { order, load } from "./stream.js";
import { said, t } from "./texts.js";

const SHAPES = {
  emergency_alarm: "M12 2 23 21H1Z", alarm: "M12 2 23 21H1Z",
  warning: "M12 2a10 10 0 1 0 0 20a10 10 0 1 0 0-20Z",
  caution: "M3 3H21V21H3Z", unknown: "M3 3H21V21H3Z",
};
const MARKS = { unacknowledged: "!", silenced: "♪̸", acknowledged: "!", transferred: "→", rectified: "✓" };
const asks = (state) => ["unacknowledged", "silenced"].includes(state);
const RANK = ["emergency_alarm", "alarm", "warning", "caution", "unknown"];
const key = (alert) => `${alert.manufacturer ?? ""}-${alert.id}-${alert.instance ?? ""}`;

let token = recall("sessionStorage", "token") ?? "";
let readOnly = null;
const rows = new Map();
let before = null;

export function startAlerts() {
  byId("token-form").addEventListener("submit", (event) => {
    event.preventDefault();
    token = byId("token").value;
    byId("token").value = "";
    keep("sessionStorage", "token", token);
    tellToken();
  });
  byId("level-form").addEventListener("submit", async (event) => {
    event.preventDefault();
    const answer = await give("api/v1/log-level", { level: byId("level").value });
    setText(byId("level-state"), answer.text);
  });
  load("api/v1/orders").then((answer) => { readOnly = answer.enabled ? null : answer.why; tellToken(); }).catch(() => {});
}

// Whether something can be changed here, and why not.
export function tellToken() {
  const text = readOnly ? t("read_only", { why: said(readOnly) }) : t(token ? "token_set" : "token_none");
  setText(byId("token-state"), text);
  byId("token").disabled = Boolean(readOnly);
  byId("token-save").disabled = Boolean(readOnly);
  byId("level-save").disabled = !token || Boolean(readOnly);
  for (const row of rows.values()) row.buttons.forEach((button) => { button.disabled = !token || Boolean(readOnly); });
}

// Whether something can be changed from this tab.
export const mayChange = () => Boolean(token) && !readOnly;

export const give = (path, body) =>
  order(path, token, body).catch(() => ({ done: false, text: t("unreachable") }));

function build(alert) {
  const icon = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  for (const [name, value] of Object.entries({ viewBox: "0 0 24 24", "aria-hidden": "true", class: "alert-icon" })) icon.setAttribute(name, value);
  const shape = svg(icon, "path", { class: "alert-shape" });
  const mark = svg(icon, "text", { x: 12, y: 18 });
  const [title, text, facts, outcome] = [make("strong"), make("span"), make("small"), make("small", { role: "status" })];
  const buttons = ["acknowledge", "silence"].map((verb) => {
    const button = make("button", { type: "button", class: verb });
    button.addEventListener("click", async () => {
      const answer = await give(`api/v1/alerts/${alert.id}/${verb}`, { instance: alert.instance });
      setText(outcome, answer.done ? "" : answer.text);
    });
    return button;
  });
  const body = make("div", { class: "alert-body" }, title, text, facts, outcome);
  const item = make("li", {}, icon, body, make("div", { class: "alert-buttons" }, ...buttons));
  return { item, shape, mark, title, text, facts, buttons };
}

function update(row, alert) {
  setClass(row.item, `alert ${alert.priority} ${alert.state}`);
  setAttr(row.shape, "d", SHAPES[alert.priority] ?? SHAPES.unknown);
  setText(row.mark, MARKS[alert.state] ?? "");
  const title = said(alert.title);
  setText(row.title, title);
  setText(row.text, said(alert.description));
  for (const button of row.buttons) {
    const verb = t(button.className);
    setText(button, verb);
    setAttr(button, "aria-label", t("of_alert", { verb, title }));
  }
  const maker = alert.manufacturer ? `${alert.manufacturer} ` : "";
  const again = alert.escalation > 0 ? t("raised_again", { times: alert.escalation }) : "";
  const number = `${maker}${alert.id}${alert.instance ? `.${alert.instance}` : ""}`;
  const [clockTime, time] = [clock(alert.changed_utc), duration(alert.since_s)];
  setText(row.facts, t("alert_facts", { priority: words(alert.priority), state: words(alert.state), number, clock: clockTime, time, again }));
  const [acknowledge, silence] = row.buttons;
  show(acknowledge, asks(alert.state) || alert.state === "rectified");
  show(silence, alert.state === "unacknowledged");
}

// The alerts, and in which order they stand.
export function alerts(data, link) {
  const list = byId("alert-list");
  const sorted = [...data.alerts].sort((a, b) =>
    Number(asks(b.state)) - Number(asks(a.state)) || RANK.indexOf(a.priority) - RANK.indexOf(b.priority));
  const keys = new Set(sorted.map(key));
  for (const [name, row] of rows) {
    if (!keys.has(name)) { row.item.remove(); rows.delete(name); }
  }
  sorted.forEach((alert, k) => {
    if (!rows.has(key(alert))) {
      rows.set(key(alert), build(alert));
      tellToken();
    }
    const row = rows.get(key(alert));
    update(row, alert);
    if (list.children[k] !== row.item) list.insertBefore(row.item, list.children[k] ?? null);
  });
  const areKnown = link !== "silent" && link !== "lost";
  setText(byId("no-alerts"), t(areKnown ? "alerts_none" : "alerts_unknown"));
  setClass(byId("no-alerts"), areKnown ? "empty good" : "empty");
  show(byId("no-alerts"), sorted.length === 0);
  const open = sorted.filter((alert) => asks(alert.state));
  show(byId("alert-count"), sorted.length > 0);
  setText(byId("alert-count"), String(sorted.length));
  setClass(byId("alert-count"), `pill ${sorted[0]?.priority ?? ""}`);
  strip(open);
  speak(sorted);
  return sorted;
}

// One line below the head of the page, while something asks for an answer.
function strip(open) {
  const node = byId("strip");
  show(node, open.length > 0);
  if (open.length === 0) return;
  setClass(node, `strip ${open[0].priority}`);
  const more = open.length > 1 ? t("alerts_more", { n: open.length - 1 }) : "";
  setText(node, t("alert_strip", { priority: words(open[0].priority).toUpperCase(), title: said(open[0].title), description: said(open[0].description), more }));
}

// New alarms interrupt whoever listens, the rest waits its turn.
function speak(sorted) {
  const now = new Map(sorted.map((alert) => [key(alert), alert]));
  if (before) {
    for (const [name, alert] of now) {
      const old = before.get(name);
      if (old && old.state === alert.state && old.priority === alert.priority) continue;
      const urgent = ["alarm", "emergency_alarm"].includes(alert.priority) && alert.state === "unacknowledged";
      setText(byId(urgent ? "say-now" : "say"), t("say_alert", { priority: words(alert.priority), state: words(alert.state), title: said(alert.title) }));
    }
    for (const [name, alert] of before) if (!now.has(name)) setText(byId("say"), t("say_normal", { title: said(alert.title) }));
  }
  before = now;
}
