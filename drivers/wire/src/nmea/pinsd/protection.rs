//! PRO: how far wrong the position may be.
//!
//! ```text
//! $PINSD,PRO,hhmmss.ss,x.xx,x.xx,x.xx,e,x.xx,a*hh
//!            1         2    3    4    5 6    7
//! 1 UTC
//! 2 radius of the circle in which the ship is with 95 %, m
//! 3 horizontal protection level, m: the error is below it but for the probability of field 5
//! 4 vertical protection level, m
//! 5 exponent of that probability: 5 stands for 1e-5
//! 6 alert limit of the horizontal error, m; empty if none is set
//! 7 A: field 3 is below field 6; V: it is not; N: not known, or no limit is set
//! ```

use super::{read_letter, read_magnitude};
use crate::nmea::civil::TimeOfDay;
use crate::nmea::decimal::Form;
use crate::nmea::fault::Fault;
use crate::nmea::fields::Fields;
use crate::nmea::line::Composer;
use crate::nmea::mode::letters;

const METRES: Form = Form { decimals: 2, width: 1, limit: 99_999.99 };

/// Whether the protection level is below the alert limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum ProtectionState {
    /// A: it is.
    Below,
    /// V: it is not.
    Above,
    /// N: level or limit is not known.
    #[default]
    Unknown,
}

letters! {
    ProtectionState { Below b'A', Above b'V', Unknown b'N' }
}

impl ProtectionState {
    /// The state of a level against a limit, both m.
    #[must_use]
    pub fn of(level: Option<f64>, limit: Option<f64>) -> Self {
        match (level, limit) {
            (Some(level), Some(limit)) if level < limit => ProtectionState::Below,
            (Some(_), Some(_)) => ProtectionState::Above,
            _ => ProtectionState::Unknown,
        }
    }
}

/// How far wrong the position may be.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PinsdProtection {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// Radius of the circle of 95 %, m.
    pub radius_95: Option<f64>,
    /// Horizontal protection level, m.
    pub horizontal: Option<f64>,
    /// Vertical protection level, m.
    pub vertical: Option<f64>,
    /// The probability that an error exceeds its level is 10 to minus this, 1 to 9.
    pub exponent: Option<u8>,
    /// Alert limit of the horizontal error, m.
    pub alert_limit: Option<f64>,
    /// Whether the horizontal level is below the limit.
    pub state: ProtectionState,
}

impl PinsdProtection {
    /// The word after the address.
    pub const NAME: &'static str = "PRO";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 65;

    pub(super) fn write_fields(&self, line: &mut Composer) {
        line.text(Self::NAME);
        line.time_of_day(self.time);
        for metres in [self.radius_95, self.horizontal, self.vertical] {
            line.magnitude(metres, METRES);
        }
        line.whole(self.exponent.filter(|exponent| *exponent > 0).map(u32::from), 1, 9);
        line.magnitude(self.alert_limit, METRES);
        line.letter(self.state.letter());
    }

    pub(super) fn read_fields(fields: &mut Fields<'_>) -> Result<Self, Fault> {
        let metres = |fields: &mut Fields<'_>| read_magnitude(fields, METRES.limit);
        Ok(PinsdProtection {
            time: fields.time_of_day()?,
            radius_95: metres(fields)?,
            horizontal: metres(fields)?,
            vertical: metres(fields)?,
            exponent: fields.convert(|text| match text.as_bytes() {
                [digit @ b'1'..=b'9'] => Some(digit - b'0'),
                _ => None,
            })?,
            alert_limit: metres(fields)?,
            state: read_letter(fields, ProtectionState::from_letter)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_good_only_below_a_limit_that_is_known() {
        assert_eq!(ProtectionState::of(Some(4.9), Some(5.0)), ProtectionState::Below);
        assert_eq!(ProtectionState::of(Some(5.0), Some(5.0)), ProtectionState::Above);
        assert_eq!(ProtectionState::of(Some(f64::NAN), Some(5.0)), ProtectionState::Above);
        assert_eq!(ProtectionState::of(None, Some(5.0)), ProtectionState::Unknown);
        assert_eq!(ProtectionState::of(Some(4.9), None), ProtectionState::Unknown);
    }
}
