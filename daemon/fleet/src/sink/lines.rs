//! Rows as line protocol of InfluxDB, which VictoriaMetrics and Telegraf read, too. A point that comes twice is
//! the same point: measurement, tags and time are its key.

use std::fmt::Write as _;

use serde_json::Value;

use super::columns::{ALERT, FleetColumn, SHIP};
use super::row::{FleetRow, RowKind};

/// The line of a row; `None` if it has no time or nothing to tell, as then it cannot be a point.
#[must_use]
pub fn line(row: &FleetRow) -> Option<String> {
    let (measurement, columns): (&str, &[FleetColumn]) = match row.kind {
        RowKind::State => ("insd_state", &SHIP),
        RowKind::History => ("insd_history", &SHIP),
        RowKind::Alert => ("insd_alert", &ALERT),
    };
    let mut line = format!("{measurement},ship={}", tag(&row.ship));
    if row.kind == RowKind::Alert {
        // two alerts may change at one time
        let id = row.told.pointer("/alert/id").and_then(Value::as_u64)?;
        let _ = write!(line, ",alert={id}");
    }
    let mut separator = ' ';
    for column in columns {
        let Some(value) = column.of(&row.told) else { continue };
        let _ = match value {
            Value::String(text) => write!(line, "{separator}{}={}", column.name, quoted(text)),
            number => write!(line, "{separator}{}={number}", column.name),
        };
        separator = ',';
    }
    let _ = write!(line, "{separator}seq={}i {}", row.sequence, row.nanos?);
    Some(line)
}

fn tag(text: &str) -> String {
    let plain = text.chars().filter(|c| !c.is_control());
    plain.flat_map(|c| ", =\\".contains(c).then_some('\\').into_iter().chain([c])).collect()
}

fn quoted(text: &str) -> String {
    let plain = text.chars().filter(|c| !c.is_control());
    let escaped: String =
        plain.flat_map(|c| "\"\\".contains(c).then_some('\\').into_iter().chain([c])).collect();
    format!("\"{escaped}\"")
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::key::RunId;

    fn row(kind: RowKind, told: Value) -> FleetRow {
        let nanos = Some(1_800_000_000_000_000_000);
        let (ship, run) = ("imo 1,a".to_owned(), RunId::of_number(1));
        FleetRow { kind, ship, name: None, run, sequence: 7, utc: None, nanos, told }
    }

    #[test]
    fn a_row_is_a_point_with_what_is_known() {
        let told =
            json!({ "mode": { "name": "a\"b" }, "motion": { "lat_deg": 53.5, "lon_deg": null } });
        let line = line(&row(RowKind::History, told)).unwrap();
        let expected =
            r#"insd_history,ship=imo\ 1\,a mode="a\"b",lat_deg=53.5,seq=7i 1800000000000000000"#;
        assert_eq!(line, expected);
    }

    #[test]
    fn without_a_time_there_is_no_point() {
        let row = FleetRow { nanos: None, ..row(RowKind::State, json!({})) };
        assert_eq!(line(&row), None);
    }
}
