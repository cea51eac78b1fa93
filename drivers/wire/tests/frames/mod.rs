//! What the tests of all binary formats need.

#![allow(clippy::unwrap_used, dead_code)] // each test file uses its part of it

use insd_wire::stream::{Cutter, Look, Protocol};
use proptest::prelude::*;
use proptest::sample::Index;

/// The bytes of hexadecimal digits, white space left out.
pub(crate) fn bytes_of_hex(text: &str) -> Vec<u8> {
    let digits: Vec<u8> = text.bytes().filter(u8::is_ascii_hexdigit).collect();
    let pair = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
    digits.chunks(2).map(pair).collect()
}

/// All frames of some bytes.
pub(crate) fn cut_all(protocol: Protocol, bytes: &[u8]) -> Vec<Vec<u8>> {
    cut_chunks(protocol, [bytes]).0
}

fn cut_chunks<'a>(
    protocol: Protocol,
    chunks: impl IntoIterator<Item = &'a [u8]>,
) -> (Vec<Vec<u8>>, u64, u64) {
    let mut cutter = Cutter::new(&[protocol]);
    let mut frames = Vec::new();
    for chunk in chunks {
        cutter.push(chunk);
        while let Some(cut) = cutter.cut() {
            frames.push(cut.bytes.to_vec());
        }
    }
    (frames, cutter.skipped(), cutter.damaged())
}

/// Checks that chunks of these sizes, in turn, give the frames that the whole gives.
pub(crate) fn is_split_anyhow(protocol: Protocol, bytes: &[u8], sizes: &[usize]) {
    let mut chunks = Vec::new();
    let mut rest = bytes;
    for size in sizes.iter().cycle() {
        if rest.is_empty() {
            break;
        }
        let (chunk, after) = rest.split_at(rest.len().min(*size));
        chunks.push(chunk);
        rest = after;
    }
    assert_eq!(cut_chunks(protocol, chunks), cut_chunks(protocol, [bytes]));
}

/// Sizes of chunks.
pub(crate) fn sizes() -> impl Strategy<Value = Vec<usize>> {
    prop::collection::vec(1_usize..80, 1..8)
}

/// Bits to turn over: where and which.
pub(crate) fn flips() -> impl Strategy<Value = Vec<(usize, u8)>> {
    prop::collection::vec((any::<usize>(), 0_u8..8), 0..6)
}

/// Any bytes.
pub(crate) fn noise() -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 0..300)
}

/// Checks that neither noise nor a frame with some bits turned over makes a look or reader panic, and
/// that a look never claims more than there is.
pub(crate) fn is_robust(
    protocol: Protocol,
    frame: &[u8],
    flips: &[(usize, u8)],
    noise: &[u8],
    read: impl Fn(&[u8]),
) {
    let mut damaged = frame.to_vec();
    for (at, bit) in flips {
        let at = at % damaged.len();
        damaged[at] ^= 1 << bit;
    }
    let behind_header = [&frame[..frame.len().min(6)], noise].concat();
    for bytes in [&damaged[..], noise, &behind_header, &damaged[..damaged.len() / 2]] {
        read(bytes);
        if bytes.is_empty() {
            continue;
        }
        match protocol.look(bytes) {
            Look::Frame(length) | Look::Filler(length) => {
                assert!((1..=bytes.len()).contains(&length));
            }
            Look::More(wanted) => assert!(wanted > bytes.len()),
            Look::Damaged | Look::Nothing => {}
        }
        cut_all(protocol, bytes).iter().for_each(|frame| read(frame));
    }
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
    let whole = cut_all(protocol, bytes);
    assert_eq!(cut_chunks(protocol, chunks).0, whole);
    assert_eq!(cut_chunks(protocol, bytes.chunks(1)).0, whole);
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
