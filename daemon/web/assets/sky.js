// The satellites: where they stand, how strong they are, which are used, and why not.

import { byId, fill, make, right, setAttr, setText, show, svg } from "./dom.js";
import { DASH, bearing, count, duration, fixed, known, words } from "./format.js";
import { said, t } from "./texts.js";

const RAD = Math.PI / 180;
// radius of the horizon in the picture
const HORIZON = 118;
// height of the letters and size of the marks: smaller where there are many
const sizes = (count) => (count > 38 ? [8, 0.72] : [10, 1]);
// the ends of the bars, dB Hz
const [WEAK, STRONG] = [15, 55];

const circle = (r) => `M${-r} 0a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`;

// What becomes of a satellite: a shape of its own, words and a tone. Those that are used come last.
const FATES = {
  left_out: { line: "M-5.5 -5.5H5.5V5.5H-5.5ZM-5.5 -5.5L5.5 5.5M5.5 -5.5L-5.5 5.5", text: "fate_left_out", tone: "bad" },
  refused: { line: `${circle(5)}M-3.5 3.5L3.5 -3.5`, text: "fate_refused", tone: "calm" },
  crowded: { line: "M0 -6L6 5H-6Z", text: "fate_crowded", tone: "calm" },
  waiting: { line: circle(5), text: "fate_waiting", tone: "calm" },
  code_only: { solid: "M0 -5.5A5.5 5.5 0 0 0 0 5.5Z", line: circle(5.5), text: "fate_code_only", tone: "busy" },
  used: { solid: circle(5.5), line: circle(5.5), text: "fate_used", tone: "good" },
};
const ORDER = Object.keys(FATES);
const fateOf = (satellite) => (satellite.fate in FATES ? satellite.fate : "waiting");
const byFate = (satellites) => [...satellites].sort((a, b) => ORDER.indexOf(fateOf(a)) - ORDER.indexOf(fateOf(b)));

const WHY_NOT = {
  fixes_only: "sky_fixes_only", silent: "sky_silent", no_receiver: "sky_no_receiver",
};

function mark(parent, fate) {
  const group = svg(parent, "g", { class: `sat ${fate}` });
  svg(group, "path", { d: FATES[fate].line, class: "sat-line" });
  if (FATES[fate].solid) svg(group, "path", { d: FATES[fate].solid, class: "sat-solid" });
  return group;
}

function icon(fate) {
  const holder = make("span", { class: "sat-icon" });
  mark(svg(holder, "svg", { viewBox: "-8 -8 16 16", "aria-hidden": "true" }), fate);
  return holder;
}

// Where a satellite stands in the picture: north is up, the zenith in the middle.
function spot(satellite) {
  const { azimuth_deg: azimuth, elevation_deg: elevation } = satellite;
  if (!known(azimuth) || !known(elevation)) return null;
  const radius = (HORIZON * (90 - Math.max(0, Math.min(90, elevation)))) / 90;
  return { x: radius * Math.sin(azimuth * RAD), y: -radius * Math.cos(azimuth * RAD) };
}

const overlap = (a, b) =>
  Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) *
  Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));

const box = (x, y, width, height) => ({ left: x - width / 2, right: x + width / 2, top: y - height / 2, bottom: y + height / 2 });

// Names stand beside their marks, where they cover least of what is there already; one that stands farther off has a line to its mark.
function place(spots, letters, scale) {
  const taken = spots.map(({ at }) => box(at.x, at.y, 13 * scale, 13 * scale));
  return spots.map(({ satellite, at }) => {
    const width = satellite.name.length * letters * 0.64;
    const around = [1, 2, 3].flatMap((ring) => {
      const [aside, above] = [3 + 6 * scale * ring + width / 2, 2 + 6 * scale * ring + letters / 2];
      return [[aside, 0], [-aside, 0], [0, above], [0, -above], [aside, above], [-aside, above], [aside, -above], [-aside, -above]]
        .map(([dx, dy], turn) => ({ dx, dy, ring, cost: turn * 0.4 + (ring - 1) * 7 }));
    });
    const rated = around.map(({ dx, dy, ring, cost }) => {
      const own = box(at.x + dx, at.y + dy, width, letters);
      const beyond = Math.max(0, Math.hypot(at.x + dx, at.y + dy) + width / 2 - HORIZON - 12);
      const covered = taken.reduce((sum, other) => sum + overlap(own, other), 0);
      return { own, x: at.x + dx, y: at.y + dy, ring, cost: cost + covered + 20 * beyond };
    });
    const best = rated.reduce((a, b) => (b.cost < a.cost ? b : a));
    taken.push(best.own);
    return best;
  });
}

