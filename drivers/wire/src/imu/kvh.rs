//! KVH 1725, 1750 and 1775: binary formats A, B and C.
//!
//! ```text
//!            A (36 bytes)   B (40 bytes)   C (38 bytes)
//! header     FE 81 FF 55    FE 81 FF 56    FE 81 FF 57
//! rotation   3 x f32        3 x f32        3 x f32
//! linear     3 x f32        3 x f32        3 x f32
//!                           time u32, us   slow f32
//! status     u8             u8             u8
//! sequence   u8             u8             u8, 0 to 127
//!            temperature i16               -
//! CRC-32     poly 04C11DB7, init FFFFFFFF, not reflected (CRC-32/MPEG-2), over all before it
//! ```
//!
//! All numbers are big endian. The slow number of format C is by sequence modulo 4 the temperature,
//! then the magnetic field along x, y, z. Whether rotation is a rate or an angle and linear an
//! acceleration or a velocity, and their units, is set in the device and cannot be seen in the stream:
//! a [`KvhFormat`] says so. Axes are those of the device's label (or of its `=AXES` matrix), right
//! handed; an axis that points up at rest reads +1 g.
//!
//! Sources: KVH 1775 IMU manual (56-0298 rev. B, tables 5-1 to 5-9, commands `=LINFMT`, `=LINUNITS`,
//! `=ROTFMT`, `=ROTUNITS`, `=TEMPUNITS`); frames of a 1750 in the tests of `ros_kvh1750` hold format A
//! and the CRC. Formats B and C are from the manual, not verified against a device; nor is where the
//! time stamp of format B starts.

use crc::{CRC_32_MPEG_2, Crc};

use super::{DeviceTime, ImuMotion, ImuReading, Wrapping};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::stream::Look;

const CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_MPEG_2);

const HEADER: [u8; 3] = [0xFE, 0x81, 0xFF];

/// Standard gravity, m/s^2.
const G: f64 = 9.806_65;
/// Metres in a foot.
const FOOT: f64 = 0.3048;
/// Sequence numbers before they start again.
const SEQUENCES: u64 = 128;

/// Status bits of the three gyroscopes and the three accelerometers, set when the data is valid.
const ALL_VALID: u8 = 0b0111_0111;

/// What a device was told to send (`=ROTFMT`, `=ROTUNITS`, `=LINFMT`, `=LINUNITS`, `=TEMPUNITS`, `=DR`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KvhFormat {
    /// The three numbers of rotation.
    pub rotation: KvhRotation,
    /// Whether they are in degrees, else in radians.
    pub degrees: bool,
    /// The three linear numbers.
    pub linear: KvhLinear,
    /// The unit of temperature.
    pub temperature: KvhTemperature,
    /// Time between two messages, s, positive. Used only if one of rotation and linear is a difference
    /// and the other a rate.
    pub interval: f64,
}

impl Default for KvhFormat {
    /// Angles in radians, accelerations in g, whole deg C, 1000 Hz: as far as known how the device is
    /// delivered.
    fn default() -> Self {
        KvhFormat {
            rotation: KvhRotation::Delta,
            degrees: false,
            linear: KvhLinear::Acceleration,
            temperature: KvhTemperature::Celsius,
            interval: 1e-3,
        }
    }
}

/// What the numbers of rotation are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum KvhRotation {
    /// Angle since the last message.
    Delta,
    /// Angular rate, per second.
    Rate,
}

/// What the linear numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum KvhLinear {
    /// Specific force, g.
    Acceleration,
    /// Velocity since the last message, m/s.
    DeltaMetres,
    /// Velocity since the last message, feet/s.
    DeltaFeet,
}

/// The unit of temperature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum KvhTemperature {
    /// deg C.
    Celsius,
    /// 0.01 deg C.
    CentiCelsius,
    /// deg F.
    Fahrenheit,
    /// 0.01 deg F.
    CentiFahrenheit,
}

