//! What must hold for any bytes of any protocol. The replay of corpora and the fuzz targets share it.

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // helpers of tests are not seen as tests

mod again;
mod behind;
pub(crate) mod good;

use insd_wire::describe::describe;
use insd_wire::stream::{Cutter, Protocol};

/// What a cutter made of a stream: protocol, bytes and end of each frame, then the bytes skipped and
/// the frames damaged.
pub(crate) type Found = (Vec<(Protocol, Vec<u8>, u64)>, u64, u64);

/// The protocol's reader, and all that is made of what it has read.
pub(crate) fn read(protocol: Protocol, frame: &[u8]) {
    drop(describe(protocol, frame));
    behind::look(protocol, frame);
}

/// All checks of one protocol: the bytes as a stream, and as the contents of good frames.
pub(crate) fn everything(protocol: Protocol, bytes: &[u8]) {
    // the last byte, which belongs to the stream as well, chooses the size of the chunks
    let size = bytes.last().map_or(1, |last| 1 + usize::from(*last));
    any_splitting(&[protocol], bytes, size);
    for frame in good::frames(protocol, bytes) {
        any_splitting(&[protocol], &frame, size);
    }
}

/// All checks of all protocols in one cutter: the bytes as a stream, and pieces of them, each of which
/// begins with the number of a protocol and a length, in good frames one behind the other.
pub(crate) fn everything_mixed(mut bytes: &[u8]) {
    let size = bytes.last().map_or(1, |last| 1 + usize::from(*last));
    any_splitting(&Protocol::ALL, bytes, size);
    let mut stream = Vec::new();
    while let [number, length, rest @ ..] = bytes {
        let (own, rest) = rest.split_at(rest.len().min(usize::from(*length)));
        bytes = rest;
        match Protocol::ALL.get(usize::from(*number) % (Protocol::ALL.len() + 1)) {
            Some(protocol) => stream.extend(good::frames(*protocol, own).concat()),
            None => stream.extend(own),
        }
    }
    any_splitting(&Protocol::ALL, &stream, size);
}

/// Cuts a stream that comes in chunks, and reads every frame.
pub(crate) fn cut<'a>(protocols: &[Protocol], chunks: impl Iterator<Item = &'a [u8]>) -> Found {
    let mut cutter = Cutter::new(protocols);
    let mut frames = Vec::new();
    for chunk in chunks {
        cutter.push(chunk);
        drain(&mut cutter, &mut frames);
    }
    while cutter.is_waiting() {
        cutter.give_up();
        drain(&mut cutter, &mut frames);
    }
    (frames, cutter.skipped(), cutter.damaged())
}

fn drain(cutter: &mut Cutter, frames: &mut Vec<(Protocol, Vec<u8>, u64)>) {
    while let Some(cut) = cutter.cut() {
        read(cut.protocol, cut.bytes);
        frames.push((cut.protocol, cut.bytes.to_vec(), cut.end));
    }
}

/// Cuts a stream as a whole and in chunks of a size, and compares. Gives what was found.
pub(crate) fn any_splitting(protocols: &[Protocol], bytes: &[u8], size: usize) -> Found {
    let whole = cut(protocols, std::iter::once(bytes));
    let split = cut(protocols, bytes.chunks(size.max(1)));
    assert!(whole == split, "chunks of {size} bytes give other frames");
    frames_stand_in_the_stream(&whole, bytes);
    whole
}

/// Every frame is a piece of the stream, behind the one before; nothing is counted twice.
fn frames_stand_in_the_stream((frames, skipped, _): &Found, bytes: &[u8]) {
    let mut last = 0;
    let mut framed = 0;
    for (_, frame, end) in frames {
        let end = usize::try_from(*end).unwrap();
        let start = end.checked_sub(frame.len()).unwrap();
        assert!(start >= last && !frame.is_empty(), "frames overlap at byte {start}");
        assert!(bytes.get(start..end) == Some(frame), "no such frame at byte {start}");
        last = end;
        framed += frame.len() as u64;
    }
    assert!(framed + skipped <= bytes.len() as u64, "bytes are counted twice");
}
