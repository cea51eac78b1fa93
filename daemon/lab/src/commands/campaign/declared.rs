//! What a campaign is: all on which its figures depend.

use std::ops::Range;

use insd_config::BadInput;
use serde::{Deserialize, Serialize};

use super::args::CampaignArgs;
use crate::evaluation::Yardstick;
use crate::scenario;

/// One variation of a campaign. Runs of two files may be put together if this is the same in both.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Declared {
    /// A checksum of the scenario and of all that follows, as CRC-64/XZ.
    pub(super) id: String,
    /// Version of the program.
    pub(super) insd: String,
    /// Name of the scenario with what was set in it.
    pub(super) scenario: String,
    /// What the sweep has set, KEY=VALUE.
    pub(super) sweep: Vec<String>,
    /// The first seed of the whole campaign.
    pub(super) from_seed: u64,
    /// The seed after the last one.
    pub(super) to_seed: u64,
    /// Options that change what comes out, as they are written on the command line.
    pub(super) options: String,
    /// What the heading is held against.
    pub(super) yardstick: Option<Yardstick>,
}

impl Declared {
    /// That of a scenario with the options of a command line.
    pub(super) fn of(
        named: &scenario::Named,
        sweep: Vec<String>,
        seeds: &Range<u64>,
        args: &CampaignArgs,
        yardstick: Option<Yardstick>,
    ) -> Self {
        let mut own = Declared {
            id: String::new(),
            insd: env!("CARGO_PKG_VERSION").to_owned(),
            scenario: named.name.clone(),
            sweep,
            from_seed: seeds.start,
            to_seed: seeds.end,
            options: args.words(),
            yardstick,
        };
        let crc = crc::Crc::<u64>::new(&crc::CRC_64_XZ);
        let all = format!("{own:?} {:?}", named.scenario);
        own.id = format!("{:016x}", crc.checksum(all.as_bytes()));
        own
    }

    /// All seeds of the campaign.
    pub(super) fn seeds(&self) -> Range<u64> {
        self.from_seed..self.to_seed
    }

    /// Whether another is the same.
    ///
    /// # Errors
    /// What differs.
    pub(super) fn is_same(
        &self,
        other: &Declared,
        own: &str,
        others: &str,
    ) -> Result<(), BadInput> {
        let seeds = |of: &Declared| format!("{}..{}", of.from_seed, of.to_seed);
        let pairs = [
            ("version", self.insd.clone(), other.insd.clone()),
            ("scenario", self.scenario.clone(), other.scenario.clone()),
            ("sweep", self.sweep.join(" "), other.sweep.join(" ")),
            ("seeds", seeds(self), seeds(other)),
            ("options", self.options.clone(), other.options.clone()),
            ("content of the scenario", self.id.clone(), other.id.clone()),
        ];
        match pairs.into_iter().find(|(_, own, other)| own != other) {
            None => Ok(()),
            Some((what, here, there)) => Err(BadInput(format!(
                "{others} is of another campaign than {own}: {what} is {there} there and {here} here"
            ))),
        }
    }
}
