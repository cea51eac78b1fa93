//! How far wrong a position may be, and whether it may be relied on.

use crate::party::Integrity;
use crate::solution::{Protection, Solution, SolutionSigma};

/// Sigmas that are a protection level, for a risk of 1e-5 in three hours of errors that last five minutes: 2.8e-7
/// each. The horizontal one is of the sum of both components, which is no less than that along any direction.
const HORIZONTAL: f64 = 5.5;
const VERTICAL: f64 = 5.2;
/// Horizontal alert limit of general navigation, m (IMO A.915(22), appendix 2).
const ALERT_LIMIT: f64 = 25.0;

impl Protection {
    /// Where nobody lies: by 1-sigma of each component.
    #[must_use]
    pub fn of(sigma: &SolutionSigma) -> Self {
        let sigma = &sigma.position.0;
        Protection { horizontal: HORIZONTAL * sigma.xy().norm(), vertical: Self::along(sigma.z) }
    }

    /// Along one direction, where nobody lies: by its 1-sigma, in the same unit.
    #[must_use]
    pub fn along(sigma: f64) -> f64 {
        VERTICAL * sigma
    }

    /// Both added.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Protection {
            horizontal: self.horizontal + other.horizontal,
            vertical: self.vertical + other.vertical,
        }
    }
}

/// Whether a position may be relied on, as in the column `integrity` of `nav.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Availability {
    /// Nothing speaks against it, and the horizontal level is within 25 m.
    Available,
    /// The level is beyond that or not known, or it rests on a receiver that was found to lie and is on trial.
    Unavailable,
    /// The sensors contradict each other, and it is not known who is wrong: not to be used.
    Fault,
}

impl Availability {
    /// All of them, the best first.
    pub const ALL: [Availability; 3] =
        [Availability::Available, Availability::Unavailable, Availability::Fault];

    /// Its word, as in `nav.csv`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Availability::Available => "available",
            Availability::Unavailable => "unavailable",
            Availability::Fault => "fault",
        }
    }

    /// That of a word of `nav.csv`.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|own| own.as_str() == word)
    }
}

impl Solution {
    /// How far wrong the position may be, by what it claims of itself and what may be wrong that nobody has found.
    #[must_use]
    pub fn protection(&self) -> Protection {
        Protection::of(&self.sigma).plus(&self.hidden)
    }

    /// Whether the position may be relied on. Where nobody compares the sensors its own claim decides.
    #[must_use]
    pub fn availability(&self) -> Availability {
        match self.judgement.integrity {
            Integrity::Contradiction => Availability::Fault,
            Integrity::Unproven => Availability::Unavailable,
            Integrity::Unwatched | Integrity::Consistent => {
                let is_within = self.protection().horizontal <= ALERT_LIMIT;
                if is_within { Availability::Available } else { Availability::Unavailable }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_that_of_one_availability() {
        for own in Availability::ALL {
            assert_eq!(Availability::from_word(own.as_str()), Some(own));
        }
        assert_eq!(Availability::from_word("Available"), None);
    }
}
