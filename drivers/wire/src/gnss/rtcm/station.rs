//! 1005 and 1006: where the antenna of the base is.
//!
//! Layout: RTCM 10403.3, the contents of 1005 and 1006 (DF003, DF025 to DF028).

use super::super::bits::{Bits, Field};
use crate::binary::Fault;

/// Numbers of the messages, without and with the height of the antenna.
pub(super) const NUMBERS: [u16; 2] = [1005, 1006];

const STATION: Field = Field::count(12, 12);
const POSITION: [Field; 3] =
    [Field::signed(34, 38, 1e-4), Field::signed(74, 38, 1e-4), Field::signed(114, 38, 1e-4)];
const HEIGHT: Field = Field::unsigned(152, 16, 1e-4);

/// Bits of 1005.
const LENGTH: usize = 152;

/// A base station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseStation {
    /// Its number.
    pub station: u16,
    /// Reference point of its antenna, ECEF in the frame of its network, m.
    pub position: [f64; 3],
    /// Height of the antenna above the mark, m, of which 1005 says nothing.
    pub height: Option<f64>,
}

/// Reads the message.
pub(super) fn read(number: u16, bits: &Bits) -> Result<BaseStation, Fault> {
    let has_height = number == NUMBERS[1];
    let length = if has_height { LENGTH + 16 } else { LENGTH };
    if bits.len() < length {
        return Err(Fault::Short { needed: length.div_ceil(8), found: bits.len() / 8 });
    }
    Ok(BaseStation {
        station: STATION.raw(bits) as u16,
        position: POSITION.map(|field| field.value(bits)),
        height: has_height.then(|| HEIGHT.value(bits)),
    })
}
