// The track on a plain sheet: graticule, scale, where the ship is and how sure that is. It knows no land
// and no depths, and never looks as if it did.

import { fitted, colour, lettering, byId, setAttr } from "./dom.js";
import { known, lat as latText, lon as lonText, metres } from "./format.js";
import { t } from "./texts.js";

const RAD = Math.PI / 180;
// Metres of a degree of latitude; of longitude times the cosine of the latitude.
const DEGREE = 111_320;
const POINTS = 6000;
// Pixels of a metre, farthest and nearest.
const [FAR, NEAR] = [1e-5, 60];

export function chart(canvas) {
  const track = { lat: [], lon: [], at: [] };
  const view = { scale: 0.2, follow: true, lat: null, lon: null, touched: false };
  let motion = null;
  let dirty = true;

  const wrap = (lon) => ((lon + 540) % 360) - 180;

  function project(width, height) {
    const cos = Math.max(Math.cos(view.lat * RAD), 0.02);
    return {
      x: (lon) => width / 2 + wrap(lon - view.lon) * DEGREE * cos * view.scale,
      y: (lat) => height / 2 - (lat - view.lat) * DEGREE * view.scale,
      cos,
    };
  }

  function zoom(factor) {
    view.scale = Math.min(NEAR, Math.max(FAR, view.scale * factor));
    view.touched = true;
    dirty = true;
  }

  function fit() {
    if (track.lat.length < 2 || !known(motion?.lat_deg)) return;
    const cos = Math.max(Math.cos(motion.lat_deg * RAD), 0.02);
    const centre = track.lon[track.lon.length - 1];
    let [west, east, south, north] = [0, 0, Infinity, -Infinity];
    track.lat.forEach((lat, k) => {
      const lon = wrap(track.lon[k] - centre);
      [west, east] = [Math.min(west, lon), Math.max(east, lon)];
      [south, north] = [Math.min(south, lat), Math.max(north, lat)];
    });
    const [w, h] = [canvas.clientWidth || 300, canvas.clientHeight || 200];
    const size = Math.max(((east - west) * DEGREE * cos) / w, ((north - south) * DEGREE) / h, 30 / h);
    view.scale = Math.min(NEAR, Math.max(FAR, 0.72 / size));
    view.lat = (south + north) / 2;
    view.lon = wrap(centre + (west + east) / 2);
    setFollow(false);
  }

  function setFollow(follow) {
    view.follow = follow;
    view.touched = true;
    setAttr(byId("follow"), "aria-pressed", follow);
    dirty = true;
  }

  byId("zoom-in").onclick = () => zoom(1.6);
  byId("zoom-out").onclick = () => zoom(1 / 1.6);
  byId("follow").onclick = () => setFollow(true);
  byId("fit").onclick = fit;
  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held || view.lat === null) return;
    const cos = Math.max(Math.cos(view.lat * RAD), 0.02);
    view.lon = wrap(view.lon - (event.clientX - held[0]) / (DEGREE * cos * view.scale));
    view.lat = Math.max(-89.9, Math.min(89.9, view.lat + (event.clientY - held[1]) / (DEGREE * view.scale)));
    held = [event.clientX, event.clientY];
    setFollow(false);
  });
  canvas.addEventListener("pointerup", () => { held = null; });

  function push(at, lat, lon) {
    track.at.push(at);
    track.lat.push(lat);
    track.lon.push(lon);
    if (track.at.length > POINTS) for (const column of Object.values(track)) column.shift();
  }

  return {
    redraw() { dirty = true; },
    past(columns) {
      for (const column of Object.values(track)) column.length = 0;
      columns.at_s.forEach((at, k) => push(at, columns.lat_deg[k], columns.lon_deg[k]));
      dirty = true;
    },
    note(at, next) {
      motion = next;
      dirty = true;
      if (!known(next?.lat_deg) || !known(next?.lon_deg)) return;
      const last = track.at[track.at.length - 1];
      if (last === undefined || at - last >= 2 || at < last - 2) push(at, next.lat_deg, next.lon_deg);
    },
    draw() {
      if (!dirty || canvas.clientWidth === 0) return;
      dirty = false;
      const { context, width, height } = fitted(canvas);
      if (!view.touched && known(motion?.lat_deg)) view.scale = fitting(track, motion, height);
      if (view.lat === null || view.follow) {
        if (!known(motion?.lat_deg) || !known(motion?.lon_deg)) return;
        [view.lat, view.lon] = [motion.lat_deg, motion.lon_deg];
      }
      const to = project(width, height);
      graticule(context, width, height, view, to);
      path(context, track, to);
      if (known(motion?.lat_deg)) ship(context, motion, to, view.scale);
      ruler(context, width, height, view.scale);
    },
    speak() {
      if (known(motion?.lat_deg)) {
        setAttr(canvas, "aria-label", t("say_track", { lat: latText(motion.lat_deg), lon: lonText(motion.lon_deg), sigma: metres(motion.ellipse_major_m) }));
      }
    },
  };
}

// Until somebody zooms: the last hour of the track, not too near and not too far.
function fitting(track, motion, height) {
  const from = track.at[track.at.length - 1] - 3600;
  let way = 30;
  track.lat.forEach((lat, k) => {
    if (track.at[k] < from) return;
    const north = (lat - motion.lat_deg) * DEGREE;
    const east = (((track.lon[k] - motion.lon_deg + 540) % 360) - 180) * DEGREE * Math.cos(lat * RAD);
    way = Math.max(way, Math.hypot(north, east));
  });
  // in steps, or the sheet would never be still
  return 2 ** Math.floor(Math.log2((0.42 * height) / way));
}

