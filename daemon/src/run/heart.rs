//! Whether the engine really advances: what the watchdog of the service is fed by.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use insd_base::{Counts, Time};

/// Time for which samples may come without one of them being taken, s.
const STUCK: f64 = 10.0;

/// Beats with each turn of the engine's thread.
#[derive(Clone, Debug, Default)]
pub(super) struct Heart(Arc<AtomicU64>);

impl Heart {
    pub(super) fn beat(&self) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }

    /// Beats since the start.
    pub(super) fn beats(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

/// Whether the engine takes what it is given. An IMU that is silent, or says what cannot be, is no fault of
/// ours; samples that are all refused for their time are, as a start would mend it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    taken: u64,
    refused: u64,
    /// Since when samples were refused and none was taken.
    refusing: Option<Time>,
}

impl Progress {
    /// Takes note of what the engine counted; to be called once a second or so.
    pub(super) fn note(&mut self, counts: &Counts, now: Time) {
        let refused = counts.imu_duplicates + counts.imu_out_of_order;
        if counts.imu_samples != self.taken || refused == self.refused {
            self.refusing = None;
        } else {
            self.refusing.get_or_insert(now);
        }
        (self.taken, self.refused) = (counts.imu_samples, refused);
    }

    /// Whether the engine advances, or has nothing to advance by.
    pub(super) fn is_sound(&self, now: Time) -> bool {
        self.refusing.is_none_or(|since| (now - since).as_seconds() < STUCK)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_engine_that_refuses_all_samples_for_their_time_is_not_sound() {
        let mut progress = Progress::default();
        for second in 0..30_u64 {
            let now = Time::from_seconds(second as f64);
            let counts = Counts {
                imu_samples: 100 * second.min(10),
                imu_out_of_order: 100 * second.saturating_sub(10),
                ..Counts::default()
            };
            progress.note(&counts, now);
            assert_eq!(progress.is_sound(now), second <= 20, "{second}");
        }
    }

    #[test]
    fn an_imu_that_is_silent_or_insane_is_no_reason_to_start_again() {
        let mut progress = Progress::default();
        for second in 0..100_u64 {
            let now = Time::from_seconds(second as f64);
            let counts = Counts { imu_samples: 7, imu_out_of_range: second, ..Counts::default() };
            progress.note(&counts, now);
            assert!(progress.is_sound(now));
        }
    }
}
