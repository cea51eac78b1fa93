//! MicroStrain MIP: packets of sensor data (descriptor set 80).
//!
//! Source: the maker's SDK (github.com/LORD-MicroStrain/mip_sdk, MIT: `definitions/data_sensor.h`,
//! `definitions/data_shared.h`, `mip_packet.c`). Framing, accelerometer, gyro, Euler and reference
//! time fields were verified against the recording of a device that the SDK brings along; the others
//! come from the definitions alone.
//!
//! A packet is 75 65, descriptor set, payload length, fields, two-byte Fletcher sum of all before it;
//! a field is its length (with its own header), descriptor, data; big endian. Readers never panic,
//! whatever the bytes.

use insd_base::{GpsTime, UtcTime};

use super::{DeviceTime, ImuMotion, ImuReading, Wrapping};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::stream::Look;

const SYNC: [u8; 2] = [0x75, 0x65];
const HEADER: usize = 4;
const CHECKSUM: usize = 2;
/// The descriptor set of sensor data.
const SENSOR: u8 = 0x80;

const ACCEL: u8 = 0x04;
const GYRO: u8 = 0x05;
const DELTA_THETA: u8 = 0x07;
const DELTA_VELOCITY: u8 = 0x08;
const EULER: u8 = 0x0C;
const OLD_GPS_TIME: u8 = 0x12;
const TEMPERATURE: u8 = 0x14;
const OVERRANGE: u8 = 0x18;
const GPS_TIME: u8 = 0xD3;
const REFERENCE_TIME: u8 = 0xD5;
const REFERENCE_DELTA: u8 = 0xD6;

/// The maker's g, m/s^2.
const G: f64 = 9.806_65;
const NANOSECOND: f64 = 1e-9;
const WEEK: f64 = 604_800.0;

/// Flags of field 12 without which its time is not GPS time: pulse present, time of week and week
/// number valid.
const OLD_GPS_VALID: u16 = 0x0019;
/// Flags of field D3 without which its time is not GPS time: time of week and week number set.
const GPS_VALID: u16 = 0x0003;
/// Bits of field 18 (over range) of the accelerometers and gyros.
const INERTIAL_OVERRANGE: u16 = 0x0077;

/// Time of a sample by the clock that the device keeps on GPS time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GpsStamp {
    /// Time of the week, s.
    pub tow: f64,
    /// Weeks since 1980.
    pub week: u16,
    /// Whether the device says that both are GPS time; else they are time since some start.
    pub valid: bool,
}

/// A packet of sensor data: the fields of it that are read here. Axes are the vehicle frame that is
/// set in the device (the sensor's own unless changed).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Packet {
    /// Field D3, or 12 of older devices. The writer writes D3.
    pub gps: Option<GpsStamp>,
    /// Field D5: time of sampling by a clock that never jumps, ns since start.
    pub reference_nanos: Option<u64>,
    /// Field D6: time since the last packet with this field, ns.
    pub reference_delta_nanos: Option<u64>,
    /// Field 04: specific force, m/s^2 (g on the wire).
    pub accel: Option<[f64; 3]>,
    /// Field 05: angular rate, rad/s.
    pub gyro: Option<[f64; 3]>,
    /// Field 07: integral of the angular rate since the last packet, rad.
    pub delta_theta: Option<[f64; 3]>,
    /// Field 08: integral of specific force since the last packet, m/s (g s on the wire).
    pub delta_velocity: Option<[f64; 3]>,
    /// Field 14: mean temperature, deg C. The writer gives it for least and greatest too.
    pub temperature: Option<f64>,
    /// Field 18: which sensors are out of their range, a bit each.
    pub overrange: Option<u16>,
    /// Field 0C: roll, pitch, yaw by the device's complementary filter, rad, to north-east-down.
    pub euler: Option<[f64; 3]>,
}

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    let in_step = bytes.iter().zip(SYNC).all(|(found, sync)| *found == sync);
    if !in_step || bytes.get(2) == Some(&0) {
        return Look::Nothing;
    }
    let Some([_, _, _, length]) = bytes.first_chunk::<HEADER>() else {
        return Look::More(bytes.len() + 1);
    };
    let end = HEADER + usize::from(*length);
    let seen = bytes.get(HEADER..end.min(bytes.len())).unwrap_or_default();
    let Some(needed) = walk(seen, usize::from(*length)) else {
        return Look::Nothing;
    };
    if needed > seen.len() {
        return Look::More(HEADER + needed);
    }
    let whole = end + CHECKSUM;
    match bytes.get(..whole) {
        None => Look::More(whole),
        Some(frame) if is_sound(frame) => Look::Frame(whole),
        Some(_) => Look::Damaged,
    }
}

