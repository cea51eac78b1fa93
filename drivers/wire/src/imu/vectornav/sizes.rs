//! How many bytes each field of each group has.

/// A group: the sizes of its fields by their bits, bytes; zero of one that is not known.
type Sizes = &'static [u8];

/// The groups by their bits: common, time, IMU, GNSS 1, attitude, INS, GNSS 2. A field without a size has one that it tells itself
/// (satellites, raw measurements): messages with it are not framed.
const GROUPS: [Sizes; 7] = [
    &[8, 8, 8, 12, 16, 12, 24, 12, 12, 24, 20, 28, 2, 4, 8],
    &[8, 8, 8, 2, 8, 8, 8, 4, 4, 1],
    &[2, 12, 12, 12, 4, 4, 16, 12, 12, 12, 12, 2, 40],
    GNSS,
    &[2, 12, 16, 36, 12, 12, 12, 12, 12, 12, 28, 24, 12, 4],
    &[2, 24, 24, 12, 12, 12, 12, 12, 12, 4, 4],
    GNSS,
];
const GNSS: Sizes = &[8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28];

/// A field by its group and its bit in it.
pub(super) type Field = (u8, u8);

/// What follows a header.
pub(super) enum Layout {
    /// The header ends behind so many bytes more.
    More(usize),
    /// There is none such.
    None,
    /// Bytes of the header behind the start, and the fields with their sizes, bytes.
    Known(usize, Vec<(Field, usize)>),
}

/// The fields of a message whose start is taken off.
pub(super) fn layout(bytes: &[u8]) -> Layout {
    let Some((groups, masks)) = bytes.split_first() else { return Layout::More(1) };
    if *groups == 0 || groups & 0x80 != 0 {
        return Layout::None;
    }
    let mut fields = Vec::new();
    let mut masks = masks.chunks(2);
    let mut header = 1;
    for group in (0..7_u8).filter(|group| groups >> group & 1 == 1) {
        header += 2;
        let Some([low, high]) = masks.next() else { return Layout::More(header) };
        let mask = u16::from_le_bytes([*low, *high]);
        let sizes = GROUPS[usize::from(group)];
        if mask == 0 || mask >> 15 == 1 {
            return Layout::None;
        }
        for bit in (0..15_u8).filter(|bit| mask >> bit & 1 == 1) {
            match sizes.get(usize::from(bit)) {
                Some(size) => fields.push(((group, bit), usize::from(*size))),
                None => return Layout::None,
            }
        }
    }
    Layout::Known(header, fields)
}
