//! MTData2: the outputs of one sampling instant, each an item with its identifier.

use insd_base::UtcTime;
use insd_base::units::DEG;

use super::number::Precision;
use super::{MTDATA2, open, seal};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::imu::rotation::delta_theta_of;
use crate::imu::{DeviceTime, ImuMotion, ImuReading, Wrapping};
use crate::nmea::{CivilTime, Date, TimeOfDay};

const TEMPERATURE: u16 = 0x0810;
const UTC_TIME: u16 = 0x1010;
const PACKET_COUNTER: u16 = 0x1020;
const FINE_TIME: u16 = 0x1060;
const COARSE_TIME: u16 = 0x1070;
const EULER: u16 = 0x2030;
const DELTA_V: u16 = 0x4010;
const ACCELERATION: u16 = 0x4020;
const RATE_OF_TURN: u16 = 0x8020;
const DELTA_Q: u16 = 0x8030;
const STATUS_BYTE: u16 = 0xE010;
const STATUS_WORD: u16 = 0xE020;

/// Count at which the fine time starts again in the MTi 1 and 600 series.
pub const FINE_U32: u64 = 1 << 32;
/// Count at which the fine time starts again in the MTi 10 and 100 series: one day.
pub const FINE_DAY: u64 = 864_000_000;
/// Length of a tick of the fine time, s.
const FINE_TICK: f64 = 1e-4;

/// Flags of the UTC item of which each must be set: time of day, date, both resolved.
const UTC_VALID: u8 = 0x07;
/// Bits 8 to 13 of the status word: an accelerometer or gyro is out of its range.
const CLIPPED: u32 = 0x3F00;

/// UTC of the sample as on the wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Utc {
    /// Date and time of day; meaningless without the flags.
    pub civil: CivilTime,
    /// Bits 0 to 2 all set: the device knows UTC.
    pub flags: u8,
}

/// The device's status.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// Item E010: bits 0 to 7 of the word; says nothing of sensors out of range.
    Byte(u8),
    /// Item E020.
    Word(u32),
}

/// Local axes of an orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum XbusAxes {
    /// East, north, up.
    Enu,
    /// North, east, down.
    Ned,
    /// North, west, up.
    Nwu,
}

/// Orientation by the device's own filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    /// Local axes that the angles lead to.
    pub axes: XbusAxes,
    /// Roll, pitch, yaw, rad (degrees on the wire).
    pub euler: [f64; 3],
}

/// MTData2: the items of it that are read here, in the device's own axes.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct MtData2 {
    /// Number of the message.
    pub counter: Option<u16>,
    /// Time of sampling, ticks of 0.1 ms.
    pub fine_time: Option<u32>,
    /// Time of sampling, whole seconds.
    pub coarse_time: Option<u32>,
    /// UTC of sampling.
    pub utc: Option<Utc>,
    /// Status.
    pub status: Option<Status>,
    /// Orientation.
    pub orientation: Option<Orientation>,
    /// Specific force, m/s^2.
    pub acceleration: Option<[f64; 3]>,
    /// Integral of specific force over the interval, m/s.
    pub delta_v: Option<[f64; 3]>,
    /// Angular rate, rad/s.
    pub rate_of_turn: Option<[f64; 3]>,
    /// Turn over the interval, quaternion (w, x, y, z); see [`crate::imu::rotation`].
    pub delta_q: Option<[f64; 4]>,
    /// Temperature of the sensors, deg C.
    pub temperature: Option<f64>,
}

