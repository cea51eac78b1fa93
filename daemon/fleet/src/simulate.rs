//! Ships that are not there: a load for a broker and a sink. What they tell has the form and the length of what ships
//! tell, each record in a message of its own.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use insd_base::Time;
use rumqttc::v5::{AsyncClient, Event, EventLoop, Incoming};
use serde_json::{Value, json};

use crate::courier::FleetNow;
use crate::key::RunId;
use crate::link;
use crate::payload::{FleetMessage, envelope, topic};
use crate::plan::BrokerPlan;

/// Connections that share the ships.
const CONNECTIONS: u32 = 4;
/// Messages on their way of each connection.
const INFLIGHT: u16 = 200;
/// Time between two looks at what is due.
const LOOK: Duration = Duration::from_millis(10);
/// Of so many messages of a ship one is a state and the others are history.
const STATE: u64 = 10;
/// How long is waited for the last acknowledgements.
const PATIENCE: Duration = Duration::from_secs(30);

/// What is to be simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct FleetLoad {
    /// The broker. Connections add a number to the name of the client.
    pub broker: BrokerPlan,
    /// What topics begin with.
    pub prefix: String,
    /// Ships.
    pub ships: u32,
    /// Messages of each a second.
    pub rate: f64,
    /// For so long, s.
    pub seconds: f64,
}

/// What was sent.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct FleetLoadSent {
    /// Messages.
    pub sent: u64,
    /// Of them, those that the broker has acknowledged.
    pub acknowledged: u64,
    /// Bytes of their payloads.
    pub bytes: u64,
    /// How long that took, s.
    pub seconds: f64,
}

#[derive(Debug, Default)]
struct Counts {
    sent: AtomicU64,
    acknowledged: AtomicU64,
    bytes: AtomicU64,
}

/// Sends for as long as is asked for. Within a runtime.
///
/// # Errors
/// The broker cannot be reached, or goes away.
pub async fn simulate(load: FleetLoad, now: FleetNow) -> Result<FleetLoadSent, String> {
    let counts = Arc::new(Counts::default());
    let run = RunId::drawn().map_err(|fault| fault.to_string())?;
    let started = now().monotonic;
    let mut tasks = Vec::new();
    for connection in 0..CONNECTIONS.min(load.ships) {
        let (load, counts, now) = (load.clone(), Arc::clone(&counts), Arc::clone(&now));
        tasks.push(tokio::spawn(async move { sail(&load, connection, run, &counts, &now).await }));
    }
    for task in tasks {
        task.await.map_err(|fault| fault.to_string())??;
    }
    let count = |own: &AtomicU64| own.load(Ordering::Relaxed);
    Ok(FleetLoadSent {
        sent: count(&counts.sent),
        acknowledged: count(&counts.acknowledged),
        bytes: count(&counts.bytes),
        seconds: (now().monotonic - started).as_seconds(),
    })
}

/// The ships of one connection.
async fn sail(
    load: &FleetLoad,
    connection: u32,
    run: RunId,
    counts: &Arc<Counts>,
    now: &FleetNow,
) -> Result<(), String> {
    let client = format!("{}-{connection}", load.broker.client);
    let mut options = link::options(&BrokerPlan { client, ..load.broker.clone() })?;
    options.set_outgoing_inflight_upper_limit(INFLIGHT);
    let (client, eventloop) = AsyncClient::new(options, usize::from(INFLIGHT));
    let own = Arc::new(Counts::default());
    let mut drive = tokio::spawn(drive(eventloop, Arc::clone(&own), Arc::clone(counts)));
    let ships: Vec<u32> = (connection..load.ships).step_by(CONNECTIONS as usize).collect();
    let started = now().monotonic;
    let mut looks = tokio::time::interval(LOOK);
    let mut sent = 0_u64;
    loop {
        tokio::select! {
            _ = looks.tick() => {}
            ended = &mut drive => return Err(ended.map_err(|fault| fault.to_string())?),
        }
        let passed = (now().monotonic - started).as_seconds().min(load.seconds);
        let due = (passed * load.rate * ships.len() as f64) as u64;
        while sent < due {
            let ship = ships[(sent % ships.len() as u64) as usize];
            let message = message(load, run, ship, sent / ships.len() as u64 + 1, now);
            counts.bytes.fetch_add(message.payload.len() as u64, Ordering::Relaxed);
            link::publish_waiting(&client, message).await?;
            sent += 1;
            counts.sent.fetch_add(1, Ordering::Relaxed);
        }
        let all = sent == own.acknowledged.load(Ordering::Relaxed);
        let over = (now().monotonic - started).as_seconds() - load.seconds;
        if over >= 0.0 && (all || over > PATIENCE.as_secs_f64()) {
            drive.abort();
            return Ok(());
        }
    }
}

/// Drives a connection until it breaks; tells why.
async fn drive(mut eventloop: EventLoop, own: Arc<Counts>, all: Arc<Counts>) -> String {
    loop {
        match eventloop.poll().await {
            Ok(Event::Incoming(Incoming::PubAck(_))) => {
                own.acknowledged.fetch_add(1, Ordering::Relaxed);
                all.acknowledged.fetch_add(1, Ordering::Relaxed);
            }
            Ok(_) => {}
            Err(fault) => return fault.to_string(),
        }
    }
}

fn message(load: &FleetLoad, run: RunId, ship: u32, sequence: u64, now: &FleetNow) -> FleetMessage {
    let name = format!("simulated{ship:05}");
    let stamp = now();
    let utc = jiff::Timestamp::from_nanosecond(i128::from(stamp.system.as_nanos()));
    let utc = utc.map(|utc| format!("{utc:.3}")).ok();
    let is_state = sequence % STATE == 1;
    let record = record(ship, sequence, utc.as_deref(), stamp.monotonic, is_state).to_string();
    let text = envelope(&name, None, run, &[&record]);
    FleetMessage {
        topic: topic(&load.prefix, &name, if is_state { "state" } else { "log" }),
        payload: text.into_bytes(),
        retain: is_state,
        expiry: None,
        content: "application/json",
        keys: (run, sequence, sequence),
    }
}

/// A ship that goes round in circles.
fn record(ship: u32, sequence: u64, utc: Option<&str>, now: Time, is_state: bool) -> Value {
    let turn = (now.as_seconds() * 0.5 + f64::from(ship) * 7.3) % 360.0;
    let round = |value: f64, scale: f64| (value * scale).round() / scale;
    let motion = json!({
        "lat_deg": round(54.0 + f64::from(ship % 100) * 0.01 + 0.003 * turn.to_radians().sin(), 1e7),
        "lon_deg": round(8.0 + f64::from(ship / 100) * 0.01 + 0.005 * turn.to_radians().cos(), 1e7),
        "height_m": 41.337, "speed_kn": 12.481, "course_deg": round(turn, 1e3),
        "heading_deg": round(turn, 1e3), "roll_deg": round(turn.to_radians().sin(), 1e3), "pitch_deg": -0.213,
        "sigma_north_m": 0.713, "sigma_east_m": 0.698, "sigma_heading_deg": 0.052,
        "integrity": "available", "excluded": [], "hpl_m": 4.214, "source": { "name": "code" },
    });
    let mut record = json!({
        "seq": sequence, "time": { "utc": utc }, "mode": { "name": "aided" }, "motion": motion,
    });
    if is_state {
        record["alerts"] = json!([]);
    }
    record
}
