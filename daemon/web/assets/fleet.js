// The sheet of a fleet: a row for each ship, those first that need somebody. Unknown is a dash.
'use strict';

const AGAIN_MS = 2000;
// a state that is older than this is history, and shown as such
const SILENT_S = 300;

const number = (value, digits, unit) => (Number.isFinite(value) ? `${value.toFixed(digits)} ${unit}` : '–');
const words = (text) => (text ? text.replaceAll('_', ' ') : '–');

function position(motion) {
  if (!Number.isFinite(motion.lat_deg) || !Number.isFinite(motion.lon_deg)) return '–';
  const part = (value, signs) => `${Math.abs(value).toFixed(4)}° ${value < 0 ? signs[1] : signs[0]}`;
  return `${part(motion.lat_deg, 'NS')} ${part(motion.lon_deg, 'EW')}`;
}

function age(seconds) {
  if (!Number.isFinite(seconds)) return 'never';
  if (seconds < 120) return `${Math.max(0, Math.round(seconds))} s ago`;
  if (seconds < 7200) return `${Math.round(seconds / 60)} min ago`;
  return seconds < 172800 ? `${Math.round(seconds / 3600)} h ago` : `${Math.round(seconds / 86400)} days ago`;
}

// the alerts that somebody has to attend to, the most urgent first
function alerts(list) {
  const active = (list ?? []).filter((own) => own.state !== 'normal' && own.state !== 'rectified');
  const rank = { emergency_alarm: 0, alarm: 1, warning: 2, caution: 3 };
  active.sort((a, b) => (rank[a.priority] ?? 4) - (rank[b.priority] ?? 4));
  const worst = active[0]?.priority;
  return {
    text: active.length ? `${active[0].title}${active.length > 1 ? ` and ${active.length - 1} more` : ''}` : 'none',
    kind: worst === undefined ? 'good' : rank[worst] <= 1 ? 'bad' : rank[worst] === 2 ? 'warn' : '',
    urgency: worst === undefined ? 9 : (rank[worst] ?? 4),
  };
}

function row(ship, now) {
  const state = ship.state ?? {};
  const motion = state.motion ?? {};
  const seconds = ship.seen_utc ? (now - Date.parse(ship.seen_utc)) / 1000 : NaN;
  const told = alerts(state.alerts);
  const isSilent = !(seconds < SILENT_S);
  const integrity = { available: 'good', unavailable: 'warn', fault: 'bad' }[motion.integrity] ?? '';
  return {
    urgency: isSilent ? 10 : told.urgency,
    name: ship.name ?? ship.ship,
    isSilent,
    cells: [
      [ship.name ? `${ship.name} (${ship.ship})` : ship.ship, ''],
      [words(state.mode?.name), state.mode?.name === 'aided' ? 'good' : 'warn'],
      [number(motion.heading_deg, 1, '°'), 'num'],
      [number(motion.sigma_heading_deg, 2, '°'), 'num'],
      [position(motion), 'num'],
      [number(motion.speed_kn, 1, 'kn'), 'num'],
      [words(motion.integrity), integrity],
      [(motion.excluded ?? []).join(', ') || 'none', motion.excluded?.length ? 'warn' : ''],
      [told.text, told.kind],
      [age(seconds), isSilent ? 'bad' : 'num'],
    ],
  };
}

function show(fleet) {
  const now = Date.parse(fleet.now_utc);
  const rows = fleet.ships.map((ship) => row(ship, now));
  rows.sort((a, b) => a.urgency - b.urgency || a.name.localeCompare(b.name));
  const made = rows.map((own) => {
    const line = document.createElement('tr');
    line.className = own.isSilent ? 'silent' : '';
    for (const [text, kind] of own.cells) {
      const cell = line.insertCell();
      cell.textContent = text;
      cell.className = kind;
    }
    return line;
  });
  document.getElementById('ships').replaceChildren(...made);
  const silent = rows.filter((own) => own.isSilent).length;
  document.getElementById('sum').textContent = `${rows.length} ships, ${silent} silent for more than ${SILENT_S / 60} min`;
}

async function look() {
  try {
    const answer = await fetch('api/v1/fleet', { cache: 'no-store' });
    show(await answer.json());
  } catch {
    document.getElementById('sum').textContent = 'the sink does not answer: what stands here is old';
  }
  setTimeout(look, AGAIN_MS);
}

look();
