//! Whether a receiver's position goes where its velocity says: no model of the ship stands between the two.

use std::collections::VecDeque;

use insd_base::{Time, earth};
use nalgebra::{Vector2, Vector3};

use crate::leap::ToldMotion;

/// Positions so far apart are compared, s.
const SPAN: f64 = 15.0;
/// Fixes further apart than this are not summed up, s: what she did between them is not known.
const APART: f64 = 3.0;
/// They contradict each other beyond so many sigmas, and this, m,
const SIGMAS: f64 = 5.0;
const FAR: f64 = 5.0;
/// that many times in a row.
const TIMES: u32 = 3;
/// Sums kept: of receivers of ten fixes a second one in each half second.
const SPACING: f64 = 0.5;

/// Sums up what the position does beside the velocity.
#[derive(Clone, Debug, Default)]
pub struct OwnWord {
    last: Option<(ToldMotion, Vector3<f64>)>,
    /// How far the position has gone, less what the velocity makes, m.
    beside: Vector2<f64>,
    sums: VecDeque<(Time, Vector2<f64>)>,
    times: u32,
}

impl OwnWord {
    /// Sees a fix with the velocity that it tells itself; tells whether the receiver contradicts itself.
    pub fn see(&mut self, told: &ToldMotion) -> bool {
        let now = told.time;
        let place = earth::ecef(&told.place).0;
        let Some((last, from)) = self.last.replace((*told, place)) else { return false };
        let elapsed = (now - last.time).as_seconds();
        if !(0.0..APART).contains(&elapsed) {
            self.sums.clear();
            self.times = 0;
            return false;
        }
        let gone = (earth::c_ne(&last.place) * (place - from)).xy();
        self.beside += gone - (told.velocity + last.velocity) * (0.5 * elapsed);
        let is_far = self.oldest(now).is_some_and(|(since, before)| {
            let span = (now - since).as_seconds();
            let unsure =
                (std::f64::consts::SQRT_2 * told.place_std).hypot(told.velocity_std * span);
            (self.beside - before).norm() > FAR.max(SIGMAS * unsure)
        });
        if self.sums.back().is_none_or(|(at, _)| (now - *at).as_seconds() >= SPACING) {
            self.sums.push_back((now, self.beside));
            self.times = if is_far { self.times.saturating_add(1) } else { 0 };
        }
        self.times >= TIMES
    }

    /// The oldest sum that is compared.
    fn oldest(&mut self, now: Time) -> Option<(Time, Vector2<f64>)> {
        while self.sums.front().is_some_and(|(at, _)| (now - *at).as_seconds() > SPAN) {
            self.sums.pop_front();
        }
        self.sums.front().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Geodetic;

    /// Metres of a radian of latitude at the equator.
    const MERIDIAN: f64 = 6_335_439.0;

    /// Seconds until a receiver of 1 m and 0.05 m/s contradicts itself, that is so far northwards and says that it makes so much, m/s.
    fn contradicts_after(place: impl Fn(f64) -> f64, velocity: impl Fn(f64) -> f64) -> Option<u32> {
        let mut word = OwnWord::default();
        (0..300).find(|second| {
            let t = f64::from(*second);
            word.see(&ToldMotion {
                time: Time::from_seconds(t),
                place: Geodetic { latitude: place(t) / MERIDIAN, longitude: 0.0, height: 0.0 },
                place_std: 1.0,
                velocity: Vector2::new(velocity(t), 0.0),
                velocity_std: 0.05,
            })
        })
    }

    #[test]
    fn a_velocity_of_another_scale_contradicts_the_position() {
        let after = contradicts_after(|t| 6.0 * t, |t| if t < 100.0 { 6.0 } else { 7.0 });
        assert!(after.is_some_and(|at| (103..115).contains(&at)), "{after:?}");
    }

    #[test]
    fn an_honest_one_in_waves_does_not_nor_one_that_is_dragged_away_with_its_velocity() {
        let wave = |t: f64| 2.0 * (0.7 * t).sin();
        assert_eq!(contradicts_after(|t| 6.0 * t + wave(t), |t| 6.0 + 1.4 * (0.7 * t).cos()), None);
        assert_eq!(contradicts_after(|t| 0.01 * t * t, |t| 0.02 * t), None);
    }

    #[test]
    fn an_outlier_does_not() {
        let outlier = |t: f64| if t as u32 % 40 == 20 { 50.0 } else { 0.0 };
        assert_eq!(contradicts_after(outlier, |_| 0.0), None);
    }
}
