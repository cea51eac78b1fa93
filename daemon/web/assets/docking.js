// The docking view: how bow, stern and manifold stand to the quay, and a plan of it.

import { byId, make, setAttr, setClass, setText, show, svg } from "./dom.js";
import { fixed, known, sigma, duration, words, DASH } from "./format.js";
import { give, mayChange } from "./alerts.js";
import { said, t } from "./texts.js";

// Slower than this she neither closes nor opens, m/s; and this straight she is parallel, deg.
const STILL = 0.005;
const PARALLEL = 0.05;
// A vector is the way of so long, s.
const AHEAD = 60;
// What is shown of the land behind the edge, and of the quay beyond the ship, m.
const LAND = 9;
const MARGIN = 14;

const PARTS = ["bow", "stern", "manifold"];
let names = null;

export function startDocking() {
  const select = byId("d-berth");
  select.addEventListener("change", async () => {
    const answer = await give("api/v1/berth", { name: select.value === "" ? null : select.value });
    setText(byId("d-outcome"), answer.done ? "" : answer.text);
  });
}

// What she does across or along the quay: the number without its sign, and the sign in a word.
const sized = (value) => (known(value) ? fixed(Math.abs(value), 2) : DASH);
const way = (value, [plus, minus], none) => (!known(value) ? "" : Math.abs(value) < STILL ? none : value > 0 ? plus : minus);

// A number, and its unit only beside one.
function number(id, text) {
  const node = byId(id);
  setText(node, text);
  node.closest("dd").classList.toggle("without", text === DASH);
}

function sure(value, level) {
  const own = known(value) ? `1σ ${sigma(value, value < 0.0995 ? 3 : 2)}` : "";
  return known(level) ? t("level", { own, level: fixed(level, 2) }) : own;
}

function part(name, point, limits) {
  const near = known(point?.distance_m) && known(limits.distance_m) && point.distance_m < limits.distance_m && point.closing_mps > STILL;
  const fast = known(point?.closing_mps) && known(limits.contact_speed_mps) && point.closing_mps > limits.contact_speed_mps;
  setText(byId(`d-${name}-sure`), sure(point?.sigma_distance_m, point?.level_m));
  number(`d-${name}-closing`, sized(point?.closing_mps));
  const over = fast ? t("over_limit", { limit: fixed(limits.contact_speed_mps, 2) }) : near ? t("within_limit", { limit: fixed(limits.distance_m, 1) }) : "";
  setText(byId(`d-${name}-way`), way(point?.closing_mps, [t("closing"), t("opening")], t("still")) + over);
  setText(byId(`d-${name}-speed-sure`), known(point?.sigma_closing_mps) ? `1σ ${sigma(point.sigma_closing_mps, 3)}` : "");
  const along = known(point?.along_mps) ? `${sized(point.along_mps)} m/s ${way(point.along_mps, [t("ahead"), t("astern")], t("along_quay"))}` : "";
  setText(byId(`d-${name}-along`), along);
  setClass(byId(`d-${name}`), `d-tile d-${name}${near ? " near" : ""}${fast ? " fast" : ""}`);
}

// What is to be shown, and how far it may be relied on.
function judged(docking) {
  if (!docking) return ["not_valid", ""];
  if (docking.freshness === "old") return ["not_valid", t("not_new")];
  return [docking.state, said(docking.why)];
}

function head(data, [state, why]) {
  const { docking, berths } = data;
  setText(byId("d-name"), docking?.berth ?? t(berths?.length ? "berth_none_near" : "berth_none"));
  const side = docking?.side ? t(docking.side === "port" ? "side_port" : "side_starboard") : "";
  setText(byId("d-choice"), docking ? t(docking.choice === "chosen" ? "berth_chosen" : "berth_nearest") + side : "");
  setText(byId("d-state"), words(state));
  setClass(byId("d-state"), `d-state ${state}`);
  setText(byId("d-why"), why);
  const told = JSON.stringify([t("berth_any"), ...(berths ?? [])]);
  const select = byId("d-berth");
  if (told !== names) {
    names = told;
    select.replaceChildren(make("option", { value: "" }, t("berth_any")), ...(berths ?? []).map((name) => make("option", { value: name }, name)));
  }
  if (document.activeElement !== select) select.value = docking?.choice === "chosen" ? docking.berth : "";
  select.disabled = !mayChange() || !berths?.length;
  setAttr(select, "title", mayChange() ? "" : t("token_missing"));
}

