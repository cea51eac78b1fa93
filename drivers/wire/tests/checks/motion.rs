//! What must hold for any bytes as telegrams of motion sensors. The tests and the fuzz target share it.

#![allow(clippy::unwrap_used, clippy::expect_used, dead_code)] // helpers of tests are not seen as tests

use std::fmt::Debug;

use insd_wire::motion::em::{self, EmAttitude};
use insd_wire::motion::kmb::{self, Kmb};
use insd_wire::motion::seapath::{LENGTH_23, LENGTH_26, Seapath23, Seapath26};
use insd_wire::motion::tss1::{self, Tss1};

/// All checks: the bytes as they are, and as the contents of good frames.
pub(crate) fn everything(bytes: &[u8]) {
    as_any_telegram(bytes);
    assert!(EmAttitude::read(&em_frame(bytes)).is_ok());
    assert!(Tss1::read(&tss1_frame(bytes)).is_ok());
    // a fraction below a second, or most frames would be refused for it
    let mut fine = bytes.to_vec();
    fine.iter_mut().skip(6).take(1).for_each(|high| *high &= 0x1F);
    let frames: [&[u8]; 5] = [
        &em_frame(bytes),
        &tss1_frame(bytes),
        &kmb_frame(bytes),
        &seapath_frame::<LENGTH_23>([0xAA, 0x51], &fine),
        &seapath_frame::<LENGTH_26>([0xAA, 0x55], &fine),
    ];
    frames.into_iter().for_each(as_any_telegram);
}

/// No reader panics; what one reads can be written, and reads the same again.
fn as_any_telegram(bytes: &[u8]) {
    again(bytes, Tss1::read, Tss1::write);
    again(bytes, EmAttitude::read, |telegram| Some(telegram.write()));
    again(bytes, Seapath23::read, Seapath23::write);
    again(bytes, Seapath26::read, Seapath26::write);
    // the conversion of a double between degrees and radians may change its last bit
    if let Some((first, second)) = written_twice(bytes, Kmb::read, Kmb::write) {
        let (place, again_place) = (&first[20..36], &second[20..36]);
        assert_eq!((&first[..20], &first[36..]), (&second[..20], &second[36..]));
        for (place, again) in place.chunks_exact(8).zip(again_place.chunks_exact(8)) {
            let [place, again] = [place, again].map(|d| f64::from_le_bytes(d.try_into().unwrap()));
            assert!((place - again).abs() <= 1e-13, "{place} {again}");
        }
    }
}

fn again<T: Debug, E: Debug, const N: usize>(
    bytes: &[u8],
    read: impl Fn(&[u8]) -> Result<T, E>,
    write: impl Fn(&T) -> Option<[u8; N]>,
) {
    if let Some((first, second)) = written_twice(bytes, read, write) {
        assert_eq!(first, second);
    }
}

fn written_twice<T: Debug, E: Debug, const N: usize>(
    bytes: &[u8],
    read: impl Fn(&[u8]) -> Result<T, E>,
    write: impl Fn(&T) -> Option<[u8; N]>,
) -> Option<([u8; N], [u8; N])> {
    let telegram = read(bytes).ok()?;
    let first = write(&telegram).expect("what was read can be written");
    let second = write(&read(&first).expect("what was written can be read"));
    Some((first, second.expect("and written again")))
}

/// The first bytes, and zeros behind them.
fn padded<const N: usize>(bytes: &[u8]) -> [u8; N] {
    let mut frame = [0; N];
    frame.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
    frame
}

fn em_frame(bytes: &[u8]) -> [u8; em::LENGTH] {
    let mut frame: [u8; em::LENGTH] = padded(bytes);
    frame[0] = if frame[0] < 0x80 { 0x90 + frame[0] % 0x20 } else { 0 };
    frame[1] = 0x90;
    frame
}

fn tss1_frame(bytes: &[u8]) -> [u8; tss1::LENGTH] {
    let mut frame = *b":XXXXXX SDDDDLSDDDD SDDDD\r\n";
    let letters = b"UuGgHhFf";
    for (place, byte) in frame.iter_mut().zip(padded::<{ tss1::LENGTH }>(bytes)) {
        match place {
            b'X' => *place = b"0123456789ABCDEF"[usize::from(byte % 16)],
            b'D' => *place = b'0' + byte % 10,
            b'S' => *place = if byte < 128 { b' ' } else { b'-' },
            b'L' => *place = letters[usize::from(byte % 8)],
            _ => {}
        }
    }
    frame
}

fn kmb_frame(bytes: &[u8]) -> [u8; kmb::LENGTH] {
    let mut frame: [u8; kmb::LENGTH] = padded(bytes);
    frame[..8].copy_from_slice(b"#KMB\x84\x00\x01\x00");
    frame[15] &= 0x1F; // nanoseconds
    frame
}

/// A frame with a good checksum, computed another way than by the library.
pub(crate) fn seapath_frame<const N: usize>(header: [u8; 2], bytes: &[u8]) -> [u8; N] {
    let mut frame: [u8; N] = padded(bytes);
    frame[..2].copy_from_slice(&header);
    let mut crc = 0xFFFF_u16;
    for byte in &frame[2..N - 2] {
        crc ^= u16::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 0 { crc >> 1 } else { crc >> 1 ^ 0x8408 };
        }
    }
    frame[N - 2..].copy_from_slice(&(!crc).to_le_bytes());
    frame
}
