//! What a device is set to send, and the datagram that tells it.

use insd_base::units::DEG;

use super::{CONFIGURATION, CONFIGURATION_LENGTH, crc, id_of, is_sound};
use crate::binary::{BinaryFault, Writer, scaled};
use crate::imu::ImuMotion;

/// Standard gravity, m/s^2.
const G: f64 = 9.806_65;
/// Radians per second of the least bit of a rate, radians of that of an angle.
const RATE: f64 = DEG / 16_384.0;
const ANGLE: f64 = DEG / 2_097_152.0;

/// What the counts of a normal datagram mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StimFormat {
    /// Gyroscopes: angular rate or angle.
    pub gyro: StimKind,
    /// Accelerometers: acceleration or velocity.
    pub accel: StimKind,
    /// Range of the accelerometers.
    pub range: StimRange,
    /// Time between two samples, s, if it is known. Needed only if one of gyroscopes and
    /// accelerometers sends differences and the other rates.
    pub interval: Option<f64>,
}

/// How a quantity is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StimKind {
    /// Rate or acceleration at the sample, or its mean since the last.
    Rate,
    /// Angle or velocity since the last sample.
    Increment,
    /// Angle or velocity since the start of the device, which is not made a reading of.
    Integrated,
}

/// Range of the accelerometers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StimRange {
    /// 2 g.
    G2,
    /// 5 g.
    G5,
    /// 10 g.
    G10,
    /// 30 g.
    G30,
    /// 80 g.
    G80,
}

/// The configuration datagram as far as it is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StimConfiguration {
    /// Revision letter of the device.
    pub revision: u8,
    /// Version of its firmware.
    pub firmware: u8,
    /// What the counts mean. The interval is that of the sample rate; at external trigger it is not
    /// known.
    pub format: StimFormat,
    /// Groups of the normal datagram: acceleration, inclination, temperatures, AUX, PPS.
    pub groups: [bool; 5],
    /// Whether CR LF follows normal datagrams.
    pub line_ends: bool,
}

/// Sample rates by code, Hz; the next code is external trigger.
const SAMPLE_RATES: [f64; 5] = [125.0, 250.0, 500.0, 1000.0, 2000.0];

/// Bit of byte 14 that says that the further input is PPS.
const PPS: u8 = 1 << 3;

/// Codes of the ranges.
const RANGES: [(u8, StimRange); 5] = [
    (0, StimRange::G10),
    (2, StimRange::G2),
    (3, StimRange::G5),
    (4, StimRange::G30),
    (6, StimRange::G80),
];

impl StimRange {
    /// m/s^2 of the least bit of an acceleration; the same number of g in m/s, divided by eight, is
    /// that of a velocity.
    fn unit(self, kind: StimKind) -> f64 {
        let bits = match self {
            StimRange::G2 => 21,
            StimRange::G5 => 20,
            StimRange::G10 => 19,
            StimRange::G30 => 18,
            StimRange::G80 => 16,
        };
        let unit = 0.5_f64.powi(bits);
        if kind == StimKind::Rate { G * unit } else { unit / 8.0 }
    }
}

impl StimFormat {
    /// Counts of gyroscopes and accelerometers for a motion, as a device with this format sends them;
    /// `None` if the interval is needed and not known.
    #[must_use]
    pub fn counts(&self, motion: &ImuMotion) -> Option<([i32; 3], [i32; 3])> {
        let (rotation, linear, differences) = match motion {
            ImuMotion::Rates { gyro, accel } => (gyro, accel, false),
            ImuMotion::Increments { delta_theta, delta_velocity } => {
                (delta_theta, delta_velocity, true)
            }
        };
        let counts = |values: &[f64; 3], unit: f64, kind: StimKind| {
            let unit = unit * self.step(kind != StimKind::Rate, differences)?;
            let limit = 1 << 23;
            Some(values.map(|value| scaled(value, unit).clamp(-limit, limit - 1) as i32))
        };
        Some((
            counts(rotation, self.gyro_unit(), self.gyro)?,
            counts(linear, self.range.unit(self.accel), self.accel)?,
        ))
    }

    /// The motion of some counts; differences if one of both sensors sends differences.
    pub(super) fn motion(&self, rotation: [i32; 3], linear: [i32; 3]) -> Option<ImuMotion> {
        if self.gyro == StimKind::Integrated || self.accel == StimKind::Integrated {
            return None;
        }
        let (gyro, accel) = (self.gyro == StimKind::Increment, self.accel == StimKind::Increment);
        let differences = gyro || accel;
        let gyro_unit = self.gyro_unit() * self.step(gyro, differences)?;
        let accel_unit = self.range.unit(self.accel) * self.step(accel, differences)?;
        let rotation = rotation.map(|count| f64::from(count) * gyro_unit);
        let linear = linear.map(|count| f64::from(count) * accel_unit);
        Some(if differences {
            ImuMotion::Increments { delta_theta: rotation, delta_velocity: linear }
        } else {
            ImuMotion::Rates { gyro: rotation, accel: linear }
        })
    }

