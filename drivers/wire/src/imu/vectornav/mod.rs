//! VectorNav's binary messages (VN-100, VN-200, VN-300, VN-110 and what speaks as they do).
//!
//! ```text
//! FA            start
//! groups        a bit for each group: 0 common, 1 time, 2 IMU, 3 GNSS, 4 attitude, 5 INS, 6 second GNSS
//! masks         two bytes for each group: a bit for each field
//! fields        those of the first group by their bits, then those of the next
//! CRC           of all before it but the start, most significant byte first
//! ```
//!
//! Little endian but for the CRC. Readers never panic, whatever the bytes. Source: the maker's SDK 0.19 (MIT, copyright VectorNav
//! Technologies), and the messages that its user manuals print, which the tests hold. Not verified against a device.

mod sizes;

use crc::{CRC_16_XMODEM, Crc, Table};
use insd_base::units::DEG;
use insd_base::{GpsTime, UtcTime};

use self::sizes::{Field, Layout, layout};
use super::{DeviceTime, ImuMotion, ImuReading, Wrapping};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::stream::Look;

const START: u8 = 0xFA;
const SUM: usize = 2;
const CRC: Crc<u16, Table<16>> = Crc::<u16, Table<16>>::new(&CRC_16_XMODEM);
const NANOSECOND: f64 = 1e-9;

/// Time of the week and date are known.
const TIME_KNOWN: u8 = 0b011;

/// Bits of the sensors' saturation that are accelerometers and gyros.
const SATURATED: u16 = 0x01F8;

/// An INS that tracks.
const TRACKING: u16 = 2;

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    let Some((START, behind)) = bytes.split_first().map(|(start, behind)| (*start, behind)) else {
        return Look::Nothing;
    };
    match layout(behind) {
        Layout::None => Look::Nothing,
        Layout::More(header) => Look::More(1 + header),
        Layout::Known(header, fields) => {
            let length = 1 + header + fields.iter().map(|(_, size)| size).sum::<usize>() + SUM;
            match bytes.get(1..length) {
                None => Look::More(length),
                // over a message and its own sum it is zero
                Some(summed) if CRC.checksum(summed) == 0 => Look::Frame(length),
                Some(_) => Look::Damaged,
            }
        }
    }
}

/// Increments over an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VnDeltas {
    /// Length of the interval, s.
    pub interval: f64,
    /// Integral of the angular rate, rad (degrees on the wire).
    pub theta: [f64; 3],
    /// Integral of specific force, m/s.
    pub velocity: [f64; 3],
}

/// The fields of a message that are read, whichever group they stand in. Axes are the device's own: forward, starboard, down unless it was
/// told a rotation.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct VnMessage {
    /// Time since it was switched on, ns.
    pub startup_nanos: Option<u64>,
    /// Time since 1980, ns; GPS time only if [`VnMessage::time_status`] says so.
    pub gps_nanos: Option<u64>,
    /// Bit 0 time of the week, 1 date, 2 UTC known.
    pub time_status: Option<u8>,
    /// Yaw, pitch and roll, rad, to north, east, down. Of a device without satellites north is the magnetic one.
    pub attitude: Option<[f64; 3]>,
    /// 1-sigma of yaw, pitch and roll, rad.
    pub attitude_std: Option<[f64; 3]>,
    /// Angular rate with the bias of the device's own filter taken off, rad/s.
    pub rate: Option<[f64; 3]>,
    /// Specific force, the same way, m/s^2.
    pub force: Option<[f64; 3]>,
    /// Angular rate as calibrated in the factory, rad/s.
    pub plain_rate: Option<[f64; 3]>,
    /// Specific force as calibrated in the factory, m/s^2.
    pub plain_force: Option<[f64; 3]>,
    /// Increments since the last message.
    pub deltas: Option<VnDeltas>,
    /// Temperature, deg C.
    pub temperature: Option<f64>,
    /// Which sensors are out of their range.
    pub saturated: Option<u16>,
    /// Status of the INS; bits 0 and 1: 0 not tracking, 1 aligning, 2 tracking, 3 without satellites.
    pub ins_status: Option<u16>,
}

