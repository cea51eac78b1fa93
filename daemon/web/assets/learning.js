// What is learnt of the sensors, in words, and the switch that keeps it from being used.

import { byId, make, setAttr, setText, show } from "./dom.js";
import { fixed, known } from "./format.js";
import { give, mayChange } from "./alerts.js";
import { said, t } from "./texts.js";

let allowed = true;
let shown = "";

export function startLearning() {
  byId("learning-switch").addEventListener("click", async () => {
    const answer = await give("api/v1/learning", { use: !allowed });
    setText(byId("learning-outcome"), answer.done ? "" : answer.text);
  });
}

function used(own) {
  if (!own.may_be_used) return t("learning_off");
  const parts = [[own.uses_log, t("learning_log")], [own.uses_current, t("learning_current")], [own.uses_temperature, t("learning_temperature")]];
  const told = parts.filter(([is]) => is).map(([, name]) => name);
  return told.length ? t("learning_used", { what: told.join(", ") }) : t("learning_not_yet");
}

export function learning(data) {
  const own = data.learning;
  show(byId("no-learning"), !own);
  show(byId("learning-switch"), Boolean(own));
  setText(byId("learning-use"), own ? used(own) : "");
  allowed = own?.may_be_used ?? true;
  setText(byId("learning-switch"), t(allowed ? "learning_stop" : "learning_start"));
  byId("learning-switch").disabled = !mayChange();
  setAttr(byId("learning-switch"), "title", mayChange() ? "" : t("token_missing"));
  const outage = known(own?.outage_m) && known(own?.outage_without_m);
  setText(byId("learning-outage"), outage ? t("learning_outage", { with: fixed(own.outage_m, 0), without: fixed(own.outage_without_m, 0) }) : "");
  const told = (own?.words ?? []).map(said);
  if (told.join("\n") === shown) return;
  shown = told.join("\n");
  byId("learning-words").replaceChildren(...told.map((line) => make("li", {}, line)));
}
