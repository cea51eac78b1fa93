//! Whether a receiver tells what was some seconds ago: no fault of an IMU makes fixes come true later.

use std::collections::VecDeque;

use insd_base::{Time, earth};
use nalgebra::{Vector2, Vector3};

use crate::leap::ToldMotion;

/// Ages of the fixes that are tried, s: what is less is estimated.
const LEAST: f64 = 1.0;
const STEP: f64 = 0.25;
const AGES: usize = 21;
/// Motion is kept at such intervals, s.
const SPACING: f64 = 0.1;
/// As many fixes in a row as come in this, s, must be of the past.
const ENOUGH: f64 = 2.5;
/// Fixes fit below such a mean square, of which one is expected, and together do not beyond that.
const FITS: f64 = 4.0;
const UNFIT: f64 = 25.0;
/// She must have gone so many sigmas of a fix meanwhile: the place of one who lies still is always the same.
const GONE: f64 = 5.0;
/// Components of a fix that are compared: place and velocity, north and east.
const COMPONENTS: f64 = 4.0;

/// Where the antenna was.
#[derive(Clone, Copy, Debug)]
struct Was {
    /// ECEF, m, and m/s.
    place: Vector3<f64>,
    velocity: Vector3<f64>,
}

/// Compares fixes with where the antenna was.
#[derive(Clone, Debug, Default)]
pub struct Echo {
    past: VecDeque<(Time, Was)>,
    last: Option<Time>,
    /// For how long fixes have not fitted, s, and the integral of the squares with each age, first without any.
    span: f64,
    sums: [f64; AGES + 1],
}

impl Echo {
    /// Where the antenna is by the navigator, ECEF axes, m and m/s.
    pub fn note(&mut self, time: Time, place: &Vector3<f64>, velocity: &Vector3<f64>) {
        if self.past.back().is_some_and(|(last, _)| (time - *last).as_seconds() < SPACING) {
            return;
        }
        let longest = LEAST + STEP * AGES as f64;
        while self.past.front().is_some_and(|(first, _)| (time - *first).as_seconds() > longest) {
            self.past.pop_front();
        }
        self.past.push_back((time, Was { place: *place, velocity: *velocity }));
    }

    /// The estimate is not that of before.
    pub fn restart(&mut self) {
        *self = Echo::default();
    }

    /// Sees a fix with the velocity that it tells itself; their sigmas are those of the difference from the navigator's. Tells whether
    /// they are of seconds ago.
    pub fn see(&mut self, told: &ToldMotion) -> bool {
        let elapsed =
            self.last.replace(told.time).map_or(0.0, |last| (told.time - last).as_seconds());
        let squares = self.squares(told).filter(|_| (0.0..ENOUGH).contains(&elapsed));
        let Some(squares) = squares else {
            (self.span, self.sums) = (0.0, [0.0; AGES + 1]);
            return false;
        };
        self.span += elapsed;
        for (sum, square) in self.sums.iter_mut().zip(squares) {
            *sum += elapsed * square;
        }
        let [now, ages @ ..] = &self.sums;
        let least = ages.iter().copied().fold(f64::INFINITY, f64::min);
        self.span > ENOUGH && *now > UNFIT * self.span && least < FITS * self.span
    }

    /// Mean squares by which a fix is off with each age, first without any; `None` where it fits without, or
    /// where that tells nothing.
    fn squares(&self, told: &ToldMotion) -> Option<[f64; AGES + 1]> {
        let c_ne = earth::c_ne(&told.place);
        let place = earth::ecef(&told.place).0;
        let square = |was: &Was| {
            let off: Vector2<f64> = (c_ne * (place - was.place)).xy();
            let wrong = told.velocity - (c_ne * was.velocity).xy();
            let [off, wrong] = [off / told.place_std, wrong / told.velocity_std];
            (off.norm_squared() + wrong.norm_squared()) / COMPONENTS
        };
        let (_, latest) = self.past.back()?;
        let now = Some(square(latest)).filter(|square| *square > FITS)?;
        let mut all = [now; AGES + 1];
        for (age, all) in all.iter_mut().skip(1).enumerate() {
            let was = self.at(told.time, LEAST + STEP * age as f64)?;
            let gone = (was.place - latest.place).norm();
            *all = if gone > GONE * told.place_std { square(&was) } else { f64::INFINITY };
        }
        Some(all)
    }

