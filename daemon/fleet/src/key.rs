//! What tells a record from all others: ship, run and sequence. A repeat has the key of what it repeats, so
//! whoever takes it in ashore can leave it out.

use std::fmt;

/// One run of the program. No clock and no counter is in it, as both may be set back: it is drawn anew by
/// the kernel at each start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RunId(u64);

impl RunId {
    /// Drawn by the kernel.
    ///
    /// # Errors
    /// The kernel gives no random numbers.
    pub fn drawn() -> std::io::Result<Self> {
        let text = std::fs::read_to_string("/proc/sys/kernel/random/uuid")?;
        let digits: String = text.chars().filter(char::is_ascii_hexdigit).collect();
        // of a random UUID the last sixteen digits are random but for the two bits of its variant
        let last = digits.get(digits.len().saturating_sub(16)..).unwrap_or_default();
        u64::from_str_radix(last, 16).map(RunId).map_err(std::io::Error::other)
    }

    /// That of a number.
    #[must_use]
    pub fn of_number(number: u64) -> Self {
        RunId(number)
    }

    /// As a number.
    #[must_use]
    pub fn number(self) -> u64 {
        self.0
    }

    /// That which is written so.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let is_one = text.len() == 16 && text.chars().all(|c| c.is_ascii_hexdigit());
        is_one.then(|| u64::from_str_radix(text, 16).ok().map(RunId)).flatten()
    }
}

/// Sixteen hexadecimal digits.
impl fmt::Display for RunId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// The key of a record, on one ship.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RecordKey {
    /// The run.
    pub run: RunId,
    /// Counts from 1 within the run.
    pub sequence: u64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_runs_are_never_the_same() {
        assert_ne!(RunId::drawn().unwrap(), RunId::drawn().unwrap());
    }

    #[test]
    fn a_run_is_read_as_it_is_written() {
        let run = RunId::of_number(0x00ff_0000_1234_abcd);
        assert_eq!(run.to_string(), "00ff00001234abcd");
        assert_eq!(RunId::parse(&run.to_string()), Some(run));
        assert_eq!(RunId::parse("+0ff00001234abcd"), None);
    }
}
