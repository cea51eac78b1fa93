//! Docking aids: lasers, radios, lidars that tell how far she is from a line or a point ashore.
//!
//! Each is judged by what inertial navigation and all others expect: a reading that contradicts it is not used, and who does so for seconds is not believed
//! before it has agreed for some. What they measure to has states of its own ([`crate::aids::ranging`]), which are carried while any of them speaks.

use insd_base::{RangingReading, Rejection, Source, Time};
use insd_estimation::Release;
use nalgebra::Matrix3;

use super::Filter;
use super::bent::bent_distance;
use super::entry::{Judged, NO_INNOVATION, RANGING_AID, detail, enter};
use super::ranging_standing::Mark;
use crate::aids::ranging::{self, RangingPrediction};
use crate::declaration::Carried;
use crate::error_state::carried;
use crate::error_state::{ATTITUDE, Innovation, POSITION, RANGING_ERRORS, VELOCITY, Weighed};
use crate::judge::{Aid, Separation, rows};
use crate::protection::RiskModel;
use crate::report::{Outcome, Report};

/// What nobody has measured to for so long, s, has no states any more.
const FORGOTTEN: f64 = 300.0;
/// Nothing is measured to from farther away, m.
const FARTHEST: f64 = 50_000.0;
/// How wrong a mark may be, 1-sigma, m: another fender, a container, a hand on the tripod.
const WRONG_MARK: f64 = 2.0;
/// Causes of the levels, beside those of the judge and of satellites.
const BY_MARK: usize = 900;

impl Filter {
    pub(super) fn apply_ranging(
        &mut self,
        reading: &RangingReading,
        source: Source,
        report: &mut Report,
    ) {
        let (judged, used_place) = match self.foresee(reading) {
            Ok((place, innovation, weighed)) => {
                let number = if let Source::Ranging(number) = source { number } else { u8::MAX };
                let is_withheld = self.judge_ranging((number, place), &innovation);
                let judged = self.take_ranging(&weighed, (number, is_withheld), report);
                (judged, (judged.outcome == Outcome::Accepted).then_some(place))
            }
            Err(reason) => {
                let outcome = Outcome::Rejected(reason);
                (Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION }, None)
            }
        };
        enter(report, reading.time, source, RANGING_AID, &judged);
        let now = self.state.time;
        if let Some(mark) = used_place.and_then(|place| self.rangings.marks[place].as_mut()) {
            mark.used = Some(now);
            self.heard.relative = Some(now);
        }
    }

    /// A reading beside what is expected of it, and the place of its mark; or why it is nothing to the ship.
    fn foresee(
        &mut self,
        reading: &RangingReading,
    ) -> Result<(usize, Innovation, Weighed), Rejection> {
        if !is_distance(reading) {
            return Err(Rejection::OutOfRange);
        }
        if !self.navigating || self.state.is_moored() {
            return Err(Rejection::NotUsable);
        }
        let now = self.state.time;
        let place = self.rangings.place(reading, now).ok_or(Rejection::NotUsable)?;
        self.begin_to_carry(Carried::WithRanging);
        let view = self.view();
        let prediction = ranging::predict(&view, reading, place).ok_or(Rejection::OutOfRange)?;
        let more = self.bent_ranging(&prediction);
        let innovation = ranging::innovation(&prediction, reading, place, more);
        let weighed = innovation.weigh(&self.state.covariance).ok_or(Rejection::OutOfRange)?;
        Ok((place, innovation, weighed))
    }

    /// Lets the judge hear a docking aid; tells whether it is left out.
    fn judge_ranging(&mut self, (number, place): (u8, usize), innovation: &Innovation) -> bool {
        let Some(aid) = Aid::docking(number) else { return false };
        if let Some(judge) = self.judge_now() {
            judge.note_mark(number.into(), place);
        }
        let own = usize::from(number);
        self.consult(aid, innovation, |age| rows::of_docking(own, place, age));
        self.withholds(aid)
    }

    fn take_ranging(
        &mut self,
        weighed: &Weighed,
        (number, is_withheld): (u8, bool),
        report: &mut Report,
    ) -> Judged {
        let now = self.state.time;
        let agrees = weighed.nis() <= self.gate.limit(weighed.rows());
        let standing = self.rangings.standings.get_mut(usize::from(number));
        let (is_used, turn) = standing.map_or((agrees, None), |own| own.hear(now, agrees));
        let is_used = is_used && !is_withheld;
        report.rangings.extend(turn.map(|turn| (now, number, turn)));
        let log_likelihood = self.bounded_likelihood(weighed);
        let refusal = if agrees { Rejection::SourceSuspect } else { Rejection::ChiSquare };
        let outcome = if is_used { Outcome::Accepted } else { Outcome::Rejected(refusal) };
        if is_used {
            self.absorb(weighed);
        }
        Judged { outcome, log_likelihood, innovation: detail(weighed) }
    }

    /// What a linear filter leaves out of a long arm that an unsure attitude turns, m^2.
    fn bent_ranging(&self, prediction: &RangingPrediction) -> f64 {
        let attitude = ATTITUDE.covariance(&self.state.covariance);
        bent_distance(&attitude, &prediction.gradient, &prediction.arm)
    }

    /// Once nobody has measured to any mark for a while their states are not carried any longer.
    pub(super) fn forget_silent_marks(&mut self) {
        let now = self.state.time;
        let is_silent = |mark: &Mark| (now - mark.heard).as_seconds() > FORGOTTEN;
        let marks = self.rangings.marks.iter().flatten();
        if marks.clone().next().is_some() && marks.clone().all(is_silent) {
            self.rangings.forget_marks();
            if let Some(judge) = self.judge_now() {
                carried(Carried::WithRanging).for_each(|own| judge.leave(own));
            }
            self.end_to_carry(Carried::WithRanging);
        }
    }

    /// The filter in which each mark that was used of late may be wrong by [`WRONG_MARK`].
    pub(super) fn without_marks(&self, now: Time, model: &RiskModel) -> Vec<Separation> {
        let chance = model.chance(model.satellite_fails);
        self.rangings
            .used(now)
            .filter_map(|(place, std)| self.without_mark(place, std, chance))
            .collect()
    }

    fn without_mark(&self, place: usize, std: f64, chance: f64) -> Option<Separation> {
        let p = &self.state.covariance;
        let first = 3 * place;
        let errors = &self.state.nominal.ranging_errors;
        let of: Vec<_> = (first..first + 3).map(|at| (at, errors[at])).collect();
        let free = WRONG_MARK / std.max(1e-3);
        let release = Release::new(p, RANGING_ERRORS.key(), &of, [1.0, free])?;
        let more: Matrix3<f64> = release.more(POSITION);
        Some(Separation {
            cause: BY_MARK + place,
            chance: (chance * release.log_factor.exp()).min(1.0),
            apart: release.apart(POSITION),
            growth: release.apart(VELOCITY),
            covariance: POSITION.covariance(p) + more,
            spreading: VELOCITY.covariance(p) + release.more(VELOCITY),
        })
    }
}

