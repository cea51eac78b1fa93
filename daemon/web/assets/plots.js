// Lines over time and over frequency.

import { fitted, colour, lettering } from "./dom.js";
import { known } from "./format.js";
import { word, t } from "./texts.js";

// What is plotted: ten minutes at one a second.
const SPAN = 600;

// So many seconds of it, with so much between two rows.
export function history(span = SPAN, step = 0.95) {
  let rows = [];
  return {
    past(columns) {
      rows = columns.at_s.map((at, k) => ({ at, ...pick(columns, k) }));
    },
    note(at, motion) {
      const last = rows[rows.length - 1];
      // time that goes back far is that of another start
      if (last && at < last.at - 2) rows = [];
      if (last && at - last.at < step && at >= last.at - 2) return false;
      rows.push({
        at,
        heading_deg: motion?.heading_deg, sigma_heading_deg: motion?.sigma_heading_deg,
        roll_deg: motion?.roll_deg, pitch_deg: motion?.pitch_deg,
        heave_m: motion?.heave?.heave_m, speed_kn: motion?.speed_kn, current_speed_kn: motion?.current_speed_kn,
      });
      while (rows.length > span / step + 2) rows.shift();
      return true;
    },
    series: (name) => rows.map((row) => [row.at, row[name]]),
    unwrapped: (name) => unwrap(rows.map((row) => [row.at, row[name]])),
  };
}

const pick = (columns, k) =>
  Object.fromEntries(Object.entries(columns).filter(([, values]) => Array.isArray(values)).map(([name, values]) => [name, values[k]]));

// A heading that goes on beyond north, so that it does not leap.
function unwrap(points) {
  let turns = 0;
  let last = null;
  return points.map(([at, value]) => {
    if (!known(value)) return [at, null];
    if (last !== null) turns += value - last > 180 ? -360 : value - last < -180 ? 360 : 0;
    last = value;
    return [at, value + turns];
  });
}

function nice(size, wanted) {
  const rough = size / wanted;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= rough);
}

const decimals = (step) => Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)));

function frame(context, width, height) {
  const box = { left: 44, right: width - 16, top: 6, bottom: height - 18 };
  context.font = lettering(11);
  context.lineWidth = 1;
  context.fillStyle = colour("dim");
  context.strokeStyle = colour("grid");
  return box;
}

function rule(context, box, y, text) {
  context.beginPath();
  context.moveTo(box.left, Math.round(y) + 0.5);
  context.lineTo(box.right, Math.round(y) + 0.5);
  context.stroke();
  context.textAlign = "right";
  context.fillText(text, box.left - 5, y + 4);
}

function column(context, box, x, text) {
  context.beginPath();
  context.moveTo(Math.round(x) + 0.5, box.top);
  context.lineTo(Math.round(x) + 0.5, box.bottom);
  context.stroke();
  context.textAlign = "center";
  context.fillText(text, x, box.bottom + 13);
}

function curve(context, box, points, x, y) {
  context.save();
  context.beginPath();
  context.rect(box.left, box.top - 2, box.right - box.left, box.bottom - box.top + 4);
  context.clip();
  context.beginPath();
  let down = false;
  for (const [at, value] of points) {
    if (!known(value)) {
      down = false;
    } else if (down) {
      context.lineTo(x(at), y(value));
    } else {
      context.moveTo(x(at), y(value));
      down = true;
    }
  }
  context.stroke();
  context.restore();
}

function minutes(context, box, x, now, span = SPAN) {
  const step = (box.right - box.left < 300 ? 5 : 2) * (span / SPAN);
  for (let minute = 0; minute <= span / 60; minute += step) {
    column(context, box, x(now - minute * 60), minute === 0 ? t("now_plot") : t("minutes_ago", { m: minute }));
  }
}

