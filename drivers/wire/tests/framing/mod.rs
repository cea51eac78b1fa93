//! Claims that every binary framing must meet, and hexadecimal goldens.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_wire::stream::{Cutter, Look, Protocol};
use proptest::prelude::*;
use proptest::sample::Index;

/// Bytes of pairs of hexadecimal digits; white space is ignored.
pub(crate) fn hex(text: &str) -> Vec<u8> {
    let digits: Vec<char> = text.chars().filter(|digit| !digit.is_whitespace()).collect();
    let byte = |pair: &[char]| u8::from_str_radix(&pair.iter().collect::<String>(), 16).unwrap();
    digits.chunks(2).map(byte).collect()
}

/// The frames of a protocol in a stream that comes in chunks.
pub(crate) fn cut<'a>(
    protocol: Protocol,
    chunks: impl IntoIterator<Item = &'a [u8]>,
) -> Vec<Vec<u8>> {
    let mut cutter = Cutter::new(&[protocol]);
    let mut frames = Vec::new();
    for chunk in chunks {
        cutter.push(chunk);
        while let Some(cut) = cutter.cut() {
            frames.push(cut.bytes.to_vec());
        }
    }
    frames
}

/// A stream of frames with noise between them, and places to split it.
pub(crate) fn stream(frames: Vec<Vec<u8>>) -> impl Strategy<Value = (Vec<u8>, Vec<Index>)> {
    let noise = prop::collection::vec(prop::num::u8::ANY, 0..12);
    let piece = (noise, prop::sample::select(frames));
    let stream = prop::collection::vec(piece, 1..6).prop_map(|pieces| {
        pieces.into_iter().flat_map(|(noise, frame)| [noise, frame].concat()).collect()
    });
    (stream, prop::collection::vec(any::<Index>(), 0..8))
}

/// Fails unless the splitting makes no difference to the frames.
pub(crate) fn assert_splitting_does_not_matter(protocol: Protocol, bytes: &[u8], places: &[Index]) {
    let mut places: Vec<usize> = places.iter().map(|place| place.index(bytes.len())).collect();
    places.extend([0, bytes.len()]);
    places.sort_unstable();
    let chunks = places.windows(2).map(|pair| &bytes[pair[0]..pair[1]]);
    let whole = cut(protocol, [bytes]);
    assert_eq!(cut(protocol, chunks), whole);
    assert_eq!(cut(protocol, bytes.chunks(1)), whole);
}

/// Fails unless a frame is found whole, is wanted byte by byte before, and is refused with any bit
/// turned over; the reader sees each of the damaged frames.
pub(crate) fn assert_frame_is_guarded(protocol: Protocol, frame: &[u8], reader: impl Fn(&[u8])) {
    assert_eq!(protocol.look(frame), Look::Frame(frame.len()));
    for end in 1..frame.len() {
        let look = protocol.look(&frame[..end]);
        let is_more =
            matches!(look, Look::More(wanted) if (end + 1..=frame.len()).contains(&wanted));
        assert!(is_more, "{end}: {look:?}");
        reader(&frame[..end]);
    }
    for bit in 0..frame.len() * 8 {
        let mut damaged = frame.to_vec();
        damaged[bit / 8] ^= 1 << (bit % 8);
        assert_ne!(protocol.look(&damaged), Look::Frame(frame.len()), "bit {bit}");
        reader(&damaged);
    }
}
