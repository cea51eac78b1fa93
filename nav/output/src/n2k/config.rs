//! Which groups are sent, as the configuration has it.

use std::collections::BTreeMap;

use insd_base::Span;
use insd_n2k::node::Transmit;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::load::{BITS_PER_SECOND, BusLoad};
use super::table::{Entry, GROUPS, default_transmit, least_interval};

/// Longest time from one message to the next, ms.
const LONGEST_MS: u32 = 60_000;
const MILLISECOND: i64 = 1_000_000;
/// Largest share of the bus that the table may take with as much stuffing as there can be. The rest is
/// for everybody else.
const LARGEST_SHARE: f64 = 0.5;

/// The groups that are sent otherwise than by default, by name or number.
#[derive(Clone, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(transparent)]
pub struct N2kGroups {
    /// Name (`heading`) or number (`127250`) of a group, and what is special about it.
    pub groups: BTreeMap<String, GroupSection>,
}

/// What is special about one group; what is left out is as by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GroupSection {
    /// Time from one message to the next, ms.
    pub interval_ms: Option<u32>,
    /// 0, the highest, to 7.
    pub priority: Option<u8>,
    /// Whether it is sent.
    pub enabled: Option<bool>,
}

impl N2kGroups {
    /// The table: the default one with the changes. Groups that are not known change nothing.
    #[must_use]
    pub fn transmit(&self) -> Vec<Transmit> {
        let mut table = default_transmit();
        for (key, section) in &self.groups {
            let pgn = named(key).map(|entry| entry.pgn);
            for line in table.iter_mut().filter(|line| Some(line.pgn) == pgn) {
                section.apply(line);
            }
        }
        table
    }

    /// All faults, each with its group and what was expected.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let mut seen = BTreeMap::new();
        for (key, section) in &self.groups {
            let Some(entry) = named(key) else {
                let names: Vec<&str> = GROUPS.iter().map(|entry| entry.name).collect();
                faults.push(format!("{key}: expected one of {}", names.join(", ")));
                continue;
            };
            if let Some(other) = seen.insert(entry.pgn, key) {
                faults.push(format!("{key}: expected each group once, {other} is the same"));
            }
            section.look(key, entry.pgn, &mut faults);
        }
        let load = BusLoad::of(&self.transmit()).worst_bits() / BITS_PER_SECOND;
        if faults.is_empty() && load > LARGEST_SHARE {
            let (share, most) = (load * 100.0, LARGEST_SHARE * 100.0);
            faults
                .push(format!("all groups: {share:.0} % of the bus, expected at most {most:.0} %"));
        }
        faults
    }
}

impl GroupSection {
    fn apply(&self, line: &mut Transmit) {
        let span = |ms: u32| Span::from_nanos(i64::from(ms) * MILLISECOND);
        line.interval = self.interval_ms.map_or(line.interval, span);
        line.priority = self.priority.unwrap_or(line.priority);
        line.enabled = self.enabled.unwrap_or(line.enabled);
    }

    fn look(&self, key: &str, pgn: u32, faults: &mut Vec<String>) {
        let least = least_interval(pgn).map_or(0, |least| least.as_nanos() / MILLISECOND);
        let range = |ms: u32| i64::from(ms) >= least && ms <= LONGEST_MS;
        if !self.interval_ms.is_none_or(range) {
            faults.push(format!("{key}: interval_ms: expected {least} to {LONGEST_MS}"));
        }
        if self.priority.is_some_and(|priority| priority > 7) {
            faults.push(format!("{key}: priority: expected 0 to 7"));
        }
    }
}

fn named(key: &str) -> Option<&'static Entry> {
    GROUPS.iter().find(|entry| entry.name == key || key.parse() == Ok(entry.pgn))
}
