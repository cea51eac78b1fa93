//! What the judge hears.

use insd_base::{Party, Time};
use insd_estimation::{Innovation, Weighed};

use super::scatter::Scatter;

/// An aid that is heard: each has noise and outliers of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aid {
    /// GNSS position.
    GnssPosition,
    /// GNSS velocity.
    GnssVelocity,
    /// A complete log, or its forward component.
    Log,
    /// Its starboard component.
    LogStarboard,
    /// Its down component.
    LogDown,
    /// Heading.
    Heading,
    /// Position of another reference.
    ReferencePosition,
    /// Its velocity.
    ReferenceVelocity,
    /// Position of a receiver that is compared with the one in use.
    SparePosition,
    /// Its velocity.
    SpareVelocity,
    /// Heading by several antennas.
    Antennas,
    /// Distance of the first docking aid.
    Docking1,
    /// Of the second.
    Docking2,
    /// Of the third.
    Docking3,
    /// Of the fourth.
    Docking4,
    /// Mean sea level.
    SeaLevel,
}

/// How many there are.
pub(super) const AIDS: usize = Aid::SeaLevel as usize + 1;

/// Each aid is heard no more often than this, s: what is between tells little more.
const SPACING: f64 = 0.95;
/// A silence that is long, s.
const SILENCE: f64 = 15.0;
/// How many outliers in a row are not heard.
const SPIKES: u32 = 2;
/// Noise that grows by so much, as a variance, spoils what was made of it; less comes by chance.
const MUCH: f64 = 10.0;

/// Docking aids that are judged one by one.
pub(crate) const DOCKING_AIDS: usize = 4;
/// They, by their numbers.
const DOCKING: [Aid; DOCKING_AIDS] = [Aid::Docking1, Aid::Docking2, Aid::Docking3, Aid::Docking4];

impl Aid {
    /// The docking aid of a number, from 0; `None` of one too many.
    #[must_use]
    pub fn docking(number: u8) -> Option<Aid> {
        DOCKING.get(usize::from(number)).copied()
    }

    /// Which docking aid it is.
    #[must_use]
    pub fn number_of_docking(self) -> Option<usize> {
        DOCKING.iter().position(|own| *own == self)
    }

    /// Who says it.
    #[must_use]
    pub fn party(self) -> Option<Party> {
        match self {
            Aid::GnssPosition | Aid::GnssVelocity => Some(Party::Gnss),
            Aid::Log | Aid::LogStarboard | Aid::LogDown => Some(Party::Log),
            Aid::Heading => Some(Party::Heading),
            Aid::ReferencePosition | Aid::ReferenceVelocity => Some(Party::Reference),
            Aid::SparePosition | Aid::SpareVelocity => Some(Party::Gnss2),
            Aid::Antennas => Some(Party::Antennas),
            Aid::Docking1 | Aid::Docking2 | Aid::Docking3 | Aid::Docking4 => Some(Party::Docking),
            Aid::SeaLevel => None,
        }
    }
}

impl Aid {
    /// Whether estimates take anything of it: what is only compared shares its slow errors with what is used.
    #[must_use]
    pub fn is_absorbed(self) -> bool {
        !matches!(self, Aid::SparePosition | Aid::SpareVelocity)
    }
}

/// When an aid was heard last, its outliers in a row, and its noise.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hearing {
    last: Option<Time>,
    /// When it spoke last, heard or not, and its last long silence: from and to.
    spoke: Option<Time>,
    silence: Option<(Time, Time)>,
    /// When it contradicted another word of the same sensor last.
    contradicted: Option<Time>,
    outliers: u32,
    scatter: Scatter,
    noise: f64,
    /// What of it was known when evidence was begun anew for it.
    known: f64,
}

impl Hearing {
    /// Whether it is time to hear it.
    pub(super) fn is_due(&self, now: Time) -> bool {
        self.last.is_none_or(|last| (now - last).as_seconds() >= SPACING)
    }

    /// Whether it was heard within such a time, s.
    pub(super) fn was_within(&self, now: Time, span: f64) -> bool {
        is_within(self.last, now, span)
    }

