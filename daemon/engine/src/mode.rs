//! The mode and why it changes.

use insd_base::{Event, Mode, ModeReason, Time};

use crate::ship::Ship;

/// What of the ship a reason may lie in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Facts {
    one_heading: bool,
    aligned: bool,
    moored: bool,
}

impl Facts {
    pub(crate) fn of(ship: &Ship) -> Self {
        Facts {
            one_heading: ship.has_one_heading(),
            aligned: ship.is_steerable(),
            moored: ship.is_moored(),
        }
    }
}

/// The mode that was told last, and what was known then.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Machine {
    mode: Option<Mode>,
    facts: Facts,
    since: Time,
}

impl Machine {
    /// The mode.
    pub(crate) fn mode(&self) -> Mode {
        self.mode.unwrap_or(Mode::Standby)
    }

    /// Whether any mode was ever told.
    pub(crate) fn has_begun(&self) -> bool {
        self.mode.is_some()
    }

    /// Takes the mode as it is now: if it is another one, that is told with its reason, which is the
    /// given one or lies in the facts. What was told earlier is never later.
    pub(crate) fn enter(
        &mut self,
        time: Time,
        to: Mode,
        facts: Facts,
        why: Option<ModeReason>,
    ) -> Option<Event> {
        let before = std::mem::replace(&mut self.facts, facts);
        let from = self.mode;
        if from == Some(to) {
            return None;
        }
        self.mode = Some(to);
        self.since = if from.is_some() { time.max(self.since) } else { time };
        let why = why.unwrap_or_else(|| reason(from.unwrap_or(Mode::Standby), to, before, facts));
        Some(Event::ModeChanged { time: self.since, from, to, why })
    }
}

/// Why a mode follows another.
fn reason(from: Mode, to: Mode, before: Facts, now: Facts) -> ModeReason {
    let found = !before.one_heading && now.one_heading;
    let settled = !before.aligned && now.aligned;
    match (from, to) {
        (_, Mode::Fault) => ModeReason::NotFinite,
        (_, Mode::Standby) => ModeReason::ImuSilent,
        (Mode::Standby, _) => ModeReason::ImuHeard,
        (Mode::Fault, _) | (_, Mode::CoarseAlignment) => ModeReason::StartedOver,
        (Mode::CoarseAlignment, _) => ModeReason::Level,
        (Mode::FineAlignment, _) if before.moored && !now.moored => ModeReason::LeftBerth,
        (Mode::FineAlignment, _) => ModeReason::HeadingSettled,
        (_, Mode::FineAlignment) => ModeReason::HeadingUnsure,
        (Mode::InMotionAlignment, _) if settled => ModeReason::HeadingSettled,
        (Mode::InMotionAlignment, _) if found => ModeReason::HeadingFound,
        (_, Mode::Aided | Mode::InMotionAlignment) => ModeReason::GnssInUse,
        (Mode::Aided | Mode::InMotionAlignment, _) => ModeReason::GnssLost,
        (_, Mode::DeadReckoning) => ModeReason::LogInUse,
        (_, Mode::Inertial) => ModeReason::AidsLost,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_change_has_its_own_reason() {
        let nothing = Facts::default();
        let found = Facts { one_heading: true, ..nothing };
        let aligned = Facts { aligned: true, ..found };
        let moored = Facts { moored: true, ..found };
        use Mode::{
            Aided, CoarseAlignment, DeadReckoning, Fault, FineAlignment, InMotionAlignment,
            Inertial, Standby,
        };
        for (from, to, before, now, why) in [
            (Standby, CoarseAlignment, nothing, nothing, "imu_heard"),
            (Standby, Aided, nothing, aligned, "imu_heard"),
            (Aided, Standby, aligned, aligned, "imu_silent"),
            (CoarseAlignment, InMotionAlignment, nothing, nothing, "level"),
            (InMotionAlignment, Aided, found, aligned, "heading_settled"),
            (InMotionAlignment, DeadReckoning, nothing, found, "heading_found"),
            (InMotionAlignment, DeadReckoning, found, found, "gnss_lost"),
            (DeadReckoning, InMotionAlignment, found, found, "gnss_in_use"),
            (FineAlignment, Aided, moored, Facts { moored: true, ..aligned }, "heading_settled"),
            (FineAlignment, InMotionAlignment, moored, found, "left_berth"),
            (Aided, FineAlignment, aligned, aligned, "heading_unsure"),
            (Aided, Inertial, aligned, aligned, "gnss_lost"),
            (Inertial, DeadReckoning, aligned, aligned, "log_in_use"),
            (DeadReckoning, Inertial, aligned, aligned, "aids_lost"),
            (DeadReckoning, Aided, aligned, aligned, "gnss_in_use"),
            (Aided, Fault, aligned, aligned, "not_finite"),
            (Fault, CoarseAlignment, aligned, nothing, "started_over"),
        ] {
            assert_eq!(reason(from, to, before, now).as_str(), why, "{from:?} -> {to:?}");
        }
    }

    #[test]
    fn a_mode_that_stays_is_not_told_and_time_does_not_go_back() {
        let mut machine = Machine::default();
        let at = Time::from_seconds;
        assert_eq!(machine.mode(), Mode::Standby);
        let first = machine.enter(at(-1.0), Mode::CoarseAlignment, Facts::default(), None);
        let (to, why) = (Mode::CoarseAlignment, ModeReason::ImuHeard);
        assert_eq!(first, Some(Event::ModeChanged { time: at(-1.0), from: None, to, why }));
        assert_eq!(machine.enter(at(5.0), to, Facts::default(), None), None);
        let _ = machine.enter(at(9.0), Mode::Standby, Facts::default(), None);
        let late = machine.enter(at(7.0), to, Facts::default(), None);
        let from = Some(Mode::Standby);
        assert_eq!(late, Some(Event::ModeChanged { time: at(9.0), from, to, why }));
    }
}
