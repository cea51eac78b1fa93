// The camera: what becomes of what it sees, how it is found to sit, and its picture for who asks.

import { byId, fill, right, setAttr, setClass, setText, show } from "./dom.js";
import { count, fixed, known } from "./format.js";
import { AXES } from "./tables.js";
import { said, t } from "./texts.js";

// time between two pictures, ms: the front end writes one every two seconds
const APART = 2000;

const STATES = {
  used: ["camera_used", "good"], doubtful: ["camera_doubtful", "bad"], waiting: ["camera_waiting", "calm"],
  silent: ["camera_silent", "warn"],
};

let wanted = false;
let turn = 0;
let timer;

export function startCamera() {
  byId("camera-switch").addEventListener("click", () => { wanted = !wanted; relabelCamera(); ask(); });
  byId("camera-picture").addEventListener("load", () => { show(byId("camera-picture"), wanted); setText(byId("camera-outcome"), ""); again(); });
  byId("camera-picture").addEventListener("error", async () => {
    show(byId("camera-picture"), false);
    again();
    const answer = await fetch("api/v1/camera").catch(() => null);
    const told = answer && !answer.ok ? await answer.json().catch(() => ({})) : {};
    if (wanted) setText(byId("camera-outcome"), told.error ? said(told.error) : t("camera_no_picture"));
  });
}

function again() {
  clearTimeout(timer);
  if (wanted) timer = setTimeout(ask, APART);
}

// A picture is fetched only while it is wanted and the page is looked at.
function ask() {
  clearTimeout(timer);
  if (!wanted) { show(byId("camera-picture"), false); setText(byId("camera-outcome"), ""); return; }
  if (document.hidden || byId("camera").hidden) { again(); return; }
  turn += 1;
  byId("camera-picture").src = `api/v1/camera?${turn}`;
}

export function relabelCamera() {
  setText(byId("camera-switch"), t(wanted ? "camera_hide" : "camera_show"));
  setAttr(byId("camera-switch"), "aria-pressed", wanted);
}

export function camera(data) {
  const own = data.camera;
  show(byId("camera"), Boolean(own));
  show(byId("to-camera"), Boolean(own));
  if (!own) return;
  const [text, tone] = STATES[own.state] ?? ["camera_unknown", "calm"];
  setText(byId("camera-sensor"), own.sensor);
  setText(byId("camera-state"), t(text));
  setClass(byId("camera-state"), `camera-state ${tone}`);
  const numbers = { points: count(own.points), poses: count(own.poses), landmarks: count(own.landmarks) };
  const tally = known(own.points) ? "camera_counts" : "camera_steps";
  setText(byId("camera-counts"), known(own.poses) ? t(tally, numbers) : "");
  const row = (what, one, digits, unit) =>
    [what, right(`${fixed(one.value, digits)}${unit}`), right(`${fixed(one.sigma, digits)}${unit}`)];
  const rows = (own.turned ?? []).map((one, k) => row(t("camera_turned", { axis: t(AXES[k]) }), one, 2, "°"));
  if (own.delay) rows.push(row(t("camera_delay"), own.delay, 3, " s"));
  show(byId("camera-table").closest(".scroll"), rows.length > 0);
  fill(byId("camera-table"), rows);
  show(byId("camera-tools"), own.has_picture);
}
