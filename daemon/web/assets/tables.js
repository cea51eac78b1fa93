// Sensors, ports, measurements and the rest that stands in tables.

import { byId, fill, right, bad, setText, setClass, show, make } from "./dom.js";
import { DASH, age, bytes, clock, count, fixed, known, percent, rate, bearing, words } from "./format.js";
import { said, t } from "./texts.js";

const SENSOR_TONES = { valid: "good", received: "calm", waiting: "calm", rejected: "bad", silent: "bad" };
const PORT_TONES = { open: "good", waiting: "calm", ended: "calm", silent: "warn", absent: "bad", lost: "bad" };
const BUS_TONES = { active: "good", warning: "warn", passive: "warn", off: "bad" };

const state = (word, tones) => ({ text: words(word), cls: `state ${tones[word] ?? "calm"}` });

const causes = (list) =>
  (list ?? []).filter((cause) => cause.count > 0).map((cause) => `${words(cause.reason)} ${count(cause.count)}`).join(", ");

// What an IMU measures is no mode of navigation.
const quantity = (code) => (code === "inertial" ? t("quantity_inertial") : words(code));

function says(sensor) {
  const parts = [
    said(sensor.fix),
    known(sensor.satellites) ? t("satellites_n", { n: sensor.satellites }) : null,
    sensor.status?.map(said).join(", ") || (sensor.status_word ? t("status_word", { word: sensor.status_word.toString(16).toUpperCase().padStart(4, "0") }) : null),
    known(sensor.temperature_c) ? `${fixed(sensor.temperature_c, 1)} °C` : null,
    said(sensor.device),
  ];
  return parts.filter(Boolean).join(" · ") || DASH;
}

// There was a source and there is none: that is bad. One that was never there is not missed.
const lost = (choice) => !choice.sensor && Boolean(choice.why);

export function sensors(data) {
  fill(byId("sensor-table"), data.sensors.map((sensor) => [
    { text: sensor.name, sub: t("on_port", { kind: words(sensor.kind), port: sensor.port }) },
    state(sensor.state, SENSOR_TONES),
    { text: sensor.used_for.map(quantity).join(", ") || DASH, sub: sensor.why ? words(sensor.why) : "" },
    right(rate(sensor.rate_hz)),
    right(age(sensor.age_s), sensor.state === "silent" ? "is-bad" : ""),
    says(sensor),
    right(count(sensor.passed)),
    bad(sensor.lost),
    { text: causes(sensor.refused) || DASH, cls: "wrap" },
  ]));
  const list = byId("choices");
  const lines = data.choices.map((choice) => {
    const values = { quantity: quantity(choice.quantity), sensor: choice.sensor ?? t("none"), why: words(choice.why) };
    return t(choice.why && (choice.sensor || lost(choice)) ? "choice_why" : "choice", values);
  });
  while (list.children.length > lines.length) list.lastChild.remove();
  lines.forEach((line, k) => {
    if (!list.children[k]) list.append(make("li"));
    setText(list.children[k], line);
    setClass(list.children[k], lost(data.choices[k]) ? "is-bad" : "");
  });
}

export function watched(data) {
  const all = data.watched ?? [];
  const told = (one, name) => (known(one[`${name}_m`]) ? `${fixed(one[`${name}_m`], 0)} m` : `${fixed(one[`${name}_deg`], 2)}°`);
  const verdict = (one) => (!one.differs ? t("within") : one.wrong ? t("is_wrong", { name: one.wrong }) : t("differ_unknown"));
  fill(byId("watch-table"), all.map((one) => [
    one.sensor, one.against ?? "insd", words(one.quantity),
    right(told(one, "difference"), one.differs ? "is-bad" : ""), right(told(one, "sigma")), right(told(one, "limit")),
    { text: verdict(one), cls: `state ${one.differs ? "bad" : "good"}` },
  ]));
  show(byId("watch-card"), all.length > 0);
}

