//! What must hold for any frames at the reader of CAN IMUs, with shipped tables and with any. The replay
//! of seeds and the fuzz target share it.
//!
//! The first byte chooses the table modulo 6: those that are shipped, one that is made from the bytes so
//! that it can be used (3, 4), or one of any fields (5); the next says how many frames such a table has,
//! then comes the table:
//!
//! ```text
//! frame   identifier of two bytes (bit 15: of 29 bits), number of fields and, in bit 7, optional
//! field   what, start, width, flags (signed, big endian, exponent, missing, modulus, mask, expected),
//!         a power of two of the scale, offset
//! ```
//!
//! Then come frames: which of the table, time since the one before in ms and, from 200 on, in s; how many
//! bytes, and the bytes.

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // helpers of tests are not seen as tests

use insd_base::can::{CanFrame, CanId};
use insd_base::{Span, Time};
use insd_wire::imu::ImuReading;
use insd_wire::imu::can::{
    ByteOrder, CanImu, CanLayout, CanPart, Field, FrameLayout, Shipped, What,
};

/// Time from sample to sample, s.
const INTERVAL: f64 = 0.01;

/// All parts of a sample, those of motion first: rate, force, angle, velocity, turn.
const WHAT: [What; 27] = [
    What::RateX,
    What::RateY,
    What::RateZ,
    What::AccelX,
    What::AccelY,
    What::AccelZ,
    What::AngleX,
    What::AngleY,
    What::AngleZ,
    What::VelocityX,
    What::VelocityY,
    What::VelocityZ,
    What::TurnW,
    What::TurnX,
    What::TurnY,
    What::TurnZ,
    What::Time,
    What::Counter,
    What::Temperature,
    What::Status,
    What::Year,
    What::Month,
    What::Day,
    What::Hour,
    What::Minute,
    What::Second,
    What::Fraction,
];
/// Of these the first that are no motion.
const REST: usize = 16;

/// Samples with shipped tables, with own tables that have no faults, and valid ones.
pub(crate) type Made = [usize; 3];

/// Reads the frames that the bytes say, by the table that they say.
pub(crate) fn everything(bytes: &[u8]) -> Made {
    let mut bytes = Taker(bytes);
    let choice = bytes.byte();
    let layout = match choice % 6 {
        0 => Shipped::Xsens.layout(),
        1 => Shipped::XsensIncrements.layout(),
        2 => Shipped::Sbg.layout(),
        3 | 4 => usable(&mut bytes),
        _ => any(&mut bytes),
    };
    let sound = layout.faults().is_empty();
    assert!(sound || choice % 6 > 2);
    let mut imu = CanImu::new(&layout, INTERVAL);
    let (mut made, mut valid, mut now, mut taken) = (0_u64, 0, Time::START, 0);
    while !bytes.0.is_empty() {
        let (frame, step) = one(&layout, &mut bytes);
        now = now + step;
        taken += 1;
        let Some(Ok(CanPart::Sample { reading, begun })) = frame.map(|frame| imu.take(&frame, now))
        else {
            continue;
        };
        assert!(begun <= now);
        is_sane(&reading, sound);
        drop(layout.write(&reading, INTERVAL));
        made += 1;
        valid += usize::from(reading.valid);
    }
    assert!(imu.incomplete() + made <= taken);
    let made = made as usize;
    if choice % 6 < 3 { [made, 0, valid] } else { [0, made * usize::from(sound), valid] }
}

/// Whether a sample is valid only with numbers, and has no others beside.
fn is_sane(reading: &ImuReading, sound: bool) {
    assert!(!reading.valid || reading.motion.is_finite(), "{reading:?}");
    assert!(reading.temperature.is_none_or(f64::is_finite), "{reading:?}");
    if let (Some(time), true) = (reading.device_time, sound) {
        assert!(time.tick.is_finite() && time.tick > 0.0 && time.ticks.modulus > 1, "{reading:?}");
    }
    assert!(reading.counter.is_none_or(|count| count.modulus > 1 || !sound), "{reading:?}");
}

