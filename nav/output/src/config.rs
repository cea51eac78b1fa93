//! What one port sends.

use crate::policy::Policy;
use crate::schedule::Rate;

/// The sentences that a port can send.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SentenceKind {
    /// Heading, without status: it stops when it could mislead.
    Hdt,
    /// Heading and status.
    Ths,
    /// Rate of turn.
    Rot,
    /// Position.
    Gga,
    /// Course and speed over ground.
    Vtg,
    /// Date and time.
    Zda,
}

/// One port: its sentences in the order in which they leave, and how it speaks of quality.
#[derive(Clone, Debug, PartialEq)]
pub struct PortConfig {
    /// Sentences and their rates.
    pub sentences: Vec<(SentenceKind, Rate)>,
    /// Limits by which quality letters are chosen.
    pub policy: Policy,
    /// Height of the geoid above the WGS-84 ellipsoid where the ship sails, m. Without it the
    /// height above mean sea level is unknown, and GGA leaves it empty.
    pub geoid_separation: Option<f64>,
    /// The data come from a simulator: GGA 8, THS S and VTG S, so that nobody takes them for real.
    pub simulated: bool,
    /// Send HDT and ROT even from a simulator, although they have no way to say so. For a port that
    /// no ship's equipment listens to.
    pub unmarked_when_simulated: bool,
}

impl PortConfig {
    /// A bridge port: heading and rate of turn at 10 Hz, position, course and time at 1 Hz. That
    /// is about 850 byte/s, for a line of 38400 bit/s.
    #[must_use]
    pub fn bridge() -> Self {
        let (fast, slow) = (Rate::from_hertz(10.0), Rate::from_hertz(1.0));
        PortConfig {
            sentences: vec![
                (SentenceKind::Hdt, fast),
                (SentenceKind::Ths, fast),
                (SentenceKind::Rot, fast),
                (SentenceKind::Zda, slow),
                (SentenceKind::Gga, slow),
                (SentenceKind::Vtg, slow),
            ],
            policy: Policy::default(),
            geoid_separation: None,
            simulated: false,
            unmarked_when_simulated: false,
        }
    }

    /// The bridge port of the demo: everything, marked as simulated where a sentence can be.
    #[must_use]
    pub fn demo() -> Self {
        PortConfig { simulated: true, unmarked_when_simulated: true, ..Self::bridge() }
    }
}
