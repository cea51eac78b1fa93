//! IMU_SHORT and IMU_DATA: means of rate and specific force over the sampling interval.
//!
//! The maker calls the fields delta angle and delta velocity in some places; in both messages they
//! are in rad/s and m/s^2.

use super::{IMU_DATA, IMU_SHORT, device_time, put_vector, seal, vector};
use crate::binary::{BinaryFault, Reader, Writer, scaled};
use crate::imu::{ImuMotion, ImuReading};

/// Steps per m/s^2.
const ACCEL_SCALE: f64 = 1_048_576.0;
/// Steps per rad/s.
const GYRO_SCALE: f64 = 67_108_864.0;
/// Steps per rad/s when a rate is too high for the other scale (10 000 deg/s at full scale).
const GYRO_HIGH_SCALE: f64 = 12_304_174.0;
/// Highest rate on the usual scale, rad/s (about 1833 deg/s).
const GYRO_LIMIT: f64 = i32::MAX as f64 / GYRO_SCALE;
/// Steps per deg C.
const TEMPERATURE_SCALE: f64 = 256.0;

/// Bits of IMU_STATUS of which each must be set: communication (0), built-in tests of the whole, the
/// accelerometers and the gyros (1 to 7), accelerometers and gyros within their range (8, 9).
const GOOD: u16 = 0x03FF;
/// Bit of IMU_STATUS: the rates are on the high scale.
const HIGH_SCALE: u16 = 1 << 10;

/// IMU_SHORT, 32 bytes of scaled integers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuShort {
    /// Microseconds since power-up.
    pub time_stamp: u32,
    /// IMU_STATUS as on the wire. The writer sets bit 10 (high scale of the rates) by itself.
    pub status: u16,
    /// Specific force, m/s^2.
    pub accel: [f64; 3],
    /// Angular rate, rad/s.
    pub gyro: [f64; 3],
    /// Mean temperature of the sensors, deg C.
    pub temperature: f64,
}

/// IMU_DATA, 58 bytes of floats. Rates and forces stand in it twice; the first ones are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuData {
    /// Microseconds since power-up.
    pub time_stamp: u32,
    /// IMU_STATUS as on the wire.
    pub status: u16,
    /// Specific force, m/s^2.
    pub accel: [f64; 3],
    /// Angular rate, rad/s.
    pub gyro: [f64; 3],
    /// Mean temperature of the sensors, deg C.
    pub temperature: f64,
}

impl ImuShort {
    pub(super) fn parse(fields: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let time_stamp = fields.le_u32()?;
        let status = fields.le_u16()?;
        Ok(ImuShort {
            time_stamp,
            status,
            accel: integers(fields, ACCEL_SCALE)?,
            gyro: integers(fields, gyro_scale(status))?,
            temperature: f64::from(fields.le_i16()?) / TEMPERATURE_SCALE,
        })
    }

    /// The whole frame. Values beyond their range are saturated.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let is_high = self.gyro.iter().any(|rate| rate.abs() > GYRO_LIMIT);
        let status = self.status & !HIGH_SCALE | if is_high { HIGH_SCALE } else { 0 };
        let temperature = scaled(self.temperature, 1.0 / TEMPERATURE_SCALE);
        let mut fields = Writer::new();
        fields.le_u32(self.time_stamp).le_u16(status);
        put_integers(&mut fields, self.accel, ACCEL_SCALE);
        put_integers(&mut fields, self.gyro, gyro_scale(status));
        fields.le_i16(temperature.clamp(i16::MIN.into(), i16::MAX.into()) as i16);
        seal(IMU_SHORT, &fields)
    }

    /// As a sample.
    #[must_use]
    pub fn reading(&self) -> ImuReading {
        reading(self.time_stamp, self.status, self.temperature, (self.gyro, self.accel))
    }
}

impl ImuData {
    pub(super) fn parse(fields: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let data = ImuData {
            time_stamp: fields.le_u32()?,
            status: fields.le_u16()?,
            accel: vector(fields)?,
            gyro: vector(fields)?,
            temperature: fields.le_f32()?.into(),
        };
        let _accel_and_gyro_again = fields.take(24)?;
        Ok(data)
    }

    /// The whole frame.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut fields = Writer::new();
        fields.le_u32(self.time_stamp).le_u16(self.status);
        put_vector(&mut fields, self.accel);
        put_vector(&mut fields, self.gyro);
        fields.le_f32(self.temperature as f32);
        put_vector(&mut fields, self.accel);
        put_vector(&mut fields, self.gyro);
        seal(IMU_DATA, &fields)
    }

    /// As a sample.
    #[must_use]
    pub fn reading(&self) -> ImuReading {
        reading(self.time_stamp, self.status, self.temperature, (self.gyro, self.accel))
    }
}

fn reading(
    time_stamp: u32,
    status: u16,
    temperature: f64,
    (gyro, accel): ([f64; 3], [f64; 3]),
) -> ImuReading {
    let motion = ImuMotion::Rates { gyro, accel };
    ImuReading {
        device_time: Some(device_time(time_stamp)),
        temperature: Some(temperature).filter(|temperature| temperature.is_finite()),
        valid: status & GOOD == GOOD && motion.is_finite(),
        status: status.into(),
        ..ImuReading::bare(motion)
    }
}

fn gyro_scale(status: u16) -> f64 {
    if status & HIGH_SCALE == 0 { GYRO_SCALE } else { GYRO_HIGH_SCALE }
}

fn integers(fields: &mut Reader<'_>, scale: f64) -> Result<[f64; 3], BinaryFault> {
    let mut next = || Ok(f64::from(fields.le_i32()?) / scale);
    Ok([next()?, next()?, next()?])
}

fn put_integers(fields: &mut Writer, vector: [f64; 3], scale: f64) {
    for component in vector {
        let steps = scaled(component, 1.0 / scale);
        fields.le_i32(steps.clamp(i32::MIN.into(), i32::MAX.into()) as i32);
    }
}
