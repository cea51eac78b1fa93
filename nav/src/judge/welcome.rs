//! Who is heard for the first time, and what may be wrong with him from then on.

use insd_base::{Fault, Time};

use super::Judge;
use super::aid::Aid;
use super::charge::{Charge, Kind};
use super::rows::{ROWS, ROWS_WITH_ANTENNAS};

/// What begins so soon after the first word was so from the begin, s.
const AT_ONCE: f64 = 1.0;
/// Antennas that turn by more than this of a sudden, rad, or go on to turn by this, rad/s, are moved, or count other whole cycles.
const TURNED: f64 = 0.026;
const TURNS: f64 = 3.5e-4;

impl Judge {
    /// Takes note of somebody who is heard; tells whether it is for the first time. What he may do may be from now on.
    pub(super) fn welcome(&mut self, aid: Aid, now: Time) -> bool {
        let (first, rows) = match (aid, aid.number_of_docking()) {
            (Aid::Antennas, _) => (&mut self.newcomers.antennas, ROWS_WITH_ANTENNAS),
            (_, Some(number)) => (&mut self.newcomers.docking[number], ROWS),
            _ => return false,
        };
        if first.is_some() {
            return false;
        }
        *first = Some(now);
        if aid == Aid::Antennas {
            self.docket.note_antennas();
        }
        if rows > self.rows {
            self.rows = rows;
            self.onsets.iter_mut().for_each(|onset| onset.widen(rows));
        }
        true
    }

    /// Whether a fault would be a mistake that was there when somebody was first heard.
    pub(super) fn is_from_begin(&self, fault: Fault, since: Time) -> bool {
        let docking = &self.newcomers.docking;
        let first = match fault {
            Fault::DockingJump(number) => docking.get(usize::from(number)).copied().flatten(),
            // heads that measure to one line are heard together
            Fault::DockingMark(_) => docking.iter().flatten().max().copied(),
            _ => None,
        };
        first.is_some_and(|first| (since - first).as_seconds() < AT_ONCE)
    }

    /// Antennas that turn of a sudden, where that is most of what there is: no heading that was found wrongly does.
    pub(super) fn turns(&self, charge: &Charge) -> bool {
        let Kind::Shaped { since, sized, .. } = charge.kind else { return false };
        let later = |first: Time| (since - first).as_seconds() > AT_ONCE;
        let least = match charge.fault {
            Fault::AntennasOffset => TURNED,
            Fault::AntennasDrift => TURNS,
            _ => f64::INFINITY,
        };
        sized.value.x.abs() > least && self.newcomers.antennas.is_some_and(later)
    }
}
