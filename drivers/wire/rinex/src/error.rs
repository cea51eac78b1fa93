//! What is wrong with a text, and where.

use std::fmt;

/// Most bytes of a text that are repeated in a message.
const SHOWN: usize = 40;

/// Most flaws that are kept one by one; all are counted.
const KEPT: usize = 100;

/// Something in a line that is not as RINEX says; what is left out for it is said by who reports it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flaw {
    /// Number of the line, from 1.
    pub line: usize,
    /// The field, by its name in the definition of the format.
    pub field: &'static str,
    /// What belongs there.
    pub expected: &'static str,
    /// The beginning of what is there.
    pub found: String,
}

impl Flaw {
    /// A flaw of a field.
    #[must_use]
    pub(crate) fn new(
        line: usize,
        field: &'static str,
        expected: &'static str,
        found: &[u8],
    ) -> Self {
        let shown = String::from_utf8_lossy(&found[..found.len().min(SHOWN)]);
        Self { line, field, expected, found: shown.trim_end().to_owned() }
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, field, expected, found } = self;
        write!(f, "line {line}: {field}: expected {expected}, found {found:?}")
    }
}

impl std::error::Error for Flaw {}

/// The flaws of a text: the first of them, and how many there are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Flaws {
    /// The first hundred.
    pub first: Vec<Flaw>,
    /// All of them, counted.
    pub total: usize,
}

impl Flaws {
    pub(crate) fn add(&mut self, flaw: Flaw) {
        self.total += 1;
        if self.first.len() < KEPT {
            self.first.push(flaw);
        }
    }
}

/// Why a text cannot be read at all.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RinexError {
    /// A field of the header without which the rest has no meaning.
    #[error("{0}")]
    Header(#[from] Flaw),
    /// A line of the header that has to be there.
    #[error("the header has no line {0:?}")]
    Missing(&'static str),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flaw_says_where_it_is_what_was_expected_and_what_was_there() {
        let flaw = Flaw::new(7, "INTERVAL", "seconds", b"  thirty   ");
        assert_eq!(flaw.to_string(), "line 7: INTERVAL: expected seconds, found \"  thirty\"");
    }

    #[test]
    fn a_text_full_of_flaws_fills_no_memory() {
        let mut flaws = Flaws::default();
        for line in 0..1000 {
            flaws.add(Flaw::new(line, "x", "y", &[0xff; 1000]));
        }
        assert_eq!((flaws.first.len(), flaws.total), (KEPT, 1000));
        assert!(flaws.first[0].found.chars().count() <= SHOWN);
    }
}