// One series over the last minutes. `least` is the least height of the picture in its unit.
export function plot(canvas, points, { least, wrap = false, span = SPAN }) {
  if (canvas.clientWidth === 0) return;
  const { context, width, height } = fitted(canvas);
  const box = frame(context, width, height);
  const values = points.map(([, value]) => value).filter(known);
  if (values.length === 0) return;
  let [low, high] = [Math.min(...values), Math.max(...values)];
  const pad = Math.max((least - (high - low)) / 2, (high - low) * 0.06);
  [low, high] = [low - pad, high + pad];
  const now = points[points.length - 1][0];
  const x = (at) => box.right - ((now - at) / span) * (box.right - box.left);
  const y = (value) => box.bottom - ((value - low) / (high - low)) * (box.bottom - box.top);
  const step = nice(high - low, 4);
  for (let value = Math.ceil(low / step) * step; value <= high; value += step) {
    const shown = wrap ? ((value % 360) + 360) % 360 : value;
    rule(context, box, y(value), shown.toFixed(decimals(step)).replace("-", "−"));
  }
  minutes(context, box, x, now, span);
  context.strokeStyle = colour("accent");
  context.lineWidth = 1.6;
  curve(context, box, points, x, y);
}

// The heading sigma, logarithmic, with what is asked for.
export function sigmaPlot(canvas, points, target) {
  if (canvas.clientWidth === 0) return;
  const { context, width, height } = fitted(canvas);
  const box = frame(context, width, height);
  const values = points.map(([, value]) => value).filter((value) => known(value) && value > 0);
  if (values.length === 0) return;
  const all = known(target) ? [...values, target] : values;
  const low = Math.floor(Math.log10(Math.min(...all)) - 0.1);
  const high = Math.max(low + 1, Math.ceil(Math.log10(Math.max(...all)) + 0.05));
  const now = points[points.length - 1][0];
  const x = (at) => box.right - ((now - at) / SPAN) * (box.right - box.left);
  const y = (value) => box.bottom - ((Math.log10(value) - low) / (high - low)) * (box.bottom - box.top);
  for (let power = low; power <= high; power += 1) rule(context, box, y(10 ** power), String(Number((10 ** power).toPrecision(1))));
  minutes(context, box, x, now);
  if (known(target)) {
    context.strokeStyle = colour("good");
    context.lineWidth = 1.6;
    context.setLineDash([7, 5]);
    curve(context, box, [[now - SPAN, target], [now, target]], x, y);
    context.setLineDash([]);
  }
  context.strokeStyle = colour("accent");
  context.lineWidth = 2;
  curve(context, box, points.filter(([, value]) => value > 0), x, y);
}

// Power densities of the disturbance: measured thin, by the model thick.
export function spectrum(canvas, axes) {
  if (canvas.clientWidth === 0) return;
  const { context, width, height } = fitted(canvas);
  const box = frame(context, width, height);
  const all = axes.flatMap((axis) => [...axis.model, ...axis.measured]).filter(([hz, density]) => hz > 0 && density > 0);
  if (all.length === 0) return;
  const far = Math.max(...all.map(([hz]) => hz));
  const densities = all.map(([, density]) => density);
  const high = Math.ceil(Math.log10(Math.max(...densities)));
  const low = Math.max(Math.floor(Math.log10(Math.min(...densities))), high - 5);
  const x = (hz) => box.left + (hz / far) * (box.right - box.left);
  const y = (density) => box.bottom - ((Math.log10(Math.max(density, 1e-30)) - low) / (high - low)) * (box.bottom - box.top);
  const raised = (power) => `10${String(power).replace("-", "⁻").replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit])}`;
  for (let power = low; power <= high; power += 1) rule(context, box, y(10 ** power), raised(power));
  const step = nice(far, 6);
  for (let hz = 0; hz <= far + 1e-9; hz += step) column(context, box, x(hz), hz.toFixed(decimals(step)));
  axes.forEach((axis, index) => {
    context.strokeStyle = colour(index === 0 ? "accent" : "second");
    context.globalAlpha = 0.55;
    context.lineWidth = 1;
    curve(context, box, axis.measured, x, y);
    context.globalAlpha = 1;
    context.lineWidth = 2.4;
    curve(context, box, axis.model, x, y);
    context.fillStyle = context.strokeStyle;
    context.textAlign = "right";
    context.fillText(word(axis.name), box.right - 4, box.top + 14 + 14 * index);
  });
}