/// One message, in the units of the wire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KvhMessage {
    /// About x, y, z.
    pub rotation: [f32; 3],
    /// Along x, y, z.
    pub linear: [f32; 3],
    /// Bits 0 to 2 gyroscopes x, y, z; 4 to 6 accelerometers x, y, z; set when valid.
    pub status: u8,
    /// Number of the message, 0 to 127.
    pub sequence: u8,
    /// What the formats do not have in common.
    pub rest: KvhRest,
}

/// What else a message says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KvhRest {
    /// Format A.
    A {
        /// Temperature in the configured unit.
        temperature: i16,
    },
    /// Format B.
    B {
        /// Time stamp, us.
        time: u32,
        /// Temperature in the configured unit.
        temperature: i16,
    },
    /// Format C.
    C {
        /// By sequence modulo 4: temperature in the configured unit, magnetic field x, y, z.
        slow: f32,
    },
}

/// What stands at the start of some bytes: a message of format A, B or C with its CRC verified.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    if !bytes.iter().zip(HEADER).all(|(byte, expected)| *byte == expected) {
        return Look::Nothing;
    }
    let Some(format) = bytes.get(3) else { return Look::More(4) };
    let Some(length) = length_of(*format) else { return Look::Nothing };
    match bytes.get(..length) {
        None => Look::More(length),
        Some(frame) if is_sound(frame) => Look::Frame(length),
        Some(_) => Look::Damaged,
    }
}

fn length_of(format: u8) -> Option<usize> {
    match format {
        0x55 => Some(36),
        0x56 => Some(40),
        0x57 => Some(38),
        _ => None,
    }
}

fn is_sound(frame: &[u8]) -> bool {
    frame
        .split_last_chunk::<4>()
        .is_some_and(|(body, crc)| CRC.checksum(body) == u32::from_be_bytes(*crc))
}

impl KvhMessage {
    /// Reads a whole message.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if header, length or CRC are wrong; [`BinaryFault::Range`] for a number that is not
    /// finite.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        if look(frame) != Look::Frame(frame.len()) {
            return Err(BinaryFault::Frame);
        }
        let mut reader = Reader::new(frame);
        let format = reader.be_u32()? as u8;
        let rotation = triple(&mut reader, "rotational data")?;
        let linear = triple(&mut reader, "acceleration")?;
        let time = if format == 0x56 { reader.be_u32()? } else { 0 };
        let slow = if format == 0x57 { reader.be_f32()? } else { 0.0 };
        let (status, sequence) = (reader.u8()?, reader.u8()?);
        let rest = match format {
            0x55 => KvhRest::A { temperature: reader.be_i16()? },
            0x56 => KvhRest::B { time, temperature: reader.be_i16()? },
            _ => KvhRest::C { slow },
        };
        Ok(KvhMessage { rotation, linear, status, sequence, rest })
    }

    /// Writes the message.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let format = match self.rest {
            KvhRest::A { .. } => 0x55,
            KvhRest::B { .. } => 0x56,
            KvhRest::C { .. } => 0x57,
        };
        let mut frame = Writer::new();
        frame.put(&HEADER).u8(format);
        for value in self.rotation.into_iter().chain(self.linear) {
            frame.be_f32(value);
        }
        match self.rest {
            KvhRest::A { .. } => {}
            KvhRest::B { time, .. } => drop(frame.be_u32(time)),
            KvhRest::C { slow } => drop(frame.be_f32(slow)),
        }
        frame.u8(self.status).u8(self.sequence);
        if let KvhRest::A { temperature } | KvhRest::B { temperature, .. } = self.rest {
            frame.be_i16(temperature);
        }
        let crc = CRC.checksum(frame.bytes());
        frame.be_u32(crc);
        frame.into_bytes()
    }

    /// What was measured. If one of rotation and linear is a difference both become differences, with
    /// the interval of the format.
    #[must_use]
    pub fn reading(&self, format: &KvhFormat) -> ImuReading {
        let device_time = match self.rest {
            KvhRest::B { time, .. } => {
                let ticks = Wrapping { value: time.into(), modulus: 1 << 32 };
                Some(DeviceTime { ticks, tick: 1e-6 })
            }
            _ => None,
        };
        ImuReading {
            device_time,
            counter: Some(Wrapping { value: self.sequence.into(), modulus: SEQUENCES }),
            temperature: self.temperature().map(|value| format.temperature.to_celsius(value)),
            valid: self.status & ALL_VALID == ALL_VALID,
            status: self.status.into(),
            ..ImuReading::bare(format.motion(self.rotation, self.linear))
        }
    }

    /// Temperature in the configured unit, if the message has one.
    fn temperature(&self) -> Option<f64> {
        match self.rest {
            KvhRest::A { temperature } | KvhRest::B { temperature, .. } => Some(temperature.into()),
            KvhRest::C { slow } if self.sequence.is_multiple_of(4) && slow.is_finite() => {
                Some(slow.into())
            }
            KvhRest::C { .. } => None,
        }
    }
}

