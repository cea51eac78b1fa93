//! How each ship of the fleet stood last.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::{Value, json};

use super::row::{FleetRow, RowKind};

/// One ship.
#[derive(Clone, Debug, Default)]
struct Ship {
    name: Option<String>,
    /// Run and sequence of the last state.
    key: Option<(crate::key::RunId, i64)>,
    /// What she said last of how she stands.
    state: Value,
    /// UTC of the newest record that has come of her.
    seen: Option<(i64, String)>,
    records: u64,
}

/// All ships. Its clones are the same.
#[derive(Clone, Debug, Default)]
pub struct FleetBoard(Arc<Mutex<BTreeMap<String, Ship>>>);

impl FleetBoard {
    /// Takes note of a row.
    pub fn note(&self, row: &FleetRow) {
        let mut ships = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let ship = ships.entry(row.ship.clone()).or_default();
        ship.records += 1;
        if let Some((nanos, utc)) = row.nanos.zip(row.utc.clone())
            && ship.seen.as_ref().is_none_or(|(seen, _)| *seen < nanos)
        {
            ship.seen = Some((nanos, utc));
        }
        // the one that comes last counts, unless it is a repeat
        let is_older =
            |(run, sequence): (crate::key::RunId, i64)| run == row.run && sequence > row.sequence;
        if row.kind == RowKind::State && !ship.key.is_some_and(is_older) {
            ship.key = Some((row.run, row.sequence));
            ship.name.clone_from(&row.name);
            ship.state = row.told.clone();
        }
    }

    /// How many there are.
    #[must_use]
    pub fn ships(&self) -> usize {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// All of them as an object of JSON; `now` is UTC by the clock of this computer.
    #[must_use]
    pub fn json(&self, now: &str) -> String {
        let ships = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let one = |(name, own): (&String, &Ship)| {
            let seen = own.seen.as_ref().map(|(_, utc)| utc);
            json!({ "ship": name, "name": own.name, "seen_utc": seen, "records": own.records, "state": own.state })
        };
        json!({ "now_utc": now, "ships": ships.iter().map(one).collect::<Vec<_>>() }).to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::key::RunId;

    #[test]
    fn a_repeat_of_an_older_state_does_not_count() {
        let board = FleetBoard::default();
        let row = |sequence: i64, nanos: i64| FleetRow {
            kind: RowKind::State,
            ship: "imo1".to_owned(),
            name: Some("Ada".to_owned()),
            run: RunId::of_number(1),
            sequence,
            utc: Some(nanos.to_string()),
            nanos: Some(nanos),
            told: json!({ "seq": sequence }),
        };
        [row(5, 50), row(4, 40)].iter().for_each(|own| board.note(own));
        let shown: Value = serde_json::from_str(&board.json("now")).unwrap();
        assert_eq!(shown["ships"][0]["state"]["seq"], 5);
        assert_eq!(shown["ships"][0]["seen_utc"], "50");
        assert_eq!(board.ships(), 1);
    }
}
