//! What the sensors make of the true motion.

pub(crate) mod gnss;
mod gnss_faults;
pub(crate) mod imu;
pub(crate) mod log;
pub(crate) mod reference;
mod vibration;
mod windows;

use insd_base::{Span, Stamped, Time};
use rand_pcg::Pcg64;

use crate::random::uniform;
use crate::scenario::Delay;

/// Instants `first`, `first` + 1, ... over `rate`, up to and with `duration`, s.
pub(crate) fn epochs(rate: f64, first: u64, duration: f64) -> impl Iterator<Item = Time> {
    let last = (duration * rate + 1e-6).floor() as u64;
    (first..=last).map(move |index| Time::from_seconds(index as f64 / rate))
}

/// A message that is received after `delay`, or at once.
fn delayed<T>(message: T, time: Time, delay: Option<Delay>, rng: &mut Pcg64) -> Stamped<T> {
    let draw = |delay: Delay| Span::from_seconds(delay.fixed_s + uniform(rng, 0.0, delay.random_s));
    Stamped { message, arrival: delay.map(draw).map(|late| time + late) }
}

#[cfg(test)]
mod tests;
