// Values as text. What is unknown is a dash, never a zero.

import { said, t, word } from "./texts.js";

export const DASH = "–";

export const known = (value) => typeof value === "number" && Number.isFinite(value);

const minus = (text) => text.replace("-", "−");

export function fixed(value, digits) {
  if (!known(value)) return DASH;
  const text = value.toFixed(digits);
  // "-0.00" is zero
  return minus(Number(text) === 0 ? text.replace("-", "") : text);
}

export function signed(value, digits) {
  if (!known(value)) return DASH;
  const text = fixed(value, digits);
  return Number(value.toFixed(digits)) > 0 ? `+${text}` : text;
}

export const sigma = (value, digits) => (known(value) ? `±\u2009${fixed(value, digits)}` : "");

export function bearing(value, digits = 1) {
  if (!known(value)) return DASH;
  const turned = ((value % 360) + 360) % 360;
  let text = turned.toFixed(digits);
  if (Number(text) >= 360) text = (0).toFixed(digits);
  return text.padStart(digits > 0 ? digits + 4 : 3, "0");
}

function sexagesimal(value, letters, width) {
  if (!known(value)) return DASH;
  let minutes = Math.round(Math.abs(value) * 60 * 1e4);
  const degrees = Math.floor(minutes / (60 * 1e4));
  minutes = (minutes - degrees * 60 * 1e4) / 1e4;
  const letter = letters[value < 0 ? 1 : 0];
  return `${String(degrees).padStart(width, "0")}°\u2009${minutes.toFixed(4).padStart(7, "0")}′\u2009${letter}`;
}

export const lat = (value) => sexagesimal(value, "NS", 2);
export const lon = (value) => sexagesimal(value, "EW", 3);

// two or three digits that count
export function metres(value) {
  if (!known(value)) return DASH;
  return fixed(value, value < 10 ? 2 : value < 100 ? 1 : 0);
}

// across a quay centimetres count where she is near
export const berth = (value) => fixed(value, Math.abs(value) < 9.995 ? 2 : 1);

export function duration(seconds) {
  if (!known(seconds)) return DASH;
  const s = Math.max(0, Math.floor(seconds));
  const [d, h, m] = [Math.floor(s / 86400), Math.floor(s / 3600) % 24, Math.floor(s / 60) % 60];
  if (d > 0) return t("days", { d, h });
  if (h > 0) return t("hours", { h, m: String(m).padStart(2, "0") });
  if (m > 0) return t("minutes", { m, s: String(s % 60).padStart(2, "0") });
  return t("seconds", { s });
}

export function age(seconds) {
  if (!known(seconds)) return DASH;
  return seconds < 100 ? fixed(seconds, 1) : duration(seconds);
}

export function bytes(value) {
  if (!known(value)) return DASH;
  let rest = value;
  for (const unit of ["B", "kB", "MB", "GB"]) {
    if (rest < 1000) return `${unit === "B" ? rest : rest.toPrecision(3)} ${unit}`;
    rest /= 1000;
  }
  return `${rest.toPrecision(3)} TB`;
}

export const count = (value) =>
  known(value) ? String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, "\u2009") : DASH;

export function rate(value) {
  if (!known(value)) return DASH;
  return value >= 99.5 ? fixed(value, 0) : value >= 9.95 ? fixed(value, 1) : fixed(value, 2);
}

export const percent = (part) => (known(part) ? `${fixed(part * 100, part < 0.1 ? 1 : 0)} %` : DASH);

export const words = (code) => (code ? word(code) : DASH);

// UTC is told as of RFC 3339: it is cut, not reckoned with
export const clock = (utc) => (utc ? utc.slice(11, 19) : DASH);
export const date = (utc) => (utc ? utc.slice(0, 10) : DASH);
export const datetime = (utc) => (utc ? `${utc.slice(0, 10)} ${utc.slice(11, 19)}` : DASH);

export function smalltime(seconds) {
  if (!known(seconds)) return DASH;
  if (seconds < 1e-3) return `${fixed(seconds * 1e6, 1)} µs`;
  return seconds < 1 ? `${fixed(seconds * 1e3, 1)} ms` : `${fixed(seconds, 1)} s`;
}

const plain = (value) => (value === null || value === undefined || value === "" ? DASH : String(value));

// the formats that the page names in data-as
export const formats = {
  plain, said: (text) => said(text) || DASH, lat, lon, metres, berth, duration, bytes, count, words, date, datetime, smalltime,
  bearing: (value) => bearing(value), bearing0: (value) => bearing(value, 0),
  fixed0: (v) => fixed(v, 0), fixed1: (v) => fixed(v, 1), fixed2: (v) => fixed(v, 2), fixed3: (v) => fixed(v, 3),
  signed1: (v) => signed(v, 1), signed2: (v) => signed(v, 2),
  sigma1: (v) => sigma(v, 1), sigma2: (v) => sigma(v, 2), sigma3: (v) => sigma(v, 3),
};
