//! What ships have sent, as rows: checked, as whoever may write to the broker may send anything.

use serde::Deserialize;
use serde_json::Value;

use crate::key::RunId;
use crate::payload::{SCHEMA, ZSTD_MAGIC};

/// Longest text that a compressed message may hold, bytes.
const MAX_TEXT: usize = 4 << 20;
/// Longest name of a ship.
const MAX_NAME: usize = 128;

/// What a row tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowKind {
    /// How everything stands.
    State,
    /// Where she was and how she lay.
    History,
    /// A change of an alert.
    Alert,
}

impl RowKind {
    /// That of a topic's last level.
    fn of(level: &str) -> Option<Self> {
        match level {
            "state" => Some(RowKind::State),
            "log" => Some(RowKind::History),
            "alert" => Some(RowKind::Alert),
            _ => None,
        }
    }
}

/// A record that has come ashore.
#[derive(Clone, Debug, PartialEq)]
pub struct FleetRow {
    /// What it tells.
    pub kind: RowKind,
    /// Of which ship.
    pub ship: String,
    /// Her name for people.
    pub name: Option<String>,
    /// In which run.
    pub run: RunId,
    /// Its number within the run.
    pub sequence: i64,
    /// UTC as the ship knew it, RFC 3339.
    pub utc: Option<String>,
    /// The same, ns since 1970.
    pub nanos: Option<i64>,
    /// What it says.
    pub told: Value,
}

/// The message as it is read.
#[derive(Deserialize)]
struct Envelope {
    schema: u32,
    ship: String,
    name: Option<String>,
    run: String,
    records: Vec<Value>,
}

/// The rows of a message; `Err` says why it is none of ours.
///
/// # Errors
/// It is no message of [`SCHEMA`], or speaks of another ship than its topic.
pub fn rows(prefix: &str, topic: &str, payload: &[u8]) -> Result<Vec<FleetRow>, String> {
    let levels = topic.strip_prefix(prefix).and_then(|rest| rest.strip_prefix('/'));
    let (ship, kind) = levels
        .and_then(|rest| rest.split_once('/'))
        .and_then(|(ship, level)| Some((ship, RowKind::of(level)?)))
        .ok_or("no topic of a ship")?;
    let unpacked;
    let text = if payload.starts_with(&ZSTD_MAGIC) {
        unpacked = zstd::bulk::decompress(payload, MAX_TEXT).map_err(|fault| fault.to_string())?;
        &unpacked
    } else {
        payload
    };
    let envelope: Envelope = serde_json::from_slice(text).map_err(|fault| fault.to_string())?;
    if envelope.schema != SCHEMA {
        return Err(format!("schema {}: expected {SCHEMA}", envelope.schema));
    }
    if envelope.ship != ship || ship.is_empty() || ship.len() > MAX_NAME {
        return Err("it speaks of another ship than its topic".to_owned());
    }
    let run = RunId::parse(&envelope.run).ok_or("run: expected sixteen hexadecimal digits")?;
    // a database has no place for it in a text
    let has_nul = text.windows(6).any(|own| own == br"\u0000");
    let row = |mut told: Value| {
        if has_nul {
            without_nul(&mut told);
        }
        let sequence = told.get("seq").and_then(Value::as_i64).filter(|own| *own >= 0);
        let (utc, nanos) =
            told.pointer("/time/utc").and_then(Value::as_str).and_then(instant).unzip();
        Ok(FleetRow {
            kind,
            ship: ship.to_owned(),
            name: envelope.name.as_ref().map(|name| name.replace('\0', "")),
            run,
            sequence: sequence.ok_or("seq: expected a number")?,
            utc,
            nanos,
            told,
        })
    };
    envelope.records.into_iter().map(row).collect()
}

/// An instant of this age of the world.
fn instant(text: &str) -> Option<(String, i64)> {
    let instant: jiff::Timestamp = text.parse().ok()?;
    let nanos = i64::try_from(instant.as_nanosecond()).ok().filter(|own| *own >= 0)?;
    Some((format!("{instant:.3}"), nanos))
}

fn without_nul(value: &mut Value) {
    match value {
        Value::String(text) => text.retain(|c| c != '\0'),
        Value::Array(all) => all.iter_mut().for_each(without_nul),
        Value::Object(all) => {
            let bad: Vec<String> = all.keys().filter(|key| key.contains('\0')).cloned().collect();
            bad.iter().for_each(|key| drop(all.remove(key)));
            all.values_mut().for_each(without_nul);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::payload::envelope;

    const TOPIC: &str = "insd/v1/imo1/log";

    fn text(records: &[&str]) -> Vec<u8> {
        envelope("imo1", Some("Ada"), RunId::of_number(9), records).into_bytes()
    }

    #[test]
    fn records_become_rows_with_their_keys_plain_and_compressed() {
        let records = [r#"{"seq":4,"time":{"utc":"2026-11-28T12:00:00.5Z"}}"#, r#"{"seq":5}"#];
        let plain = text(&records);
        let packed = zstd::bulk::compress(&plain, 3).unwrap();
        for payload in [plain, packed] {
            let rows = rows("insd/v1", TOPIC, &payload).unwrap();
            assert_eq!(rows.iter().map(|own| own.sequence).collect::<Vec<_>>(), [4, 5]);
            assert_eq!(rows[0].utc.as_deref(), Some("2026-11-28T12:00:00.500Z"));
            assert_eq!((rows[1].utc.as_deref(), rows[1].name.as_deref()), (None, Some("Ada")));
        }
    }

    #[test]
    fn nobody_writes_in_the_name_of_another_ship() {
        let payload = text(&[r#"{"seq":4}"#]);
        assert!(rows("insd/v1", "insd/v1/imo2/log", &payload).is_err());
        assert!(rows("insd/v1", "other/imo1/log", &payload).is_err());
    }

    #[test]
    fn what_a_database_cannot_hold_is_taken_out() {
        let rows =
            rows("insd/v1", TOPIC, &text(&[r#"{"seq":1,"a\u0000b":1,"c":["x\u0000y"]}"#])).unwrap();
        assert_eq!(rows[0].told.to_string(), r#"{"c":["xy"],"seq":1}"#);
    }

    proptest! {
        #[test]
        fn no_bytes_make_it_panic(payload: Vec<u8>, packed: bool) {
            let payload = if packed { [ZSTD_MAGIC.as_slice(), &payload].concat() } else { payload };
            let _ = rows("insd/v1", TOPIC, &payload);
        }
    }
}