// Steps of a graticule, degrees: whole parts of degrees, minutes and their tenths.
const STEPS = [1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200]
  .map((minutes) => minutes / 60);

function edge(value, step, letters) {
  const minutes = Math.abs(value) * 60;
  const degrees = Math.floor(minutes / 60 + 1e-9);
  const digits = Math.max(0, Math.ceil(-Math.log10(step * 60) - 1e-9));
  const rest = Math.max(0, minutes - degrees * 60).toFixed(digits);
  return `${degrees}°${rest.padStart(digits > 0 ? digits + 3 : 2, "0")}′${letters[value < 0 ? 1 : 0]}`;
}

function graticule(context, width, height, view, to) {
  context.strokeStyle = colour("grid");
  context.fillStyle = colour("dim");
  context.lineWidth = 1;
  context.font = lettering(11);
  const lines = (size, wanted) => STEPS.find((step) => step * size * view.scale >= wanted) ?? 30;
  const stepLat = lines(DEGREE, 70);
  const halfLat = height / 2 / (DEGREE * view.scale);
  for (let lat = Math.ceil((view.lat - halfLat) / stepLat) * stepLat; lat < view.lat + halfLat; lat += stepLat) {
    const y = Math.round(to.y(lat)) + 0.5;
    line(context, 0, y, width, y);
    context.fillText(edge(lat, stepLat, "NS"), 4, y - 3);
  }
  const stepLon = lines(DEGREE * to.cos, 90);
  const halfLon = width / 2 / (DEGREE * to.cos * view.scale);
  for (let lon = Math.ceil((view.lon - halfLon) / stepLon) * stepLon; lon < view.lon + halfLon; lon += stepLon) {
    const x = Math.round(width / 2 + (lon - view.lon) * DEGREE * to.cos * view.scale) + 0.5;
    line(context, x, 0, x, height);
    const shown = ((lon + 540) % 360) - 180;
    context.fillText(edge(shown, stepLon, "EW"), x + 3, height - 5);
  }
}

function line(context, x1, y1, x2, y2) {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}

function path(context, track, to) {
  context.strokeStyle = colour("accent");
  context.globalAlpha = 0.75;
  context.lineWidth = 2;
  context.lineJoin = "round";
  context.beginPath();
  let last = null;
  track.lat.forEach((lat, k) => {
    const lon = track.lon[k];
    const [x, y] = [to.x(lon), to.y(lat)];
    // the far side of the antimeridian is not joined across the sheet
    if (last === null || Math.abs(x - last) > 2000) context.moveTo(x, y);
    else context.lineTo(x, y);
    last = x;
  });
  context.stroke();
  context.globalAlpha = 1;
}

function ship(context, motion, to, scale) {
  const [x, y] = [to.x(motion.lon_deg), to.y(motion.lat_deg)];
  doubt(context, motion, x, y, scale);
  vector(context, motion, x, y, scale);
  context.save();
  context.translate(x, y);
  if (known(motion.heading_deg)) {
    context.rotate(motion.heading_deg * RAD);
    context.beginPath();
    context.moveTo(0, -15);
    context.quadraticCurveTo(6.5, -5, 6, 11);
    context.lineTo(-6, 11);
    context.quadraticCurveTo(-6.5, -5, 0, -15);
  } else {
    context.beginPath();
    context.arc(0, 0, 6, 0, 2 * Math.PI);
  }
  context.fillStyle = colour("card");
  context.strokeStyle = colour("text");
  context.lineWidth = 1.8;
  context.fill();
  context.stroke();
  context.restore();
}

// The 1-sigma ellipse, as large as it is; one smaller than the ship is not seen, and its size is told.
function doubt(context, motion, x, y, scale) {
  const { ellipse_major_m: major, ellipse_minor_m: minor, ellipse_direction_deg: direction } = motion;
  if (!known(major) || !known(minor)) return;
  context.save();
  context.translate(x, y);
  context.rotate((known(direction) ? direction : 0) * RAD);
  context.beginPath();
  context.ellipse(0, 0, Math.max(minor * scale, 0.5), Math.max(major * scale, 0.5), 0, 0, 2 * Math.PI);
  context.fillStyle = colour("doubt-fill");
  context.strokeStyle = colour("doubt");
  context.lineWidth = 1.5;
  context.fill();
  context.stroke();
  context.restore();
}

// Where she will be in three minutes.
function vector(context, motion, x, y, scale) {
  if (!known(motion.course_deg) || !known(motion.speed_kn)) return;
  const way = motion.speed_kn * 0.514444 * 180 * scale;
  const [dx, dy] = [way * Math.sin(motion.course_deg * RAD), -way * Math.cos(motion.course_deg * RAD)];
  context.strokeStyle = colour("text");
  context.lineWidth = 1.2;
  context.setLineDash([5, 4]);
  line(context, x, y, x + dx, y + dy);
  context.setLineDash([]);
}

function ruler(context, width, height, scale) {
  const longest = 130 / scale;
  const steps = [1, 2, 5].flatMap((k) => [...Array(8).keys()].map((power) => k * 10 ** power));
  const nautical = longest > 1852;
  const unit = nautical ? 1852 : 1;
  const length = Math.max(0.1, ...[...steps, 0.5, 0.2, 0.1].filter((step) => step * unit <= longest));
  const pixels = length * unit * scale;
  const [x, y] = [width - pixels - 14, 20];
  context.strokeStyle = colour("text");
  context.fillStyle = colour("text");
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + pixels, y);
  context.lineTo(x + pixels, y - 5);
  context.stroke();
  context.font = lettering(11);
  context.textAlign = "right";
  context.fillText(`${length} ${nautical ? "NM" : "m"}`, x + pixels, y + 13);
  context.textAlign = "left";
}
