// The views: the page, one for the bridge, one to go alongside. The one for the bridge: one screen of what is steered by, with the alerts and the last hours.

import { byId, keep, make, recall, setClass, setText, show } from "./dom.js";
import { fixed, known, words } from "./format.js";
import { history, plot } from "./plots.js";
import { load } from "./stream.js";
import { said, t } from "./texts.js";

// What is plotted: two hours, a point every ten seconds.
const past = history(7200, 9.5);
const PLOTS = [
  ["b-plot-heading", () => past.unwrapped("heading_deg"), { least: 4, wrap: true, span: 7200 }],
  ["b-plot-speed", () => past.series("speed_kn"), { least: 2, span: 7200 }],
  ["b-plot-drift", () => past.series("current_speed_kn"), { least: 1, span: 7200 }],
];
// Alerts that there is room for.
const ROOM = 5;

export const isBridge = () => document.body.dataset.view === "bridge";

// `onChange` is told that something else is seen now.
export function startView(onChange) {
  const select = byId("view");
  const apply = () => {
    document.body.dataset.view = select.value;
    show(byId("bridge"), isBridge());
    show(byId("docking"), select.value === "docking");
    keep("localStorage", "view", select.value);
    onChange();
  };
  // a screen can be started with one: …/#bridge, …/#docking
  const asked = location.hash.slice(1);
  select.value = ["bridge", "docking"].includes(asked) ? asked : recall("localStorage", "view") ?? "page";
  select.addEventListener("change", apply);
  apply();
}

export function catchUp(done) {
  load("api/v1/history?step=10").then((columns) => { past.past(columns); done(); }).catch(() => {});
}

export const note = (at, motion) => past.note(at, motion);

export function draw() {
  if (isBridge()) PLOTS.forEach(([id, series, options]) => plot(byId(id), series(), options));
}

// The alerts in the order of the page, as many as there is room for.
export function alerts(sorted, areKnown) {
  const list = byId("b-alerts");
  while (list.children.length > Math.min(sorted.length, ROOM)) list.lastChild.remove();
  sorted.slice(0, ROOM).forEach((alert, k) => {
    const node = list.children[k] ?? list.appendChild(make("li"));
    setClass(node, `b-alert ${alert.priority} ${alert.state}`);
    setText(node, t(alert.state === "rectified" ? "bridge_over" : "bridge_alert", { priority: words(alert.priority), title: said(alert.title) }));
  });
  const more = sorted.length - ROOM;
  const text = sorted.length === 0 ? t(areKnown ? "bridge_none" : "bridge_unknown") : more > 0 ? t("bridge_more", { n: more }) : "";
  setText(byId("b-more"), text);
}

// A bar to port or starboard of its middle, for roll and pitch.
export function lean(root, value, most) {
  const part = known(value) ? Math.max(-1, Math.min(1, value / most)) : 0;
  root.style.setProperty("--from", fixed(part < 0 ? 50 + part * 50 : 50, 1).replace("−", "-") + "%");
  root.style.setProperty("--size", fixed(Math.abs(part) * 50, 1) + "%");
}
