//! Which source the solution lives by, and how far RTK is believed: counted, and told when it changes.

use insd_base::{Event, Solution, SolutionSource, SourceReason};
use insd_nav::Report;

use crate::Engine;

impl Engine {
    /// Tells another source than was told last.
    pub(crate) fn tell_source(&mut self, solution: &Solution) {
        let Some(to) = solution.source else { return };
        let from = self.source.replace(to);
        if from == Some(to) {
            return;
        }
        let is_better = from.is_none_or(|from| to < from);
        let no_rtk = self.no_rtk.filter(|_| from == Some(SolutionSource::Rtk));
        let why = if is_better {
            SourceReason::Better
        } else {
            no_rtk.map_or(SourceReason::Unheard, SourceReason::NoRtk)
        };
        self.tell(Event::SourceChanged { time: solution.time, from, to, why });
    }

    /// Takes note of what an epoch against a base came to.
    pub(crate) fn note_rtk(&mut self, report: &Report) {
        if let Some(outcome) = report.against_base {
            self.no_rtk = outcome.err();
            let word = outcome.err().map_or("fixed", |why| why.as_str());
            *self.counts.rtk.entry(word).or_insert(0) += 1;
        }
        for (time, turn) in report.rtk.iter().copied() {
            *self.counts.rtk.entry(turn.as_str()).or_insert(0) += 1;
            self.tell(Event::RtkJudged { time, turn });
        }
        for (time, ranging, turn) in report.rangings.iter().copied() {
            self.tell(Event::RangingJudged { time, ranging, turn });
        }
        for (time, turn) in report.camera.iter().copied() {
            self.tell(Event::CameraJudged { time, turn });
        }
    }
}
