//! Whether a craft goes on wheels: she climbs as she points, and nothing moves her athwart.
//!
//! A ship that heaves goes up and down without pointing there, and one that rides up a swell has it move beneath her. Only
//! what rolls along a road rises by the way it makes times the sine of its pitch, metres within a minute, while nothing is left of
//! its velocity athwart and square to its floor (for the constraint itself: Dissanayake et al. 2001, The aiding of a
//! low-cost strapdown inertial measurement unit using vehicle model constraints, IEEE Trans. Robotics and
//! Automation 17(5)).

use insd_base::Time;
use nalgebra::Vector3;

/// A longer silence between looks is a gap, s.
const GAP: f64 = 5.0;
/// Looks that are judged together.
const SPAN: u32 = 60;
/// Below this speed a craft says little, m/s.
const UNDER_WAY: f64 = 3.0;
/// Wheels leave so much of the velocity athwart and downwards at most, RMS, m/s, and what has no wheels more than that.
const ATHWART: f64 = 0.3;
const DOWNWARDS: f64 = 0.15;
const FAR_ATHWART: f64 = 0.6;
const FAR_DOWNWARDS: f64 = 0.4;
/// Rise that is a hill, m, and the share of it that may have come otherwise than by pointing there.
const HILL: f64 = 5.0;
const OTHERWISE: f64 = 0.2;
/// So many spans prove it.
const PROOFS: u32 = 2;

/// The velocity of a craft as it is looked at.
#[derive(Clone, Copy, Debug)]
pub struct WheelLook {
    /// Body axes: forward, starboard, down, m/s.
    pub velocity: Vector3<f64>,
    /// How fast she rises, m/s.
    pub rise: f64,
    /// Her pitch, bow up, rad.
    pub pitch: f64,
}

/// Sums over a span.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    count: u32,
    /// Squares of the velocity athwart and downwards, m^2/s^2.
    athwart: f64,
    downwards: f64,
    /// Rise by pointing there, and in all, m.
    pointed: f64,
    risen: f64,
}

impl Span {
    fn add(&mut self, look: &WheelLook, seconds: f64) {
        self.count += 1;
        self.athwart += look.velocity.y.powi(2);
        self.downwards += look.velocity.z.powi(2);
        self.pointed += look.velocity.x * look.pitch.sin() * seconds;
        self.risen += look.rise * seconds;
    }

    /// Whether nothing was left of the velocity but what goes ahead, RMS, m/s.
    fn is_below(&self, athwart: f64, downwards: f64) -> bool {
        let rms = |sum: f64| (sum / f64::from(self.count.max(1))).sqrt();
        rms(self.athwart) < athwart && rms(self.downwards) < downwards
    }

    fn is_proof(&self) -> bool {
        let otherwise = (self.risen - self.pointed).abs();
        self.is_below(ATHWART, DOWNWARDS)
            && self.pointed.abs() > HILL
            && otherwise < OTHERWISE * self.pointed.abs()
    }
}

/// What is known of her wheels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wheels {
    last: Option<Time>,
    span: Span,
    proofs: u32,
}

impl Wheels {
    /// Whether she is proven to go on wheels.
    #[must_use]
    pub fn are_proven(&self) -> bool {
        self.proofs >= PROOFS
    }

    /// Looks at her, once a second while a receiver tells her velocity.
    pub fn see(&mut self, now: Time, look: &WheelLook) {
        let since = self.last.replace(now).map_or(GAP, |last| (now - last).as_seconds());
        if since >= GAP {
            self.span = Span::default();
        } else if look.velocity.x > UNDER_WAY {
            self.span.add(look, since);
        }
        if self.span.count == SPAN {
            self.judge();
        }
    }

    fn judge(&mut self) {
        let span = std::mem::take(&mut self.span);
        if span.is_proof() {
            self.proofs += 1;
        } else if !span.is_below(FAR_ATHWART, FAR_DOWNWARDS) {
            self.proofs = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Ten minutes, looked at every second, of a craft at 8 m/s that pitches and rises like that at a time, s, and
    /// has that velocity athwart, m/s.
    fn seen(pitch: impl Fn(f64) -> f64, rise: impl Fn(f64) -> f64, athwart: f64) -> bool {
        let mut wheels = Wheels::default();
        for second in 0..600 {
            let t = f64::from(second);
            let (pitch, rise, ahead) = (pitch(t), rise(t), 8.0);
            let down = ahead * pitch.sin() - rise * pitch.cos();
            let velocity = Vector3::new(ahead, athwart, down);
            wheels.see(Time::from_seconds(t), &WheelLook { velocity, rise, pitch });
        }
        wheels.are_proven()
    }

    fn hill(t: f64) -> f64 {
        0.03 * (TAU * t / 300.0).sin()
    }

    #[test]
    fn a_car_on_a_hill_goes_on_wheels() {
        assert!(seen(hill, |t| 8.0 * hill(t).sin(), 0.1));
        assert!(!seen(hill, |t| 8.0 * hill(t).sin(), 1.0), "she slides");
    }

    #[test]
    fn a_car_in_the_plain_and_a_ship_on_calm_water_may_be_either() {
        assert!(!seen(|_| 0.0, |_| 0.0, 0.0));
        assert!(!seen(|_| 0.03, |_| 0.0, 0.0), "she is trimmed by the stern");
    }

    #[test]
    fn a_ship_in_a_swell_or_with_a_false_height_goes_on_none() {
        for period in [8.0, 20.0, 60.0, 120.0] {
            let slope = |t: f64| 0.06 * (TAU * t / period).sin();
            let rise = |t: f64| 0.5 * (TAU * t / period).cos();
            assert!(!seen(slope, rise, 0.0), "{period} s");
            let with_slope = |t: f64| -4.0 * slope(t).sin();
            assert!(!seen(slope, with_slope, 0.0), "overtaken, {period} s");
        }
        assert!(!seen(|_| 0.0, |_| 0.3, 0.0));
    }
}
