//! Telegrams of motion sensors in a stream, where nothing but their shape tells them from what is around them.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod motion_samples;

use insd_wire::motion::em::EmAttitude;
use insd_wire::motion::kmb::Kmb;
use insd_wire::stream::{Cutter, Protocol};
use motion_samples::EM;
use proptest::prelude::*;

/// Frames of a protocol in chunks of a size, and the bytes that were skipped.
fn cut(protocol: Protocol, bytes: &[u8], size: usize) -> (Vec<Vec<u8>>, u64) {
    let mut cutter = Cutter::new(&[protocol]);
    let mut frames = Vec::new();
    for chunk in bytes.chunks(size.max(1)) {
        cutter.push(chunk);
        while let Some(cut) = cutter.cut() {
            frames.push(cut.bytes.to_vec());
        }
    }
    (frames, cutter.skipped())
}

#[test]
fn telegrams_one_after_the_other_are_all_found_whatever_the_chunks() {
    let em = EM.write();
    let unknown = EmAttitude { roll: None, pitch: None, heave: None, heading: None, ..EM }.write();
    let stream = [&em[..], &unknown, b"\x90\x90junk", &em].concat();
    for size in 1..30 {
        let (frames, skipped) = cut(Protocol::Em3000, &stream, size);
        assert_eq!(frames, [em, unknown, em]);
        assert_eq!(skipped, 6);
    }
}

#[test]
fn km_binary_is_found_between_other_bytes() {
    let telegram = std::fs::read("../../fuzz/corpus/kmb/telegrams.kmb").unwrap();
    let whole = telegram.get(..132).unwrap();
    assert!(Kmb::read(whole).is_ok());
    let stream = [b"#KMB\x84\0\x02", whole, b"#KM", whole].concat();
    for size in [1, 7, 132, 500] {
        assert_eq!(cut(Protocol::Kmb, &stream, size).0, [whole, whole]);
    }
}

#[test]
fn tss1_is_found_between_other_lines_and_cut_telegrams() {
    let whole: &[u8] = b":1A4770 -0016H 0429 -0680\r\n";
    for cut_at in 0..whole.len() {
        let stream =
            [&whole[..cut_at], whole, b":BI,+1,+2,+3,+4,A\r\n$HEHDT,1.0,T\r\n", whole].concat();
        for size in [1, 7, 100] {
            assert_eq!(cut(Protocol::Tss1, &stream, size).0, [whole, whole], "{cut_at}");
        }
    }
}

#[test]
fn random_bytes_hold_next_to_no_telegram_of_em3000() {
    let mut state = 1_u64;
    let mut byte = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 56) as u8
    };
    let noise: Vec<u8> = (0..1_000_000).map(|_| byte()).collect();
    let (frames, _) = cut(Protocol::Em3000, &noise, 4096);
    assert!(frames.len() < 10, "{}", frames.len());
}

proptest! {
    #[test]
    fn flipped_telegrams_never_hide_the_one_behind_the_next(bit in 0..80_usize) {
        let mut flipped = EM.write();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let stream = [flipped, EM.write(), EM.write()].concat();
        let (frames, _) = cut(Protocol::Em3000, &stream, 10);
        prop_assert_eq!(frames.last().map(Vec::as_slice), Some(&EM.write()[..]));
    }
}
