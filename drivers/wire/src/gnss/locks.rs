//! Which signals lost lock between two epochs, by how long each says that it has been tracked.

use std::collections::BTreeMap;

use insd_base::satellites::{SatelliteEpoch, SatelliteId, SignalCode};

/// The lock times of the signals of one receiver as they were heard last.
#[derive(Clone, Debug, Default)]
pub struct Locks {
    /// The lock time, s, and whether a slip waits for a phase that can be marked.
    last: BTreeMap<(SatelliteId, SignalCode), (f64, bool)>,
}

impl Locks {
    /// Of a receiver that has not been heard yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Marks the phases of an epoch whose lock is younger than it was, or begins.
    ///
    /// A lock of zero always counts, so that of a receiver that counts whole seconds all phases of the first one are marked.
    /// Formats tell no more of a slip than that; a receiver that loses lock and holds it again for longer than before between two epochs
    /// can not be found out.
    pub fn mark(&mut self, epoch: &mut SatelliteEpoch) {
        for signal in &mut epoch.signals {
            let Some(lock) = signal.lock else { continue };
            let own = self.last.entry((signal.satellite, signal.signal)).or_insert((lock, false));
            let slipped = own.1 || lock <= 0.0 || lock < own.0;
            signal.slip |= slipped && signal.phase.is_some();
            *own = (lock, slipped && signal.phase.is_none());
        }
    }
}

#[cfg(test)]
mod tests {
    use insd_base::GpsTime;
    use insd_base::satellites::{Constellation, SignalObservation};

    use super::*;

    fn marked(locks: &mut Locks, lock: f64, phase: Option<f64>) -> bool {
        let satellite = SatelliteId::new(Constellation::Gps, 7).unwrap();
        let signal = SignalObservation::unknown(satellite, SignalCode::new(1, b'C'));
        let mut epoch = SatelliteEpoch {
            tag: GpsTime::from_nanos(0),
            signals: vec![SignalObservation { phase, lock: Some(lock), ..signal }],
            leap_seconds: None,
            clock_reset: false,
        };
        locks.mark(&mut epoch);
        epoch.signals[0].slip
    }

    #[test]
    fn a_lock_that_is_younger_than_it_was_is_a_slip() {
        let mut locks = Locks::new();
        let told = [(0.0, true), (1.0, false), (2.0, false), (0.5, true), (0.5, false)];
        for (lock, slip) in told {
            assert_eq!(marked(&mut locks, lock, Some(1.0)), slip, "{lock}");
        }
    }

    #[test]
    fn a_slip_while_there_is_no_phase_is_told_of_the_next_one() {
        let mut locks = Locks::new();
        let told = [(1.0, Some(1.0), false), (0.0, None, false), (0.5, Some(1.0), true)];
        for (lock, phase, slip) in told {
            assert_eq!(marked(&mut locks, lock, phase), slip, "{lock}");
        }
        assert!(!marked(&mut locks, 0.7, Some(1.0)));
    }
}
