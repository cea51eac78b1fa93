// The instruments: heading rose, horizon, rate of turn.

import { svg, setAttr, setText, setClass, show, byId } from "./dom.js";
import { bearing, duration, fixed, signed, known, sigma, words, DASH } from "./format.js";
import { said, t } from "./texts.js";

const RAD = Math.PI / 180;
const point = (radius, degrees) => [radius * Math.sin(degrees * RAD), -radius * Math.cos(degrees * RAD)];

function arc(radius, from, to) {
  const [x1, y1] = point(radius, from);
  const [x2, y2] = point(radius, to);
  const large = to - from > 180 ? 1 : 0;
  return `M${x1.toFixed(2)} ${y1.toFixed(2)}A${radius} ${radius} 0 ${large} 1 ${x2.toFixed(2)} ${y2.toFixed(2)}`;
}

export function rose(root) {
  svg(root, "circle", { r: 108, class: "dial" });
  const card = svg(root, "g");
  for (let degree = 0; degree < 360; degree += 5) {
    const long = degree % 30 === 0 ? 14 : degree % 10 === 0 ? 10 : 6;
    const [x1, y1] = point(105, degree);
    const [x2, y2] = point(105 - long, degree);
    svg(card, "line", { x1, y1, x2, y2, class: degree % 30 === 0 ? "tick strong" : "tick" });
  }
  const names = { 0: "N", 90: "E", 180: "S", 270: "W" };
  for (let degree = 0; degree < 360; degree += 30) {
    const cardinal = degree in names;
    svg(card, "text", {
      x: 0, y: -79, transform: `rotate(${degree})`, class: cardinal ? "cardinal" : "degrees",
    }, names[degree] ?? String(degree).padStart(3, "0"));
  }
  const course = svg(card, "path", { d: "M0 -111 6 -102 0 -93 -6 -102Z", class: "course-mark" });
  const doubt = svg(root, "path", { class: "doubt" });
  svg(root, "path", { d: "M0 -105 7 -119 -7 -119Z", class: "lubber" });
  const value = svg(root, "text", { y: 8, class: "big" }, DASH);
  const doubtText = svg(root, "text", { y: 32, class: "doubt-text" }, "");
  const label = svg(root, "text", { y: -28, class: "label" }, "");

  return (motion) => {
    const { heading_deg: heading, sigma_heading_deg: sure, course_deg: track } = motion ?? {};
    setText(value, known(heading) ? `${bearing(heading)}°` : DASH);
    setText(doubtText, known(sure) ? `1σ ${sigma(sure, sure < 1 ? 3 : 1)}°` : "1σ –");
    setClass(card, known(heading) ? "" : "unknown");
    if (known(heading)) setAttr(card, "transform", `rotate(${(-heading).toFixed(2)})`);
    // narrower than half a degree nobody would see it
    const half = known(sure) ? Math.min(Math.max(sure, 0.5), 179) : 0;
    setAttr(doubt, "d", half > 0 ? arc(109, -half, half) : "");
    setAttr(course, "visibility", known(track) ? "visible" : "hidden");
    if (known(track)) setAttr(course, "transform", `rotate(${track.toFixed(2)})`);
    const isValid = motion?.heading_quality !== "not_valid";
    setClass(value, isValid ? "big" : "big not-valid");
    setText(label, t(isValid ? "heading_true" : "heading_not_valid"));
  };
}

// What may be trusted of the motion. A value that is not valid is never large: style.css looks for these.
export function qualities(motion) {
  const { heading_quality: heading, position_quality: position, velocity_quality: velocity, level_quality: level } = motion ?? {};
  const isOld = motion?.freshness === "old";
  const tell = (quality) => (!quality ? "" : isOld ? t("old", { quality: words(quality) }) : words(quality));
  for (const [id, quality] of [["heading-quality", heading], ["position-quality", position], ["level-quality", level === "not_valid" ? level : ""]]) {
    setText(byId(id), tell(quality));
  }
  const bad = (quality) => ["not_valid", "invalid"].includes(quality);
  for (const [name, quality] of Object.entries({ heading, position, velocity, level })) {
    document.body.classList.toggle(`${name}-not-valid`, bad(quality) || !motion || motion.freshness !== "fresh");
  }
}

// What the position lives by, since when and why.
export function source(motion) {
  const own = motion?.source;
  show(byId("source"), Boolean(own));
  const since = known(own?.since_s) ? t("source_for", { time: duration(own.since_s) }) : "";
  setText(byId("source-why"), own?.reason ? t("source_because", { since, reason: said(own.reason) }) : since);
}

