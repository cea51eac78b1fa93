//! Attempts to open a port: how they end, and how long is waited before the next.

use std::time::Duration;

use insd_base::Span;

use super::teller::Teller;

/// First and longest pause before a port is opened again; each is twice the one before.
pub(crate) const FIRST_PAUSE: Duration = Duration::from_millis(200);
pub(crate) const LONGEST_PAUSE: Duration = Duration::from_secs(5);

/// A port that was open for so long starts with the first pause again; one that comes and goes more
/// quickly is waited for longer and longer.
const LASTING: Span = Span::from_nanos(5_000_000_000);

/// How an attempt ended.
pub(crate) enum Outcome {
    /// It could not be opened.
    Absent(String),
    /// It was open and was lost.
    Lost(String),
    /// There is no more to come.
    Ended,
}

/// Tells how an attempt ended. Gives whether there is to be another.
pub(crate) fn tell(outcome: Outcome, teller: &mut Teller) -> bool {
    match outcome {
        Outcome::Absent(reason) => teller.absent(reason),
        Outcome::Lost(reason) => teller.lost(reason),
        Outcome::Ended => {
            teller.ended();
            return false;
        }
    }
    true
}

/// The pauses between attempts.
pub(crate) struct Pause {
    next: Duration,
    longest: Duration,
}

impl Default for Pause {
    fn default() -> Self {
        Pause { next: FIRST_PAUSE, longest: LONGEST_PAUSE }
    }
}

impl Pause {
    /// Pauses that grow up to this one.
    pub(crate) fn up_to(longest: Duration) -> Self {
        Pause { next: FIRST_PAUSE, longest }
    }

    /// The next pause, after a port that was open for so long.
    pub(crate) fn after(&mut self, open_for: Span) -> Duration {
        if open_for >= LASTING {
            self.next = FIRST_PAUSE;
        }
        let pause = self.next;
        self.next = (pause * 2).min(self.longest);
        pause
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_double_up_to_five_seconds_and_start_again_after_a_lasting_opening() {
        let mut pause = Pause::default();
        let brief = Span::from_seconds(1.0);
        let millis: Vec<u128> = (0..7).map(|_| pause.after(brief).as_millis()).collect();
        assert_eq!(millis, [200, 400, 800, 1600, 3200, 5000, 5000]);
        assert_eq!(pause.after(LASTING), FIRST_PAUSE);
    }
}
