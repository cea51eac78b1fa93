//! Blocks of a telegram, one behind the other, and which of them there are.

use crate::binary::Writer;

/// Masks and blocks in the making. Blocks must come in the order of their bits; a place is the number
/// of the mask (navigation, extended, external) and the bit.
#[derive(Debug, Default)]
pub(super) struct Composer {
    pub(super) masks: [u32; 3],
    pub(super) body: Writer,
}

impl Composer {
    /// Begins a block and says where to write it.
    pub(super) fn block(&mut self, (mask, bit): (usize, u32)) -> &mut Writer {
        if let Some(mask) = self.masks.get_mut(mask) {
            *mask |= 1 << bit;
        }
        &mut self.body
    }

    pub(super) fn floats<const N: usize>(
        &mut self,
        place: (usize, u32),
        values: Option<[f64; N]>,
        units: [f64; N],
    ) {
        if let Some(values) = values {
            let block = self.block(place);
            for (value, unit) in values.iter().zip(units) {
                block.be_f32((value / unit) as f32);
            }
        }
    }

    pub(super) fn words<const N: usize>(&mut self, place: (usize, u32), words: Option<[u32; N]>) {
        if let Some(words) = words {
            let block = self.block(place);
            for word in words {
                block.be_u32(word);
            }
        }
    }
}
