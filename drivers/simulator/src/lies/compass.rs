//! Lies of a heading reference.

use insd_base::Voyage;
use insd_base::units::wrap_two_pi;
use rand::RngExt;
use rand_pcg::Pcg64;

use super::Window;
use crate::random::normal;

/// What a compass tells wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompassLie {
    /// It is off by an angle, rad.
    Offset(f64),
    /// It drifts, rad/s.
    Drift(f64),
    /// It stands still.
    Frozen,
    /// It turns the wrong way.
    Mirrored,
    /// Its sigma is too small by this factor.
    TinySigma(f64),
    /// It is noisy beyond what it says, 1-sigma, rad.
    Noise(f64),
    /// Now and then it tells anything.
    Spikes,
    /// It wanders, 1-sigma, rad, with a time constant, s.
    Wander {
        /// 1-sigma, rad.
        std: f64,
        /// Time constant, s.
        time: f64,
    },
}

/// Share of messages that are spikes.
const SPIKES: f64 = 0.05;

impl CompassLie {
    pub(super) fn spoil(self, voyage: &mut Voyage, window: &Window, rng: &mut Pcg64) {
        let told = voyage.reference.iter_mut().filter(|told| window.holds(told.message.time));
        let mut held = None;
        let mut wandered: Option<(f64, f64)> = None;
        for told in told {
            let (now, since) = (told.message.time.as_seconds(), window.since(told.message.time));
            let Some(heading) = told.message.heading else { continue };
            let first = *held.get_or_insert(heading);
            let off = match self {
                CompassLie::Offset(by) => by,
                CompassLie::Drift(rate) => rate * since,
                CompassLie::Frozen => first - heading,
                CompassLie::Mirrored => 2.0 * (first - heading),
                CompassLie::Noise(std) => std * normal(rng),
                CompassLie::Spikes if rng.random::<f64>() < SPIKES => rng.random_range(-3.0..3.0),
                CompassLie::Wander { std, time } => {
                    let (at, before) = wandered.unwrap_or((now, std * normal(rng)));
                    let kept = (-(now - at) / time).exp();
                    let next = kept * before + std * (1.0 - kept * kept).sqrt() * normal(rng);
                    wandered = Some((now, next));
                    next
                }
                CompassLie::Spikes | CompassLie::TinySigma(_) => 0.0,
            };
            told.message.heading = Some(wrap_two_pi(heading + off));
            if let CompassLie::TinySigma(factor) = self {
                told.message.heading_std = told.message.heading_std.map(|std| std / factor);
            }
        }
    }
}