export function ports(data) {
  fill(byId("inputs"), data.inputs.map((port) => [
    { text: port.name, sub: `${port.transport} · ${port.what}` },
    state(port.state, PORT_TONES),
    right(rate(port.rate_bytes_s)), right(age(port.age_s)), right(bytes(port.bytes)), right(count(port.frames)),
    bad(port.damaged), bad(port.skipped_bytes), bad(port.overrun_bytes), bad(port.refused), bad(port.reopened),
    { text: said(port.last_error) || DASH, cls: "wrap" },
  ]));
  fill(byId("outputs"), data.outputs.map(output));
  const { epochs, late, skipped } = data.schedule;
  setText(byId("schedule"), !known(epochs) ? "" : t("schedule", { epochs: count(epochs), late: count(late), skipped: count(skipped) }));
  show(byId("bus-card"), data.buses.length > 0);
  fill(byId("buses"), data.buses.map((bus) => [
    bus.port, state(bus.state, BUS_TONES), right(percent(bus.load)), right(rate(bus.rate_hz)),
    bad(bus.errors), bad(bus.offs), bad(bus.dropped),
    bus.node_state ? { text: t("address", { state: words(bus.node_state), address: bus.address ?? DASH }), sub: bus.name ?? "" } : DASH,
    { text: bus.nodes.map((node) => `${node.address}: ${node.name}`).join(", ") || DASH, cls: "wrap" },
  ]));
}

function output(port) {
  const load = known(port.capacity_bytes_s) && known(port.rate_bytes_s) ? port.rate_bytes_s / port.capacity_bytes_s : null;
  const ms = (value) => right(known(value) ? fixed(value, value < 10 ? 2 : 0) : DASH);
  const names = port.messages.map((message) => `${message.name}${known(message.rate_hz) ? ` ${Number(message.rate_hz.toPrecision(3))} Hz` : ""}`);
  const details = port.messages.map((message) =>
    t("message_details", { name: message.name, sent: message.sent, dropped: message.dropped, p99: fixed(message.age_ms?.p99, 1) }));
  return [
    { text: port.name, sub: `${port.transport} · ${port.what}${port.point ? ` · ${t("at_point", { point: port.point })}` : ""}` },
    { ...state(port.state, PORT_TONES), sub: said(port.last_error) },
    right(rate(port.rate_bytes_s)),
    right(percent(load), load > 0.9 ? "is-bad" : ""),
    right(count(port.sent)), bad(port.dropped), right(count(port.waiting)),
    ms(port.age_ms?.last), ms(port.age_ms?.p50), ms(port.age_ms?.p99), ms(port.age_ms?.max),
    { text: names.join(", ") || DASH, cls: "wrap", title: details.join("\n") },
  ];
}

// An innovation as a bar of characters about the middle: three sigmas to each side.
function gauge(value) {
  if (!known(value)) return { text: DASH, cls: "num" };
  const mark = Math.max(0, Math.min(12, Math.round(value * 2) + 6));
  const bar = [...Array(13).keys()].map((k) => (k === mark ? "●" : k === 6 ? "┼" : "─")).join("");
  return { text: `${bar} ${fixed(value, 1)}`, cls: `num gauge ${Math.abs(value) > 3 ? "is-bad" : ""}` };
}

export function measurements(data) {
  fill(byId("aids"), data.aids.map((aid) => [
    words(aid.name),
    aid.in_use ? { text: t("in_use_yes"), cls: "state good" } : { text: t("in_use_no"), cls: "state warn" },
    right(age(aid.age_s)), right(count(aid.accepted)), bad(aid.rejected),
    gauge(aid.last_normalised_innovation),
    { text: causes(aid.reasons) || DASH, cls: "wrap" },
  ]));
  const { used, gaps, duplicates, out_of_order: late, out_of_range: wild } = data.samples;
  setText(byId("samples"), known(used) ? t("samples", { used: count(used), gaps, refused: duplicates + late + wild }) : "");
  const newest = [...data.rejections].reverse();
  fill(byId("rejections"), newest.map((one) => [
    one.utc ? clock(one.utc) + one.utc.slice(19, 21) : `${fixed(one.at_s, 1)} s`, one.source, words(one.aid), words(one.reason),
  ]));
  show(byId("no-rejections"), newest.length === 0);
}

