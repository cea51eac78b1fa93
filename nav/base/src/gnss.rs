//! What a GNSS receiver says of itself.

use crate::frames::{Body, Geodetic, Ned};
use crate::time::Time;

/// The receiver's own word on its fix, as in field 6 of an NMEA GGA sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum FixQuality {
    /// No fix (0).
    #[default]
    Invalid,
    /// Autonomous (1).
    Autonomous,
    /// Differential or SBAS (2).
    Differential,
    /// Precise positioning service (3).
    Precise,
    /// Real-time kinematic with fixed ambiguities (4).
    RtkFixed,
    /// Real-time kinematic with float ambiguities (5).
    RtkFloat,
    /// Dead reckoning of the receiver (6): not an independent fix.
    Estimated,
    /// Typed in by hand (7): not a measurement.
    Manual,
    /// A simulator (8), accepted as autonomous.
    Simulated,
}

impl FixQuality {
    /// The quality of a GGA digit; `None` for digits the sentence does not define.
    #[must_use]
    pub fn from_gga(digit: u8) -> Option<Self> {
        Some(match digit {
            0 => Self::Invalid,
            1 => Self::Autonomous,
            2 => Self::Differential,
            3 => Self::Precise,
            4 => Self::RtkFixed,
            5 => Self::RtkFloat,
            6 => Self::Estimated,
            7 => Self::Manual,
            8 => Self::Simulated,
            _ => return None,
        })
    }

    /// The digit of field 6 of a GGA sentence.
    #[must_use]
    pub fn as_gga(self) -> u8 {
        self as u8
    }

    /// Whether the fix comes from satellites, so that a filter may use it.
    #[must_use]
    pub fn is_measured(self) -> bool {
        !matches!(self, Self::Invalid | Self::Estimated | Self::Manual)
    }
}

/// Position and velocity of the GNSS antenna; whatever is not available is `None`.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct GnssFix {
    /// Time of validity.
    pub time: Time,
    /// Position of the antenna.
    pub position: Option<Geodetic>,
    /// Velocity of the antenna over the Earth, m/s.
    pub velocity: Option<Ned>,
    /// 1-sigma of the position, m, as claimed by the receiver; infinite for the down component alone
    /// where it tells no height (RMC).
    pub position_std: Option<Ned>,
    /// 1-sigma of the velocity, m/s, as claimed by the receiver; infinite for the down component alone
    /// where it does not tell it (VTG).
    pub velocity_std: Option<Ned>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Satellites used.
    pub satellites: Option<u16>,
    /// Fix quality.
    pub quality: FixQuality,
    /// Lever arm from the IMU to this receiver's antenna, body axes, m; `None`: that of the ship, or of
    /// the one that was heard before.
    pub lever: Option<Body>,
    /// By how much its time of validity was set back because the receiver tags its epochs late, s.
    pub redated: f64,
    /// Place of the receiver among those of the ship: 0 is the one to be used, the others are compared with what is
    /// made of it, in this order.
    pub rank: u8,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_gga_digit_comes_back() {
        for digit in 0..=8 {
            assert_eq!(FixQuality::from_gga(digit).unwrap().as_gga(), digit);
        }
        assert_eq!(FixQuality::from_gga(9), None);
    }
}
