//! Aids, reasons and events in the words of a mariner.

use insd_base::{Event, Rejection};
use insd_vessel::words;

/// An aid's name for people: `gnss_position` is `GNSS position`.
#[must_use]
pub fn aid(name: &str) -> String {
    match name {
        "gnss_position" => "GNSS position".to_owned(),
        "gnss_velocity" => "GNSS velocity".to_owned(),
        "log_bottom" => "Log over ground".to_owned(),
        "log_water" => "Log in water".to_owned(),
        "sea_level" => "Sea level".to_owned(),
        "zero_velocity" => "At rest".to_owned(),
        other => capitalised(&other.replace('_', " ")),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// Why a measurement was not used.
#[must_use]
pub fn reason(reason: Rejection) -> &'static str {
    match reason {
        Rejection::ChiSquare => "disagrees",
        Rejection::DopTest => "jumped",
        Rejection::SourceSuspect => "suspect",
        Rejection::NoFix => "no fix",
        Rejection::OutOfRange => "impossible",
        Rejection::TooLate => "too late",
        Rejection::Duplicate => "repeated",
        Rejection::OutOfOrder => "out of order",
        Rejection::Frozen => "frozen",
        Rejection::Spike => "a spike",
        Rejection::NotUsable => "not usable yet",
        Rejection::RangesInUse => "ranges are used",
    }
}

/// An event as one line.
#[must_use]
pub fn event(event: &Event) -> String {
    match event {
        Event::ModeChanged { to, .. } => capitalised(words::mode(*to)),
        Event::Rejected { aid: name, reason: why, .. } => {
            format!("✗ {}: {}", aid(name), reason(*why))
        }
        Event::ImuGap { missing, .. } => format!("IMU gap of {missing:.2} s"),
        Event::ImuClock { step, .. } => format!("IMU clock stepped by {step:.2} s"),
        Event::LeftBerth { .. } => "Left the berth".to_owned(),
        Event::Resumed { gap, .. } => format!("Going on after {gap:.1} s"),
        Event::ResumeConfirmed { .. } => "Saved state confirmed".to_owned(),
        Event::ResumeDropped { reason, .. } => {
            format!("✗ Saved state: {}", reason.as_str().replace('_', " "))
        }
        Event::InstallationFound { finding, .. } => {
            format!("✗ Installation: {}", finding.as_str().replace('_', " "))
        }
        Event::Judged { stands, .. } => capitalised(&stands.to_string()),
        Event::ReceiverUsed { change, .. } => capitalised(&change.to_string()),
        Event::SatelliteJudged { satellite, is_excluded: true, .. } => {
            format!("✗ {satellite} is left out")
        }
        Event::SatelliteJudged { satellite, .. } => format!("{satellite} is used again"),
        Event::RtkJudged { turn, .. } => turn.to_string(),
        Event::CompassJudged { why_not: None, .. } => "Antennas tell the heading".to_owned(),
        Event::CompassJudged { why_not: Some(why), .. } => format!("✗ Antennas: {why}"),
        Event::RangingJudged { ranging, turn, .. } => {
            format!("Docking aid {}: {turn}", ranging + 1)
        }
        Event::Learnt { turn, .. } => capitalised(&turn.to_string()),
        Event::CameraJudged { turn, .. } => format!("Camera: {turn}"),
        Event::SourceChanged { to, .. } => format!("Best source {}", to.as_str()),
        Event::PositionReset { .. } => "Position set anew".to_owned(),
        Event::StoredStateUsed { .. } => "Stored heading confirmed".to_owned(),
        Event::StoredStateDropped { reason, .. } => {
            format!("✗ Stored heading: {}", reason.as_str().replace('_', " "))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_aid_without_a_name_of_its_own_is_still_readable() {
        assert_eq!(aid("reference_heading"), "Reference heading");
        assert_eq!(aid(""), "");
    }
}