/// Whether it can be one.
fn is_distance(reading: &RangingReading) -> bool {
    reading.distance.abs() < FARTHEST && reading.std > 0.0 && reading.std.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filter::checkpoint::tests;
    use crate::timeline::Estimator;
    use insd_base::{
        Body, Ecef, Geodetic, Message, RangingBeam, RangingLine, RangingTarget, RangingTurn,
        Received, earth,
    };
    use nalgebra::Vector3;

    /// A line that runs north, 20 m east of where the filter has the ship.
    fn reading(filter: &Filter, distance: f64) -> RangingReading {
        let view = filter.view();
        let end = |north: f64| -> Geodetic {
            let way = view.c_ne.tr_mul(&Vector3::new(north, 20.0, 0.0));
            earth::geodetic(&Ecef(view.nominal.position + way))
        };
        RangingReading {
            time: filter.time(),
            mark: 4,
            target: RangingTarget::Line(RangingLine {
                ends: [end(-100.0), end(100.0)],
                water_right: false,
                std: 0.1,
                beam: RangingBeam::Across,
            }),
            lever: Body::default(),
            distance,
            std: 0.03,
        }
    }

    fn apply(filter: &mut Filter, reading: &RangingReading) -> Report {
        let (receipt, source) = (filter.time(), Source::Ranging(0));
        filter.apply(&Received { receipt, source, message: Message::Ranging(*reading) })
    }

    #[test]
    fn many_readings_do_not_make_a_line_better_known_than_its_survey() {
        let (_, mut filter) = tests::filter();
        let told = reading(&filter, 20.0);
        for _ in 0..2000 {
            let report = apply(&mut filter, &told);
            assert_eq!(report.aids[0].outcome, Outcome::Accepted);
        }
        let east = filter.view().c_ne.row(1) * POSITION.covariance(filter.covariance());
        let std = (east * filter.view().c_ne.row(1).transpose())[0].sqrt();
        // between two ends that are off each for itself
        assert!((std - 0.1 / 2.0_f64.sqrt()).abs() < 0.003, "{std}");
    }

    #[test]
    fn what_contradicts_is_refused_each_time_and_told_once_and_the_states_leave_after_it() {
        let (_, mut filter) = tests::filter();
        for _ in 0..50 {
            let told = reading(&filter, 20.0);
            apply(&mut filter, &told);
        }
        let (mut turns, before) = (Vec::new(), filter.nominal().position);
        let wrong = reading(&filter, 23.0);
        for step in 0..40 {
            let own = RangingReading { distance: 23.0 + 0.001 * f64::from(step), ..wrong };
            filter.state.time = filter.state.time + insd_base::Span::from_seconds(0.1);
            let report = apply(&mut filter, &own);
            assert_eq!(report.aids[0].outcome, Outcome::Rejected(Rejection::ChiSquare));
            turns.extend(report.rangings.iter().map(|(_, number, turn)| (*number, *turn)));
        }
        assert_eq!(turns, [(0, RangingTurn::Contradicted)]);
        assert_eq!(filter.nominal().position, before);
        assert!(filter.covariance().has(RANGING_ERRORS));
        filter.state.time = filter.state.time + insd_base::Span::from_seconds(400.0);
        filter.forget_silent_marks();
        assert!(!filter.covariance().has(RANGING_ERRORS));
    }
}