/// Walks over the fields of a payload of `length` bytes, of which some are seen. Gives the bytes
/// that are needed to see the next field's header, or all of them after the last; `None` if the
/// fields do not fill the payload, so that a false start is given up early.
fn walk(seen: &[u8], length: usize) -> Option<usize> {
    let mut at = 0;
    while let Some(field) = seen.get(at) {
        at += usize::from(*field);
        if *field < 2 || at > length {
            return None;
        }
    }
    Some((at + 1).min(length))
}

fn is_sound(frame: &[u8]) -> bool {
    matches!(frame, [covered @ .., first, second] if fletcher(covered) == [*first, *second])
}

fn fletcher(bytes: &[u8]) -> [u8; 2] {
    bytes.iter().fold([0, 0], |[first, second], byte: &u8| {
        let first = byte.wrapping_add(first);
        [first, first.wrapping_add(second)]
    })
}

impl Packet {
    /// Reads a packet.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if it is none, [`BinaryFault::OtherMessage`] if it is of another descriptor set,
    /// [`BinaryFault::Short`] if a field ends early.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let ([_, _, set, _, payload @ .., _, _], true) =
            (frame, look(frame) == Look::Frame(frame.len()))
        else {
            return Err(BinaryFault::Frame);
        };
        if *set != SENSOR {
            return Err(BinaryFault::OtherMessage);
        }
        let mut packet = Packet::default();
        let mut fields = Reader::new(payload);
        while let Ok(length) = fields.u8() {
            let field = fields.take(usize::from(length).saturating_sub(1))?;
            if let Some((descriptor, data)) = field.split_first() {
                packet.take(*descriptor, &mut Reader::new(data))?;
            }
        }
        Ok(packet)
    }

    fn take(&mut self, descriptor: u8, data: &mut Reader<'_>) -> Result<(), BinaryFault> {
        match descriptor {
            ACCEL => self.accel = Some(vector(data, G)?),
            GYRO => self.gyro = Some(vector(data, 1.0)?),
            DELTA_THETA => self.delta_theta = Some(vector(data, 1.0)?),
            DELTA_VELOCITY => self.delta_velocity = Some(vector(data, G)?),
            EULER => self.euler = Some(vector(data, 1.0)?),
            OLD_GPS_TIME => {
                let old = GpsStamp::parse(data, OLD_GPS_VALID)?;
                self.gps.get_or_insert(old);
            }
            GPS_TIME => self.gps = Some(GpsStamp::parse(data, GPS_VALID)?),
            REFERENCE_TIME => self.reference_nanos = Some(data.be_u64()?),
            REFERENCE_DELTA => self.reference_delta_nanos = Some(data.be_u64()?),
            TEMPERATURE => self.temperature = Some(vector(data, 1.0)?[2]),
            OVERRANGE => self.overrange = Some(data.be_u16()?),
            _ => {}
        }
        Ok(())
    }

    /// The whole packet, with those fields that are there.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut payload = Writer::new();
        if let Some(GpsStamp { tow, week, valid }) = self.gps {
            let flags = if valid { GPS_VALID } else { 0 };
            payload.put(&[14, GPS_TIME]).be_f64(tow).be_u16(week).be_u16(flags);
        }
        if let Some(nanos) = self.reference_nanos {
            payload.put(&[10, REFERENCE_TIME]).be_u64(nanos);
        }
        if let Some(nanos) = self.reference_delta_nanos {
            payload.put(&[10, REFERENCE_DELTA]).be_u64(nanos);
        }
        put_vector(&mut payload, ACCEL, self.accel, G);
        put_vector(&mut payload, GYRO, self.gyro, 1.0);
        put_vector(&mut payload, DELTA_THETA, self.delta_theta, 1.0);
        put_vector(&mut payload, DELTA_VELOCITY, self.delta_velocity, G);
        put_vector(&mut payload, TEMPERATURE, self.temperature.map(|mean| [mean; 3]), 1.0);
        if let Some(bits) = self.overrange {
            payload.put(&[4, OVERRANGE]).be_u16(bits);
        }
        put_vector(&mut payload, EULER, self.euler, 1.0);
        seal(&payload)
    }

    /// As a sample, if it has both angular rate and specific force. Integrals are preferred.
    ///
    /// Without field D5 the device's clock is the time of the week, which steps when the device is
    /// set to GPS time.
    #[must_use]
    pub fn reading(&self) -> Option<ImuReading> {
        let rates = self.gyro.zip(self.accel);
        let rates = rates.map(|(gyro, accel)| ImuMotion::Rates { gyro, accel });
        let increments = self.delta_theta.zip(self.delta_velocity);
        let increments = increments.map(|(delta_theta, delta_velocity)| ImuMotion::Increments {
            delta_theta,
            delta_velocity,
        });
        let motion = increments.or(rates)?;
        let status = self.overrange.unwrap_or(0);
        Some(ImuReading {
            device_time: self.device_time(),
            utc: self.gps.filter(|stamp| stamp.valid).and_then(|stamp| stamp.utc()),
            temperature: self.temperature.filter(|temperature| temperature.is_finite()),
            valid: status & INERTIAL_OVERRANGE == 0 && motion.is_finite(),
            status: status.into(),
            ..ImuReading::bare(motion)
        })
    }

    fn device_time(&self) -> Option<DeviceTime> {
        // 64 bits of nanoseconds do not wrap within five centuries
        let reference = self.reference_nanos.map(|value| Wrapping { value, modulus: u64::MAX });
        let of_week = || {
            let value = self.gps?.nanos_of_week()?;
            Some(Wrapping { value, modulus: (WEEK / NANOSECOND) as u64 })
        };
        let ticks = reference.or_else(of_week)?;
        Some(DeviceTime { ticks, tick: NANOSECOND })
    }
}