    /// Time since it was heard, s; infinite if it never was.
    pub(super) fn unheard(&self, now: Time) -> f64 {
        self.last.map_or(f64::INFINITY, |last| (now - last).as_seconds())
    }

    /// Whether it has spoken within such a time, s, heard or not.
    pub(super) fn spoke_within(&self, now: Time, span: f64) -> bool {
        is_within(self.spoke, now, span)
    }

    /// It is heard now.
    pub(super) fn note(&mut self, now: Time) {
        self.last = Some(now);
        self.note_word(now);
    }

    /// It speaks, heard or not.
    pub(super) fn note_word(&mut self, now: Time) {
        let before = self.spoke.replace(now);
        let silence = before.filter(|before| (now - *before).as_seconds() > SILENCE);
        self.silence = silence.map(|before| (before, now)).or(self.silence);
    }

    /// It contradicts another word of the same sensor.
    pub(super) fn note_contradiction(&mut self, now: Time) {
        self.contradicted = Some(now);
    }

    /// Whether it did so within such a time, s.
    pub(super) fn was_contradicted_within(&self, now: Time, span: f64) -> bool {
        is_within(self.contradicted, now, span)
    }

    /// Whether it was heard again after a long silence within such a time, s.
    pub(super) fn was_resumed_within(&self, now: Time, span: f64) -> bool {
        is_within(self.silence.map(|(_, end)| end), now, span)
    }

    /// Whether an instant is in its last long silence, or just after it, s.
    pub(super) fn was_silent_at(&self, since: Time, span: f64) -> bool {
        let is_in =
            |(begin, end): (Time, Time)| since >= begin && (since - end).as_seconds() <= span;
        self.silence.is_some_and(is_in)
    }

    /// Sees an innovation of which all of the variance of the noise has been raised by what it scatters: what was not would make
    /// the scatter grow by itself. Where it is found to scatter much more than before, by how much, as a variance.
    pub(super) fn see(&mut self, innovation: &Innovation) -> Option<f64> {
        let before = self.noise();
        let of = |i: usize| innovation.z[i] / (innovation.r[(i, i)] / before).sqrt();
        self.scatter
            .see(std::array::from_fn(|i| if i < innovation.rows() { of(i) } else { f64::NAN }));
        self.noise = self.scatter.factor();
        self.known = self.known.min(self.noise()).max(1.0);
        let growth = Some(self.noise / self.known).filter(|growth| *growth > MUCH);
        self.known = growth.map_or(self.known, |_| self.noise);
        growth
    }

    /// By how much the variance of the noise is larger than stated.
    pub(super) fn noise(&self) -> f64 {
        self.noise.max(1.0)
    }

    /// Counts outliers; tells whether this one is the first, and whether it is to be heard.
    pub(super) fn count(&mut self, is_outlier: bool) -> (bool, bool) {
        self.outliers = if is_outlier { self.outliers + 1 } else { 0 };
        (self.outliers == 1, !(1..=SPIKES).contains(&self.outliers))
    }
}

/// Whether something happened within such a time, s.
fn is_within(at: Option<Time>, now: Time, span: f64) -> bool {
    at.is_some_and(|at| (now - at).as_seconds() <= span)
}

/// The mean square of an innovation, of which one is expected, if it agrees: one in 10,000 honest ones does not.
pub(super) fn agreement(weighed: &Weighed) -> Option<f64> {
    let limit = match weighed.rows() {
        1 => 15.1,
        2 => 18.4,
        3 => 21.1,
        _ => 27.9,
    };
    Some(weighed.nis()).filter(|nis| *nis <= limit).map(|nis| nis / weighed.rows() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_of_a_long_silence_is_silent_and_the_moment_after_it() {
        let mut hearing = Hearing::default();
        for second in [8.0, 9.0, 10.0, 40.0, 41.0, 42.0] {
            hearing.note_word(Time::from_seconds(second));
        }
        let was_silent = |second: f64| hearing.was_silent_at(Time::from_seconds(second), 5.0);
        assert!(was_silent(15.0) && was_silent(39.0) && was_silent(44.0));
        assert!(!was_silent(9.0) && !was_silent(46.0));
    }
}
