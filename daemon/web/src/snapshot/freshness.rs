//! How old a value may be.

use serde::{Deserialize, Serialize};

/// Age beyond which a value is not the present any more, s.
pub const OLD: f64 = 0.5;
/// Age beyond which a value is not told any more, s.
pub const GONE: f64 = 1.0;

/// Whether a value may be taken as the present.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Freshness {
    /// It may.
    #[default]
    Fresh,
    /// It is a moment old: shown as such, and not to be used.
    Old,
    /// It is so old that it is not told at all; a word that this version does not know is taken so, too.
    #[serde(other)]
    Gone,
}

impl Freshness {
    /// That of a value of an age, s. What is not a number is gone.
    #[must_use]
    pub fn of_age(age_s: f64) -> Self {
        if age_s <= OLD {
            Freshness::Fresh
        } else if age_s <= GONE {
            Freshness::Old
        } else {
            Freshness::Gone
        }
    }
}
