//! Frames of UBX, SBF, RTCM3 and NMEA mixed: the chunks do not matter, and no bytes whatever panic.

use insd_wire::gnss::{rtcm, sbf, ubx};
use insd_wire::stream::{Cutter, Look, Protocol};
use proptest::prelude::*;

/// Reads whatever the bytes may be with every reader.
fn read_all(bytes: &[u8]) {
    let _ = rtcm::Frame::open(bytes).map(|frame| frame.number());
    let _ = ubx::UbxMessage::read(bytes).map(|message| (message.part(), message.pulse()));
    let _ = sbf::SbfMessage::read(bytes).map(|message| (message.part(), message.pulse()));
}

/// Protocol, start and bytes of the frames in some chunks.
fn frames(chunks: &[&[u8]]) -> Vec<(Protocol, u64, Vec<u8>)> {
    let mut cutter = Cutter::new(&Protocol::ALL);
    let mut found = Vec::new();
    for chunk in chunks {
        cutter.push(chunk);
        while let Some(cut) = cutter.cut() {
            found.push((cut.protocol, cut.end - cut.bytes.len() as u64, cut.bytes.to_vec()));
        }
    }
    found
}

fn bytes(longest: usize) -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 0..longest)
}

/// The messages that we read, by class and id.
const UBX: [(u8, u8); 16] = [
    (0x01, 0x07),
    (0x01, 0x04),
    (0x01, 0x36),
    (0x01, 0x14),
    (0x01, 0x20),
    (0x01, 0x26),
    (0x0D, 0x01),
    (0x02, 0x15),
    (0x02, 0x13),
    (0x01, 0x02),
    (0x01, 0x03),
    (0x01, 0x06),
    (0x01, 0x12),
    (0x01, 0x21),
    (0x01, 0x3C),
    (0x0A, 0x09),
];

/// The blocks that we read.
const SBF: [u16; 10] = [4006, 4028, 4007, 5906, 5908, 5938, 5939, 5914, 5911, 4027];

/// One frame of any protocol with a good checksum.
fn frame() -> impl Strategy<Value = Vec<u8>> {
    let ubx = (prop::sample::select(UBX.to_vec()), bytes(120))
        .prop_map(|((class, id), payload)| ubx::Frame { class, id, payload: &payload }.write());
    let sbf = (prop::sample::select(SBF.to_vec()), 0..8_u8, bytes(120))
        .prop_map(|(id, revision, payload)| sbf::Frame { id, revision, payload: &payload }.write());
    let rtcm = bytes(120).prop_filter("no number fits", |message| message.len() != 1);
    let rtcm = rtcm.prop_map(|message| rtcm::Frame { message: &message }.write());
    prop_oneof![ubx, sbf, rtcm, Just(b"$HETHS,316.70,E*1A\r\n".to_vec())]
}

proptest! {
    #[test]
    fn the_same_bytes_give_the_same_frames_in_any_splitting(
        parts in prop::collection::vec(prop_oneof![3 => frame(), 1 => bytes(12)], 1..12),
        size in 1..40_usize,
    ) {
        let stream = parts.concat();
        let whole = frames(&[&stream]);
        prop_assert_eq!(&whole, &frames(&stream.chunks(size).collect::<Vec<_>>()));
        for (_, _, bytes) in &whole {
            read_all(bytes);
        }
    }

    #[test]
    fn frames_one_after_the_other_are_all_found(
        parts in prop::collection::vec(frame(), 1..12),
    ) {
        let found = frames(&[&parts.concat()]);
        let whole: Vec<Vec<u8>> = parts.iter().map(|part| {
            part.strip_suffix(b"*1A\r\n").map_or_else(|| part.clone(), |line| [line, b"*1A"].concat())
        }).collect();
        prop_assert_eq!(found.into_iter().map(|one| one.2).collect::<Vec<_>>(), whole);
    }

    #[test]
    fn a_frame_with_a_flipped_bit_is_no_frame_and_panics_nobody(
        good in frame(), at: prop::sample::Index, bit in 0..8_u8,
    ) {
        let mut bad = good;
        let at = at.index(bad.len());
        bad[at] ^= 1 << bit;
        read_all(&bad);
        prop_assert!(ubx::Frame::open(&bad).is_err());
        prop_assert!(sbf::Frame::open(&bad).is_err());
        prop_assert!(rtcm::Frame::open(&bad).is_err());
    }

    #[test]
    fn a_look_at_a_beginning_says_what_a_look_at_more_says(
        stream in prop_oneof![bytes(40), frame()], more in bytes(40),
    ) {
        let longer = [stream.clone(), more].concat();
        for protocol in [Protocol::Ubx, Protocol::Sbf, Protocol::Rtcm] {
            for end in 1..=stream.len() {
                match protocol.look(&stream[..end]) {
                    Look::More(wanted) => prop_assert!(wanted > end),
                    told => prop_assert_eq!(told, protocol.look(&longer)),
                }
            }
        }
    }

    #[test]
    fn arbitrary_bytes_never_panic_a_reader(noise in bytes(300)) {
        read_all(&noise);
        frames(&[&noise]);
    }
}

#[test]
fn noise_does_not_hold_up_the_stream() {
    for (start, end) in [(&b"\xB5\x62\x01\x07\xFF\xFF"[..], 0), (b"$@\0\0\0\0\xFF\xFF", 0)] {
        assert_eq!(ubx::look(start), Look::Nothing, "{end}");
        assert_eq!(sbf::look(start), Look::Nothing);
    }
    assert_eq!(sbf::look(b"$@\0\0\0\0\x11\0"), Look::Nothing);
    assert_eq!(rtcm::look(b"\xD3\x04"), Look::Nothing);
    for byte in (0..=u8::MAX).filter(|byte| !b"\xB5$\xD3".contains(byte)) {
        for look in [ubx::look, sbf::look, rtcm::look] {
            assert_eq!(look(&[byte]), Look::Nothing);
        }
    }
}

#[test]
fn a_block_whose_checksum_looks_like_an_end_of_line_is_no_sentence() {
    let block =
        |count: u32| sbf::Frame { id: 4007, revision: 2, payload: &count.to_le_bytes() }.write();
    let odd = (0..).map(block).find(|block| block[2] == b'\r');
    let odd = odd.unwrap_or_default();
    assert_eq!(frames(&[&odd[..5], &odd[5..]]), [(Protocol::Sbf, 0, odd)]);
}
