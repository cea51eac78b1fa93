// How old what is shown may be. The program judges what it knows, and leaves out what is too old; the time
// since its last word is added here, by the same rule (`snapshot/age.rs`).

// Age beyond which a value is not the present any more, and beyond which it is not shown any more, s.
const [OLD, GONE] = [0.5, 1.0];
const RANK = ["fresh", "old", "gone"];

const ofAge = (age) => (age <= OLD ? "fresh" : age <= GONE ? "old" : "gone");
const worst = (...all) => RANK[Math.max(...all.map((one) => RANK.indexOf(one)))];

// What is to be shown of the data so long after they came, s.
export function after(data, passed) {
  const time = { ...data.time, at_s: data.time.at_s + passed, told_ago_s: (data.time.told_ago_s ?? 0) + passed };
  const navigator = ofAge(time.told_ago_s);
  if (navigator === "gone") return forgotten(data, time);
  const motion = moved(data.motion, time.at_s, navigator);
  const docking = alongside(data.docking, time.at_s, navigator);
  const silent = { name: "fault", since_s: time.told_ago_s, reason: "nothing is heard of the navigator" };
  return { ...data, time, motion, docking, mode: navigator === "fresh" ? data.mode : silent };
}

// The quay stays where it is; what is told of the ship beside it does not.
function alongside(docking, now, navigator) {
  if (!docking) return null;
  const freshness = worst(docking.freshness ?? "fresh", ofAge(now - docking.valid_at_s), navigator);
  if (freshness !== "gone") return { ...docking, freshness };
  const { berth, choice, why, valid_at_s, quay } = docking;
  return { berth, choice, valid_at_s, quay, freshness, state: "not_valid", why: why ?? "nothing new is known", outline_m: [] };
}

function moved(motion, now, navigator) {
  if (!motion) return null;
  const freshness = worst(motion.freshness ?? "fresh", ofAge(now - motion.valid_at_s), navigator);
  if (freshness === "gone") return null;
  const heave = motion.heave && ofAge(now - motion.heave.valid_at_s) !== "gone" ? motion.heave : null;
  return { ...motion, freshness, heave };
}

// Names stay, and what is of the past anyway: changes of the mode, refused measurements, the journal. Alerts
// stay, too, as nobody knows whether they are over.
function forgotten(data, time) {
  const row = ({ name, kind, port, transport, what, point, messages }) => ({
    name, kind, port, transport, what, point, state: "unknown", used_for: [], refused: [], nodes: [],
    messages: (messages ?? []).map((message) => ({ name: message.name, rate_hz: message.rate_hz })),
  });
  return {
    ...data,
    time: { at_s: time.at_s, told_ago_s: time.told_ago_s, quality: "" },
    mode: { name: "fault", since_s: time.told_ago_s, reason: "nothing is heard of the navigator" },
    motion: null, docking: alongside(data.docking, time.at_s, "gone"), alignment: null, estimates: null, disturbance: null,
    engines: data.engines.map(({ name }) => ({ name, mode: "", in_use: false, healthy: false, differs: [] })),
    sensors: data.sensors.map(row), choices: [], watched: [],
    sky: { state: "unknown", satellites: [], refused: data.sky?.refused ?? [] },
    camera: data.camera && { sensor: data.camera.sensor, state: "unknown", has_picture: data.camera.has_picture },
    inputs: data.inputs.map(row), outputs: data.outputs.map(row),
    buses: data.buses.map((bus) => ({ ...row(bus), port: bus.port })),
    aids: data.aids.map(({ name }) => ({ name, in_use: false, reasons: [] })),
    schedule: {}, samples: {},
    recording: data.recording && { ...data.recording, state: "unknown" },
  };
}
