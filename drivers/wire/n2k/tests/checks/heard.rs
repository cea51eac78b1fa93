//! Frames of others, made of any bytes: as they come, or shaped so that they are nearly right.

use insd_base::can::{CanFrame, CanId};
use insd_n2k::pgn::Known;
use insd_n2k::{N2kId, Name, fast_packet};

/// Groups of network management, groups that nobody here knows, and one that is longer than a frame
/// but no fast packet. Those of [`Known`] stand behind them.
const GROUPS: [u32; 14] = [
    59_392, 59_904, 60_160, 60_416, 60_928, 61_184, 65_240, 65_280, 126_208, 126_464, 126_720,
    126_993, 126_996, 126_998,
];

/// The group of a number.
pub(crate) fn group(number: u8) -> u32 {
    let mut groups = GROUPS.iter().chain(Known::PGNS);
    let count = GROUPS.len() + Known::PGNS.len();
    groups.nth(usize::from(number) % count).copied().unwrap_or_default()
}

/// A frame of four bytes of identifier and data. The lowest bit of the first byte that has no place in
/// an identifier of 29 bits says whether it has 11.
pub(crate) fn frame(bytes: &[u8]) -> Option<CanFrame> {
    let (id, data) = bytes.split_first_chunk::<4>()?;
    let bits = u32::from_be_bytes(*id);
    let short = bits >> 29 & 1 == 1;
    let id = if short {
        CanId::Standard(bits as u16 & CanId::MAX_STANDARD)
    } else {
        CanId::Extended(bits & CanId::MAX_EXTENDED)
    };
    CanFrame::new(id, data.get(..data.len().min(8))?)
}

/// A frame of a group from a source.
pub(crate) fn single(pgn: u32, source: u8, destination: u8, data: &[u8]) -> Option<CanFrame> {
    let id = N2kId { priority: 6, pgn, source, destination };
    CanFrame::new(id.compose(), data.get(..data.len().min(8))?)
}

/// The frames of a whole message: group, source, destination and priority, data. `own` is the address
/// of the node.
pub(crate) fn message(bytes: &[u8], own: u8) -> Option<Vec<CanFrame>> {
    let ([number, source, way], data) = bytes.split_first_chunk()?;
    let id = N2kId {
        priority: way & 7,
        pgn: group(*number),
        source: *source,
        destination: if way & 8 == 0 { own } else { 255 },
    };
    let longest = if fast_packet::is_fast(id.pgn) { fast_packet::MAX_LENGTH } else { 8 };
    fast_packet::split(id, data.get(..data.len().min(longest))?, way >> 4)
}

/// The same with one or two frames left out, doubled or exchanged, as the first byte says.
pub(crate) fn damaged(bytes: &[u8], own: u8) -> Option<Vec<CanFrame>> {
    let (how, bytes) = bytes.split_first()?;
    let mut frames = message(bytes, own)?;
    let at = usize::from(how >> 2) % frames.len().max(1);
    match how & 3 {
        0 => drop(frames.remove(at)),
        1 => frames.insert(at, *frames.get(at)?),
        2 => {
            let next = (at + 1) % frames.len();
            frames.swap(at, next);
        }
        _ => frames.truncate(at),
    }
    Some(frames)
}

/// A message by the transport protocol of ISO 11783-3, to everybody or to one: how it is damaged, group,
/// source, contents. The sender waits for nobody.
pub(crate) fn transfer(bytes: &[u8], destination: u8) -> Option<Vec<CanFrame>> {
    let ([how, number, source], data) = bytes.split_first_chunk()?;
    let packets = data.len().div_ceil(7) as u8;
    let [low, high] = (data.len() as u16).to_le_bytes();
    let [pgn_low, pgn_middle, pgn_high, _] = group(*number).to_le_bytes();
    let kind = if destination == 255 { 32 } else { 16 };
    let claimed = packets.wrapping_add(how >> 6 & 1);
    let head = [kind, low, high, claimed, how | 1, pgn_low, pgn_middle, pgn_high];
    let mut frames = vec![single(60_416, *source, destination, &head)?];
    for (number, piece) in (1_u8..).zip(data.chunks(7)) {
        let number =
            if how >> 7 == 1 && number == how & 63 { number.wrapping_add(1) } else { number };
        let packet: Vec<u8> = std::iter::once(number).chain(piece.iter().copied()).collect();
        frames.push(single(60_160, *source, destination, &packet)?);
    }
    Some(frames)
}

/// A group function to the node: which and whether it asks everybody, group, source, contents.
pub(crate) fn function(bytes: &[u8], own: u8) -> Option<Vec<CanFrame>> {
    let ([what, number, source], contents) = bytes.split_first_chunk()?;
    let [low, middle, high, _] = group(*number).to_le_bytes();
    let mut data = vec![what & 7, low, middle, high];
    data.extend_from_slice(contents);
    data.truncate(fast_packet::MAX_LENGTH);
    let destination = if what & 8 == 0 { own } else { 255 };
    let id = N2kId { priority: 3, pgn: 126_208, source: *source, destination };
    fast_packet::split(id, &data, what >> 4)
}

/// A claim: source, NAME.
pub(crate) fn claim(bytes: &[u8]) -> Option<CanFrame> {
    let (source, name) = bytes.split_first()?;
    single(60_928, *source, 255, name)
}

/// Claims of as many nodes from an address on, with one NAME after the other.
pub(crate) fn crowd(bytes: &[u8]) -> Vec<CanFrame> {
    let [count, first, name @ ..] = bytes else { return Vec::new() };
    let base = name.iter().take(8).fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte));
    let one = |at: u8| {
        let name = Name::new(base.wrapping_add(at.into()));
        single(60_928, first.wrapping_add(at), 255, &name.bytes())
    };
    (0..*count).filter_map(one).collect()
}