const SEVERITIES = { error: "bad", warn: "warn", info: "calm", debug: "calm" };

export function system(data) {
  const engines = data.engines.map((engine) => [
    engine.name, words(engine.mode), right(bearing(engine.heading_deg, 2)), right(fixed(engine.sigma_heading_deg, 3)),
    engine.differs.length > 0
      ? { text: t("differs", { what: engine.differs.map(words).join(", ") }), cls: "state bad" }
      : { text: t(engine.in_use ? "engine_in_use" : engine.healthy ? "engine_reserve" : "engine_out"), cls: `state ${engine.in_use ? "good" : "calm"}` },
  ]);
  fill(byId("engines"), engines);
  const recording = data.recording;
  const node = byId("recording-state");
  setText(node, recording ? `${words(recording.state)}${recording.last_error ? `: ${recording.last_error}` : ""}` : t("off"));
  setClass(node, recording?.state === "failing" ? "is-bad" : "");
  estimates(data.estimates);
  standings(data.standings ?? []);
  installation(data.installation ?? []);
  fill(byId("events"), [...data.events].reverse().map((event) => [
    event.utc ? clock(event.utc) : `${fixed(event.at_s, 1)} s`, state(event.severity, SEVERITIES), { text: said(event.text), cls: "wrap" },
  ]));
}

export const AXES = ["axis_forward", "axis_starboard", "axis_down"];

const STANDINGS = { doubtful: "is-bad", excluded: "is-bad" };
const PARTIES = {
  gnss: "party_gnss", gnss2: "party_gnss2", gnss3: "party_gnss3", log: "party_log", heading: "party_heading", reference: "party_reference",
  imu: "party_imu", antennas: "party_antennas", docking: "party_docking",
};

function standings(all) {
  const list = byId("standings");
  const key = JSON.stringify([t("believed"), all]);
  if (list.dataset.shown === key) return;
  list.dataset.shown = key;
  list.replaceChildren(...all.map((one) => {
    const item = document.createElement("li");
    item.className = STANDINGS[one.standing] ?? "";
    const told = one.standing === "trusted" && !one.text ? t("believed") : said(one.text);
    const advice = one.advice ? ` ${said(one.advice)}` : "";
    item.textContent = t("standing", { who: one.name in PARTIES ? t(PARTIES[one.name]) : one.name, what: told, advice });
    return item;
  }));
  show(byId("believed"), all.some((one) => one.standing !== "trusted"));
}

function installation(findings) {
  const list = byId("findings");
  const key = JSON.stringify(findings.map((found) => said(found.text)));
  if (list.dataset.shown === key) return;
  list.dataset.shown = key;
  list.replaceChildren(...findings.map((found) => {
    const item = document.createElement("li");
    item.textContent = said(found.text);
    return item;
  }));
  show(byId("found"), findings.length > 0);
}

function estimates(found) {
  const rows = [];
  const add = (what, estimate, unit, digits) => {
    if (estimate) rows.push([what, right(fixed(estimate.value, digits)), right(fixed(estimate.sigma, digits)), unit]);
  };
  found?.gyro_bias_deg_h.forEach((one, k) => add(t("gyro_bias", { axis: t(AXES[k]) }), one, "°/h", 4));
  found?.accel_bias_ug.forEach((one, k) => add(t("accel_bias", { axis: t(AXES[k]) }), one, "µg", 0));
  add(t("log_scale"), found?.log_scale_ppm, "ppm", 0);
  add(t("log_misalignment"), found?.log_misalignment_deg, "°", 2);
  found?.gnss_lever_m.forEach((one, k) => add(t("gnss_lever", { axis: t(AXES[k]) }), one, "m", 2));
  add(t("gnss_delay"), found?.gnss_delay_s, "s", 3);
  add(t("course_less_heading"), found?.course_less_heading_deg, "°", 1);
  fill(byId("estimates"), rows);
}
