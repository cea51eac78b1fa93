//! An instant that another run of the program can place.

use insd_base::{Span, UtcTime};
use serde::{Deserialize, Serialize};

/// An instant by the time since the computer was started, and by its clock.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Boot {
    /// Which start of the computer; empty if that is not known.
    id: String,
    /// Time since that start, ns; goes on while the computer sleeps.
    since_start: i64,
    /// UTC as the computer believes, ns; it may be wrong, and it may have been set since.
    system: i64,
}

impl Boot {
    /// An instant of this computer.
    #[must_use]
    pub fn new(id: String, since_start: Span, system: UtcTime) -> Self {
        Boot { id, since_start: since_start.as_nanos(), system: system.as_nanos() }
    }

    /// Time from an earlier instant to this one; `None` if nobody knows. Within one start of the computer
    /// no clock that is set plays a part; after another start its clock is all there is.
    #[must_use]
    pub fn since(&self, earlier: &Boot) -> Option<Span> {
        let same = !self.id.is_empty() && self.id == earlier.id;
        let nanos = if same {
            self.since_start.checked_sub(earlier.since_start)
        } else {
            self.system.checked_sub(earlier.system)
        };
        nanos.filter(|nanos| *nanos >= 0).map(Span::from_nanos)
    }

    #[cfg(test)]
    pub(crate) fn made_up(id: u8, seconds: f64) -> Self {
        let since_start = Span::from_seconds(seconds);
        Boot::new(id.to_string(), since_start, UtcTime::from_nanos(since_start.as_nanos()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boot(id: &str, since_start: i64, system: i64) -> Boot {
        Boot { id: id.to_owned(), since_start, system }
    }

    #[test]
    fn a_clock_that_was_set_by_an_hour_does_not_matter_within_one_start_of_the_computer() {
        let (before, after) = (boot("a", 10, 1_000), boot("a", 15, 3_600_000));
        assert_eq!(after.since(&before), Some(Span::from_nanos(5)));
    }

    #[test]
    fn after_another_start_the_clock_counts_unless_it_went_back() {
        let before = boot("a", 10, 1_000);
        assert_eq!(boot("b", 1, 1_500).since(&before), Some(Span::from_nanos(500)));
        assert_eq!(boot("b", 1, 999).since(&before), None);
        assert_eq!(boot("", 20, 1_500).since(&boot("", 10, 1_000)), Some(Span::from_nanos(500)));
    }
}
