//! What is watched, and by which limits.

use insd_base::{Body, Span};
use insd_intake::watched::WatchedValue;

/// Most sensors that are watched.
pub const MOST_WATCHED: usize = 8;

/// A sensor that is watched and not used.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchPlan {
    /// Its index among the sensors of the first engine's intake.
    pub sensor: usize,
    /// Its name.
    pub name: String,
    /// Where a position reference is, from the IMU.
    pub lever: Body,
    /// Differences beyond these are told.
    pub limits: WatchLimits,
    /// 1-sigma of roll and pitch of a sensor that states none, rad.
    pub attitude_std: f64,
    /// Differences are averaged over this time.
    pub smooth: Span,
    /// A difference is told after it has been beyond its limit for so long.
    pub hold: Span,
}

/// Greatest differences that are no news.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WatchLimits {
    /// Of headings, rad.
    pub heading: f64,
    /// Of positions, m.
    pub position: f64,
    /// Of roll and of pitch, rad.
    pub attitude: f64,
}

impl WatchLimits {
    /// The one of a quantity.
    #[must_use]
    pub fn of(&self, quantity: WatchQuantity) -> f64 {
        match quantity {
            WatchQuantity::Heading => self.heading,
            WatchQuantity::Position => self.position,
            WatchQuantity::Attitude => self.attitude,
        }
    }
}

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum WatchQuantity {
    /// True heading.
    Heading,
    /// Horizontal position.
    Position,
    /// Roll and pitch.
    Attitude,
}

impl WatchQuantity {
    /// All of them.
    pub const ALL: [WatchQuantity; 3] =
        [WatchQuantity::Heading, WatchQuantity::Position, WatchQuantity::Attitude];

    /// That of a value.
    #[must_use]
    pub fn of(value: &WatchedValue) -> Self {
        match value {
            WatchedValue::Heading(_) => WatchQuantity::Heading,
            WatchedValue::Position(_) => WatchQuantity::Position,
            WatchedValue::Tilt { .. } => WatchQuantity::Attitude,
        }
    }

    /// Its word: `heading`, `position`, `attitude`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            WatchQuantity::Heading => "heading",
            WatchQuantity::Position => "position",
            WatchQuantity::Attitude => "attitude",
        }
    }
}
