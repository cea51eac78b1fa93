//! Which source the solution lives by: the best one that was used of late.

use insd_base::{FixQuality, Message, SolutionSource, Time};

use super::entry::{CODE_AID, PHASE_AID, POSITION_AID, RATE_AID, RTK_AID, VELOCITY_AID};
use crate::report::{Outcome, Report};

/// A place by integers counts for so long, s: RTK lapses for an epoch or two.
const FIXED: f64 = 2.5;
/// Others for so long, s.
const FRESH: f64 = 5.0;
/// How many kinds there are but for dead reckoning.
const KINDS: [SolutionSource; 5] = [
    SolutionSource::Rtk,
    SolutionSource::Float,
    SolutionSource::Carrier,
    SolutionSource::Code,
    SolutionSource::Doppler,
];

/// When each was used last.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sources([Option<Time>; KINDS.len()]);

impl Sources {
    /// Takes note of what was used of a message.
    pub(super) fn note(&mut self, now: Time, report: &Report, message: &Message) {
        let used = report.aids.iter().filter(|aid| aid.outcome == Outcome::Accepted);
        let of_fix = match message {
            Message::Gnss(fix) => by_quality(fix.quality),
            _ => SolutionSource::Code,
        };
        let source = |aid: &str| match aid {
            RTK_AID => Some(SolutionSource::Rtk),
            PHASE_AID => Some(SolutionSource::Carrier),
            CODE_AID => Some(SolutionSource::Code),
            RATE_AID | VELOCITY_AID => Some(SolutionSource::Doppler),
            POSITION_AID => Some(of_fix),
            _ => None,
        };
        for source in used.filter_map(|aid| source(aid.aid)) {
            let own = self.0.iter_mut().zip(KINDS).find(|(_, kind)| *kind == source);
            own.into_iter().for_each(|(last, _)| *last = Some(now));
        }
    }

    /// The best one that was used of late.
    pub(super) fn best(&self, now: Time) -> SolutionSource {
        let is_used = |(last, kind): &(&Option<Time>, SolutionSource)| {
            let lasts = if *kind == SolutionSource::Rtk { FIXED } else { FRESH };
            last.is_some_and(|last| (now - last).as_seconds() < lasts)
        };
        let best = self.0.iter().zip(KINDS).find(is_used);
        best.map_or(SolutionSource::DeadReckoning, |(_, kind)| kind)
    }
}

fn by_quality(quality: FixQuality) -> SolutionSource {
    match quality {
        FixQuality::RtkFixed => SolutionSource::Rtk,
        FixQuality::RtkFloat => SolutionSource::Float,
        _ => SolutionSource::Code,
    }
}
