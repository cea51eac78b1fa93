//! `--without WHAT,WHAT`: what a voyage has and a replay is not to use.

use insd_base::{Received, Source};
use insd_config::BadInput;

use super::args::ReplayArgs;
use crate::ranges::GnssUse;

/// Something that a replay leaves out, to see what it gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Without {
    /// What was learnt before the voyage; nothing is yet.
    Learning,
    /// Pictures and what was made of them; nothing of them is used yet.
    Camera,
    /// The folder `raw/`, as if it were not there.
    Raw,
    /// The Doppler log, as if `log.csv` were not there.
    Log,
    /// Fixes and ranges.
    Gnss,
}

impl Without {
    /// Whether this was asked to be left out.
    fn is_asked(self, args: &ReplayArgs) -> bool {
        args.without.contains(&self)
    }

    /// What is made of GNSS, after all that the options say of it; `None` if they leave the choice.
    ///
    /// # Errors
    /// One option asks for what another leaves out.
    pub(super) fn gnss(args: &ReplayArgs) -> Result<Option<GnssUse>, BadInput> {
        let used = |way: &GnssUse| *way != GnssUse::None;
        if Without::Gnss.is_asked(args) {
            return match args.gnss.filter(used) {
                Some(_) => Err(BadInput("--without gnss leaves nothing for --gnss".to_owned())),
                None => Ok(Some(GnssUse::None)),
            };
        }
        if Without::Raw.is_asked(args) {
            return match args.gnss {
                Some(GnssUse::Tight) => {
                    Err(BadInput("--without raw leaves nothing for --gnss tight".to_owned()))
                }
                other => Ok(other.or(Some(GnssUse::Loose))),
            };
        }
        Ok(args.gnss)
    }

    /// Whether a message is of a sensor that is left out for the whole voyage.
    pub(super) fn drops(args: &ReplayArgs, received: &Received) -> bool {
        matches!(received.source, Source::Log(_)) && Without::Log.is_asked(args)
    }
}