function plot(root) {
  for (const elevation of [0, 30, 60]) {
    svg(root, "circle", { r: (HORIZON * (90 - elevation)) / 90, class: elevation === 0 ? "dial" : "sky-ring" });
  }
  svg(root, "path", { d: `M0 ${-HORIZON}V${HORIZON}M${-HORIZON} 0H${HORIZON}`, class: "sky-ring" });
  for (const [name, x, y] of [["N", 0, -130], ["E", 133, 5], ["S", 0, 141], ["W", -133, 5]]) {
    svg(root, "text", { x, y, class: "cardinal" }, name);
  }
  for (const elevation of [30, 60]) svg(root, "text", { x: 2, y: (HORIZON * (90 - elevation)) / 90 - 3, class: "sky-degrees" }, `${elevation}°`);
  const bow = svg(root, "path", { d: `M0 ${-HORIZON} 6 ${-HORIZON - 9} -6 ${-HORIZON - 9}Z`, class: "lubber" });
  const all = svg(root, "g");
  let shown = "";
  const draw = (satellites, heading) => {
    setAttr(bow, "visibility", known(heading) ? "visible" : "hidden");
    if (known(heading)) setAttr(bow, "transform", `rotate(${heading.toFixed(1)})`);
    // those that are used are drawn last, above the others
    const spots = byFate(satellites).map((satellite) => ({ satellite, at: spot(satellite) })).filter(({ at }) => at);
    const key = spots.map(({ satellite, at }) => [satellite.name, satellite.fate, at.x.toFixed(1), at.y.toFixed(1)]).join();
    if (key === shown) return;
    shown = key;
    all.replaceChildren();
    const [letters, scale] = sizes(spots.length);
    const names = place(spots, letters, scale);
    spots.forEach(({ at }, k) => {
      if (names[k].ring > 1) svg(all, "path", { d: `M${at.x.toFixed(1)} ${at.y.toFixed(1)}L${names[k].x.toFixed(1)} ${names[k].y.toFixed(1)}`, class: "sat-lead" });
    });
    spots.forEach(({ satellite, at }, k) => {
      const fate = fateOf(satellite);
      const group = mark(all, fate);
      setAttr(group, "transform", `translate(${at.x.toFixed(1)} ${at.y.toFixed(1)}) scale(${scale})`);
      svg(group, "title", {}, `${satellite.name}: ${t(FATES[fate].text)}`);
      svg(all, "text", { x: names[k].x.toFixed(1), y: (names[k].y + letters * 0.36).toFixed(1), class: `sat-name ${fate}`, "font-size": letters }, satellite.name);
    });
  };
  return { draw, again: () => { shown = ""; } };
}

const strengths = (satellite) =>
  satellite.signals.map((signal) => `${signal.band} ${fixed(signal.cn0_db_hz, 0)}`).join(" · ") || DASH;

// A column: the greatest number, a bar for each band, the mark and the name.
function column(satellite) {
  const levels = satellite.signals.map((signal) => signal.cn0_db_hz);
  const fate = fateOf(satellite);
  const bars = levels.map((level) => {
    const bar = make("i");
    const part = known(level) ? Math.max(0.02, Math.min(1, (level - WEAK) / (STRONG - WEAK))) : 0;
    bar.style.setProperty("--level", `${(100 * part).toFixed(1)}%`);
    return bar;
  });
  const most = levels.filter(known).length > 0 ? Math.max(...levels.filter(known)) : null;
  return make("li", { class: `cn0 ${fate}`, title: `${satellite.name}: ${strengths(satellite)} dB Hz, ${t(FATES[fate].text)}` },
    make("span", { class: "num" }, fixed(most, 0)), make("span", { class: "cn0-bars" }, ...bars), icon(fate), make("span", {}, satellite.name));
}

function row(satellite) {
  const fate = FATES[fateOf(satellite)];
  return [
    { text: satellite.name, title: satellite.system },
    { text: t(fate.text), cls: `state ${fate.tone}`, sub: known(satellite.left_out_for_s) ? t("sky_for", { time: duration(satellite.left_out_for_s) }) : "" },
    right(fixed(satellite.elevation_deg, 0)), right(bearing(satellite.azimuth_deg, 0)),
    { text: strengths(satellite), cls: "num" }, { text: said(satellite.text) || DASH, cls: "wrap" },
  ];
}

function legend() {
  const items = Object.entries(FATES).reverse().map(([fate, { text }]) => make("li", {}, icon(fate), t(text)));
  const bow = make("span", { class: "sat-icon" });
  svg(svg(bow, "svg", { viewBox: "-8 -8 16 16", "aria-hidden": "true" }), "path", { d: "M0 5 6 -4 -6 -4Z", class: "lubber" });
  byId("sky-legend").replaceChildren(...items, make("li", {}, bow, t("her_bow")));
}

const picture = plot(byId("sky-plot"));
let columns = "";

// Another language is shown: what is drawn once is drawn again.
export function relabel() {
  legend();
  columns = "";
  picture.again();
}

export function sky(data) {
  const { state, used, satellites = [], refused = [] } = data.sky ?? {};
  const isTold = state === "raw";
  for (const id of ["sky-box", "signals-card"]) show(byId(id), isTold && satellites.length > 0);
  show(byId("no-sky"), !isTold || satellites.length === 0);
  byId("sky-card").classList.toggle("without", byId("sky-box").hidden);
  setText(byId("no-sky"), t(isTold ? "sky_empty" : WHY_NOT[state] ?? "sky_unknown"));
  const tally = isTold ? t("sky_tally", { used: count(used), all: satellites.length }) : "";
  setText(byId("sky-tally"), tally);
  setAttr(byId("sky-plot"), "aria-label", tally ? t("sky_spoken", { tally }) : t("sky_spoken_unknown"));
  picture.draw(satellites, data.motion?.heading_deg);
  const elsewhere = satellites.filter((satellite) => !spot(satellite)).map((satellite) => satellite.name);
  setText(byId("sky-elsewhere"), elsewhere.length > 0 ? t("sky_elsewhere", { names: elsewhere.join(", ") }) : "");
  const key = JSON.stringify(satellites.map(({ name, fate, signals }) => [name, fate, signals]));
  if (key !== columns) byId("cn0").replaceChildren(...satellites.map(column));
  columns = key;
  fill(byId("sky-table"), byFate(satellites).map(row));
  const since = refused.filter((cause) => cause.count > 0).map((cause) => `${words(cause.reason)} ${count(cause.count)}`).join(", ");
  setText(byId("sky-refused"), since ? t("sky_refused", { causes: since }) : "");
}
