//! How much may be sent: a budget of bytes an hour, for links that are thin or paid by the byte.
//!
//! A purse that fills steadily and holds a few minutes' worth. Half of what comes in is for the state as it is now and half for
//! what waits in the spool; what one half does not need the other may spend. A message may be sent when its purse
//! is not empty, and is paid in full: so large ones are sent, too, and the mean is kept.

use insd_base::Time;

/// A purse holds what comes in during so long, s.
const HOLDS: f64 = 180.0;
/// And this at least, bytes: a message or two.
const LEAST: f64 = 2048.0;

/// What TCP/IP and its acknowledgements add to each message and its own acknowledgement, bytes: four headers of 52.
pub const OVERHEAD: usize = 208;

/// For what is spent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purse {
    /// The state as it is now.
    State,
    /// What waits in the spool.
    Spool,
}

/// A budget.
#[derive(Clone, Debug)]
pub struct ByteBudget {
    /// Bytes a second; `None` without a limit.
    rate: Option<f64>,
    purses: [f64; 2],
    filled: Option<Time>,
}

impl ByteBudget {
    /// So many bytes an hour; `None` without a limit.
    #[must_use]
    pub fn new(bytes_per_hour: Option<u64>) -> Self {
        let rate = bytes_per_hour.map(|bytes| bytes as f64 / 3600.0);
        let full = rate.map_or(0.0, holds);
        ByteBudget { rate, purses: [full; 2], filled: None }
    }

    /// Whether a message may be sent now.
    #[must_use]
    pub fn allows(&mut self, purse: Purse, now: Time) -> bool {
        let Some(rate) = self.rate else { return true };
        let passed = self.filled.map_or(0.0, |filled| (now - filled).as_seconds()).max(0.0);
        self.filled = Some(now);
        let half = rate * passed / 2.0;
        let spare: [f64; 2] = std::array::from_fn(|own| {
            self.purses[own] += half;
            let beyond = (self.purses[own] - holds(rate)).max(0.0);
            self.purses[own] -= beyond;
            beyond
        });
        for own in 0..2 {
            self.purses[own] = (self.purses[own] + spare[1 - own]).min(holds(rate));
        }
        self.purses[purse as usize] > 0.0
    }

    /// Bytes were sent.
    pub fn spend(&mut self, purse: Purse, bytes: usize) {
        if self.rate.is_some() {
            self.purses[purse as usize] -= (bytes + OVERHEAD) as f64;
        }
    }
}

/// What a purse holds at a rate, bytes.
fn holds(rate: f64) -> f64 {
    (rate * HOLDS / 2.0).max(LEAST)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is sent in so many hours if there is always something to send, bytes for state and spool.
    fn sent(budget: u64, hours: usize, wanted: [Option<usize>; 2]) -> [usize; 2] {
        let mut own = ByteBudget::new(Some(budget));
        let mut sent = [0, 0];
        for second in 0..hours * 3600 {
            let now = Time::from_seconds(second as f64);
            for purse in [Purse::State, Purse::Spool] {
                let Some(bytes) = wanted[purse as usize] else { continue };
                if own.allows(purse, now) {
                    own.spend(purse, bytes);
                    sent[purse as usize] += bytes + OVERHEAD;
                }
            }
        }
        sent
    }

    #[test]
    fn in_the_mean_no_more_is_sent_than_the_budget_allows() {
        for budget in [8_000, 60_000, 1_000_000] {
            let [state, spool] = sent(budget, 24, [Some(600), Some(3_000)]);
            let (all, allowed) = (state + spool, budget as usize * 24);
            assert!(all <= allowed + allowed / 20, "{budget}: {all} of {allowed}");
            assert!(all >= allowed * 9 / 10, "{budget}: {all} of {allowed}");
            // and neither starves the other
            assert!(state > allowed / 3 && spool > allowed / 3, "{state} {spool}");
        }
    }

    #[test]
    fn what_one_does_not_need_the_other_spends() {
        let [_, spool] = sent(60_000, 24, [None, Some(2_000)]);
        assert!(spool >= 60_000 * 24 * 9 / 10, "{spool}");
    }

    #[test]
    fn without_a_limit_everything_is_allowed() {
        let mut own = ByteBudget::new(None);
        own.spend(Purse::State, usize::MAX / 4);
        assert!(own.allows(Purse::State, Time::START));
    }
}