impl MtData2 {
    /// Reads a message.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if it is none, [`BinaryFault::OtherMessage`] if it is not MTData2,
    /// [`BinaryFault::Short`] if an item ends early.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let (id, data) = open(frame).ok_or(BinaryFault::Frame)?;
        if id != MTDATA2 {
            return Err(BinaryFault::OtherMessage);
        }
        let mut message = MtData2::default();
        let mut items = Reader::new(data);
        while let Ok(identifier) = items.be_u16() {
            let size = items.u8()?;
            message.take(identifier, &mut Reader::new(items.take(size.into())?))?;
        }
        Ok(message)
    }

    fn take(&mut self, identifier: u16, data: &mut Reader<'_>) -> Result<(), BinaryFault> {
        let precision = Precision::of_identifier(identifier);
        match identifier & 0xFFF0 {
            TEMPERATURE => self.temperature = Some(precision.read(data)?),
            UTC_TIME => self.utc = Some(Utc::parse(data)?),
            PACKET_COUNTER => self.counter = Some(data.be_u16()?),
            FINE_TIME => self.fine_time = Some(data.be_u32()?),
            COARSE_TIME => self.coarse_time = Some(data.be_u32()?),
            EULER => self.orientation = Orientation::parse(identifier, data)?,
            DELTA_V => self.delta_v = Some(numbers(precision, data)?),
            ACCELERATION => self.acceleration = Some(numbers(precision, data)?),
            RATE_OF_TURN => self.rate_of_turn = Some(numbers(precision, data)?),
            DELTA_Q => self.delta_q = Some(numbers(precision, data)?),
            STATUS_BYTE => {
                let byte = Status::Byte(data.u8()?);
                self.status.get_or_insert(byte);
            }
            STATUS_WORD => self.status = Some(Status::Word(data.be_u32()?)),
            _ => {}
        }
        Ok(())
    }

    /// The whole message, with those items that are there, real numbers in one format.
    #[must_use]
    pub fn write(&self, precision: Precision) -> Vec<u8> {
        let mut items = Writer::new();
        self.put_header_items(&mut items);
        if let Some(Orientation { axes, euler }) = self.orientation {
            let degrees = euler.map(|angle| angle / DEG);
            put_numbers(&mut items, EULER | axes.bits(), precision, Some(degrees));
        }
        put_numbers(&mut items, ACCELERATION, precision, self.acceleration);
        put_numbers(&mut items, DELTA_V, precision, self.delta_v);
        put_numbers(&mut items, RATE_OF_TURN, precision, self.rate_of_turn);
        put_numbers(&mut items, DELTA_Q, precision, self.delta_q);
        put_numbers(&mut items, TEMPERATURE, precision, self.temperature.map(|value| [value]));
        seal(MTDATA2, &items)
    }

    fn put_header_items(&self, items: &mut Writer) {
        if let Some(counter) = self.counter {
            items.be_u16(PACKET_COUNTER).u8(2).be_u16(counter);
        }
        if let Some(ticks) = self.fine_time {
            items.be_u16(FINE_TIME).u8(4).be_u32(ticks);
        }
        if let Some(seconds) = self.coarse_time {
            items.be_u16(COARSE_TIME).u8(4).be_u32(seconds);
        }
        if let Some(utc) = self.utc {
            items.be_u16(UTC_TIME).u8(12);
            utc.put(items);
        }
        match self.status {
            Some(Status::Byte(byte)) => items.be_u16(STATUS_BYTE).u8(1).u8(byte),
            Some(Status::Word(word)) => items.be_u16(STATUS_WORD).u8(4).be_u32(word),
            None => items,
        };
    }

    /// As a sample, if it has both turn and specific force. Integrals are preferred. The fine time
    /// is taken to start again at 2^32, as in the MTi 600 series.
    ///
    /// Valid means that the status names no accelerometer or gyro out of range. The self-test (bit
    /// 0) is not asked: the 600 series always leaves it at zero.
    #[must_use]
    pub fn reading(&self) -> Option<ImuReading> {
        self.reading_wrapping(FINE_U32)
    }

    /// [`MtData2::reading`] of a series with another end of the fine time: [`FINE_DAY`].
    #[must_use]
    pub fn reading_wrapping(&self, fine_modulus: u64) -> Option<ImuReading> {
        let motion = self.motion()?;
        let status = self.status.map_or(0, Status::bits);
        let wrapping = |value: u64, modulus: u64| Wrapping { value, modulus };
        Some(ImuReading {
            device_time: self.fine_time.map(|ticks| DeviceTime {
                ticks: wrapping(ticks.into(), fine_modulus),
                tick: FINE_TICK,
            }),
            counter: self.counter.map(|counter| wrapping(counter.into(), 1 << 16)),
            utc: self.utc.and_then(|utc| utc.utc()),
            temperature: self.temperature.filter(|temperature| temperature.is_finite()),
            valid: status & CLIPPED == 0 && motion.is_finite(),
            status,
            ..ImuReading::bare(motion)
        })
    }

    fn motion(&self) -> Option<ImuMotion> {
        let rates = self.rate_of_turn.zip(self.acceleration);
        let rates = rates.map(|(gyro, accel)| ImuMotion::Rates { gyro, accel });
        let increments = self.delta_q.zip(self.delta_v);
        let increments = increments.map(|(delta_q, delta_velocity)| ImuMotion::Increments {
            delta_theta: delta_theta_of(delta_q),
            delta_velocity,
        });
        increments.or(rates)
    }
}