    /// Where the antenna was so long ago, s.
    fn at(&self, now: Time, age: f64) -> Option<Was> {
        let behind = |(time, _): &(Time, Was)| (now - *time).as_seconds();
        let next = self.past.partition_point(|was| behind(was) >= age);
        let (before, after) = (self.past.get(next.checked_sub(1)?)?, self.past.get(next)?);
        let share = (behind(before) - age) / (behind(before) - behind(after));
        let between = |from: Vector3<f64>, to: Vector3<f64>| from + (to - from) * share;
        let ((_, from), (_, to)) = (before, after);
        Some(Was {
            place: between(from.place, to.place),
            velocity: between(from.velocity, to.velocity),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Geodetic;

    const RADIUS: f64 = 6_378_137.0;
    const SPEED: f64 = 6.0;
    /// Amplitude, m/s, and angular frequency, rad/s, of the surge.
    const SURGE: (f64, f64) = (0.5, 0.8);

    fn velocity(t: f64) -> f64 {
        SPEED + SURGE.0 * (SURGE.1 * t).sin()
    }

    fn place(t: f64) -> Geodetic {
        let east = SPEED * t - SURGE.0 / SURGE.1 * (SURGE.1 * t).cos();
        Geodetic { latitude: 0.0, longitude: east / RADIUS, height: 0.0 }
    }

    /// Along the equator for a minute, with fixes that are late by some seconds from 30 s on, beside a navigator who is
    /// off by some metres and metres per second from then on; tells when the receiver was found to tell the past.
    fn found(late: f64, off: (f64, f64), speed: f64) -> Option<f64> {
        let mut echo = Echo::default();
        for k in 0..1200 {
            let t = 0.05 * f64::from(k);
            let since = (t - 30.0).max(0.0);
            let own =
                |t: f64| if speed > 0.0 { (place(t), velocity(t)) } else { (place(0.0), 0.0) };
            let (at, going) = own(t);
            let c_en = earth::c_ne(&at).transpose();
            let wrong = if since > 0.0 { off.0 + off.1 * since } else { 0.0 };
            let drift = if since > 0.0 { off.1 } else { 0.0 };
            let noted = earth::ecef(&at).0 + c_en * Vector3::new(wrong, 0.0, 0.0);
            let time = Time::from_seconds(t);
            echo.note(time, &noted, &(c_en * Vector3::new(drift, going, 0.0)));
            let (place, going) = own(if since > 0.0 { t - late } else { t });
            let velocity = Vector2::new(0.0, going);
            let told = ToldMotion { time, place, place_std: 1.0, velocity, velocity_std: 0.05 };
            if k % 4 == 0 && echo.see(&told) {
                return Some(t);
            }
        }
        None
    }

    #[test]
    fn fixes_of_seconds_ago_are_found_within_seconds() {
        for late in [1.6, 2.85, 5.3] {
            let at = found(late, (0.0, 0.0), SPEED).unwrap();
            assert!((30.0..35.0).contains(&at), "{late}: {at}");
        }
    }

    #[test]
    fn honest_fixes_and_a_navigator_who_is_wrong_are_none() {
        assert_eq!(found(0.0, (0.0, 0.0), SPEED), None);
        assert_eq!(found(0.0, (0.0, 1.0), SPEED), None);
        assert_eq!(found(0.0, (20.0, 0.0), SPEED), None);
        assert_eq!(found(0.0, (0.0, 1.0), 0.0), None, "one who lies still");
    }
}