    fn gyro_unit(&self) -> f64 {
        if self.gyro == StimKind::Rate { RATE } else { ANGLE }
    }

    /// What a value of the wire is multiplied by to become a difference or a rate.
    fn step(&self, wire_differences: bool, differences: bool) -> Option<f64> {
        match (wire_differences, differences) {
            (false, true) => self.interval,
            (true, false) => self.interval.map(|interval| 1.0 / interval),
            _ => Some(1.0),
        }
    }
}

impl StimKind {
    /// By the low two bits of the gyroscopes' code: at the sample, difference, mean, since the start.
    /// A higher bit says that they are delayed to match the accelerometers.
    fn of_gyro(code: u8) -> Self {
        match code & 3 {
            1 => StimKind::Increment,
            3 => StimKind::Integrated,
            _ => StimKind::Rate,
        }
    }

    /// By the accelerometers' code, which has two for velocity since the start.
    fn of_accel(code: u8) -> Option<Self> {
        match code & 0x0F {
            0 | 2 => Some(StimKind::Rate),
            1 => Some(StimKind::Increment),
            3 | 4 => Some(StimKind::Integrated),
            _ => None,
        }
    }

    fn code(self) -> u8 {
        match self {
            StimKind::Rate => 0,
            StimKind::Increment => 1,
            StimKind::Integrated => 3,
        }
    }
}

impl StimConfiguration {
    /// Reads the configuration datagram.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if length or CRC are wrong, [`BinaryFault::OtherMessage`] for other datagrams,
    /// [`BinaryFault::Range`] for a code that is not known. All axes are taken to
    /// have the range of the first.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        if !is_sound(frame) {
            return Err(BinaryFault::Frame);
        }
        let at = |index: usize| frame.get(index).copied().unwrap_or_default();
        if !CONFIGURATION.contains(&at(0)) || frame.len() != CONFIGURATION_LENGTH {
            return Err(BinaryFault::OtherMessage);
        }
        let rate = usize::from(at(3) >> 5);
        let interval = match SAMPLE_RATES.get(rate) {
            Some(rate) => Some(1.0 / rate),
            None if rate == SAMPLE_RATES.len() => None,
            None => return Err(BinaryFault::Range { field: "sample rate" }),
        };
        let range = RANGES.iter().find(|(code, _)| *code == at(17) >> 4);
        let (_, range) =
            range.ok_or(BinaryFault::Range { field: "range of the accelerometers" })?;
        let accel = StimKind::of_accel(at(8));
        let accel = accel.ok_or(BinaryFault::Range { field: "unit of the accelerometers" })?;
        let [acceleration, inclination, temperatures, input] =
            [1, 2, 3, 4].map(|bit| at(3) >> bit & 1 == 1);
        let pps = input && at(14) & PPS != 0;
        let groups = [acceleration, inclination, temperatures, input && !pps, pps];
        Ok(StimConfiguration {
            revision: at(1),
            firmware: at(2),
            format: StimFormat { gyro: StimKind::of_gyro(at(5)), accel, range: *range, interval },
            groups,
            line_ends: at(3) & 1 == 1,
        })
    }

    /// Writes the configuration datagram; what is not among the fields is zero.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let trigger = SAMPLE_RATES.len();
        let rate = self.format.interval.and_then(|interval| {
            SAMPLE_RATES.iter().position(|rate| (rate * interval - 1.0).abs() < 0.1)
        });
        let [acceleration, inclination, temperatures, aux, pps] = self.groups;
        let groups = id_of([acceleration, inclination, temperatures, aux || pps, false]) & 0x0F;
        let contents =
            (rate.unwrap_or(trigger) as u8) << 5 | groups << 1 | u8::from(self.line_ends);
        let code = RANGES.iter().find(|(_, range)| *range == self.format.range);
        let mut body = [0; CONFIGURATION_LENGTH - 4];
        body[0] = CONFIGURATION[usize::from(self.line_ends)];
        (body[1], body[2], body[3]) = (self.revision, self.firmware, contents);
        (body[5], body[8]) = (self.format.gyro.code(), self.format.accel.code());
        body[14] = if pps { PPS } else { 0 };
        body[17] = code.map_or(0, |(code, _)| code << 4);
        let mut frame = Writer::new();
        frame.put(&body).be_u32(crc(&body));
        frame.into_bytes()
    }
}
