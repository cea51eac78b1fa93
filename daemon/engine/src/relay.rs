//! A ship without an IMU still has receivers and a compass: what they say passes through, marked as such.
//!
//! The position is that of the antenna as received, its sigma widened by the lever arm that nobody can
//! turn without an attitude; course and speed are the receiver's, the heading a compass's. Roll, pitch
//! and rates are not known, and the sigmas say so.

use std::f64::consts::PI;

use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, GnssFix, Message, Mode, Motion, Ned, Received, Solution, SolutionSigma, Time,
};
use insd_nav::floors::Floors;

/// What is older than this is not passed on, s.
const STALE: f64 = 3.0;
/// Acceleration of a ship that nobody measures, m/s^2, and turn, rad/s, 1-sigma.
const UNSEEN: f64 = 0.1;
const UNSEEN_TURN: f64 = 0.5 * DEG;
/// Heading of a compass that does not say how good it is, 1-sigma, rad.
const COMPASS: f64 = 1.0 * DEG;
/// Velocity of a receiver that tells none, 1-sigma, m/s.
const NO_SPEED: f64 = 30.0;

/// What was said last of position and heading.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Relay {
    fix: Option<GnssFix>,
    heading: Option<(Time, f64, f64)>,
    latest: Time,
}

impl Relay {
    /// Hears a plausible message.
    pub(crate) fn hear(&mut self, received: &Received) {
        self.latest = self.latest.max(received.receipt);
        match &received.message {
            Message::Gnss(fix) if fix.quality.is_measured() && fix.position.is_some() => {
                self.fix = Some(*fix);
            }
            Message::Reference(reference) => {
                let std = reference.heading_std.filter(|std| std.is_finite() && *std > 0.0);
                let heading = reference.heading.filter(|heading| heading.is_finite());
                let told = heading.map(|told| (reference.time, told, std.unwrap_or(COMPASS)));
                self.heading = told.or(self.heading);
            }
            _ => {}
        }
    }

    /// The ship as receivers and compass have her, carried on to the newest message; `reach` from the IMU
    /// to the antenna at most, m. `None` without a fix of late.
    pub(crate) fn motion(&self, reach: f64) -> Option<Motion> {
        let fix = self.fix.filter(|fix| self.age(fix.time) < STALE)?;
        let (position, age) = (fix.position?, self.age(fix.time).max(0.0));
        let velocity = fix.velocity.map(level).unwrap_or_default();
        let speed_std = self.speed_std(&fix) + UNSEEN * age;
        let place_std = Floors::default().gnss_position(fix.position_std, fix.quality).value;
        let across = reach + speed_std * age;
        let (heading, heading_std) = self.heading();
        let solution = Solution {
            time: fix.time,
            position,
            velocity,
            attitude: Attitude { roll: 0.0, pitch: 0.0, heading },
            rate: Body::default(),
            sigma: SolutionSigma {
                position: Ned(place_std.map(|std| std.hypot(across))),
                velocity: Ned::new(speed_std, speed_std, speed_std),
                roll: PI,
                pitch: PI,
                heading: heading_std,
            },
            mode: Mode::Standby,
            judgement: insd_base::Judgement::default(),
            source: None,
            hidden: insd_base::Protection::default(),
        };
        let motion = Motion { solution, acceleration: None, covariance: None, current: None };
        Some(motion.at(self.latest.max(fix.time)))
    }

    fn age(&self, time: Time) -> f64 {
        (self.latest - time).as_seconds()
    }

    fn speed_std(&self, fix: &GnssFix) -> f64 {
        match fix.velocity {
            Some(_) => Floors::default().gnss_velocity(fix.velocity_std).value.xy().max(),
            None => NO_SPEED,
        }
    }

    /// Heading and its sigma; a heading of zero that could be anything where no compass is heard.
    fn heading(&self) -> (f64, f64) {
        match self.heading {
            Some((time, heading, std)) if self.age(time) < STALE => {
                (heading, std.hypot(UNSEEN_TURN * self.age(time).max(0.0)))
            }
            _ => (0.0, PI),
        }
    }
}

/// A receiver that does not tell the down component leaves it at rest.
fn level(velocity: Ned) -> Ned {
    Ned(velocity.0.map(|part| if part.is_finite() { part } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{ExternalReference, FixQuality, Geodetic, Source};

    fn at(receipt: f64, message: Message) -> Received {
        Received { receipt: Time::from_seconds(receipt), source: Source::Gnss(0), message }
    }

    fn fix(time: f64) -> Message {
        Message::Gnss(GnssFix {
            time: Time::from_seconds(time),
            position: Some(Geodetic::from_degrees(54.0, 8.0, 40.0)),
            velocity: Some(Ned::new(0.0, 5.0, 0.0)),
            position_std: Some(Ned::new(1.0, 1.0, 2.0)),
            quality: FixQuality::Autonomous,
            ..GnssFix::default()
        })
    }

    fn compass(time: f64) -> Message {
        Message::Reference(ExternalReference {
            time: Time::from_seconds(time),
            heading: Some(1.5),
            ..ExternalReference::default()
        })
    }

    #[test]
    fn position_course_and_heading_pass_through_and_nothing_else_is_claimed() {
        let mut relay = Relay::default();
        relay.hear(&at(10.2, fix(10.0)));
        relay.hear(&at(10.4, compass(10.3)));
        let solution = relay.motion(5.0).unwrap().solution;
        assert_eq!((solution.mode, solution.time), (Mode::Standby, Time::from_seconds(10.4)));
        assert!((solution.attitude.heading - 1.5).abs() < 1e-9);
        assert!((solution.velocity.0.y - 5.0).abs() < 1e-9);
        assert!(solution.position.longitude.to_degrees() > 8.0, "carried on by 2 m");
        assert!(solution.sigma.position.0.x > 5.0, "the lever arm is not turned");
        assert!(solution.sigma.roll > 3.0 && solution.sigma.pitch > 3.0);
    }

    #[test]
    fn what_is_old_is_not_passed_on() {
        let mut relay = Relay::default();
        relay.hear(&at(10.2, fix(10.0)));
        relay.hear(&at(10.2, compass(10.2)));
        relay.hear(&at(12.0, fix(12.0)));
        relay.hear(&at(13.5, fix(13.5)));
        let solution = relay.motion(0.0).unwrap().solution;
        assert!(solution.sigma.heading > 3.0, "the compass is silent");
        relay.hear(&at(16.6, compass(16.6)));
        assert!(relay.motion(0.0).is_none(), "the receiver is");
    }
}
