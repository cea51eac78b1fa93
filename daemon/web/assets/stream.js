// The data as they come: server-sent events, and what to do when they do not.

import { said, t } from "./texts.js";

// Pause before another attempt where the browser has given up, ms.
const PAUSE = 1500;

// `onData` takes what came, whole or put into the last whole; `onLink` is told whether there is a connection.
export function follow({ onData, onLink }) {
  let data = null;

  function take(event, whole) {
    const part = JSON.parse(event.data);
    data = whole ? part : { ...data, ...part };
    onLink(true);
    onData(data, whole);
  }

  function open() {
    const source = new EventSource("api/v1/stream?hz=10");
    source.addEventListener("snapshot", (event) => take(event, true));
    source.addEventListener("live", (event) => {
      // without a whole snapshot there is nothing to put it into
      if (data) take(event, false);
    });
    source.onerror = () => {
      onLink(false);
      if (source.readyState === EventSource.CLOSED) setTimeout(open, PAUSE);
    };
  }

  open();
}

export async function load(path) {
  const answer = await fetch(path, { cache: "no-store" });
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return answer.json();
}

// Gives an order; resolves to a text that says what became of it.
export async function order(path, token, body) {
  const answer = await fetch(path, {
    method: "POST",
    headers: { "Authorization": `Bearer ${token}`, "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });
  if (answer.ok) return { done: true, text: t("done") };
  const fault = await answer.json().catch(() => ({ error: t("refused", { status: answer.status }) }));
  return { done: false, text: said(fault.error) };
}
