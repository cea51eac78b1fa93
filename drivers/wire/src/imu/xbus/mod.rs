//! Xsens (Movella) Xbus: messages of MTi devices, of which MTData2 is read.
//!
//! Source: the maker's MT Low-Level Communication Protocol Documentation (MT0101P). Framing and the
//! items of [`MtData2`] were verified against recordings of an MTi device in all four number formats
//! (testdata of github.com/einride/xsens-go, MIT), but for the coordinate systems NED and NWU.
//!
//! A message is FA FF, id, length (FF: a u16 length follows), data, and a byte that makes the sum of
//! all bytes after FA zero; big endian. Readers never panic, whatever the bytes.

mod mtdata2;
mod number;

use crate::binary::Writer;
use crate::stream::Look;

pub use mtdata2::{FINE_DAY, FINE_U32, MtData2, Orientation, Status, Utc, XbusAxes};
pub use number::Precision;

const PREAMBLE: [u8; 2] = [0xFA, 0xFF];
/// Message id of MTData2.
const MTDATA2: u8 = 0x36;
/// Length byte that says that a u16 length follows.
const EXTENDED: u8 = 0xFF;
const EXTENDED_HEADER: usize = 6;
const HEADER: usize = 4;
/// Most data of one message, by the maker's document.
const LONGEST: usize = 2048;
/// Identifier and size before the data of an item.
const ITEM_HEADER: usize = 3;

/// What stands at the start of some bytes.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    if !bytes.iter().zip(PREAMBLE).all(|(found, byte)| *found == byte) {
        return Look::Nothing;
    }
    match *bytes {
        [_, _, id, EXTENDED, high, low, ..] => {
            let length = usize::from(u16::from_be_bytes([high, low]));
            if (usize::from(EXTENDED)..=LONGEST).contains(&length) {
                message(bytes, id, EXTENDED_HEADER, length)
            } else {
                Look::Nothing
            }
        }
        [_, _, id, length, ..] if length != EXTENDED => {
            message(bytes, id, HEADER, usize::from(length))
        }
        _ => Look::More(bytes.len() + 1),
    }
}

fn message(bytes: &[u8], id: u8, header: usize, length: usize) -> Look {
    let end = header + length;
    let seen = bytes.get(header..end.min(bytes.len())).unwrap_or_default();
    let needed = if id == MTDATA2 { walk(seen, length) } else { Some(length) };
    match (needed, bytes.get(..=end)) {
        (None, _) => Look::Nothing,
        (Some(needed), _) if needed > seen.len() => Look::More(header + needed),
        (_, None) => Look::More(end + 1),
        (_, Some(whole)) if is_sound(whole) => Look::Frame(end + 1),
        (_, Some(_)) => Look::Damaged,
    }
}

/// Walks over the items of MTData2 with `length` bytes, of which some are seen. Gives the bytes that
/// are needed to see the next item's header, or all of them after the last; `None` if the items do
/// not fill the message, so that a false start is given up early.
fn walk(seen: &[u8], length: usize) -> Option<usize> {
    let mut at = 0;
    while at < length {
        if at + ITEM_HEADER > length {
            return None;
        }
        let Some(size) = seen.get(at + ITEM_HEADER - 1) else {
            return Some(at + ITEM_HEADER);
        };
        at += ITEM_HEADER + usize::from(*size);
    }
    (at == length).then_some(length)
}

fn is_sound(whole: &[u8]) -> bool {
    whole.iter().skip(1).fold(0_u8, |sum, byte| sum.wrapping_add(*byte)) == 0
}

/// Id and data of a message that [`look`] holds for whole.
fn open(whole: &[u8]) -> Option<(u8, &[u8])> {
    if look(whole) != Look::Frame(whole.len()) {
        return None;
    }
    match whole {
        [_, _, id, EXTENDED, _, _, data @ .., _] | [_, _, id, _, data @ .., _] => Some((*id, data)),
        _ => None,
    }
}

/// A message of at most 254 bytes of data.
fn seal(id: u8, data: &Writer) -> Vec<u8> {
    let mut whole = Writer::new();
    whole.put(&PREAMBLE).u8(id).u8(data.bytes().len() as u8).put(data.bytes());
    let sum = whole.bytes().iter().skip(1).fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
    whole.u8(sum.wrapping_neg());
    whole.into_bytes()
}
