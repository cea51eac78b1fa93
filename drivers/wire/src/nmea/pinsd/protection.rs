//! PRO: how far wrong the position may be.

use crate::nmea::civil::TimeOfDay;
use crate::nmea::kinds::{Clock, Decimal, Field, Needed, letter};
use crate::nmea::mode::letters;
use crate::nmea::table::sentence;

const METRES: Decimal = Decimal::magnitude(2, 99_999.99);
/// A digit but 0.
const EXPONENT: Field<u8> = Field {
    write: |line, exponent| line.whole(Some(exponent.into()).filter(|one| *one > 0), 1, 9),
    read: |text| text.parse().ok().filter(|one| (1..=9).contains(one) && text.len() == 1),
};

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

sentence! {
    /// How far wrong the position may be.
    part PinsdProtection "PINSD" "PRO", longest 65: Default;
    /// UTC.
    1 time: Option<TimeOfDay> = Clock(2);
    /// Radius of the circle in which the ship is with 95 %, m.
    2 radius_95: Option<f64> = METRES;
    /// Horizontal protection level, m: the error is below it but for the probability of field 5.
    3 horizontal: Option<f64> = METRES;
    /// Vertical protection level, m.
    4 vertical: Option<f64> = METRES;
    /// The probability that an error exceeds its level is 10 to minus this, 1 to 9.
    5 exponent: Option<u8> = EXPONENT;
    /// Alert limit of the horizontal error, m; unknown if none is set.
    6 alert_limit: Option<f64> = METRES;
    /// Whether the horizontal level is below the limit.
    7 state: ProtectionState = Needed(letter());
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
