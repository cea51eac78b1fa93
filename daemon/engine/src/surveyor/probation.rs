//! Whether a heading is hers that was found anew with an IMU that had been in doubt: somebody else must bear it out.
//!
//! Alignment finds which way the IMU points, and where that has been turned in its seat, it points elsewhere than the
//! bow. The course of a ship under way bears a heading out within what wind and current may do ([`super::mounting`]), a compass
//! to its own accuracy.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{ExternalReference, Mode, Solution, Span, Time};
use serde::{Deserialize, Serialize};

/// What may be wrong with a heading that nobody bears out, 1-sigma, rad: quarters of a turn.
const UNPROVEN: f64 = 45.0 * DEG;
/// With one that only the course bears out: leeway, and what the IMU does to it meanwhile; for so long after, s.
const BY_COURSE: f64 = 10.0 * DEG;
const SERVED: f64 = 1800.0;
/// A compass bears it out by being no farther off, rad, for so long, s; it may be silent between for no more than this, s.
const NEAR: f64 = 10.0 * DEG;
const LONG: f64 = 30.0;
const SILENT: f64 = 5.0;

/// How far it has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
enum Stage {
    /// Nobody doubts the IMU.
    #[default]
    Free,
    /// Nobody bears a heading out.
    Unproven,
    /// The course does, since then.
    ByCourse(Time),
}

/// The probation of an IMU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Probation {
    stage: Stage,
    /// Since when a compass has told the same, and when it was heard.
    near: Option<(Time, Time)>,
    /// How far such a heading may have led her astray since a receiver was in use, m, and until when that is counted.
    astray: f64,
    seen: Option<Time>,
}

impl Probation {
    /// The IMU is in doubt.
    pub(super) fn begin(&mut self) {
        self.enter(Stage::Unproven);
    }

    /// The same on a time line that is later by a span, nobody heard since.
    pub(crate) fn shifted(self, by: Span) -> Self {
        let stage = match self.stage {
            Stage::ByCourse(since) => Stage::ByCourse(since + by),
            other => other,
        };
        Probation { stage, near: None, seen: None, ..self }
    }

    /// Alignment begins anew.
    pub(super) fn begin_anew(&mut self) {
        let is_free = self.stage == Stage::Free;
        self.enter(if is_free { Stage::Free } else { Stage::Unproven });
    }

    /// What a compass told before is of no account.
    fn enter(&mut self, stage: Stage) {
        (self.stage, self.near) = (stage, None);
    }

    /// Sees whether the course bears out her heading.
    pub(super) fn see(&mut self, is_ahead: bool, now: Time) {
        match self.stage {
            Stage::Unproven if is_ahead => self.stage = Stage::ByCourse(now),
            Stage::ByCourse(since) if (now - since).as_seconds() > SERVED => {
                self.enter(Stage::Free);
            }
            _ => {}
        }
    }

    /// Sees how she makes her way: by a log and such a heading, or by a receiver.
    pub(super) fn see_way(&mut self, solution: &Solution) {
        let before = self.seen.replace(solution.time);
        let since = before.map_or(0.0, |before| (solution.time - before).as_seconds());
        match solution.mode {
            Mode::Aided => self.astray = 0.0,
            Mode::DeadReckoning => self.astray += since * solution.speed() * self.least().sin(),
            _ => {}
        }
    }

    /// 1-sigma of what may be wrong with her heading, rad.
    fn least(&self) -> f64 {
        match self.stage {
            Stage::Free => 0.0,
            Stage::Unproven => UNPROVEN,
            Stage::ByCourse(_) => BY_COURSE,
        }
    }

    /// Hears a compass beside the heading that was found and its 1-sigma, rad.
    pub(super) fn hear(&mut self, told: &ExternalReference, found: (f64, f64)) {
        let Some(heading) = told.heading.filter(|_| self.stage != Stage::Free) else { return };
        let is_near = wrap_pi(heading - found.0).abs() < NEAR && found.1 < NEAR;
        let before = self.near.filter(|(_, last)| (told.time - *last).as_seconds() < SILENT);
        let since = before.map_or(told.time, |(since, _)| since);
        self.near = is_near.then_some((since, told.time));
        if is_near && (told.time - since).as_seconds() > LONG {
            self.enter(Stage::Free);
        }
    }

