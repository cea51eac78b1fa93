//! SIG: 1-sigma of the solution.

use insd_base::SolutionSigma;

use crate::nmea::civil::TimeOfDay;
use crate::nmea::kinds::{Clock, Decimal, Significant, Three};
use crate::nmea::table::sentence;

const METRES: Significant = Significant(Decimal::magnitude(2, 9999.0));
const METRES_PER_SECOND: Significant = Significant(Decimal::magnitude(3, 999.0));
const ANGLE: Significant = Significant(Decimal::magnitude(3, 180.0).degrees());
const HEAVE: Significant = Significant(Decimal::magnitude(2, 99.9));

sentence! {
    /// 1-sigma of each part of the solution.
    ///
    /// Three significant digits, but no more than 0.01 m of position and heave, 0.001 m/s and 0.001 deg. Empty
    /// are those of the position from 10 km on, of the velocity from 1000 m/s, of angles beyond 180 deg, of the
    /// heave from 100 m.
    part PinsdSigma "PINSD" "SIG", longest 81: Default;
    /// UTC.
    1 time: Option<TimeOfDay> = Clock(2);
    /// Position: north, east, down, m.
    2 position: [Option<f64>; 3] = Three(METRES);
    /// Velocity: north, east, down, m/s.
    5 velocity: [Option<f64>; 3] = Three(METRES_PER_SECOND);
    /// Roll, pitch, heading, rad.
    8 attitude: [Option<f64>; 3] = Three(ANGLE);
    /// Heave, m.
    11 heave: Option<f64> = HEAVE;
}

impl PinsdSigma {
    /// The sigmas of a solution and of the heave, m.
    #[must_use]
    pub fn of(time: Option<TimeOfDay>, sigma: &SolutionSigma, heave: Option<f64>) -> Self {
        PinsdSigma {
            time,
            position: <[f64; 3]>::from(sigma.position.0).map(Some),
            velocity: <[f64; 3]>::from(sigma.velocity.0).map(Some),
            attitude: [sigma.roll, sigma.pitch, sigma.heading].map(Some),
            heave,
        }
    }
}