fn triple(reader: &mut Reader<'_>, field: &'static str) -> Result<[f32; 3], BinaryFault> {
    let values = [reader.be_f32()?, reader.be_f32()?, reader.be_f32()?];
    let finite = values.iter().all(|value| value.is_finite());
    if finite { Ok(values) } else { Err(BinaryFault::Range { field }) }
}

impl KvhFormat {
    /// Numbers of rotation and linear numbers of a motion, as a device with this format sends them.
    #[must_use]
    pub fn numbers(&self, motion: &ImuMotion) -> ([f32; 3], [f32; 3]) {
        let (rotation, linear, differences) = match motion {
            ImuMotion::Rates { gyro, accel } => (gyro, accel, false),
            ImuMotion::Increments { delta_theta, delta_velocity } => {
                (delta_theta, delta_velocity, true)
            }
        };
        let scale = |values: &[f64; 3], unit: f64, wire_differences: bool| {
            let unit = unit * self.step(wire_differences, differences);
            values.map(|value| (value / unit) as f32)
        };
        (
            scale(rotation, self.angle(), self.rotation == KvhRotation::Delta),
            scale(linear, self.linear.unit(), self.linear.is_delta()),
        )
    }

    fn motion(&self, rotation: [f32; 3], linear: [f32; 3]) -> ImuMotion {
        let delta = self.rotation == KvhRotation::Delta;
        let differences = delta || self.linear.is_delta();
        let rotation_unit = self.angle() * self.step(delta, differences);
        let linear_unit = self.linear.unit() * self.step(self.linear.is_delta(), differences);
        let rotation = rotation.map(|value| f64::from(value) * rotation_unit);
        let linear = linear.map(|value| f64::from(value) * linear_unit);
        if differences {
            ImuMotion::Increments { delta_theta: rotation, delta_velocity: linear }
        } else {
            ImuMotion::Rates { gyro: rotation, accel: linear }
        }
    }

    /// Radians in the unit of angles.
    fn angle(&self) -> f64 {
        if self.degrees { insd_base::units::DEG } else { 1.0 }
    }

    /// What a value of the wire is multiplied by to become a difference or a rate.
    fn step(&self, wire_differences: bool, differences: bool) -> f64 {
        match (wire_differences, differences) {
            (false, true) => self.interval,
            (true, false) => 1.0 / self.interval,
            _ => 1.0,
        }
    }
}

impl KvhLinear {
    fn is_delta(self) -> bool {
        self != KvhLinear::Acceleration
    }

    /// The unit in m/s^2 or m/s.
    fn unit(self) -> f64 {
        match self {
            KvhLinear::Acceleration => G,
            KvhLinear::DeltaMetres => 1.0,
            KvhLinear::DeltaFeet => FOOT,
        }
    }
}

impl KvhTemperature {
    fn to_celsius(self, value: f64) -> f64 {
        match self {
            KvhTemperature::Celsius => value,
            KvhTemperature::CentiCelsius => value / 100.0,
            KvhTemperature::Fahrenheit => (value - 32.0) / 1.8,
            KvhTemperature::CentiFahrenheit => (value / 100.0 - 32.0) / 1.8,
        }
    }
}
