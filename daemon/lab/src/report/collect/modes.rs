//! What the system did when, and why it changed.

use insd_base::{Event, Mode, Time};

use super::lane::Lane;
use crate::report::bounded::Bounded;

/// Changes kept at each end of the recording.
const CHANGES: usize = 50;

/// All modes, those that matter least first.
pub(crate) const MODES: [Mode; 8] = [
    Mode::Aided,
    Mode::DeadReckoning,
    Mode::Inertial,
    Mode::FineAlignment,
    Mode::InMotionAlignment,
    Mode::CoarseAlignment,
    Mode::Standby,
    Mode::Fault,
];

/// A change of the mode.
#[derive(Clone, Debug)]
pub(crate) struct Change {
    pub(crate) time: Time,
    pub(crate) from: Option<Mode>,
    pub(crate) to: Mode,
    pub(crate) reason: String,
}

/// The time line of modes.
#[derive(Clone, Debug)]
pub(crate) struct Modes {
    pub(crate) lane: Lane,
    pub(crate) changes: Bounded<Change>,
    /// Time in each of [`MODES`], s.
    pub(crate) spent: [f64; MODES.len()],
    /// Longest time of navigating without GNSS, s.
    pub(crate) without_gnss: f64,
    lonely: f64,
}

/// The bit of a mode in its lane.
pub(crate) fn bit(mode: Mode) -> u16 {
    let index = MODES.iter().position(|own| *own == mode).unwrap_or(0);
    1 << index
}

impl Modes {
    pub(crate) fn new(start: Time) -> Self {
        Modes {
            lane: Lane::new(start),
            changes: Bounded::new(CHANGES),
            spent: [0.0; MODES.len()],
            without_gnss: 0.0,
            lonely: 0.0,
        }
    }

    /// A solution of this mode, so long after the one before, s.
    pub(crate) fn solution(&mut self, time: Time, mode: Mode, passed: Option<f64>) {
        self.lane.mark(time, bit(mode));
        let passed = passed.unwrap_or(0.0);
        for (spent, own) in self.spent.iter_mut().zip(MODES) {
            *spent += if own == mode { passed } else { 0.0 };
        }
        let lonely = mode.is_navigating() && mode != Mode::Aided;
        self.lonely = if lonely { self.lonely + passed } else { 0.0 };
        self.without_gnss = self.without_gnss.max(self.lonely);
    }

    /// Time with a heading to steer by, s.
    pub(crate) fn navigating(&self) -> f64 {
        MODES.iter().zip(self.spent).filter(|(mode, _)| mode.is_navigating()).map(|(_, s)| s).sum()
    }

    /// Whether a mode was ever that of a solution.
    pub(crate) fn has_seen(&self, mode: Mode) -> bool {
        !self.lane.runs(bit(mode)).is_empty()
    }

    /// Takes note of a change.
    pub(crate) fn event(&mut self, event: &Event) {
        let Event::ModeChanged { time, from, to, why } = *event else { return };
        if matches!(to, Mode::Fault | Mode::Standby) {
            self.lane.mark(time, bit(to));
        }
        self.changes.push(Change { time, from, to, reason: why.to_string() });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::ModeReason;

    fn at(seconds: f64) -> Time {
        Time::from_seconds(seconds)
    }

    #[test]
    fn a_change_is_told_with_its_reason() {
        let mut modes = Modes::new(Time::START);
        let (from, to) = (Some(Mode::Aided), Mode::DeadReckoning);
        modes.event(&Event::ModeChanged { time: at(205.0), from, to, why: ModeReason::LogInUse });
        let change = modes.changes.first().last().unwrap();
        assert_eq!((change.from, change.to), (from, to));
        assert_eq!(change.reason, "a log or a reference carries her, without GNSS");
    }

    #[test]
    fn time_without_gnss_counts_while_navigating_only() {
        let mut modes = Modes::new(Time::START);
        let told =
            [(Mode::FineAlignment, 50), (Mode::Aided, 10), (Mode::Inertial, 7), (Mode::Aided, 3)];
        let all = told.iter().flat_map(|(mode, seconds)| vec![*mode; *seconds]);
        for (second, mode) in (0..).zip(all) {
            modes.solution(at(f64::from(second)), mode, Some(1.0));
        }
        assert_eq!((modes.without_gnss, modes.navigating()), (7.0, 20.0));
        assert!(modes.has_seen(Mode::Inertial) && !modes.has_seen(Mode::Fault));
    }
}