function middle(docking) {
  const angle = docking?.angle_deg;
  number("d-angle", known(angle) ? fixed(Math.abs(angle), 1) : DASH);
  setText(byId("d-angle-way"), !known(angle) ? "" : t(Math.abs(angle) < PARALLEL ? "parallel" : angle > 0 ? "bow_in" : "bow_out"));
  setText(byId("d-angle-sure"), known(docking?.sigma_angle_deg) ? `1σ ${sigma(docking.sigma_angle_deg, 2)}` : "");
  const contact = docking?.contact;
  setText(byId("d-contact-part"), !contact ? "" : contact.part === "manifold" ? t("amidships") : words(contact.part));
  number("d-contact-speed", known(contact?.speed_mps) ? fixed(contact.speed_mps, 2) : DASH);
  const when = known(contact?.in_s) ? t("contact_in", { time: duration(contact.in_s), sigma: sigma(contact.sigma_in_s, contact.sigma_in_s < 9.5 ? 1 : 0) }) : "";
  setText(byId("d-contact-when"), contact ? when : docking?.side ? t("contact_none") : "");
  const limit = docking?.contact_speed_limit_mps;
  byId("d-contact").classList.toggle("fast", known(limit) && known(contact?.speed_mps) && contact.speed_mps > limit);
  show(byId("d-manifold"), Boolean(docking?.manifold));
  const { above_m: above, sigma_above_m: aboveSure } = docking?.manifold ?? {};
  setText(byId("d-above"), known(above) ? t("above_it", { height: fixed(above, 1), sigma: sigma(aboveSure, 1) }) : "");
  const place = docking?.manifold?.place_m;
  setText(byId("d-place"), known(place) ? t("along_m", { n: fixed(place, 1) }) : "");
}

export function docking(data) {
  const told = judged(data.docking);
  head(data, told);
  const own = data.docking;
  const limits = { distance_m: own?.distance_limit_m, contact_speed_mps: own?.contact_speed_limit_mps };
  PARTS.forEach((name) => part(name, own?.[name], limits));
  middle(own);
  byId("docking").dataset.state = told[0];
  byId("docking").dataset.freshness = own?.freshness ?? "gone";
  byId("docking").classList.toggle("chosen", own?.choice === "chosen");
}

// How far the face of the fenders is before the edge at a place, m; as the program has it.
function face(fenders, place) {
  const after = fenders.findIndex(([at]) => at > place);
  if (fenders.length === 0) return 0;
  if (after === 0) return fenders[0][1];
  if (after < 0) return fenders[fenders.length - 1][1];
  const [[a, one], [b, other]] = [fenders[after - 1], fenders[after]];
  return one + ((other - one) * (place - a)) / (b - a);
}

const dots = (points) => points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");