// Pixels of a degree of pitch.
const PITCH = 3.4;

export function horizon(root) {
  const defs = svg(root, "defs");
  const clip = svg(defs, "clipPath", { id: "ball" });
  svg(clip, "circle", { r: 96 });
  const ball = svg(root, "g", { "clip-path": "url(#ball)" });
  const tilt = svg(ball, "g");
  svg(tilt, "rect", { x: -300, y: -400, width: 600, height: 400, class: "sky" });
  svg(tilt, "rect", { x: -300, y: 0, width: 600, height: 400, class: "sea" });
  svg(tilt, "line", { x1: -200, x2: 200, y1: 0, y2: 0, class: "horizon-line" });
  for (let degree = -20; degree <= 20; degree += 5) {
    if (degree === 0) continue;
    const half = degree % 10 === 0 ? 26 : 14;
    const y = -degree * PITCH;
    svg(tilt, "line", { x1: -half, x2: half, y1: y, y2: y, class: "pitch-line" });
    if (degree % 10 === 0) svg(tilt, "text", { x: half + 12, y: y + 3.5, class: "pitch-text" }, String(Math.abs(degree)));
  }
  svg(root, "circle", { r: 96, class: "ring" });
  for (const degree of [-45, -30, -20, -10, 0, 10, 20, 30, 45]) {
    const [x1, y1] = point(98, degree);
    const [x2, y2] = point(degree % 30 === 0 ? 110 : 105, degree);
    svg(root, "line", { x1, y1, x2, y2, class: "tick strong" });
    if (degree !== 0 && degree % 10 === 0) {
      const [x, y] = point(116, degree);
      svg(root, "text", { x, y: y + 3, class: "degrees small" }, String(Math.abs(degree)));
    }
  }
  const pointer = svg(root, "path", { d: "M0 -94 6 -82 -6 -82Z", class: "lubber" });
  svg(root, "path", { d: "M-52 0H-20L-10 8 0 0 10 8 20 0H52", class: "own-ship" });
  const unknown = svg(root, "text", { y: 6, class: "big" }, "");

  return (motion) => {
    const { roll_deg: roll, pitch_deg: pitch } = motion ?? {};
    const both = known(roll) && known(pitch);
    setAttr(ball, "visibility", both ? "visible" : "hidden");
    setAttr(pointer, "visibility", both ? "visible" : "hidden");
    setText(unknown, both ? "" : DASH);
    if (!both) return;
    // starboard side down: the horizon leans to port
    const shift = Math.max(-25, Math.min(25, pitch)) * PITCH;
    setAttr(tilt, "transform", `rotate(${(-roll).toFixed(2)}) translate(0 ${shift.toFixed(2)})`);
    setAttr(pointer, "transform", `rotate(${(-roll).toFixed(2)})`);
  };
}

export function turn(root) {
  svg(root, "rect", { x: -96, y: -5, width: 192, height: 10, rx: 2, class: "track-rect" });
  const bar = svg(root, "rect", { x: 0, y: -5, width: 0, height: 10, class: "fill-rect" });
  const ticks = svg(root, "g");
  for (let k = -3; k <= 3; k += 1) svg(ticks, "line", { x1: k * 32, x2: k * 32, y1: -9, y2: 9, class: k === 0 ? "tick strong" : "tick" });
  const ends = [-1, 1].map((side) => svg(root, "text", { x: side * 84, y: 3.4, class: "bar-text" }, ""));
  let scale = 30;

  return (motion) => {
    const rate = motion?.rate_of_turn_deg_min;
    const size = known(rate) ? Math.abs(rate) : 0;
    // the scale grows at once and shrinks late
    if (size > scale) scale = size > 60 ? 300 : 60;
    else if (size < 0.3 * scale && scale > 30) scale = scale === 300 ? 60 : 30;
    const width = Math.min(96, (size / scale) * 96);
    setAttr(bar, "x", rate < 0 ? -width : 0);
    setAttr(bar, "width", width.toFixed(1));
    ends.forEach((end) => setText(end, String(scale)));
  };
}

// What instruments say to those who cannot see them; once a second is enough.
export function speak(motion) {
  setAttr(byId("rose"), "aria-label", t("say_heading", { heading: bearing(motion?.heading_deg), sigma: fixed(motion?.sigma_heading_deg, 3) }));
  setAttr(byId("horizon"), "aria-label", t("say_level", { roll: signed(motion?.roll_deg, 1), pitch: signed(motion?.pitch_deg, 1) }));
  setAttr(byId("turn"), "aria-label", t("say_turn", { rate: signed(motion?.rate_of_turn_deg_min, 1) }));
}
