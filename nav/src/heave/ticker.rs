//! Steps of an IMU, of any length, cut into even ticks.

use insd_base::{Span, Time};
use nalgebra::Vector3;

use super::bank::Kick;
use super::step::VerticalStep;
use super::times::TICK;

/// Rounding of times, s.
const ROUNDING: f64 = 1e-9;

/// What one tick brought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tick {
    /// Its end.
    pub(super) time: Time,
    /// Upward motion of the IMU.
    pub(super) up: Kick,
    /// Direction of down in body axes at its end.
    pub(super) down_b: Vector3<f64>,
}

/// Sums the increments since the last tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ticker {
    /// The last tick.
    pub(super) last: Time,
    /// Time since then, s.
    pub(super) filled: f64,
    /// Motion since then.
    pub(super) up: Kick,
    /// Direction of down in body axes.
    pub(super) down_b: Vector3<f64>,
}

impl Ticker {
    /// Nothing yet.
    pub(super) fn new(start: Time, down_b: Vector3<f64>) -> Self {
        let up = Kick { velocity: 0.0, displacement: 0.0 };
        Ticker { last: start, filled: 0.0, up, down_b }
    }

    /// The latest instant.
    pub(super) fn now(&self) -> Time {
        self.last + Span::from_seconds(self.filled)
    }

    /// Takes a step from the latest instant on, and hands over each tick that it completes.
    pub(super) fn take(&mut self, step: &VerticalStep, mut each: impl FnMut(&Tick)) {
        let (begun, begin) = (self.down_b, self.now());
        let duration = (step.to - begin).as_seconds();
        let mut done = 0.0;
        while duration - done > ROUNDING {
            let part = (duration - done).min(TICK - self.filled);
            self.add(part, step.velocity * part / duration);
            done += part;
            self.down_b = begun.lerp(&step.down_b, (done / duration).min(1.0));
            if TICK - self.filled < ROUNDING {
                each(&self.complete());
            }
        }
        self.down_b = step.down_b;
        self.filled = (step.to - self.last).as_seconds().clamp(0.0, TICK);
    }

    /// Adds a piece of a step, over which the velocity grows evenly.
    fn add(&mut self, duration: f64, velocity: f64) {
        self.up.displacement += (self.up.velocity + 0.5 * velocity) * duration;
        self.up.velocity += velocity;
        self.filled += duration;
    }

    fn complete(&mut self) -> Tick {
        let time = self.last + Span::from_seconds(TICK);
        let tick = Tick { time, up: self.up, down_b: self.down_b };
        *self = Ticker::new(time, self.down_b);
        tick
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_any_length_make_even_ticks_of_the_same_motion() {
        let (down, acceleration) = (Vector3::new(0.0, 0.0, 1.0), 0.7);
        let mut ticker = Ticker::new(Time::START, down);
        let mut ticks = Vec::new();
        let mut t = 0.0;
        for i in 0..100 {
            let duration = [0.004, 0.017, 0.25, 0.1][i % 4];
            t += duration;
            let velocity = acceleration * duration;
            let step = VerticalStep { to: Time::from_seconds(t), duration, velocity, down_b: down };
            ticker.take(&step, |tick| ticks.push(*tick));
        }
        assert_eq!(ticks.len(), 92);
        assert!((ticker.filled - 0.075).abs() < 1e-9);
        for (i, tick) in ticks.iter().enumerate() {
            assert_eq!(tick.time, Time::from_nanos((i as i64 + 1) * 100_000_000));
            assert!((tick.up.velocity - acceleration * TICK).abs() < 1e-9);
            let displacement = 0.5 * acceleration * TICK * TICK;
            assert!((tick.up.displacement - displacement).abs() < 1e-9);
        }
    }

    #[test]
    fn down_turns_evenly_over_a_step() {
        let mut ticker = Ticker::new(Time::START, Vector3::new(0.0, 0.0, 1.0));
        let to = Vector3::new(0.04, 0.0, 1.0);
        let step =
            VerticalStep { to: Time::from_seconds(0.2), duration: 0.2, velocity: 0.0, down_b: to };
        let mut seen = Vec::new();
        ticker.take(&step, |tick| seen.push(tick.down_b.x));
        assert!((seen[0] - 0.02).abs() < 1e-12 && (seen[1] - 0.04).abs() < 1e-12, "{seen:?}");
    }
}