// The plan: her bow is up, the quay on the side on which she has it.
export function plan(root) {
  const land = svg(root, "polygon", { class: "d-land" });
  const beyond = svg(root, "polyline", { class: "d-beyond" });
  const edge = svg(root, "polyline", { class: "d-edge" });
  const fenders = svg(root, "path", { class: "d-fenders" });
  const bollards = svg(root, "path", { class: "d-bollards" });
  const gaps = svg(root, "path", { class: "d-gaps" });
  const hull = svg(root, "polygon", { class: "d-hull" });
  const mark = svg(root, "polyline", { class: "d-mark" });
  const ways = svg(root, "path", { class: "d-ways" });

  return (docking) => {
    const quay = docking?.quay;
    const isKnown = known(quay?.length_m);
    setAttr(root, "visibility", isKnown ? "visible" : "hidden");
    if (!isKnown) return;
    const port = docking.side !== "starboard";
    const ahead = port === (quay.water === "right") ? 1 : -1;
    // metres to the right and down
    const at = ([along, across]) => [port ? across : -across, -ahead * along];
    const outline = docking.outline_m ?? [];
    const alongs = outline.map(([along]) => along);
    const [least, most] = outline.length ? [Math.min(...alongs) - MARGIN, Math.max(...alongs) + MARGIN] : [-MARGIN, quay.length_m + MARGIN];
    const off = Math.max(15, ...outline.map(([, across]) => across + 6));
    const corners = [at([least, -LAND]), at([most, off])];
    const [xs, ys] = [0, 1].map((k) => corners.map((corner) => corner[k]));
    const [x, y] = [Math.min(...xs), Math.min(...ys)];
    setAttr(root, "viewBox", `${x.toFixed(2)} ${y.toFixed(2)} ${(Math.max(...xs) - x).toFixed(2)} ${(Math.max(...ys) - y).toFixed(2)}`);
    const L = quay.length_m;
    setAttr(land, "points", dots([[0, 0], [L, 0], [L, -LAND], [0, -LAND]].map(at)));
    setAttr(beyond, "points", dots([[least, 0], [most, 0]].map(at)));
    setAttr(edge, "points", dots([[0, 0], [L, 0]].map(at)));
    const all = quay.fenders_m;
    const lone = all.length < 2 ? [...Array(Math.max(2, Math.round(L / 15)))].map((_, k, own) => [(L * (k + 0.5)) / own.length, all[0]?.[1] ?? 0]) : all;
    setAttr(fenders, "d", lone.map(([place, before]) => [[place - 1, 0], [place - 1, before], [place + 1, before], [place + 1, 0]].map(at))
      .map((points) => `M${points.map((p) => p.map((v) => v.toFixed(2)).join(" ")).join("L")}Z`).join(""));
    setAttr(bollards, "d", quay.bollards_m.map((place) => at([place, -2])).map(([px, py]) => `M${px.toFixed(2)} ${py.toFixed(2)}h0`).join(""));
    setAttr(hull, "points", outline.length > 2 ? dots(outline.map(at)) : "");
    drawShip({ docking, at, all, gaps, ways, mark, ahead });
  };
}

// The gaps that are told, and the way of bow and stern for some seconds.
function drawShip({ docking, at, all, gaps, ways, mark, ahead }) {
  const told = ["bow", "stern"].map((name) => docking[name]).filter((point) => known(point?.distance_m));
  const line = ([from, to]) => `M${from.map((v) => v.toFixed(2)).join(" ")}L${to.map((v) => v.toFixed(2)).join(" ")}`;
  const side = (point) => {
    const fender = face(all, point.place_m);
    return [[point.place_m, fender], [point.place_m, fender + point.distance_m]];
  };
  setAttr(gaps, "d", told.map((point) => line(side(point).map(at))).join(""));
  const moved = (point) => {
    const [, [along, across]] = side(point);
    return [[along, across], [along + ahead * point.along_mps * AHEAD, across - point.closing_mps * AHEAD]].map(at);
  };
  setAttr(ways, "d", told.map((point) => line(moved(point))).join(""));
  const [bow, stern] = ["bow", "stern"].map((name) => (docking[name] ? at(side(docking[name])[1]) : null));
  const outline = docking.outline_m ?? [];
  if (!bow || !stern || outline.length < 3) { setAttr(mark, "points", ""); return; }
  // an arrow head on her deck shows where her bow is
  const middle = at([outline.reduce((sum, own) => sum + own[0], 0) / outline.length, outline.reduce((sum, own) => sum + own[1], 0) / outline.length]);
  const [ux, uy] = [bow[0] - stern[0], bow[1] - stern[1]];
  const long = Math.hypot(ux, uy) || 1;
  const [fx, fy] = [ux / long, uy / long];
  const tip = [middle[0] + fx * long * 0.42, middle[1] + fy * long * 0.42];
  const wing = (s) => [tip[0] - fx * 7 - s * fy * 5, tip[1] - fy * 7 + s * fx * 5];
  setAttr(mark, "points", dots([wing(1), tip, wing(-1)]));
}
