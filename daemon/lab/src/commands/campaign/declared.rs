//! What a campaign is: all on which its figures depend.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::args::CampaignArgs;
use crate::evaluation::{Run, Yardstick};
use crate::parts::{CampaignDeclaration, checksum};
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
        own.id = checksum(&format!("{own:?} {:?}", named.scenario));
        own
    }

    /// All seeds of the campaign.
    pub(super) fn seeds(&self) -> Range<u64> {
        self.from_seed..self.to_seed
    }
}

impl CampaignDeclaration for Declared {
    type Key = u64;
    type Run = Run;
    const KEY: &'static str = "seed";

    fn id(&self) -> &str {
        &self.id
    }

    fn keys(&self) -> Vec<u64> {
        self.seeds().collect()
    }

    fn key_of(run: &Run) -> u64 {
        run.seed
    }

    fn has_key(&self, key: &u64) -> bool {
        self.seeds().contains(key)
    }

    fn range(&self) -> String {
        format!("{}..{}", self.from_seed, self.to_seed)
    }

    fn is_counterpart_of(&self, other: &Self) -> bool {
        self.sweep == other.sweep
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        vec![
            ("version", self.insd.clone()),
            ("scenario", self.scenario.clone()),
            ("sweep", self.sweep.join(" ")),
            ("seeds", self.range()),
            ("options", self.options.clone()),
            ("content of the scenario", self.id.clone()),
        ]
    }
}
