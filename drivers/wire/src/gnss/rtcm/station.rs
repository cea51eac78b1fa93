//! 1005 and 1006: where the antenna of the base is.
//!
//! Layout: RTCM 10403.3, the contents of 1005 and 1006 (DF003, DF025 to DF028).

use super::super::bits::{Bits, Field};
use super::NUMBER;
use super::frame::Frame;
use crate::binary::BinaryFault;

/// Numbers of the messages, without and with the height of the antenna.
pub(super) const NUMBERS: [u16; 2] = [1005, 1006];

const STATION: Field = Field::count(12, 12);
const POSITION: [Field; 3] =
    [Field::signed(34, 38, 1e-4), Field::signed(74, 38, 1e-4), Field::signed(114, 38, 1e-4)];
const HEIGHT: Field = Field::unsigned(LENGTH, HEIGHT_LENGTH, 1e-4);

/// Bits of 1005, and of the height that 1006 has behind them.
const LENGTH: usize = 152;
const HEIGHT_LENGTH: usize = 16;

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

impl BaseStation {
    /// The frame: 1006 where the height of the antenna is known, else 1005. Systems that it serves are not told.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let (number, length) = match self.height {
            None => (NUMBERS[0], LENGTH),
            Some(_) => (NUMBERS[1], LENGTH + HEIGHT_LENGTH),
        };
        let mut bits = Bits::zeros(length);
        NUMBER.put_raw(&mut bits, number.into());
        STATION.put_raw(&mut bits, self.station.into());
        for (field, axis) in POSITION.iter().zip(self.position) {
            field.put(&mut bits, axis);
        }
        if let Some(height) = self.height {
            HEIGHT.put(&mut bits, height);
        }
        Frame { message: bits.bytes() }.write()
    }
}

/// Reads the message.
pub(super) fn read(number: u16, bits: &Bits) -> Result<BaseStation, BinaryFault> {
    let has_height = number == NUMBERS[1];
    let length = if has_height { LENGTH + HEIGHT_LENGTH } else { LENGTH };
    if bits.len() < length {
        return Err(BinaryFault::Short { needed: length.div_ceil(8), found: bits.len() / 8 });
    }
    Ok(BaseStation {
        station: STATION.raw(bits) as u16,
        position: POSITION.map(|field| field.value(bits)),
        height: has_height.then(|| HEIGHT.value(bits)),
    })
}
