//! How far from the truth the solution is. Only a simulated ship can know.

use insd_base::earth::{c_ne, ecef};
use insd_base::units::wrap_pi;
use insd_base::{Attitude, Geodetic, Solution, Time, Truth};

/// True error of a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrueError {
    /// Horizontal distance between solution and truth, m.
    pub horizontal: f64,
    /// Heading minus true heading, rad, if the truth has an attitude.
    pub heading: Option<f64>,
}

/// The true track, in order of time.
#[derive(Clone, Debug)]
pub struct TrueTrack(Vec<Truth>);

impl TrueTrack {
    /// The truth of a voyage.
    #[must_use]
    pub fn new(truth: Vec<Truth>) -> Self {
        TrueTrack(truth)
    }

    /// True position and, if known, attitude at an instant, interpolated linearly; `None` outside
    /// the track.
    #[must_use]
    pub fn at(&self, time: Time) -> Option<(Geodetic, Option<Attitude>)> {
        let next = self.0.partition_point(|truth| truth.time < time);
        let after = self.0.get(next)?;
        if after.time == time {
            return Some((after.position, after.attitude));
        }
        let before = self.0.get(next.checked_sub(1)?)?;
        let share = (time - before.time).as_seconds() / (after.time - before.time).as_seconds();
        let attitude = before.attitude.zip(after.attitude).map(|(a, b)| Attitude {
            roll: a.roll + share * (b.roll - a.roll),
            pitch: a.pitch + share * (b.pitch - a.pitch),
            heading: a.heading + share * wrap_pi(b.heading - a.heading),
        });
        let (a, b) = (before.position, after.position);
        let position = Geodetic {
            latitude: a.latitude + share * (b.latitude - a.latitude),
            longitude: wrap_pi(a.longitude + share * wrap_pi(b.longitude - a.longitude)),
            height: a.height + share * (b.height - a.height),
        };
        Some((position, attitude))
    }

    /// Error of a solution at its time of validity.
    #[must_use]
    pub fn error_of(&self, solution: &Solution) -> Option<TrueError> {
        let (position, attitude) = self.at(solution.time)?;
        let horizontal = east_north(&position, &solution.position);
        let heading = attitude.map(|truth| wrap_pi(solution.attitude.heading - truth.heading));
        Some(TrueError { horizontal: horizontal.0.hypot(horizontal.1), heading })
    }
}

/// East and north of a point as seen from another, m, along the axes at `from`.
#[must_use]
pub fn east_north(from: &Geodetic, to: &Geodetic) -> (f64, f64) {
    let offset = c_ne(from) * (ecef(to).0 - ecef(from).0);
    (offset.y, offset.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn truth(seconds: f64, longitude: f64, heading: f64) -> Truth {
        Truth {
            time: Time::from_seconds(seconds),
            position: Geodetic::from_degrees(10.0, longitude, 0.0),
            velocity: None,
            attitude: Some(Attitude { heading: heading.to_radians(), ..Attitude::default() }),
        }
    }

    #[test]
    fn truth_is_interpolated_across_antimeridian_and_north() {
        let track = TrueTrack::new(vec![truth(0.0, 179.9, 359.0), truth(1.0, -179.9, 1.0)]);
        let (position, attitude) = track.at(Time::from_seconds(0.5)).unwrap();
        assert!((position.longitude.abs() - std::f64::consts::PI).abs() < 1e-12);
        assert!(wrap_pi(attitude.unwrap().heading).abs() < 1e-12);
        assert_eq!(track.at(Time::from_seconds(1.5)), None);
        assert_eq!(track.at(Time::from_seconds(-0.5)), None);
    }

    #[test]
    fn a_minute_of_latitude_is_a_nautical_mile() {
        let from = Geodetic::from_degrees(45.0, 7.0, 0.0);
        let to = Geodetic::from_degrees(45.0 + 1.0 / 60.0, 7.0, 0.0);
        let (east, north) = east_north(&from, &to);
        assert!(east.abs() < 1e-6);
        assert!((north - 1852.0).abs() < 1.0);
    }
}