impl VnMessage {
    /// Reads a message.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if it is none, [`BinaryFault::OtherMessage`] if none of its fields is read here.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        if look(frame) != Look::Frame(frame.len()) {
            return Err(BinaryFault::Frame);
        }
        let behind = frame.get(1..).unwrap_or_default();
        let Layout::Known(header, fields) = layout(behind) else { return Err(BinaryFault::Frame) };
        let mut reader = Reader::new(behind.get(header..).unwrap_or_default());
        let mut message = VnMessage::default();
        for (field, size) in fields {
            message.take(field, Reader::new(reader.take(size)?))?;
        }
        if message == VnMessage::default() { Err(BinaryFault::OtherMessage) } else { Ok(message) }
    }

    fn take(&mut self, field: Field, mut own: Reader<'_>) -> Result<(), BinaryFault> {
        match field {
            (0 | 1, 0) => self.startup_nanos = Some(own.le_u64()?),
            (0 | 1, 1) => self.gps_nanos = Some(own.le_u64()?),
            (1, 9) => self.time_status = Some(own.u8()?),
            (0, 3) | (4, 1) => self.attitude = Some(vector(&mut own, DEG)?),
            (4, 8) => self.attitude_std = Some(vector(&mut own, DEG)?),
            (0, 5) | (2, 10) => self.rate = Some(vector(&mut own, 1.0)?),
            (0, 8) | (2, 9) => self.force = Some(vector(&mut own, 1.0)?),
            (0, 9) => {
                self.plain_force = Some(vector(&mut own, 1.0)?);
                self.plain_rate = Some(vector(&mut own, 1.0)?);
            }
            (2, 2) => self.plain_force = Some(vector(&mut own, 1.0)?),
            (2, 3) => self.plain_rate = Some(vector(&mut own, 1.0)?),
            (0, 11) => {
                let (interval, theta) = turn(&mut own)?;
                self.deltas = Some(VnDeltas { interval, theta, velocity: vector(&mut own, 1.0)? });
            }
            (2, 6) => {
                let (interval, theta) = turn(&mut own)?;
                self.deltas = Some(VnDeltas { interval, theta, velocity: [f64::NAN; 3] });
            }
            (2, 7) => {
                let velocity = vector(&mut own, 1.0)?;
                self.deltas = self.deltas.map(|deltas| VnDeltas { velocity, ..deltas });
            }
            (2, 4) => self.temperature = Some(own.le_f32()?.into()),
            (2, 11) => self.saturated = Some(own.le_u16()?),
            (0, 12) | (5, 0) => self.ins_status = Some(own.le_u16()?),
            _ => {}
        }
        Ok(())
    }

    /// The message, with those fields that are there.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut fields: Vec<(Field, Vec<u8>)> = Vec::new();
        let mut put = |field: Field, bytes: Option<Vec<u8>>| {
            fields.extend(bytes.map(|bytes| (field, bytes)));
        };
        put((0, 0), self.startup_nanos.map(|nanos| nanos.to_le_bytes().to_vec()));
        put((0, 1), self.gps_nanos.map(|nanos| nanos.to_le_bytes().to_vec()));
        put((0, 3), self.attitude.map(|own| floats(&own, DEG)));
        put((0, 5), self.rate.map(|own| floats(&own, 1.0)));
        put((0, 8), self.force.map(|own| floats(&own, 1.0)));
        put((0, 11), self.deltas.map(|own| own.bytes()));
        put((0, 12), self.ins_status.map(|status| status.to_le_bytes().to_vec()));
        put((1, 9), self.time_status.map(|status| vec![status]));
        put((2, 2), self.plain_force.map(|own| floats(&own, 1.0)));
        put((2, 3), self.plain_rate.map(|own| floats(&own, 1.0)));
        put((2, 4), self.temperature.map(|own| floats(&[own], 1.0)));
        put((2, 11), self.saturated.map(|bits| bits.to_le_bytes().to_vec()));
        put((4, 8), self.attitude_std.map(|own| floats(&own, DEG)));
        seal(&fields)
    }

    /// As a sample: increments if it has them, else rates as calibrated in the factory, else those of the device's own filter.
    #[must_use]
    pub fn reading(&self) -> Option<ImuReading> {
        let increments = self.deltas.map(|own| ImuMotion::Increments {
            delta_theta: own.theta,
            delta_velocity: own.velocity,
        });
        let rates = |gyro: Option<[f64; 3]>, accel: Option<[f64; 3]>| {
            gyro.zip(accel).map(|(gyro, accel)| ImuMotion::Rates { gyro, accel })
        };
        let plain = rates(self.plain_rate, self.plain_force);
        let whole = increments.filter(ImuMotion::is_finite);
        let motion = whole.or(plain).or(rates(self.rate, self.force)).or(increments)?;
        let saturated = self.saturated.unwrap_or(0);
        let ticks = |value| Wrapping { value, modulus: u64::MAX };
        Some(ImuReading {
            device_time: self
                .startup_nanos
                .map(|nanos| DeviceTime { ticks: ticks(nanos), tick: NANOSECOND }),
            utc: self.utc(),
            temperature: self.temperature.filter(|temperature| temperature.is_finite()),
            valid: saturated & SATURATED == 0 && motion.is_finite(),
            status: saturated.into(),
            ..ImuReading::bare(motion)
        })
    }

    /// The instant in UTC by the table of leap seconds of this version, if the device says that it knows it.
    #[must_use]
    pub fn utc(&self) -> Option<UtcTime> {
        let known = self.time_status.is_some_and(|status| status & TIME_KNOWN == TIME_KNOWN);
        let nanos = self.gps_nanos.filter(|_| known)?;
        Some(GpsTime::from_nanos(i64::try_from(nanos).ok()?).to_utc(None))
    }

    /// Yaw against true north, rad, as its INS stands behind it; `None` of a device without one, and while it does not track.
    #[must_use]
    pub fn true_heading(&self) -> Option<f64> {
        let tracks = self.ins_status.is_some_and(|status| status & 3 == TRACKING);
        self.attitude.map(|[yaw, ..]| yaw).filter(|yaw| tracks && yaw.is_finite())
    }
}

