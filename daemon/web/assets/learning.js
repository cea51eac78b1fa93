// What is learnt of the sensors, in words, and the switch that keeps it from being used.

import { byId, make, setAttr, setText, show } from "./dom.js";
import { fixed, known } from "./format.js";
import { give, mayChange } from "./alerts.js";

let allowed = true;
let shown = "";

export function startLearning() {
  byId("learning-switch").addEventListener("click", async () => {
    const answer = await give("api/v1/learning", { use: !allowed });
    setText(byId("learning-outcome"), answer.done ? "" : answer.text);
  });
}

function used(own) {
  if (!own.may_be_used) return "not used: switched off";
  const parts = [[own.uses_log, "log"], [own.uses_current, "current"], [own.uses_temperature, "temperature of the IMU"]];
  const told = parts.filter(([is]) => is).map(([, name]) => name);
  return told.length ? `used: ${told.join(", ")}` : "not used yet";
}

export function learning(data) {
  const own = data.learning;
  show(byId("no-learning"), !own);
  show(byId("learning-switch"), Boolean(own));
  setText(byId("learning-use"), own ? used(own) : "");
  allowed = own?.may_be_used ?? true;
  setText(byId("learning-switch"), allowed ? "Do not use" : "Use");
  byId("learning-switch").disabled = !mayChange();
  setAttr(byId("learning-switch"), "title", mayChange() ? "" : "A token is needed: type it in below the alerts");
  const outage = known(own?.outage_m) && known(own?.outage_without_m);
  setText(byId("learning-outage"), outage ? `If GNSS failed now: ${fixed(own.outage_m, 0)} m in 5 min, without learning ${fixed(own.outage_without_m, 0)}.` : "");
  const told = own?.words ?? [];
  if (told.join("\n") === shown) return;
  shown = told.join("\n");
  byId("learning-words").replaceChildren(...told.map((line) => make("li", {}, line)));
}
