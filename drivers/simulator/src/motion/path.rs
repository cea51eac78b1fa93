//! The guidance path: heading, course and speed as smooth functions of time, out of the legs.

use insd_base::units::{DEG, KNOT};

use super::jet::Jet;
use super::ramp::Ramp;
use super::seaway::Heading;
use crate::scenario::{Leg, Route, SHORTEST_CHANGE, TURN_ENTRY};

/// A turn: the rate of turn rises to its steady value, stays, and falls to zero.
#[derive(Clone, Copy, Debug)]
struct Turn {
    entry: Ramp,
    exit: Ramp,
}

impl Turn {
    /// A turn by `angle`, rad, at `rate`, rad/s, that begins at `start`, s. The rates of two equal
    /// and opposite ramps, `angle / rate` apart, enclose just that angle, however short the turn.
    fn new(start: f64, angle: f64, rate: f64) -> Self {
        let entry = Ramp { start, length: TURN_ENTRY, height: rate.copysign(angle) };
        let exit = Ramp { start: start + (angle / rate).abs(), height: -entry.height, ..entry };
        Turn { entry, exit }
    }

    fn angle(&self, t: f64) -> Jet {
        self.entry.integral(t) + self.exit.integral(t)
    }

    fn rate(&self, t: f64) -> Jet {
        self.entry.at(t) + self.exit.at(t)
    }
}

/// A leg as it is sailed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stage {
    /// When it begins, s.
    pub(crate) start: f64,
    /// Change of seaway from the stage before; of no meaning for the first.
    pub(crate) change: Ramp,
    /// Steady heading, course and speed.
    pub(crate) steady: Heading,
    /// Made fast.
    pub(crate) moored: bool,
}

/// The ship's guidance at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guidance {
    /// Heading, rad, unwrapped.
    pub(crate) heading: Jet,
    /// Rate of turn, rad/s.
    pub(crate) turn_rate: Jet,
    /// Direction of the velocity, rad, unwrapped.
    pub(crate) course: Jet,
    /// Speed over ground, m/s.
    pub(crate) speed: Jet,
}

/// The guidance path.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    heading: f64,
    speed: f64,
    drift: f64,
    turns: Vec<Turn>,
    speed_changes: Vec<Ramp>,
    drift_changes: Vec<Ramp>,
    course_lag: f64,
    stages: Vec<Stage>,
}

impl Path {
    /// The path along the legs, with a course that lags `course_lag` s behind the heading.
    pub(crate) fn new(route: &Route, course_lag: f64) -> Self {
        let first = route.legs.first();
        let from_first = |get: fn(&Leg) -> f64| first.map_or(0.0, get);
        let mut path = Path {
            heading: from_first(|leg| leg.heading_deg * DEG),
            speed: from_first(|leg| leg.speed_kn * KNOT),
            drift: from_first(|leg| leg.drift_deg * DEG),
            turns: Vec::new(),
            speed_changes: Vec::new(),
            drift_changes: Vec::new(),
            course_lag,
            stages: Vec::new(),
        };
        let mut start = 0.0;
        for (before, leg) in route.steps() {
            path.append(start, before, leg);
            start += leg.duration(before);
        }
        path
    }

    fn append(&mut self, start: f64, before: &Leg, leg: &Leg) {
        let angle = leg.turn_angle(before);
        if angle.abs() > 1e-9 {
            self.turns.push(Turn::new(start, angle, leg.turn_rate_deg_s * DEG));
        }
        let speed = (leg.speed_kn - before.speed_kn) * KNOT;
        if speed != 0.0 {
            self.speed_changes.push(Ramp { start, length: leg.speed_time(before), height: speed });
        }
        let drift = (leg.drift_deg - before.drift_deg) * DEG;
        if drift != 0.0 {
            self.drift_changes.push(Ramp { start, length: SHORTEST_CHANGE, height: drift });
        }
        let steady = Heading {
            heading: leg.heading_deg * DEG,
            course: (leg.heading_deg + leg.drift_deg) * DEG,
            speed: leg.speed_kn * KNOT,
        };
        let change = Ramp { start, length: leg.change_time(before), height: 1.0 };
        self.stages.push(Stage { start, change, steady, moored: leg.moored });
    }