impl GpsStamp {
    fn parse(data: &mut Reader<'_>, needed: u16) -> Result<Self, BinaryFault> {
        Ok(GpsStamp {
            tow: data.be_f64()?,
            week: data.be_u16()?,
            valid: data.be_u16()? & needed == needed,
        })
    }

    /// The instant in UTC, by the table of leap seconds of this version; `None` if the time of the
    /// week is outside the week.
    #[must_use]
    pub fn utc(&self) -> Option<UtcTime> {
        let nanos = i64::try_from(self.nanos_of_week()?).ok()?;
        Some(GpsTime::from_week(self.week, nanos).to_utc(None))
    }

    fn nanos_of_week(&self) -> Option<u64> {
        let within = (0.0..WEEK).contains(&self.tow);
        within.then(|| (self.tow / NANOSECOND).round() as u64)
    }
}

fn vector(data: &mut Reader<'_>, unit: f64) -> Result<[f64; 3], BinaryFault> {
    let mut next = || Ok(f64::from(data.be_f32()?) * unit);
    Ok([next()?, next()?, next()?])
}

fn put_vector(payload: &mut Writer, descriptor: u8, vector: Option<[f64; 3]>, unit: f64) {
    if let Some(vector) = vector {
        payload.put(&[14, descriptor]);
        for component in vector {
            payload.be_f32((component / unit) as f32);
        }
    }
}

fn seal(payload: &Writer) -> Vec<u8> {
    let mut frame = Writer::new();
    frame.put(&SYNC).u8(SENSOR).u8(payload.bytes().len() as u8).put(payload.bytes());
    let checksum = fletcher(frame.bytes());
    frame.put(&checksum);
    frame.into_bytes()
}
