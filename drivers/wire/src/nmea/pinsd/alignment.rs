//! ALI: how the alignment gets on.
//!
//! ```text
//! $PINSD,ALI,hhmmss.ss,p,b,s,t,x,g*hh
//!            1         2 3 4 5 6 7
//! 1 UTC
//! 2 phase: L levelling, S searching for the heading at the berth, F fine alignment at the berth, M in
//!   motion, A aligned
//! 3 1 if the ship is taken as lying at her berth, else 0
//! 4 1-sigma of the heading now, deg
//! 5 1-sigma of the heading that is asked for here, deg
//! 6 whole seconds until then; 0 if it is reached, empty if unknown or out of reach
//! 7 1-sigma of the heading that the gyros leave to a gyrocompass here, deg
//! ```
//! Three significant digits, but no more than 0.001 deg. Beyond 180 deg a sigma is empty.

use insd_base::{AlignmentPhase, AlignmentStatus, Forecast};

use super::{flag, read_flag, read_letter, read_magnitude, significant};
use crate::nmea::civil::TimeOfDay;
use crate::nmea::fault::Fault;
use crate::nmea::fields::Fields;
use crate::nmea::line::Composer;
use crate::nmea::mode::letters;

const MAX_DEGREES: f64 = 180.0;
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

/// How the alignment gets on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinsdAlignment {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// Where it stands.
    pub phase: PinsdPhase,
    /// Whether the ship is taken as lying at her berth.
    pub moored: bool,
    /// 1-sigma of the heading now, rad.
    pub sigma: Option<f64>,
    /// 1-sigma of the heading that is asked for here, rad.
    pub target: Option<f64>,
    /// Whole s until then: 0 if it is reached, none if unknown or out of reach.
    pub seconds_left: Option<u32>,
    /// 1-sigma of the heading that the gyros leave to a gyrocompass here, rad.
    pub gyrocompass: Option<f64>,
}

impl PinsdAlignment {
    /// The word after the address.
    pub const NAME: &'static str = "ALI";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 54;

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

    pub(super) fn write_fields(&self, line: &mut Composer) {
        let sigma = |line: &mut Composer, sigma: Option<f64>| {
            significant(line, sigma.map(f64::to_degrees), 3, MAX_DEGREES);
        };
        line.text(Self::NAME);
        line.time_of_day(self.time);
        line.letter(self.phase.letter());
        flag(line, self.moored);
        sigma(line, self.sigma);
        sigma(line, self.target);
        line.whole(self.seconds_left, 1, MAX_SECONDS);
        sigma(line, self.gyrocompass);
    }

    pub(super) fn read_fields(fields: &mut Fields<'_>) -> Result<Self, Fault> {
        let sigma = |fields: &mut Fields<'_>| {
            read_magnitude(fields, MAX_DEGREES).map(|sigma| sigma.map(f64::to_radians))
        };
        Ok(PinsdAlignment {
            time: fields.time_of_day()?,
            phase: read_letter(fields, PinsdPhase::from_letter)?,
            moored: read_flag(fields)?,
            sigma: sigma(fields)?,
            target: sigma(fields)?,
            seconds_left: fields.whole(MAX_SECONDS)?,
            gyrocompass: sigma(fields)?,
        })
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
