//! Sensors that lie: a voyage is made with honest sensors, and then one or two of them are spoilt.
//!
//! Each kind of the [`catalogue`] draws its size, axis, direction and moment from a seed; what is asked of a
//! navigator then depends on what the other sensors can show ([`evidence`]).

mod case;
mod compass;
mod draw;
pub mod evidence;
mod gnss;
mod imu;
mod kinds;
mod log;

use std::fmt;

use insd_base::{Span, Time, Truth, Voyage};
use rand_pcg::Pcg64;

use crate::random::{Purpose, stream};

pub use case::{Case, case, compass};
pub use compass::CompassLie;
pub use gnss::GnssLie;
pub use imu::ImuLie;
pub use kinds::{LieKind, catalogue};
pub use log::LogLie;

/// What one sensor tells wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lie {
    /// The GNSS receiver, or the second one where there are two.
    Gnss(GnssLie),
    /// The log.
    Log(LogLie),
    /// The heading reference.
    Compass(CompassLie),
    /// The IMU.
    Imu(ImuLie),
    /// No receiver tells anything.
    Outage,
}

/// From when until when, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Its begin.
    pub from: f64,
    /// Its end; infinite if it never heals.
    pub until: f64,
}

/// A lie and when it is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    /// The lie.
    pub lie: Lie,
    /// When.
    pub window: Window,
}

/// The sensors beside the IMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Suite {
    /// A receiver alone.
    Gnss,
    /// With a Doppler log on the bottom.
    Log,
    /// With a compass.
    Compass,
    /// With both.
    Both,
    /// A second receiver, told as an external reference.
    Two,
    /// A second receiver and a log.
    TwoAndLog,
}

/// Grade of the IMU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grade {
    /// Gyros of 0.01 deg/h.
    Navigation,
    /// Of some deg/h.
    Mems,
}

/// What is asked of a navigator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// The others prove it and can carry on: name it, leave it out, navigate.
    Required,
    /// Provable, but nothing carries on: tell.
    Told,
    /// Below what can be shown: cover it.
    Bounded,
}

/// The word by which a spoilt sensor is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Culprit {
    /// GNSS.
    Gnss,
    /// The log.
    Log,
    /// The compass, or another reference.
    Reference,
    /// The IMU or a part of it.
    Imu,
}

impl Window {
    /// Whether an instant lies in it.
    #[must_use]
    pub fn holds(&self, time: Time) -> bool {
        (self.from..self.until).contains(&time.as_seconds())
    }

    /// Time since it began, s.
    #[must_use]
    pub fn since(&self, time: Time) -> f64 {
        time.as_seconds() - self.from
    }
}

impl Suite {
    /// Whether there is a log.
    #[must_use]
    pub fn has_log(self) -> bool {
        matches!(self, Suite::Log | Suite::Both | Suite::TwoAndLog)
    }

    /// Whether there is a compass.
    #[must_use]
    pub fn has_compass(self) -> bool {
        matches!(self, Suite::Compass | Suite::Both)
    }

    /// Whether there is a second receiver.
    #[must_use]
    pub fn has_second(self) -> bool {
        matches!(self, Suite::Two | Suite::TwoAndLog)
    }
}

impl Told {
    /// Spoils a voyage.
    pub fn spoil(&self, voyage: &mut Voyage, rng: &mut Pcg64) {
        let window = self.window;
        match self.lie {
            Lie::Gnss(lie) => lie.spoil(voyage, &window, rng),
            Lie::Log(lie) => lie.spoil(voyage, &window, rng),
            Lie::Compass(lie) => lie.spoil(voyage, &window, rng),
            Lie::Imu(lie) => lie.spoil(voyage, &window, rng),
            Lie::Outage => voyage.gnss.retain(|fix| !window.holds(fix.message.time)),
        }
    }

    /// Spoils a voyage, what is random about it drawn from a seed.
    pub fn spoil_by(&self, voyage: &mut Voyage, seed: u64) {
        self.spoil(voyage, &mut stream(seed, Purpose::Lying));
    }

    /// Who tells it.
    #[must_use]
    pub fn culprit(&self) -> Culprit {
        match self.lie {
            Lie::Gnss(lie) if lie.is_of_second() => Culprit::Reference,
            Lie::Gnss(_) | Lie::Outage => Culprit::Gnss,
            Lie::Log(_) => Culprit::Log,
            Lie::Compass(_) => Culprit::Reference,
            Lie::Imu(_) => Culprit::Imu,
        }
    }
}

impl Culprit {
    /// Whether a word of the column `excluded` means it.
    #[must_use]
    pub fn is_meant_by(self, word: &str) -> bool {
        match self {
            Culprit::Gnss => word.starts_with("gnss"),
            Culprit::Log => word == "log",
            Culprit::Reference => matches!(word, "reference" | "heading"),
            Culprit::Imu => matches!(word, "imu" | "gyro" | "accel"),
        }
    }
}

impl fmt::Display for Suite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Suite::Gnss => "-",
            Suite::Log => "log",
            Suite::Compass => "hdg",
            Suite::Both => "log+hdg",
            Suite::Two => "gnss2",
            Suite::TwoAndLog => "gnss2+log",
        })
    }
}

/// The same moment, later or earlier, s.
fn shifted(time: Time, by: f64) -> Time {
    time + Span::from_seconds(by)
}

/// The truth nearest to an instant.
fn truth_at(truth: &[Truth], time: Time) -> Option<&Truth> {
    let after = truth.partition_point(|row| row.time < time);
    let near = |row: &&Truth| (row.time - time).as_seconds().abs();
    let both = truth.get(after.saturating_sub(1)..truth.len().min(after + 1))?;
    both.iter().min_by(|one, other| near(one).total_cmp(&near(other)))
}

#[cfg(test)]
mod tests;
