//! ALI: how the alignment gets on.

use insd_base::{AlignmentPhase, AlignmentStatus, Forecast};

use crate::nmea::civil::TimeOfDay;
use crate::nmea::kinds::{Clock, DIGIT, Decimal, Needed, Significant, Whole, letter};
use crate::nmea::mode::letters;
use crate::nmea::table::sentence;

const SIGMA: Significant = Significant(Decimal::magnitude(3, 180.0).degrees());
const MAX_SECONDS: u32 = 999_999;

/// Where the alignment stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdPhase {
    /// L: finding which way is down.
    Levelling,
    /// S: at the berth, several headings still possible.
    Searching,
    /// F: at the berth with one heading, which is growing better.
    Fine,
    /// M: under way, without a heading to steer by.
    InMotion,
    /// A: aligned.
    Aligned,
}

letters! {
    PinsdPhase { Levelling b'L', Searching b'S', Fine b'F', InMotion b'M', Aligned b'A' }
}

impl From<AlignmentPhase> for PinsdPhase {
    fn from(phase: AlignmentPhase) -> Self {
        match phase {
            AlignmentPhase::Levelling => PinsdPhase::Levelling,
            AlignmentPhase::Searching => PinsdPhase::Searching,
            AlignmentPhase::Fine => PinsdPhase::Fine,
            AlignmentPhase::InMotion => PinsdPhase::InMotion,
            AlignmentPhase::Aligned => PinsdPhase::Aligned,
        }
    }
}

sentence! {
    /// How the alignment gets on. Sigmas have three significant digits, but no more than 0.001 deg; beyond
    /// 180 deg they are empty.
    part PinsdAlignment "PINSD" "ALI", longest 54;
    /// UTC.
    1 time: Option<TimeOfDay> = Clock(2);
    /// Where it stands.
    2 phase: PinsdPhase = Needed(letter());
    /// Whether the ship is taken as lying at her berth.
    3 moored: bool = DIGIT;
    /// 1-sigma of the heading now, rad.
    4 sigma: Option<f64> = SIGMA;
    /// 1-sigma of the heading that is asked for here, rad.
    5 target: Option<f64> = SIGMA;
    /// Whole s until then: 0 if it is reached, none if unknown or out of reach.
    6 seconds_left: Option<u32> = Whole::of(1, MAX_SECONDS);
    /// 1-sigma of the heading that the gyros leave to a gyrocompass here, rad.
    7 gyrocompass: Option<f64> = SIGMA;
}

impl PinsdAlignment {
    /// What the aligner says of itself, at a UTC.
    #[must_use]
    pub fn of(time: Option<TimeOfDay>, status: &AlignmentStatus) -> Self {
        let seconds_left = match status.ready {
            Forecast::Reached { .. } => Some(0),
            Forecast::Expected { at, .. } => {
                let left = (at - status.time).as_seconds().ceil().max(0.0);
                (left <= f64::from(MAX_SECONDS)).then_some(left as u32)
            }
            Forecast::Unreachable { .. } | Forecast::Unknown { .. } => None,
        };
        PinsdAlignment {
            time,
            phase: status.phase.into(),
            moored: status.moored,
            sigma: status.sigma.map(|sigma| sigma.heading),
            target: status.target,
            seconds_left,
            gyrocompass: status.gyrocompass,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::units::DEG;
    use insd_base::{AttitudeSigma, Lack, Limiting, Time};

    fn status(ready: Forecast) -> AlignmentStatus {
        AlignmentStatus {
            time: Time::from_seconds(100.0),
            phase: AlignmentPhase::Fine,
            moored: true,
            sigma: Some(AttitudeSigma { roll: 0.0, pitch: 0.0, heading: 0.5 * DEG }),
            target: Some(0.1 * DEG),
            gyrocompass: Some(0.04 * DEG),
            ready,
            sea: None,
            fit: None,
            shifts: 0,
        }
    }

    #[test]
    fn the_time_left_is_known_only_if_there_is_a_forecast() {
        let left = |ready: Forecast| PinsdAlignment::of(None, &status(ready)).seconds_left;
        let limiting = Limiting::Sea;
        let at = Time::from_seconds(260.5);
        assert_eq!(left(Forecast::Expected { at, limiting }), Some(161));
        assert_eq!(left(Forecast::Reached { at: Time::from_seconds(90.0) }), Some(0));
        assert_eq!(left(Forecast::Unreachable { best: 1.0, limiting }), None);
        assert_eq!(left(Forecast::Unknown { lacks: Lack::Time }), None);
        let late = Forecast::Expected { at: Time::from_seconds(9e6), limiting };
        assert_eq!(left(late), None);
    }

    #[test]
    fn a_status_of_the_aligner_becomes_a_sentence() {
        let at = Time::from_seconds(260.0);
        let ready = Forecast::Expected { at, limiting: Limiting::Sea };
        let alignment = PinsdAlignment::of(None, &status(ready));
        let line = super::super::Pinsd::Alignment(alignment).write();
        let text = "$PINSD,ALI,,F,1,0.500,0.100,160,0.040*";
        assert!(line.as_str().starts_with(text), "{line:?}");
    }
}
