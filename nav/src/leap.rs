//! Leaps of a receiver's position where there is no judge: while the heading is sought, and at the berth.
//!
//! Between two fixes it goes further than the antenna has, by more than both are unsure of, and it stays so. No ship does that.

use insd_base::{Geodetic, Time, earth};
use nalgebra::Vector2;

/// Who leaps goes further than this, m, and than so many sigmas.
const FAR: f64 = 10.0;
const SIGMAS: f64 = 8.0;
/// Fixes further apart than this are not compared, s: what she did meanwhile is not known so well.
const APART: f64 = 3.0;
/// One that has not gone back for so long is none of single outliers, s.
const STAYS: f64 = 4.0;

/// A position that a receiver tells, beside a velocity of its antenna: what is known of that, or what it tells of it itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToldMotion {
    /// When.
    pub time: Time,
    /// Of the antenna.
    pub place: Geodetic,
    /// 1-sigma of what is white of its errors, of each component, m.
    pub place_std: f64,
    /// Velocity of the antenna, north and east, m/s.
    pub velocity: Vector2<f64>,
    /// 1-sigma of each component, m/s.
    pub velocity_std: f64,
}

/// Watches the positions of a receiver.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeapWatch {
    last: Option<(Time, Geodetic)>,
    /// Since when it may have leapt, how far it is off since then, m, and how far that must be for a leap, m.
    suspected: Option<(Time, Vector2<f64>, f64)>,
    /// Sum of all leaps, m.
    net: Vector2<f64>,
}

impl LeapWatch {
    /// Sees a position. Gives a leap, north and east, m, once it is one.
    pub fn see(&mut self, told: &ToldMotion) -> Option<Vector2<f64>> {
        let now = told.time;
        let (at, before) = self.last.replace((now, told.place))?;
        let elapsed = (now - at).as_seconds();
        if elapsed > APART {
            self.suspected = None;
            return None;
        }
        let gone = earth::c_ne(&before) * (earth::ecef(&told.place).0 - earth::ecef(&before).0);
        let step = gone.xy() - told.velocity * elapsed;
        let unsure = (std::f64::consts::SQRT_2 * told.place_std).hypot(told.velocity_std * elapsed);
        let fresh = (now, Vector2::zeros(), FAR.max(SIGMAS * unsure));
        let (since, off, far) = self.suspected.unwrap_or(fresh);
        let off = off + step;
        self.suspected = (off.norm() > far).then_some((since, off, far));
        if self.suspected.is_none() || (now - since).as_seconds() < STAYS {
            return None;
        }
        self.suspected = None;
        self.net += off;
        Some(off)
    }

    /// Whether it may have leapt a moment ago.
    #[must_use]
    pub fn is_suspected(&self) -> bool {
        self.suspected.is_some()
    }

    /// How far it is from where it was at first, by all its leaps, m.
    #[must_use]
    pub fn net(&self) -> Vector2<f64> {
        self.net
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Metres of a radian of latitude at the equator.
    const MERIDIAN: f64 = 6_335_439.0;

    /// The leaps that are found when a receiver of 1 m is so far off northwards at each instant, s, of a ship that lies still.
    fn leaps(instants: impl Iterator<Item = u32>, off: impl Fn(u32) -> f64) -> Vec<f64> {
        let mut watch = LeapWatch::default();
        let seen = instants.filter_map(|second| {
            let latitude = off(second) / MERIDIAN;
            watch.see(&ToldMotion {
                time: Time::from_seconds(f64::from(second)),
                place: Geodetic { latitude, longitude: 0.0, height: 0.0 },
                place_std: 0.5,
                velocity: Vector2::zeros(),
                velocity_std: 0.1,
            })
        });
        seen.map(|leap| leap.x.round()).collect()
    }

    #[test]
    fn a_leap_that_stays_is_found_once_and_its_way_back_as_well() {
        assert_eq!(leaps(0..60, |t| if t < 30 { 0.0 } else { 40.0 }), [40.0]);
        let there_and_back = |t| if (20..40).contains(&t) { 40.0 } else { 0.0 };
        assert_eq!(leaps(0..60, there_and_back), [40.0, -40.0]);
    }

    #[test]
    fn outliers_drifts_and_what_was_so_from_the_begin_are_none() {
        assert!(leaps(0..60, |t| if t % 7 == 3 { 500.0 } else { 0.0 }).is_empty());
        assert!(leaps(0..60, |t| 3.0 * f64::from(t)).is_empty());
        assert!(leaps(0..60, |_| 1000.0).is_empty());
    }

    #[test]
    fn what_changes_over_a_silence_is_none() {
        let silent = (0..20).chain(60..80);
        assert!(leaps(silent, |t| if t < 30 { 0.0 } else { 300.0 }).is_empty());
    }
}
