//! From records to the messages of MQTT.
//!
//! Of our own a message is one object: who tells, in which run, and records in their order.
//!
//! ```text
//! {"schema":1,"ship":"imo9074729","name":"Ada","run":"9f0c...","records":[{"seq":17,"time":{...},"mode":{...},"motion":{...}}]}
//! ```

use insd_base::Span;
use serde_json::{Map, Value, json};

use crate::iso19848;
use crate::key::{RecordKey, RunId};
use crate::plan::{FleetPayload, FleetPlan};
use crate::signal_k;
use crate::spool::{SpoolBatch, SpoolClass};

/// Version of the envelope.
pub const SCHEMA: u32 = 1;
/// Texts that are shorter are not compressed, bytes.
const WORTHWHILE: usize = 512;
/// Level of zstd: batches are small, and every byte is paid for.
const LEVEL: i32 = 9;
/// What a compressed message begins with (RFC 8878, 3.1.1).
pub const ZSTD_MAGIC: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];

/// A message as the broker is to have it.
#[derive(Clone, Debug, PartialEq)]
pub struct FleetMessage {
    /// Its topic.
    pub topic: String,
    /// What it says.
    pub payload: Vec<u8>,
    /// Whether the broker keeps it for whoever comes later.
    pub retain: bool,
    /// After this the broker forgets it.
    pub expiry: Option<Span>,
    /// The kind of its payload.
    pub content: &'static str,
    /// Run, first and last sequence.
    pub keys: (RunId, u64, u64),
}

/// The topic of something that a ship tells.
#[must_use]
pub fn topic(prefix: &str, ship: &str, what: &str) -> String {
    format!("{prefix}/{ship}/{what}")
}

/// A record as it waits in the spool, with its sequence.
pub(crate) fn record(sequence: u64, told: Map<String, Value>) -> String {
    let mut all = Map::from_iter([("seq".to_owned(), json!(sequence))]);
    all.extend(told);
    Value::Object(all).to_string()
}

/// The state as it is now: the broker keeps the last one.
pub(crate) fn state(plan: &FleetPlan, key: RecordKey, told: Map<String, Value>) -> FleetMessage {
    let texts = [record(key.sequence, told)];
    let keys = (key.run, key.sequence, key.sequence);
    FleetMessage {
        retain: true,
        ..message(plan, "state", keys, &texts.each_ref().map(String::as_str))
    }
}

/// What was taken out of the spool.
pub(crate) fn batch(plan: &FleetPlan, batch: &SpoolBatch) -> FleetMessage {
    let texts: Vec<&str> = batch.records.iter().map(|own| own.text.as_str()).collect();
    let sequence = |own: Option<&crate::spool::SpoolRecord>| own.map_or(0, |own| own.key.sequence);
    let run = batch.records.first().map_or(RunId::of_number(0), |own| own.key.run);
    let keys = (run, sequence(batch.records.first()), sequence(batch.records.last()));
    message(plan, batch.class.name(), keys, &texts)
}

fn message(
    plan: &FleetPlan,
    what: &str,
    keys: (RunId, u64, u64),
    records: &[&str],
) -> FleetMessage {
    let text = match plan.payload {
        FleetPayload::Json => envelope(&plan.ship, plan.ship_name.as_deref(), keys.0, records),
        FleetPayload::SignalK => signal_k::delta(&plan.ship, records),
        FleetPayload::Iso19848 => iso19848::package(&plan.ship, records),
    };
    let wanted = what == SpoolClass::History.name() && plan.packs(SpoolClass::History);
    let (payload, content) = packed(text, wanted);
    FleetMessage {
        topic: topic(&plan.prefix, &plan.ship, what),
        payload,
        retain: false,
        expiry: plan.expiry,
        content,
        keys,
    }
}

/// The object of our own; `records` are objects already.
#[must_use]
pub fn envelope(ship: &str, name: Option<&str>, run: RunId, records: &[&str]) -> String {
    let name = name.map_or(String::new(), |name| format!("\"name\":{},", json!(name)));
    let (ship, records) = (json!(ship), records.join(","));
    format!(
        "{{\"schema\":{SCHEMA},\"ship\":{ship},{name}\"run\":\"{run}\",\"records\":[{records}]}}"
    )
}

/// Compressed, if that is wanted and makes it smaller.
fn packed(text: String, wanted: bool) -> (Vec<u8>, &'static str) {
    let plain = text.into_bytes();
    if wanted
        && plain.len() >= WORTHWHILE
        && let Ok(packed) = zstd::bulk::compress(&plain, LEVEL)
        && packed.len() < plain.len()
    {
        return (packed, "application/json+zstd");
    }
    (plain, "application/json")
}
