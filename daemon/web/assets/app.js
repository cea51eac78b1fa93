// The page: takes the data as they come and shows them with the next picture of the screen.

import { byId, binder, keep, recall, setAttr, setClass, setText, show } from "./dom.js";
import { clock } from "./format.js";
import { follow, load } from "./stream.js";
import { rose, horizon, turn, speak } from "./instruments.js";
import { chart } from "./chart.js";
import { history, plot, sigmaPlot, spectrum } from "./plots.js";
import { sensors, ports, measurements, system } from "./tables.js";
import { alignment, disturbance, modes, modeTone } from "./alignment.js";
import { alerts, startAlerts } from "./alerts.js";

const bind = binder(document);
const instruments = [rose(byId("rose")), horizon(byId("horizon")), turn(byId("turn"))];
const sheet = chart(byId("chart"));
const past = history();
const plots = [
  ["plot-heading", () => past.unwrapped("heading_deg"), { least: 2, wrap: true }],
  ["plot-roll", () => past.series("roll_deg"), { least: 2 }],
  ["plot-pitch", () => past.series("pitch_deg"), { least: 1 }],
  ["plot-heave", () => past.series("heave_m"), { least: 0.4 }],
  ["plot-speed", () => past.series("speed_kn"), { least: 1 }],
].map(([id, series, options]) => [byId(id), series, options]);

let data = null;
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
  setText(byId("utc"), clock(data.time.utc));
  setAttr(byId("utc"), "datetime", data.time.utc ?? "");
  setClass(byId("mode-chip"), `mode tone-${modeTone(data.mode.name)}`);
}

function drawWhole() {
  show(byId("simulated"), data.program.simulated);
  sensors(data);
  ports(data);
  measurements(data);
  system(data);
  modes(data);
  disturbance(data);
  alerts(data);
  speak(data.motion);
  sheet.speak();
  document.title = `${data.program.unit ?? "insd"}: ${data.mode.name.replaceAll("_", " ")}`;
}

function drawPlots() {
  plots.forEach(([canvas, series, options]) => plot(canvas, series(), options));
  sigmaPlot(byId("plot-sigma"), past.series("sigma_heading_deg"), data.alignment?.target_deg);
  spectrum(byId("spectrum"), data.disturbance?.axes ?? []);
}

function take(next, whole) {
  data = next;
  if (whole && version !== null && version !== next.program.version) {
    // another program answers: it has another page
    location.reload();
    return;
  }
  if (whole) version = next.program.version;
  sheet.note(next.time.at_s, next.motion);
  due.plots = past.note(next.time.at_s, next.motion) || due.plots;
  due.live = true;
  due.whole = whole || due.whole;
  wake();
}

// What has been before this page looked; also after a gap.
function catchUp() {
  load("api/v1/track").then((columns) => { sheet.past(columns); wake(); }).catch(() => {});
  load("api/v1/history").then((columns) => { past.past(columns); due.plots = true; wake(); }).catch(() => {});
}

const LINKS = { connecting: "connecting", live: "live", silent: "no new data", lost: "connection lost" };

function enter(state) {
  setText(byId("link"), LINKS[state]);
  setClass(byId("link"), `badge link ${state}`);
  const stale = state !== "live";
  document.body.classList.toggle("stale", stale && data !== null);
  document.body.classList.toggle("waiting", data === null && stale);
  const at = data ? ` Last data ${clock(data.time.utc ?? data.time.system_utc)} UTC.` : "";
  const what = state === "silent" ? "The navigator sends no new data." : "Connection lost.";
  setText(byId("lost"), `${what}${at} What is shown below is old.`);
  show(byId("lost"), stale && data !== null);
  if (stale && data !== null) document.title = `⚠ ${LINKS[state]}`;
  if (state === "live") catchUp();
}

function startTheme() {
  const select = byId("theme");
  const apply = () => {
    document.documentElement.dataset.theme = select.value;
    keep("localStorage", "theme", select.value);
    redraw();
  };
  select.value = recall("localStorage", "theme") ?? "auto";
  select.addEventListener("change", apply);
  apply();
}

function redraw() {
  sheet.redraw();
  due.plots = true;
  wake();
}

window.addEventListener("resize", redraw);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
startTheme();
startAlerts();
follow({ onData: take, onState: enter });
