//! Fast packets: messages of up to 223 bytes in frames of eight.
//!
//! Byte 0 of each frame is the sequence counter (3 bits, the upper) and the number of the frame (5
//! bits). Frame 0 has the length of the message in byte 1 and its first six bytes; each later frame
//! has seven more, and the last is filled up with 0xFF. The layout and the table of groups are those
//! of canboat.json 8. Of a group of the range 126976 to 130815 that the table does not name nobody
//! can say by its number whether it is a fast packet: it is taken for a single frame.

use std::collections::BTreeMap;

use insd_base::can::CanFrame;

use crate::{BROADCAST, N2kId};

/// The longest message that a fast packet carries, bytes.
pub const MAX_LENGTH: usize = 223;

/// Bytes of the message in frame 0.
const FIRST: usize = 6;
/// Bytes of the message in each later frame.
const LATER: usize = 7;
/// Frames before the counter in their first byte overflows.
pub(crate) const MAX_FRAMES: u8 = 32;

/// Groups of the mixed range that are fast packets, in order.
#[rustfmt::skip]
const FAST: [u32; 121] = [
    126_983, 126_984, 126_985, 126_986, 126_987, 126_988, 126_996, 126_998, 127_233, 127_237,
    127_489, 127_490, 127_491, 127_494, 127_495, 127_496, 127_497, 127_498, 127_503, 127_504,
    127_506, 127_507, 127_509, 127_510, 127_511, 127_512, 127_513, 127_514, 128_275, 128_520,
    128_538, 129_029, 129_038, 129_039, 129_040, 129_041, 129_044, 129_045, 129_284, 129_285,
    129_301, 129_302, 129_538, 129_540, 129_541, 129_542, 129_545, 129_547, 129_549, 129_551,
    129_556, 129_792, 129_793, 129_794, 129_795, 129_796, 129_797, 129_798, 129_799, 129_800,
    129_801, 129_802, 129_803, 129_804, 129_805, 129_806, 129_807, 129_808, 129_809, 129_810,
    129_811, 129_812, 129_813, 129_814, 129_815, 129_816, 130_052, 130_053, 130_054, 130_060,
    130_061, 130_064, 130_065, 130_066, 130_067, 130_068, 130_069, 130_070, 130_071, 130_072,
    130_073, 130_074, 130_320, 130_321, 130_322, 130_323, 130_324, 130_329, 130_330, 130_561,
    130_562, 130_563, 130_564, 130_565, 130_566, 130_567, 130_568, 130_569, 130_570, 130_571,
    130_572, 130_573, 130_574, 130_575, 130_577, 130_578, 130_580, 130_581, 130_583, 130_584,
    130_586,
];

/// Whether the group is sent as fast packets, whatever its length.
#[must_use]
pub fn is_fast(pgn: u32) -> bool {
    match pgn {
        126_208..=126_975 | 130_816..=131_071 => true,
        126_976..=130_815 => FAST.binary_search(&pgn).is_ok(),
        _ => false,
    }
}

/// How many frames a message of this length takes as a fast packet.
#[must_use]
pub fn frames(length: usize) -> usize {
    1 + length.saturating_sub(FIRST).div_ceil(LATER)
}

/// Which bytes of the message frame `index` carries: the first and how many.
pub(crate) fn piece(index: u8, length: usize) -> (usize, usize) {
    match usize::from(index) {
        0 => (0, length.min(FIRST)),
        index => {
            let first = FIRST + (index - 1) * LATER;
            (first, length.saturating_sub(first).min(LATER))
        }
    }
}

/// Frame `index` of a fast packet; `None` if the message is too long or has no such frame.
#[must_use]
pub fn frame(id: N2kId, data: &[u8], sequence: u8, index: u8) -> Option<CanFrame> {
    if data.len() > MAX_LENGTH || usize::from(index) >= frames(data.len()) {
        return None;
    }
    let (first, count) = piece(index, data.len());
    let mut bytes = Vec::with_capacity(8);
    bytes.push(sequence << 5 | index);
    if index == 0 {
        bytes.push(data.len() as u8);
    }
    bytes.extend_from_slice(data.get(first..first + count)?);
    bytes.resize(8, BROADCAST);
    CanFrame::new(id.compose(), &bytes)
}

/// The frames of a message: one, or those of a fast packet; `None` if it is too long.
#[must_use]
pub fn split(id: N2kId, data: &[u8], sequence: u8) -> Option<Vec<CanFrame>> {
    if !is_fast(id.pgn) {
        return CanFrame::new(id.compose(), data).map(|frame| vec![frame]);
    }
    let count = u8::try_from(frames(data.len())).ok()?;
    (0..count).map(|index| frame(id, data, sequence, index)).collect()
}

/// The sequence counters of one sender, one for each group.
#[derive(Clone, Debug, Default)]
pub struct Sequences(BTreeMap<u32, u8>);

impl Sequences {
    /// The counter of the group's next message: 0 to 7, and again.
    pub fn next(&mut self, pgn: u32) -> u8 {
        let counter = self.0.entry(pgn).or_insert(7);
        *counter = (*counter + 1) & 7;
        *counter
    }

    /// The message that got the group's last counter was not sent after all: the next one gets it.
    pub(crate) fn give_back(&mut self, pgn: u32) {
        if let Some(counter) = self.0.get_mut(&pgn) {
            *counter = (*counter + 7) & 7;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn id(pgn: u32) -> N2kId {
        N2kId { priority: 6, pgn, source: 1, destination: BROADCAST }
    }

    #[test]
    fn the_table_is_in_order() {
        assert!(FAST.is_sorted());
        for (pgn, fast) in [
            (60_928, false),
            (65_300, false),
            (126_208, true),
            (126_720, true),
            (126_992, false),
            (126_996, true),
            (127_250, false),
            (129_029, true),
            (130_306, false),
            (130_578, true),
            (130_850, true),
        ] {
            assert_eq!(is_fast(pgn), fast, "{pgn}");
        }
    }

    #[test]
    fn a_message_fills_as_many_frames_as_the_standard_says() {
        let counts = [(0, 1), (6, 1), (7, 2), (13, 2), (14, 3), (43, 7), (134, 20), (223, 32)];
        for (length, count) in counts {
            assert_eq!(frames(length), count, "{length} bytes");
            assert_eq!(split(id(126_996), &vec![0; length], 0).unwrap().len(), count);
        }
        assert_eq!(split(id(126_996), &[0; 224], 0), None);
        assert_eq!(split(id(127_250), &[0; 9], 0), None);
    }

    #[test]
    fn frames_carry_counter_length_and_padding() {
        let data: Vec<u8> = (1..=9).collect();
        let frames = split(id(129_029), &data, 5).unwrap();
        assert_eq!(frames[0].data(), [0xA0, 9, 1, 2, 3, 4, 5, 6]);
        assert_eq!(frames[1].data(), [0xA1, 7, 8, 9, 255, 255, 255, 255]);
    }

    #[test]
    fn each_group_has_its_own_counter() {
        let mut sequences = Sequences::default();
        let first: Vec<u8> = (0..9).map(|_| sequences.next(129_029)).collect();
        assert_eq!(first, [0, 1, 2, 3, 4, 5, 6, 7, 0]);
        assert_eq!(sequences.next(126_996), 0);
    }
}
