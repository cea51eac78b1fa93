// Alignment, modes and what moves the ship at her berth.

import { byId, fill, make, right, setAttr, setClass, setText, show, svg } from "./dom.js";
import { DASH, clock, duration, fixed, known, words } from "./format.js";
import { said, t } from "./texts.js";

const PHASES = ["levelling", "searching", "fine", "aligned"];
const LIMITS = { gyro_bias: "limit_gyro_bias", random_walk: "limit_random_walk", sea: "limit_sea", latitude: "limit_latitude" };
const LACKS = {
  time: "lack_time", manoeuvres: "lack_manoeuvres", gnss_velocity: "lack_gnss_velocity", aid: "lack_aid", method: "lack_method",
};

function readiness(alignment) {
  const limited = LIMITS[alignment.limited_by];
  const limit = limited ? t(limited) : "";
  switch (alignment.forecast) {
    case "reached": return [t("ready_reached"), said(alignment.text)];
    case "expected": {
      const time = duration(alignment.ready_in_s);
      const when = alignment.ready_utc ? t("ready_at", { time, clock: clock(alignment.ready_utc) }) : t("ready_in", { time });
      return [when, limit ? t("limited_by", { limit }) : ""];
    }
    case "unreachable": {
      const best = fixed(alignment.best_deg, 2);
      return [t("ready_never"), limit ? t("ready_best_limited", { best, limit }) : t("ready_best", { best })];
    }
    default: return [t("ready_unknown"), alignment.lacks in LACKS ? t(LACKS[alignment.lacks]) : ""];
  }
}

export function alignment(data) {
  const now = data.alignment;
  const list = byId("steps");
  const phases = now?.phase === "in_motion" ? ["levelling", "in_motion", "aligned"] : PHASES;
  const at = phases.indexOf(now?.phase);
  while (list.children.length > phases.length) list.lastChild.remove();
  phases.forEach((phase, k) => {
    if (!list.children[k]) list.append(make("li"));
    setText(list.children[k], words(phase));
    setClass(list.children[k], k < at || now?.phase === "aligned" ? "done" : k === at ? "current" : "");
    if (k === at) list.children[k].setAttribute("aria-current", "step");
    else list.children[k].removeAttribute("aria-current");
  });
  const [when, why] = now ? readiness(now) : [DASH, ""];
  setText(byId("ready-when"), when);
  setText(byId("ready-why"), why);
  const told = known(now?.told_at_s) ? data.time.at_s - now.told_at_s : 0;
  const where = t(now?.moored ? "at_berth" : "under_way");
  setText(byId("align-place"), !now ? "" : told > 1 ? t("told_ago", { where, s: fixed(told, 0) }) : where);
  const part = known(now?.progress) ? Math.max(0, Math.min(1, now.progress)) : null;
  setAttr(byId("progress-fill"), "width", part === null ? 0 : (part * 100).toFixed(1));
  if (part === null) byId("progress").removeAttribute("aria-valuenow");
  else setAttr(byId("progress"), "aria-valuenow", Math.round(part * 100));
}

export function modeTone(name) {
  if (name === "aided") return "good";
  if (name === "dead_reckoning" || name === "inertial") return "warn";
  if (name === "fault") return "bad";
  if (!name) return "calm";
  return name.endsWith("alignment") && name !== "coarse_alignment" ? "busy" : "calm";
}

export function modes(data) {
  const newest = [...data.modes].reverse();
  fill(byId("modes"), newest.map((change) => [
    change.utc ? clock(change.utc) : `${fixed(change.at_s, 0)} s`,
    { text: words(change.to), cls: `state ${modeTone(change.to)}` },
    { text: said(change.reason) || DASH, cls: "wrap" },
  ]));
  timeline(byId("timeline"), data);
}

// Each mode as a bar; the last hour, or all if it is shorter.
function timeline(root, data) {
  const now = data.time.at_s;
  const from = Math.max(data.modes[0]?.at_s ?? 0, now - 3600);
  const x = (at) => Math.max(0, ((at - from) / Math.max(now - from, 1)) * 1000);
  const bars = data.modes
    .map((change, k) => ({ tone: modeTone(change.to), name: change.to, x1: x(change.at_s), x2: x(data.modes[k + 1]?.at_s ?? now) }))
    .filter((bar) => bar.x2 > bar.x1);
  while (root.children.length > bars.length) root.lastChild.remove();
  bars.forEach((bar, k) => {
    const node = root.children[k] ?? svg(root, "rect", { y: 0, height: 26 });
    setAttr(node, "x", bar.x1.toFixed(1));
    setAttr(node, "width", Math.max(2, bar.x2 - bar.x1).toFixed(1));
    setAttr(node, "class", `tone-${bar.tone}`);
  });
  setAttr(root, "aria-label", t("modes_spoken", { time: duration(now - from), modes: bars.map((bar) => words(bar.name)).join(", ") }));
}

export function disturbance(data) {
  const found = data.disturbance;
  const card = byId("disturbance-card");
  card.classList.toggle("without", !found);
  show(byId("no-disturbance"), !found);
  const order = known(found?.order) ? t("disturbance_order", { n: found.order }) : "";
  const window = known(found?.window_s) ? t("disturbance_window", { n: fixed(found.window_s, 0) }) : "";
  const radius = known(found?.radius) ? t("disturbance_radius", { n: fixed(found.radius, 3) }) : "";
  setText(byId("disturbance-method"), found ? `${words(found.method)}${order}${window}${radius}` : "");
  const isPlace = found?.quantity === "displacement";
  setText(byId("density"), t(isPlace ? "density_displacement" : "density_velocity"));
  setText(byId("disturbance-fit"), found?.fit ? t("disturbance_fit", { fit: said(found.fit.text) }) : "");
  const left = (axis) => (isPlace ? `${fixed(axis.residual_m, 3)} m` : `${fixed(axis.residual_mps, 4)} m/s`);
  fill(byId("ar"), (found?.axes ?? []).map((axis) => [
    words(axis.name), right(fixed(axis.dominant_period_s, 1)), right(left(axis)),
    { text: axis.coefficients.map((one) => fixed(one, 3)).join("  ") || DASH, cls: "num wrap" },
  ]));
}
