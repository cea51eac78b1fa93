//! What became of stored states over many voyages.

use std::collections::BTreeMap;

use insd_base::{Event, StoredDoubt, Time};
use serde::{Deserialize, Serialize};

use super::aligned::{Times, times};
use crate::table::{Align, Table, significant};

/// What became of the stored state of one voyage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StoredFate {
    /// There was none: the first voyage ended unaligned or away from her berth.
    Missing,
    /// Neither confirmed nor dropped.
    Undecided,
    /// Confirmed.
    Used(Time),
    /// Dropped.
    Dropped(Time, StoredDoubt),
}

/// The voyages together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StoredEstimates {
    /// Voyages that had no stored state to start with.
    pub missing: usize,
    /// Voyages that ended without a verdict.
    pub undecided: usize,
    /// Voyages whose stored heading was confirmed.
    pub used: usize,
    /// Voyages whose stored state was dropped, by reason.
    pub dropped: BTreeMap<&'static str, usize>,
    /// When it was confirmed; the others count as never.
    pub used_at: Times,
    /// When it was dropped; the others count as never.
    pub dropped_at: Times,
}

impl StoredFate {
    /// The fate that an event tells.
    #[must_use]
    pub fn of(event: &Event) -> Option<Self> {
        match *event {
            Event::StoredStateUsed { time } => Some(StoredFate::Used(time)),
            Event::StoredStateDropped { time, reason } => Some(StoredFate::Dropped(time, reason)),
            _ => None,
        }
    }
}

/// The voyages put together; `None` where no stored state was asked for.
pub(super) fn together(fates: &[StoredFate]) -> Option<StoredEstimates> {
    let count = |wanted: StoredFate| fates.iter().filter(|fate| **fate == wanted).count();
    let used = |fate: &StoredFate| match fate {
        StoredFate::Used(time) => Some(time.as_seconds()),
        _ => None,
    };
    let dropped = |fate: &StoredFate| match fate {
        StoredFate::Dropped(time, _) => Some(time.as_seconds()),
        _ => None,
    };
    let mut reasons = BTreeMap::new();
    for fate in fates {
        if let StoredFate::Dropped(_, reason) = fate {
            *reasons.entry(reason.as_str()).or_insert(0) += 1;
        }
    }
    (!fates.is_empty()).then(|| StoredEstimates {
        missing: count(StoredFate::Missing),
        undecided: count(StoredFate::Undecided),
        used: fates.iter().filter_map(used).count(),
        dropped: reasons,
        used_at: times(fates.iter().map(used)),
        dropped_at: times(fates.iter().map(dropped)),
    })
}

/// A row for each fate.
pub(super) fn table(stored: &StoredEstimates) -> Table {
    let mut columns = vec![("stored state", Align::Left)];
    columns.extend(["voyages", "median s", "90 % s", "max s"].map(|name| (name, Align::Right)));
    let mut table = Table::new(&columns);
    let time = |time: Option<f64>| time.map_or("-".to_owned(), |time| significant(time, 4));
    let mut row = |name: String, voyages: usize, times: Option<&Times>| {
        let at = |pick: fn(&Times) -> Option<f64>| time(times.and_then(pick));
        let times = [at(|t| t.median_s), at(|t| t.p90_s), at(|t| t.max_s)];
        table.push([vec![name, voyages.to_string()], times.to_vec()].concat());
    };
    row("confirmed".to_owned(), stored.used, Some(&stored.used_at));
    let reasons: Vec<String> = stored.dropped.iter().map(|(why, n)| format!("{n} {why}")).collect();
    let dropped = stored.dropped.values().sum();
    row(
        format!("dropped {}", reasons.join(", ")).trim().to_owned(),
        dropped,
        Some(&stored.dropped_at),
    );
    row("undecided".to_owned(), stored.undecided, None);
    row("none to start with".to_owned(), stored.missing, None);
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fates_are_counted_with_their_reasons_and_times() {
        let at = Time::from_seconds;
        let turned = |t| StoredFate::Dropped(at(t), StoredDoubt::Turned);
        let fates = [StoredFate::Used(at(70.0)), turned(40.0), turned(50.0), StoredFate::Missing];
        let all = together(&fates).unwrap();
        assert_eq!((all.used, all.missing, all.undecided), (1, 1, 0));
        assert_eq!(all.dropped["turned"], 2);
        assert_eq!(all.dropped_at.never, 2);
        let text = table(&all).to_string();
        assert!(text.contains("dropped 2 turned"), "{text}");
        assert_eq!(together(&[]), None);
    }
}