impl Utc {
    fn parse(data: &mut Reader<'_>) -> Result<Self, BinaryFault> {
        let nanosecond = data.be_u32()?;
        let date = Date { year: data.be_u16()?, month: data.u8()?, day: data.u8()? };
        let [hour, minute, second, flags] = data.array()?;
        let time = TimeOfDay { hour, minute, second, nanosecond };
        Ok(Utc { civil: CivilTime { date, time }, flags })
    }

    fn put(&self, items: &mut Writer) {
        let Date { year, month, day } = self.civil.date;
        let TimeOfDay { hour, minute, second, nanosecond } = self.civil.time;
        let rest = [month, day, hour, minute, second, self.flags];
        items.be_u32(nanosecond).be_u16(year).put(&rest);
    }

    /// The instant, if the device knows it.
    #[must_use]
    pub fn utc(&self) -> Option<UtcTime> {
        self.civil.to_utc().filter(|_| self.flags & UTC_VALID == UTC_VALID)
    }
}

impl Status {
    /// As bits of the status word.
    #[must_use]
    pub fn bits(self) -> u32 {
        match self {
            Status::Byte(byte) => byte.into(),
            Status::Word(word) => word,
        }
    }
}

impl XbusAxes {
    fn of_identifier(identifier: u16) -> Option<Self> {
        match identifier & 0xC {
            0x0 => Some(XbusAxes::Enu),
            0x4 => Some(XbusAxes::Ned),
            0x8 => Some(XbusAxes::Nwu),
            _ => None,
        }
    }

    fn bits(self) -> u16 {
        match self {
            XbusAxes::Enu => 0x0,
            XbusAxes::Ned => 0x4,
            XbusAxes::Nwu => 0x8,
        }
    }
}

impl Orientation {
    /// `None` if the axes are none that the protocol defines.
    fn parse(identifier: u16, data: &mut Reader<'_>) -> Result<Option<Self>, BinaryFault> {
        let degrees: [f64; 3] = numbers(Precision::of_identifier(identifier), data)?;
        let axes = XbusAxes::of_identifier(identifier);
        Ok(axes.map(|axes| Orientation { axes, euler: degrees.map(|angle| angle * DEG) }))
    }
}

fn numbers<const N: usize>(
    precision: Precision,
    data: &mut Reader<'_>,
) -> Result<[f64; N], BinaryFault> {
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        *number = precision.read(data)?;
    }
    Ok(numbers)
}

fn put_numbers<const N: usize>(
    items: &mut Writer,
    identifier: u16,
    precision: Precision,
    numbers: Option<[f64; N]>,
) {
    if let Some(numbers) = numbers {
        items.be_u16(identifier | precision.bits()).u8(N as u8 * precision.size());
        for number in numbers {
            precision.write(items, number);
        }
    }
}
