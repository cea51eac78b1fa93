//! What became of the measurements: counted, and told; and how everybody stands.

use insd_base::{AidInnovation, Event, Received, Rejection, Source, Stands, Time};
use insd_nav::{Outcome, Report};

use crate::{Engine, Output};

impl Engine {
    pub(crate) fn reject(&mut self, received: &Received, aid: &'static str, reason: Rejection) {
        *self.counts.rejected.entry((aid, reason)).or_insert(0) += 1;
        let time = received.message.time();
        self.tell(Event::Rejected { time, source: received.source, aid, reason });
    }

    pub(crate) fn note(&mut self, report: &Report) {
        self.resumption.iter_mut().for_each(|resumption| resumption.hear(report));
        for aid in &report.floored {
            *self.counts.floored.entry(aid).or_insert(0) += 1;
        }
        for aid in &report.aids {
            let accepted = aid.outcome == Outcome::Accepted;
            for (component, (innovation, sigma)) in (0..3_u8).zip(aid.innovation) {
                if innovation.is_finite() {
                    self.outputs.push_back(Output::Innovation(AidInnovation {
                        time: aid.time,
                        aid: aid.aid,
                        component,
                        innovation,
                        sigma,
                        accepted,
                    }));
                }
            }
            match aid.outcome {
                Outcome::Accepted => *self.counts.accepted.entry(aid.aid).or_insert(0) += 1,
                Outcome::Rejected(reason) => {
                    self.note_rejection(aid.time, aid.source, aid.aid, reason);
                }
            }
        }
        self.outputs.extend(report.ranges.iter().copied().map(Output::Satellite));
        for (time, satellite, is_excluded) in report.satellites.iter().copied() {
            self.tell(Event::SatelliteJudged { time, satellite, is_excluded });
        }
        self.note_rtk(report);
        if report.position_reset {
            let time = report.aids.first().map_or(Time::START, |aid| aid.time);
            self.tell(Event::PositionReset { time });
        }
    }

    fn note_rejection(&mut self, time: Time, source: Source, aid: &'static str, reason: Rejection) {
        *self.counts.rejected.entry((aid, reason)).or_insert(0) += 1;
        self.tell(Event::Rejected { time, source, aid, reason });
    }

    /// Tells whoever stands otherwise than was told last. What is made of the others beside an IMU that is not believed is
    /// of no account.
    pub(crate) fn tell_standings(&mut self) {
        if self.shunned.is_some() {
            return;
        }
        let mut told = self.told;
        let new: Vec<Stands> = self.standings().filter(|stands| told.note(stands)).collect();
        self.told = told;
        for stands in new {
            let time = stands.since;
            self.tell(Event::Judged { time, stands });
        }
    }
}
