//! Lies of a log.

use insd_base::{LogReference, LogVelocity, Stamped, Voyage};
use nalgebra::{Rotation2, Vector2};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::{Window, shifted, truth_at};

/// What a log tells wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LogLie {
    /// It stands still.
    Frozen,
    /// It tells zero.
    Zero,
    /// It is too fast by this factor.
    Scale(f64),
    /// It is turned, rad; half a turn is the wrong sign.
    Turned(f64),
    /// It tells so much too much to starboard, m/s.
    Athwart(f64),
    /// It tells the speed through the water as one over the bottom, in a current north and east, m/s.
    WaterAsBottom(Vector2<f64>),
    /// It tells now the one and now the other, in such a current.
    Swapping(Vector2<f64>),
    /// It tells the speed through the water, and says so.
    Water(Vector2<f64>),
    /// Now and then it tells anything, up to this, m/s.
    Spikes(f64),
    /// It leaves out such a share.
    Dropouts(f64),
    /// It repeats everything so many times.
    Flood(u32),
}

/// Share of messages that are spikes.
const SPIKES: f64 = 0.05;
/// Spacing of repeated messages, s.
const REPEATED: f64 = 0.002;

impl LogLie {
    pub(super) fn spoil(self, voyage: &mut Voyage, window: &Window, rng: &mut Pcg64) {
        let held = voyage.log.iter().find(|log| window.holds(log.message.time)).copied();
        match self {
            LogLie::Dropouts(share) => {
                let lost = |log: &Stamped<LogVelocity>| {
                    window.holds(log.message.time) && rng.random::<f64>() < share
                };
                let mut lost = lost;
                voyage.log.retain(|log| !lost(log));
            }
            LogLie::Flood(times) => flood(voyage, window, times),
            LogLie::WaterAsBottom(_) | LogLie::Swapping(_) | LogLie::Water(_) => {
                self.stream(voyage, window);
            }
            _ => {
                for log in voyage.log.iter_mut().filter(|log| window.holds(log.message.time)) {
                    self.spoil_one(&mut log.message, held.as_ref().map(|held| &held.message), rng);
                }
            }
        }
    }

    fn spoil_one(self, told: &mut LogVelocity, held: Option<&LogVelocity>, rng: &mut Pcg64) {
        match self {
            LogLie::Frozen => {
                if let Some(held) = held {
                    (told.u, told.v, told.w) = (held.u, held.v, held.w);
                }
            }
            LogLie::Zero => change(told, |_| Vector2::zeros()),
            LogLie::Scale(factor) => change(told, |u| u * factor),
            LogLie::Turned(angle) => change(told, |u| Rotation2::new(-angle) * u),
            LogLie::Athwart(by) => change(told, |u| u + Vector2::new(0.0, by)),
            LogLie::Spikes(greatest) if rng.random::<f64>() < SPIKES => {
                let mut any = || greatest * (2.0 * rng.random::<f64>() - 1.0);
                let spike = Vector2::new(any(), any());
                change(told, |_| spike);
            }
            _ => {}
        }
    }

    /// Takes the current from what is told, and says what it is, or not.
    fn stream(self, voyage: &mut Voyage, window: &Window) {
        let logs = voyage.log.iter_mut().filter(|log| window.holds(log.message.time));
        for (number, log) in logs.enumerate() {
            let attitude = truth_at(&voyage.truth, log.message.time).and_then(|t| t.attitude);
            let heading = attitude.map(|attitude| attitude.heading).unwrap_or_default();
            let (current, says_so) = match self {
                LogLie::WaterAsBottom(current) => (current, false),
                LogLie::Swapping(current) if number % 2 == 0 => (current, false),
                LogLie::Water(current) => (current, true),
                _ => continue,
            };
            change(&mut log.message, |u| u - Rotation2::new(-heading) * current);
            if says_so {
                log.message.reference = LogReference::Water;
            }
        }
    }
}

/// Changes forward and starboard together.
fn change(told: &mut LogVelocity, by: impl Fn(Vector2<f64>) -> Vector2<f64>) {
    let changed = by(Vector2::new(told.u.unwrap_or_default(), told.v.unwrap_or_default()));
    told.u = told.u.map(|_| changed.x);
    told.v = told.v.map(|_| changed.y);
}

fn flood(voyage: &mut Voyage, window: &Window, times: u32) {
    let repeated = |log: &Stamped<LogVelocity>| {
        let log = *log;
        (1..times).map(move |k| {
            let late = REPEATED * f64::from(k);
            let message = LogVelocity { time: shifted(log.message.time, late), ..log.message };
            Stamped { message, arrival: log.arrival.map(|arrival| shifted(arrival, late)) }
        })
    };
    let flooded = voyage.log.iter().filter(|log| window.holds(log.message.time));
    let again: Vec<Stamped<LogVelocity>> = flooded.flat_map(repeated).collect();
    voyage.log.extend(again);
    voyage.log.sort_by_key(|log| log.message.time);
}
