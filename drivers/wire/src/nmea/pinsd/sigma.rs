//! SIG: 1-sigma of the solution.
//!
//! ```text
//! $PINSD,SIG,hhmmss.ss,n,e,d,vn,ve,vd,r,p,h,z*hh
//!            1         2 3 4 5  6  7  8 9 10 11
//! 1      UTC
//! 2..4   position: north, east, down, m; from 10 km on empty
//! 5..7   velocity: north, east, down, m/s; from 1000 m/s on empty
//! 8..10  roll, pitch, heading, deg; beyond 180 deg empty
//! 11     heave, m; from 100 m on empty
//! ```
//! Three significant digits, but no more than 0.01 m of position and heave, 0.001 m/s and 0.001 deg.

use insd_base::SolutionSigma;

use super::{read_magnitude, significant};
use crate::nmea::civil::TimeOfDay;
use crate::nmea::fault::Fault;
use crate::nmea::fields::Fields;
use crate::nmea::line::Composer;

const POSITION: (u8, f64) = (2, 9999.0);
const VELOCITY: (u8, f64) = (3, 999.0);
const ANGLE: (u8, f64) = (3, 180.0);
const HEAVE: (u8, f64) = (2, 99.9);

/// 1-sigma of each part of the solution.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PinsdSigma {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// Position: north, east, down, m.
    pub position: [Option<f64>; 3],
    /// Velocity: north, east, down, m/s.
    pub velocity: [Option<f64>; 3],
    /// Roll, pitch, heading, rad.
    pub attitude: [Option<f64>; 3],
    /// Heave, m.
    pub heave: Option<f64>,
}

impl PinsdSigma {
    /// The word after the address.
    pub const NAME: &'static str = "SIG";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 81;

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

    pub(super) fn write_fields(&self, line: &mut Composer) {
        line.text(Self::NAME);
        line.time_of_day(self.time);
        let attitude = self.attitude.map(|angle| angle.map(f64::to_degrees));
        for (values, (decimals, limit)) in
            [(self.position, POSITION), (self.velocity, VELOCITY), (attitude, ANGLE)]
        {
            values.into_iter().for_each(|value| significant(line, value, decimals, limit));
        }
        significant(line, self.heave, HEAVE.0, HEAVE.1);
    }

    pub(super) fn read_fields(fields: &mut Fields<'_>) -> Result<Self, Fault> {
        let time = fields.time_of_day()?;
        let position = three(fields, POSITION.1)?;
        let velocity = three(fields, VELOCITY.1)?;
        let attitude = three(fields, ANGLE.1)?.map(|angle| angle.map(f64::to_radians));
        let heave = read_magnitude(fields, HEAVE.1)?;
        Ok(PinsdSigma { time, position, velocity, attitude, heave })
    }
}

fn three(fields: &mut Fields<'_>, limit: f64) -> Result<[Option<f64>; 3], Fault> {
    let mut next = || read_magnitude(fields, limit);
    Ok([next()?, next()?, next()?])
}