    /// The legs as they are sailed.
    pub(crate) fn stages(&self) -> &[Stage] {
        &self.stages
    }

    /// Index of the stage at time `t`, s.
    pub(crate) fn stage_index(&self, t: f64) -> usize {
        self.stages.partition_point(|stage| stage.start <= t).saturating_sub(1)
    }

    /// Whether she has not yet left the berth of the start at time `t`, s.
    pub(crate) fn is_at_first_berth(&self, t: f64) -> bool {
        self.stages.iter().take(self.stage_index(t) + 1).all(|stage| stage.moored)
    }

    /// Heading, course and speed at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> Guidance {
        let sum = |ramps: &[Ramp], first: f64| {
            ramps.iter().map(|ramp| ramp.at(t)).fold(Jet::constant(first), |a, b| a + b)
        };
        let turn_rate = self.turns.iter().map(|turn| turn.rate(t));
        Guidance {
            heading: self.heading_at(t),
            turn_rate: turn_rate.fold(Jet::default(), |a, b| a + b),
            course: self.heading_at(t - self.course_lag) + sum(&self.drift_changes, self.drift),
            speed: sum(&self.speed_changes, self.speed),
        }
    }

    fn heading_at(&self, t: f64) -> Jet {
        let turned = self.turns.iter().map(|turn| turn.angle(t));
        turned.fold(Jet::constant(self.heading), |a, b| a + b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn route(legs: &str) -> Route {
        toml::from_str(legs).unwrap()
    }

    #[test]
    fn every_leg_ends_on_its_heading_at_its_speed() {
        let route = route(
            "legs = [
               { heading_deg = 350.0, speed_kn = 0.0, duration_s = 60.0 },
               { heading_deg = 20.0, speed_kn = 12.0, duration_s = 400.0 },
               { heading_deg = 10.0, speed_kn = 6.0, duration_s = 400.0, turn = \"starboard\" },
             ]",
        );
        let path = Path::new(&route, 3.0);
        let at = |t| path.at(t);
        assert_relative_eq!(at(459.0).heading.value, 380.0 * DEG, epsilon = 1e-12);
        assert_relative_eq!(at(459.0).speed.value, 12.0 * KNOT, epsilon = 1e-12);
        assert_relative_eq!(at(859.0).heading.value, 730.0 * DEG, epsilon = 1e-12);
        assert_relative_eq!(at(859.0).course.value, 730.0 * DEG, epsilon = 1e-12);
        assert_relative_eq!(at(859.0).speed.value, 6.0 * KNOT, epsilon = 1e-12);
    }

    #[test]
    fn a_leg_given_by_its_distance_is_just_as_long() {
        let route = route(
            "legs = [
               { heading_deg = 0.0, speed_kn = 2.0, duration_s = 10.0 },
               { heading_deg = 0.0, speed_kn = 10.0, distance_m = 2000.0 },
             ]",
        );
        let path = Path::new(&route, 0.0);
        let steps = 100_000;
        let dt = (route.duration() - 10.0) / f64::from(steps);
        let speed = |i: i32| path.at(10.0 + (f64::from(i) + 0.5) * dt).speed.value;
        assert_relative_eq!((0..steps).map(speed).sum::<f64>() * dt, 2000.0, epsilon = 1e-3);
    }

    #[test]
    fn the_rate_of_turn_is_steady_at_the_rate_of_the_leg() {
        let route = route(
            "legs = [
               { heading_deg = 0.0, speed_kn = 5.0, duration_s = 10.0 },
               { heading_deg = 270.0, speed_kn = 5.0, duration_s = 200.0, turn_rate_deg_s = 0.8 },
             ]",
        );
        let path = Path::new(&route, 0.0);
        assert_relative_eq!(path.at(60.0).turn_rate.value, -0.8 * DEG, epsilon = 1e-12);
        assert_relative_eq!(path.at(60.0).heading.rate, -0.8 * DEG, epsilon = 1e-12);
        assert_relative_eq!(path.at(150.0).turn_rate.value, 0.0, epsilon = 1e-12);
    }
}