/// The next frame, and the time since the one before.
fn one(layout: &CanLayout, bytes: &mut Taker<'_>) -> (Option<CanFrame>, Span) {
    let (which, step, length) = (bytes.byte(), bytes.byte(), bytes.byte());
    let seconds = if step < 200 { f64::from(step) * 1e-3 } else { f64::from(step - 199) };
    let data: Vec<u8> = (0..length % 9).map(|_| bytes.byte()).collect();
    let frames = layout.frames.iter().cycle().take(64);
    let id = frames.map(FrameLayout::can_id).nth(usize::from(which & 63)).flatten();
    let id = id.filter(|_| which < 0xF0).unwrap_or(CanId::Standard(which.into()));
    (CanFrame::new(id, &data), Span::from_seconds(seconds))
}

/// A table of any fields.
fn any(bytes: &mut Taker<'_>) -> CanLayout {
    let count = bytes.byte() % 9;
    let frame = |_| {
        let (high, low, more) = (bytes.byte(), bytes.byte(), bytes.byte());
        let fields = (0..more % 9).map(|_| {
            let what = WHAT[usize::from(bytes.byte()) % WHAT.len()];
            field(what, bytes)
        });
        let fields = fields.collect();
        let id = u32::from(u16::from_be_bytes([high & 0x7F, low]));
        FrameLayout { id, extended: high >> 7 == 1, optional: more >> 7 == 1, fields }
    };
    CanLayout { frames: (0..count).map(frame).collect() }
}

/// A table with all parts of a motion, each in a place where it fits, and some others.
fn usable(bytes: &mut Taker<'_>) -> CanLayout {
    let how = bytes.byte();
    let turn: &[What] = match how % 3 {
        0 => &WHAT[0..3],
        1 => &WHAT[6..9],
        _ => &WHAT[12..16],
    };
    let force = if how >> 2 & 1 == 0 { &WHAT[3..6] } else { &WHAT[9..12] };
    let rest = (0..how >> 3 & 7).map(|_| WHAT[REST + usize::from(bytes.byte()) % 11]);
    let mut rest: Vec<What> = rest.collect();
    let clock = rest.iter().position(|what| *what == What::Time);
    let mut place = 0;
    rest.retain(|what| {
        place += 1;
        *what != What::Time || clock == Some(place - 1)
    });
    let parts: Vec<What> = turn.iter().chain(force).copied().chain(rest).collect();
    let each = 1 + usize::from(how >> 6);
    let frames = (0_u32..).zip(parts.chunks(each)).map(|(id, parts)| {
        let fields = parts.iter().map(|what| fitting(&field(*what, bytes))).collect();
        let extended = bytes.byte() & 1 == 1;
        let vital = parts.iter().any(|what| WHAT[..=REST].contains(what));
        FrameLayout { id, extended, optional: !vital && bytes.byte() & 1 == 1, fields }
    });
    CanLayout { frames: frames.collect() }
}

/// A field as the bytes say.
fn field(what: What, bytes: &mut Taker<'_>) -> Field {
    let (start, width, flags) = (bytes.byte(), bytes.byte(), bytes.byte());
    let power = f64::from(bytes.byte() as i8) * 8.0;
    let offset = f64::from(bytes.byte() as i8) * power.exp2();
    let mut number = |bit: u8| {
        (flags >> bit & 1 == 1).then(|| (0..2).fold(0, |sum, _| sum << 8 | u64::from(bytes.byte())))
    };
    Field {
        signed: flags & 1 == 1,
        order: if flags & 2 == 0 { ByteOrder::Little } else { ByteOrder::Big },
        scale: (power / 16.0).exp2(),
        offset,
        exponent: number(2).map(|start| start as u8),
        missing: number(3),
        modulus: number(4),
        mask: number(5),
        expected: number(6),
        ..Field::new(what, start, width)
    }
}

/// The field moved to where a frame has room for it, with numbers that a table may have.
fn fitting(field: &Field) -> Field {
    let width = 1 + field.width % 64;
    let offset = if field.offset.is_finite() { field.offset } else { 0.0 };
    Field {
        start: field.start % (65 - width),
        width,
        signed: field.signed && field.what != What::Time,
        offset,
        exponent: field.exponent.map(|start| start % 57),
        modulus: field.modulus.filter(|modulus| *modulus > 1),
        ..*field
    }
}

/// Bytes one after the other, and zeros behind them.
struct Taker<'a>(&'a [u8]);

impl Taker<'_> {
    fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }
}
