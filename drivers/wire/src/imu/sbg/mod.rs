//! SBG Systems sbgECom: frames, the IMU logs, the clock log and the Euler angles.
//!
//! Source: the maker's SDK and its documents (github.com/SBG-Systems/sbgECom, MIT, release
//! 5.2.590: `doc/binaryProtocol.md`, `doc/binaryMessages.md`, `src/logs`). The goldens of the
//! tests come out of that SDK's own writers; nothing was verified against a device. Which end of the
//! sampling interval TIME_STAMP marks is not documented; it is taken as the end.
//!
//! A frame is FF 5A, id, class, u16 length, data, u16 CRC over id to data, 33; little endian.
//! Readers never panic, whatever the bytes.

mod euler;
mod imu;
mod time;

use crc::{CRC_16_KERMIT, Crc};

use super::{DeviceTime, ImuReading, Wrapping};
use crate::binary::{BinaryFault, Reader, Writer};
use crate::stream::Look;

pub use euler::Euler;
pub use imu::{ImuData, ImuShort};
pub use time::{ClockState, TimeReference, UtcStatus};

const SYNC: [u8; 2] = [0xFF, 0x5A];
const END: u8 = 0x33;
const HEADER: usize = 6;
const TRAILER: usize = 3;

/// Class of the logs that are read here.
const LOGS: u8 = 0x00;
/// Set in the class of a page of a large frame.
const PAGED: u8 = 0x80;
/// Transfer id, page index and page count before the data of a page.
const PAGE_HEADER: usize = 5;

/// Longest data of any frame.
const LONGEST: usize = 4086;
/// Longest data of a log that is read here, of which later versions may append fields.
const LONGEST_LOG: usize = 128;

/// Reflected polynomial 8408, initial value 0.
static CRC: Crc<u16> = Crc::<u16>::new(&CRC_16_KERMIT);

const UTC_TIME: u8 = 2;
const IMU_DATA: u8 = 3;
const EKF_EULER: u8 = 6;
const IMU_SHORT: u8 = 44;

/// A message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SbgMessage {
    /// SBG_ECOM_LOG_IMU_SHORT (44): the sensors at their own rate.
    ImuShort(ImuShort),
    /// SBG_ECOM_LOG_IMU_DATA (03): the sensors extrapolated to the main loop; deprecated.
    ImuData(ImuData),
    /// SBG_ECOM_LOG_UTC_TIME (02): device clock and UTC of one instant.
    Time(TimeReference),
    /// SBG_ECOM_LOG_EKF_EULER (06): attitude by the device's own filter.
    Euler(Euler),
    /// A good frame that is not read here: another log, a command, a page of a large frame.
    Other {
        /// Class, with bit 7 set for a page of a large frame.
        class: u8,
        /// Id within the class.
        id: u8,
    },
}

impl SbgMessage {
    /// Reads a frame.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] if it is none, [`BinaryFault::Short`] if fields are missing.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let ([_, _, id, class, _, _, data @ .., _, _, _], true) =
            (frame, look(frame) == Look::Frame(frame.len()))
        else {
            return Err(BinaryFault::Frame);
        };
        let mut fields = Reader::new(data);
        Ok(match (*class, *id) {
            (LOGS, IMU_SHORT) => SbgMessage::ImuShort(ImuShort::parse(&mut fields)?),
            (LOGS, IMU_DATA) => SbgMessage::ImuData(ImuData::parse(&mut fields)?),
            (LOGS, UTC_TIME) => SbgMessage::Time(TimeReference::parse(&mut fields)?),
            (LOGS, EKF_EULER) => SbgMessage::Euler(Euler::parse(&mut fields)?),
            (class, id) => SbgMessage::Other { class, id },
        })
    }

    /// The sample, if the message is one.
    #[must_use]
    pub fn reading(&self) -> Option<ImuReading> {
        match self {
            SbgMessage::ImuShort(short) => Some(short.reading()),
            SbgMessage::ImuData(data) => Some(data.reading()),
            SbgMessage::Time(_) | SbgMessage::Euler(_) | SbgMessage::Other { .. } => None,
        }
    }
}

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    let in_step = bytes.iter().zip(SYNC).all(|(found, sync)| *found == sync);
    if !in_step || bytes.get(3).is_some_and(|class| !is_class(*class)) {
        return Look::Nothing;
    }
    let Some([_, _, id, class, length @ ..]) = bytes.first_chunk::<HEADER>() else {
        return Look::More(bytes.len() + 1);
    };
    let length = usize::from(u16::from_le_bytes(*length));
    if length < shortest(*class) || length > longest(*class, *id) {
        return Look::Nothing;
    }
    let whole = HEADER + length + TRAILER;
    match bytes.get(..whole) {
        None => Look::More(whole),
        Some(frame) if is_sound(frame) => Look::Frame(whole),
        Some(_) => Look::Damaged,
    }
}

/// Whether the protocol has a class: logs, NMEA and third-party logs, commands.
fn is_class(class: u8) -> bool {
    matches!(class & !PAGED, 0x00..=0x05 | 0x10)
}

fn shortest(class: u8) -> usize {
    if class & PAGED == 0 { 0 } else { PAGE_HEADER }
}

/// A tight limit where it is known, so that one wrong byte in a length does not hold the stream up.
fn longest(class: u8, id: u8) -> usize {
    match (class, id) {
        (LOGS, UTC_TIME | IMU_DATA | EKF_EULER | IMU_SHORT) => LONGEST_LOG,
        _ => LONGEST,
    }
}

fn is_sound(frame: &[u8]) -> bool {
    let [_, _, covered @ .., low, high, END] = frame else {
        return false;
    };
    CRC.checksum(covered) == u16::from_le_bytes([*low, *high])
}

/// The frame of a log.
fn seal(id: u8, data: &Writer) -> Vec<u8> {
    let mut covered = Writer::new();
    covered.u8(id).u8(LOGS).le_u16(data.bytes().len() as u16).put(data.bytes());
    let mut frame = Writer::new();
    frame.put(&SYNC).put(covered.bytes()).le_u16(CRC.checksum(covered.bytes())).u8(END);
    frame.into_bytes()
}

/// The device's clock: microseconds since power-up, 32 bits.
fn device_time(time_stamp: u32) -> DeviceTime {
    DeviceTime { ticks: Wrapping { value: time_stamp.into(), modulus: 1 << 32 }, tick: 1e-6 }
}

/// Three floats.
fn vector(fields: &mut Reader<'_>) -> Result<[f64; 3], BinaryFault> {
    Ok([fields.le_f32()?.into(), fields.le_f32()?.into(), fields.le_f32()?.into()])
}

fn put_vector(fields: &mut Writer, vector: [f64; 3]) {
    for component in vector {
        fields.le_f32(component as f32);
    }
}

/// A float that later versions append: `None` if it is missing or NaN.
fn appended(fields: &mut Reader<'_>) -> Option<f64> {
    fields.le_f32().ok().map(f64::from).filter(|value| !value.is_nan())
}

fn put_appended(fields: &mut Writer, value: Option<f64>) {
    fields.le_f32(value.map_or(f32::NAN, |value| value as f32));
}
