// The page: takes the data as they come and shows them with the next picture of the screen.

import { byId, binder, keep, recall, setAttr, setClass, setText, show } from "./dom.js";
import { clock, words } from "./format.js";
import { startLanguage } from "./language.js";
import { t } from "./texts.js";
import { after } from "./age.js";
import { follow, load } from "./stream.js";
import { rose, horizon, turn, qualities, source, speak } from "./instruments.js";
import { chart } from "./chart.js";
import { history, plot, sigmaPlot, spectrum } from "./plots.js";
import { sensors, watched, ports, measurements, system } from "./tables.js";
import { sky, relabel } from "./sky.js";
import { alignment, disturbance, modes, modeTone } from "./alignment.js";
import { alerts, startAlerts, tellToken } from "./alerts.js";
import * as bridge from "./bridge.js";
import { docking, plan, startDocking } from "./docking.js";
import { camera, relabelCamera, startCamera } from "./camera.js";
import { learning, startLearning } from "./learning.js";
import { recordings, relabelRecordings, startRecordings } from "./recordings.js";

const bind = binder(document);
const instruments = [rose(byId("rose")), rose(byId("b-rose")), horizon(byId("horizon")), turn(byId("turn")), turn(byId("b-turn")), qualities, source];
const sheet = chart(byId("chart"));
const quay = plan(byId("d-plan"));
const past = history();
const plots = [
  ["plot-heading", () => past.unwrapped("heading_deg"), { least: 2, wrap: true }],
  ["plot-roll", () => past.series("roll_deg"), { least: 2 }],
  ["plot-pitch", () => past.series("pitch_deg"), { least: 1 }],
  ["plot-heave", () => past.series("heave_m"), { least: 0.4 }],
  ["plot-speed", () => past.series("speed_kn"), { least: 1 }],
].map(([id, series, options]) => [byId(id), series, options]);

// how often it is looked whether what is shown has grown too old, ms
const LOOK = 100;

// what came last and when, whether there is a connection, and what of it is shown
let came = null;
let at = 0;
let linked = null;
let data = null;
let link = "connecting";
// what is to be drawn anew with the next picture
const due = { live: false, whole: false, plots: false };
let waiting = false;
let version = null;

function wake() {
  if (!waiting) {
    waiting = true;
    requestAnimationFrame(draw);
  }
}

function draw() {
  waiting = false;
  if (!data) return;
  if (due.live) drawLive();
  if (due.whole) drawWhole();
  if (due.plots) drawPlots();
  sheet.draw();
  due.live = due.whole = due.plots = false;
}

function drawLive() {
  bind(data);
  instruments.forEach((show) => show(data.motion));
  alignment(data);
  docking(data);
  quay(data.docking);
  setText(byId("utc"), clock(data.time.utc));
  setAttr(byId("utc"), "datetime", data.time.utc ?? "");
  setClass(byId("mode-chip"), `mode tone-${modeTone(data.mode.name)}`);
  document.body.dataset.motion = data.motion?.freshness ?? "gone";
  bridge.lean(byId("b-roll"), data.motion?.roll_deg, 20);
  bridge.lean(byId("b-pitch"), data.motion?.pitch_deg, 10);
}

function drawWhole() {
  show(byId("simulated"), data.program.simulated);
  sensors(data);
  watched(data);
  sky(data);
  camera(data);
  learning(data);
  ports(data);
  measurements(data);
  recordings(data);
  system(data);
  modes(data);
  disturbance(data);
  bridge.alerts(alerts(data, link), link !== "silent" && link !== "lost");
  speak(data.motion);
  sheet.speak();
  const what = link === "silent" || link === "lost" ? `⚠ ${t(LINKS[link])}` : words(data.mode.name);
  document.title = `${data.program.unit ?? "insd"}: ${what}`;
}

function drawPlots() {
  plots.forEach(([canvas, series, options]) => plot(canvas, series(), options));
  sigmaPlot(byId("plot-sigma"), past.series("sigma_heading_deg"), data.alignment?.target_deg);
  spectrum(byId("spectrum"), data.disturbance?.axes ?? []);
  bridge.draw();
}

function take(next, whole) {
  if (whole && version !== null && version !== next.program.version) {
    // another program answers: it has another page
    location.reload();
    return;
  }
  if (whole) version = next.program.version;
  [came, at] = [next, performance.now()];
  sheet.note(next.time.at_s, next.motion);
  due.plots = [past, bridge].map((own) => own.note(next.time.at_s, next.motion)).some(Boolean) || due.plots;
  age(whole);
}

// Shows what came as it is now: with the data, and when none come, again and again.
function age(whole) {
  if (!came) return;
  data = after(came, (performance.now() - at) / 1000);
  const before = link;
  link = linkNow();
  if (link !== before) enter();
  due.live = true;
  due.whole = whole || link !== before || due.whole;
  wake();
}

function linkNow() {
  if (!linked) return "lost";
  if (data.time.told_ago_s > 1) return "silent";
  return data.motion?.freshness === "fresh" ? "live" : "connected";
}

// What has been before this page looked; also after a gap.
function catchUp() {
  load("api/v1/track").then((columns) => { sheet.past(columns); wake(); }).catch(() => {});
  load("api/v1/history").then((columns) => { past.past(columns); due.plots = true; wake(); }).catch(() => {});
  bridge.catchUp(() => { due.plots = true; wake(); });
}

const LINKS = { connecting: "link_connecting", live: "link_live", connected: "link_connected", silent: "link_silent", lost: "link_lost" };

function enter() {
  setText(byId("link"), t(LINKS[link]));
  byId("link").dataset.state = link;
  setClass(byId("link"), `badge link ${link}`);
  const stale = link === "silent" || link === "lost";
  document.body.classList.toggle("stale", stale && came !== null);
  document.body.classList.toggle("waiting", came === null);
  const last = came ? t("last_data", { clock: clock(came.time.utc ?? came.time.system_utc) }) : "";
  setText(byId("lost"), t(link === "silent" ? "lost_silent" : "lost_lost", { last }));
  show(byId("lost"), stale && came !== null);
}

function onLink(open) {
  if (linked === open) return;
  linked = open;
  if (open) catchUp();
  else if (came) age(true);
  else { link = "lost"; enter(); }
}

function startTheme() {
  const [select, dimmer] = [byId("theme"), byId("dimmer")];
  const apply = () => {
    document.documentElement.dataset.theme = select.value;
    // never so dark that nothing is seen
    document.documentElement.style.setProperty("--shade", String(0.85 * (1 - dimmer.value / 100)));
    keep("localStorage", "theme", select.value);
    keep("localStorage", "dimmer", dimmer.value);
    redraw();
  };
  select.value = recall("localStorage", "theme") ?? "auto";
  dimmer.value = recall("localStorage", "dimmer") ?? "100";
  select.addEventListener("change", apply);
  dimmer.addEventListener("input", apply);
  apply();
}

function redraw() {
  sheet.redraw();
  due.plots = true;
  wake();
}

// What is shown is said again in another language.
function translate() {
  enter();
  relabel();
  relabelCamera();
  relabelRecordings();
  tellToken();
  if (came) {
    due.live = due.whole = true;
    redraw();
  }
}

window.addEventListener("resize", redraw);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
await startLanguage(translate);
relabel();
relabelCamera();
relabelRecordings();
enter();
startTheme();
bridge.startView(redraw);
startAlerts();
startDocking();
startLearning();
startCamera();
startRecordings();
setInterval(() => { if (performance.now() - at > LOOK) age(false); }, LOOK);
follow({ onData: take, onLink });
