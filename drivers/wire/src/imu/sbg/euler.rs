//! EKF_EULER: attitude and heading by the device's own filter.

use super::{EKF_EULER, appended, device_time, put_appended, put_vector, seal, vector};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::imu::DeviceTime;

const ATTITUDE_VALID: u32 = 1 << 4;
const HEADING_VALID: u32 = 1 << 5;

/// EKF_EULER, 40 bytes (32 before release 5 of the protocol).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Euler {
    /// Microseconds since power-up.
    pub time_stamp: u32,
    /// Roll, pitch and yaw, rad: device axes to north-east-down in the order yaw-pitch-roll.
    pub angles: [f64; 3],
    /// 1-sigma of roll, pitch and yaw, rad.
    pub std: [f64; 3],
    /// SOLUTION_STATUS as on the wire.
    pub status: u32,
    /// Magnetic declination, rad, east positive.
    pub declination: Option<f64>,
    /// Magnetic inclination, rad, down positive.
    pub inclination: Option<f64>,
}

impl Euler {
    pub(super) fn parse(fields: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        Ok(Euler {
            time_stamp: fields.le_u32()?,
            angles: vector(fields)?,
            std: vector(fields)?,
            status: fields.le_u32()?,
            declination: appended(fields),
            inclination: appended(fields),
        })
    }

    /// The whole frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut fields = Writer::new();
        fields.le_u32(self.time_stamp);
        put_vector(&mut fields, self.angles);
        put_vector(&mut fields, self.std);
        fields.le_u32(self.status);
        put_appended(&mut fields, self.declination);
        put_appended(&mut fields, self.inclination);
        seal(EKF_EULER, &fields)
    }

    /// The device's clock at the instant.
    #[must_use]
    pub fn device_time(&self) -> DeviceTime {
        device_time(self.time_stamp)
    }

    /// Whether the device holds roll and pitch for reliable.
    #[must_use]
    pub fn is_attitude_valid(&self) -> bool {
        self.status & ATTITUDE_VALID != 0
    }

    /// Whether the device holds the heading for reliable.
    #[must_use]
    pub fn is_heading_valid(&self) -> bool {
        self.status & HEADING_VALID != 0
    }
}