    /// What is claimed of a solution; `reach` from the IMU to the antenna, m. A heading that nobody bears out yet points
    /// anywhere, and so does the lever arm; who has no more than that is not aligned. What passes through in standby has
    /// its heading from a compass.
    pub(super) fn claim(&self, mut solution: Solution, reach: f64) -> Solution {
        if solution.mode == Mode::Standby {
            return solution;
        }
        let least = self.least();
        if self.stage == Stage::Unproven && solution.mode.is_navigating() {
            solution.mode = Mode::InMotionAlignment;
        }
        let sigma = &mut solution.sigma;
        sigma.heading = sigma.heading.max(least);
        let astray = (reach * least.sin()).hypot(self.astray);
        sigma.position.0.x = sigma.position.0.x.hypot(astray);
        sigma.position.0.y = sigma.position.0.y.hypot(astray);
        solution
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Attitude, Body, Geodetic, Integrity, Judgement, Ned, Parties, SolutionSigma};

    fn told(seconds: f64, heading: f64) -> ExternalReference {
        ExternalReference {
            time: Time::from_seconds(seconds),
            heading: Some(heading * DEG),
            ..ExternalReference::default()
        }
    }

    /// Until when a heading of north is unproven beside a compass that tells this, s.
    fn proven(heading: f64, sigma: f64) -> Option<u32> {
        let mut probation = Probation::default();
        probation.begin();
        (0..120).find(|second| {
            probation.hear(&told(f64::from(*second), heading), (0.0, sigma * DEG));
            probation.stage == Stage::Free
        })
    }

    #[test]
    fn a_compass_bears_a_heading_out_by_telling_the_same_for_half_a_minute() {
        assert_eq!(proven(355.0, 1.0), Some(31));
        assert_eq!(proven(90.0, 1.0), None);
        assert_eq!(proven(0.0, 20.0), None, "such a heading says nothing");
    }

    #[test]
    fn the_course_bears_it_out_roughly_until_half_an_hour_has_passed_in_peace() {
        let at = |minutes: f64| Time::from_seconds(minutes * 60.0);
        let mut probation = Probation::default();
        probation.see(true, at(1.0));
        assert_eq!(probation.stage, Stage::Free, "nobody doubts it");
        probation.begin();
        probation.see(false, at(2.0));
        assert_eq!(probation.stage, Stage::Unproven);
        probation.see(true, at(3.0));
        assert_eq!(probation.stage, Stage::ByCourse(at(3.0)));
        probation.begin_anew();
        assert_eq!(probation.stage, Stage::Unproven, "another heading");
        probation.see(true, at(4.0));
        probation.see(true, at(33.0));
        assert_eq!(probation.stage, Stage::ByCourse(at(4.0)));
        let resumed = probation.shifted(Span::from_seconds(60.0));
        assert_eq!(resumed.stage, Stage::ByCourse(at(5.0)), "on another time line");
        probation.see(false, at(35.0));
        assert_eq!(probation.stage, Stage::Free);
    }

    /// A ship that makes 5 m/s.
    fn going(seconds: f64, mode: Mode) -> Solution {
        let judgement =
            Judgement { integrity: Integrity::Consistent, excluded: Parties::default() };
        Solution {
            source: None,
            time: Time::from_seconds(seconds),
            position: Geodetic::default(),
            velocity: Ned::new(3.0, 4.0, 0.0),
            attitude: Attitude::default(),
            rate: Body::default(),
            sigma: SolutionSigma::default(),
            mode,
            judgement,
            hidden: insd_base::Protection::default(),
        }
    }

    #[test]
    fn a_way_made_by_log_and_such_a_heading_is_as_unsure_until_a_receiver_is_used_again() {
        let mut probation = Probation { stage: Stage::ByCourse(Time::START), ..Default::default() };
        for second in 0..=100 {
            probation.see_way(&going(f64::from(second), Mode::DeadReckoning));
        }
        let claimed = |probation: &Probation, mode| {
            probation.claim(going(100.0, mode), 0.0).sigma.position.0.x
        };
        let sigma = claimed(&probation, Mode::DeadReckoning);
        assert!((sigma - 500.0 * BY_COURSE.sin()).abs() < 1e-6, "{sigma}");
        probation.enter(Stage::Free);
        assert_eq!(claimed(&probation, Mode::DeadReckoning), sigma, "what was made astray stays");
        probation.see_way(&going(101.0, Mode::Aided));
        assert_eq!(claimed(&probation, Mode::Aided), 0.0);
    }
}
