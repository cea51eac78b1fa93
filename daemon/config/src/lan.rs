//! The ship's network after IEC 61162-450.

use std::collections::BTreeMap;
use std::net::Ipv4Addr;

use insd_output::{LanConfig, MessageKind, Sfi, TransmissionGroup};
use schemars::JsonSchema;
use serde::Deserialize;

/// Routers that a datagram may pass, and one.
const TTL: std::ops::RangeInclusive<u32> = 1..=255;

/// How a port speaks on the ship's network.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LanSection {
    /// Who sends: two letters and four digits.
    pub source: String,
    /// Address of the interface by which to leave; the system's choice if left out.
    pub interface: Option<Ipv4Addr>,
    /// Routers that a datagram may pass, and one.
    #[serde(default = "one")]
    pub ttl: u32,
    /// Transmission groups of messages that are not to go where their talker belongs.
    #[serde(default)]
    pub groups: BTreeMap<String, String>,
    /// Whether the time of validity goes with each sentence.
    #[serde(default)]
    pub time: bool,
    /// Whether each sentence has a datagram of its own.
    #[serde(default)]
    pub single: bool,
}

fn one() -> u32 {
    1
}

impl LanSection {
    /// What makes its datagrams; `None` if its source is no name of a sender. What else is not known is
    /// left out: see [`LanSection::faults`].
    #[must_use]
    pub fn config(&self) -> Option<LanConfig> {
        let group = |(kind, group): (&String, &String)| {
            Some((MessageKind::named(kind)?, TransmissionGroup::from_name(group)?))
        };
        Some(LanConfig {
            source: Sfi::new(&self.source)?,
            groups: self.groups.iter().filter_map(group).collect(),
            time: self.time,
            single: self.single,
        })
    }

    /// All that is wrong with it, in words.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        if Sfi::new(&self.source).is_none() {
            faults.push("lan: source: expected two capital letters and 0001 to 9999".to_owned());
        }
        if !TTL.contains(&self.ttl) {
            faults.push(format!("lan: ttl: expected {} to {}", TTL.start(), TTL.end()));
        }
        for (kind, group) in &self.groups {
            if MessageKind::named(kind).is_none() {
                let names: Vec<&str> = MessageKind::all().map(MessageKind::name).collect();
                faults.push(format!("lan: groups: {kind}: expected one of {}", names.join(", ")));
            }
            if TransmissionGroup::from_name(group).is_none() {
                let names: Vec<&str> =
                    TransmissionGroup::ALL.into_iter().map(TransmissionGroup::name).collect();
                let names = names.join(", ");
                faults.push(format!("lan: groups: {kind}: {group}: expected one of {names}"));
            }
        }
        faults
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(text: &str) -> LanSection {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn a_sound_section_has_no_faults_and_keeps_what_it_says() {
        let section = section("source = \"IN0001\"\ngroups = { ROT = \"usr1\" }\ntime = true");
        assert_eq!(section.faults(), Vec::<String>::new());
        let config = section.config().unwrap();
        assert_eq!(config.source.as_str(), "IN0001");
        let rot = MessageKind::named("ROT").unwrap();
        assert_eq!(config.groups, [(rot, TransmissionGroup::Usr1)]);
        assert_eq!((config.time, config.single), (true, false));
    }

    #[test]
    fn every_fault_is_named() {
        let section = section(
            "source = \"in1\"\nttl = 0\ngroups = { ROT = \"USR9\", TOR = \"MISC\", HDT = \"SATD\" }",
        );
        let faults = section.faults();
        let starts = ["lan: source:", "lan: ttl:", "lan: groups: ROT: USR9:", "lan: groups: TOR:"];
        assert_eq!(faults.len(), starts.len(), "{faults:?}");
        for (fault, start) in faults.iter().zip(starts) {
            assert!(fault.starts_with(start), "{fault}");
        }
        assert_eq!(section.config(), None);
    }
}
