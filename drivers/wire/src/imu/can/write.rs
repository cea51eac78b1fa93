//! From samples to frames, for simulators and tests.

use insd_base::can::CanFrame;

use super::bits;
use super::layout::{ACCEL, ANGLE, CanLayout, Field, FrameLayout, RATE, TURN, UTC, VELOCITY, What};
use crate::imu::rotation::quaternion_of;
use crate::imu::{ImuMotion, ImuReading};
use crate::nmea::CivilTime;

/// Bits of the longest mantissa of a signed number in a frame with an exponent.
const MANTISSA: f64 = 15.0;

impl CanLayout {
    /// The frames of a sample, in the order of the table. What the sample does not tell is left out
    /// with its frame if that is optional, and zero otherwise. Values beyond the range of a field are
    /// saturated. `interval`: time from sample to sample, s.
    #[must_use]
    pub fn write(&self, reading: &ImuReading, interval: f64) -> Vec<CanFrame> {
        let told = |frame: &&FrameLayout| {
            let known = |field: &Field| value(field.what, reading, interval).is_some();
            !frame.optional || frame.fields.iter().any(known)
        };
        let write = |frame: &FrameLayout| frame.write(reading, interval);
        self.frames.iter().filter(told).filter_map(write).collect()
    }
}

impl FrameLayout {
    fn write(&self, reading: &ImuReading, interval: f64) -> Option<CanFrame> {
        let mut data = [0; 8];
        let exponents = self.fields.iter().filter_map(|field| field.exponent);
        for start in exponents {
            let field = Field::new(What::Counter, start, 8);
            bits::put(&mut data, &field, self.exponent(start, reading, interval));
        }
        for field in &self.fields {
            let number = match field.what {
                What::Time => reading.device_time.map_or(0, |time| time.ticks.value),
                What::Counter => reading.counter.map_or(0, |counter| counter.value),
                What::Status => reading.status.into(),
                what => {
                    let value = value(what, reading, interval).unwrap_or(0.0);
                    let power =
                        field.exponent.map_or(0, |start| super::group::exponent(&data, start));
                    let scaled = value * f64::from(power).exp2();
                    bits::saturated((scaled - field.offset) / field.scale, field)
                }
            };
            bits::put(&mut data, field, number);
        }
        CanFrame::new(self.can_id()?, data.get(..self.length())?)
    }

    /// The exponent with which the largest of the numbers that share it just fits 16 bits.
    fn exponent(&self, start: u8, reading: &ImuReading, interval: f64) -> u64 {
        let sharing = self.fields.iter().filter(|field| field.exponent == Some(start));
        let values = sharing.filter_map(|field| {
            value(field.what, reading, interval).map(|value| (value / field.scale).abs())
        });
        let largest = values.fold(1e-6, f64::max);
        (MANTISSA - largest.log2().floor() - 1.0).clamp(0.0, 31.0) as u64
    }
}

/// What a sample says of a part; `None` if it says nothing.
fn value(what: What, reading: &ImuReading, interval: f64) -> Option<f64> {
    let (gyro, theta, accel, velocity) = match reading.motion {
        ImuMotion::Rates { gyro, accel } => {
            (gyro, gyro.map(|own| own * interval), accel, accel.map(|own| own * interval))
        }
        ImuMotion::Increments { delta_theta, delta_velocity } => {
            let over = |own: [f64; 3]| own.map(|own| own / interval);
            (over(delta_theta), delta_theta, over(delta_velocity), delta_velocity)
        }
    };
    let part = |whole: &[What], values: &[f64]| {
        whole.iter().position(|own| *own == what).and_then(|index| values.get(index).copied())
    };
    match what {
        What::Time => reading.device_time.map(|time| time.ticks.value as f64),
        What::Counter => reading.counter.map(|counter| counter.value as f64),
        What::Temperature => reading.temperature,
        What::Status => Some(reading.status.into()),
        _ => part(&RATE, &gyro)
            .or_else(|| part(&ANGLE, &theta))
            .or_else(|| part(&TURN, &quaternion_of(theta)))
            .or_else(|| part(&ACCEL, &accel))
            .or_else(|| part(&VELOCITY, &velocity))
            .or_else(|| part(&UTC, &parts_of_utc(reading)?)),
    }
}

fn parts_of_utc(reading: &ImuReading) -> Option<[f64; 7]> {
    let CivilTime { date, time } = CivilTime::from_utc(reading.utc?)?;
    Some([
        date.year.into(),
        date.month.into(),
        date.day.into(),
        time.hour.into(),
        time.minute.into(),
        time.second.into(),
        f64::from(time.nanosecond) * 1e-9,
    ])
}