impl VnDeltas {
    fn bytes(&self) -> Vec<u8> {
        let [interval, theta, velocity] =
            [(&[self.interval][..], 1.0), (&self.theta, DEG), (&self.velocity, 1.0)];
        [interval, theta, velocity].map(|(own, unit)| floats(own, unit)).concat()
    }
}

fn vector(own: &mut Reader<'_>, unit: f64) -> Result<[f64; 3], BinaryFault> {
    let mut next = || Ok(f64::from(own.le_f32()?) * unit);
    Ok([next()?, next()?, next()?])
}

/// An interval and what was turned within it.
fn turn(own: &mut Reader<'_>) -> Result<(f64, [f64; 3]), BinaryFault> {
    Ok((own.le_f32()?.into(), vector(own, DEG)?))
}

fn floats(values: &[f64], unit: f64) -> Vec<u8> {
    values.iter().flat_map(|value| ((value / unit) as f32).to_le_bytes()).collect()
}

/// The frame of fields that are in their order.
fn seal(fields: &[(Field, Vec<u8>)]) -> Vec<u8> {
    let of = |group: u8| fields.iter().filter(move |((own, _), _)| *own == group);
    let mut groups = 0;
    let mut masks = Writer::new();
    for group in (0..7).filter(|group| of(*group).next().is_some()) {
        groups |= 1 << group;
        masks.le_u16(of(group).fold(0, |mask, ((_, bit), _)| mask | 1 << bit));
    }
    let bytes = fields.iter().flat_map(|(_, bytes)| bytes.iter().copied()).collect::<Vec<u8>>();
    let summed = [&[groups][..], masks.bytes(), &bytes].concat();
    let sum = CRC.checksum(&summed).to_be_bytes();
    [&[START][..], &summed, &sum].concat()
}
