//! Lines in a stream: TAG blocks, datagrams, splitting, damage.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::UtcTime;
use insd_wire::gnss;
use insd_wire::nmea::{
    ChecksumPolicy, Frame, HeadingMode, Line, Sentence, TagBlock, TagGroup, Talker, Ths, datagram,
    others,
};
use insd_wire::stream::{Cutter, Protocol};
use proptest::prelude::*;

/// Lines of several kinds with what may stand between them.
const STREAM: &[u8] =
    b"\xB5\x62UdPbC\0\\s:IN0001,n:1*06\\$HETHS,316.70,A*1E\r\nUdPb$TIROT,1.0,A*2D\r\n\
\\s:IN0001,n:2*06\\$HETHS,316.70,A*1E\r\n\\g:1-2-34*59\\\r\n$GPGGA,,,,,,0,,,,,,,,*66\r\n\
$HETHS,316.71,E*1A\r\n$HETHS,316.70,E\r\n\\s:IN0001*xx$PSXN,20,0,0,0,0*3B\r\n\\";

fn cut(chunks: &[&[u8]]) -> (Vec<Vec<u8>>, u64, u64) {
    let mut cutter = Cutter::new(&[Protocol::Nmea]);
    let mut found = Vec::new();
    for chunk in chunks {
        cutter.push(chunk);
        while let Some(cut) = cutter.cut() {
            found.push(cut.bytes.to_vec());
        }
    }
    (found, cutter.skipped(), cutter.damaged())
}

/// Everything that reads a line.
fn read_in_every_way(bytes: &[u8]) {
    let _ = others::kind(bytes);
    if let Ok(frame) = Frame::parse_with(bytes, ChecksumPolicy::Optional) {
        let _ = frame.tag();
        if let Ok(sentence) = Sentence::read_frame(&frame) {
            let _ = gnss::nmea::part(&sentence);
            let _ = sentence.write(Talker::IN);
        }
    }
}

#[test]
fn a_damaged_tag_block_costs_itself_and_not_its_sentence() {
    let (found, _, damaged) = cut(&[STREAM]);
    let lines: Vec<_> = found.iter().map(|bytes| String::from_utf8_lossy(bytes)).collect();
    let expected = [
        "\\s:IN0001,n:1*06\\$HETHS,316.70,A*1E",
        "$HETHS,316.70,A*1E",
        "$GPGGA,,,,,,0,,,,,,,,*66",
        "$HETHS,316.70,E",
        "$PSXN,20,0,0,0,0*3B",
    ];
    assert_eq!(lines, expected);
    assert_eq!(damaged, 3, "the second TAG block, ROT and the second THS");
}

#[test]
fn a_sentence_without_checksum_is_for_the_policy_of_its_port() {
    let line = b"$HETHS,316.70,E\r\n";
    assert!(Frame::parse(line).is_err());
    let frame = Frame::parse_with(line, ChecksumPolicy::Optional).unwrap();
    assert!(matches!(Sentence::read_frame(&frame), Ok(Sentence::Ths(_))));
}

#[test]
fn the_same_bytes_give_the_same_lines_in_any_splitting() {
    let whole = cut(&[STREAM]);
    for at in 0..STREAM.len() {
        assert_eq!(cut(&[&STREAM[..at], &STREAM[at..]]), whole, "{at}");
    }
    let single: Vec<&[u8]> = STREAM.chunks(1).collect();
    assert_eq!(cut(&single), whole);
}

#[test]
fn a_datagram_that_is_too_long_is_not_written() {
    let ths = Ths { heading: None, mode: HeadingMode::NotValid }.write(Talker::HE);
    let block = TagBlock { source: Some("IN0001"), ..TagBlock::default() };
    assert!(datagram(&vec![(block, &ths); 40]).is_some());
    assert_eq!(datagram(&vec![(block, &ths); 60]), None);
}

proptest! {
    #[test]
    fn tag_blocks_and_sentences_come_back_from_a_datagram(
        source in prop::option::of("[A-Z]{2}[0-9]{4}"), line in prop::option::of(1..=999_u16),
        group in prop::option::of((1..=9_u16, 0..=9_u16, 0..=999_999_u32)),
        millis in prop::option::of(100_000_000_000..9_000_000_000_000_i64), heading in 0.0..6.2_f64,
    ) {
        let block = TagBlock {
            source: source.as_deref(), destination: None, line, text: None,
            group: group.map(|(line, more, id)| TagGroup { line, lines: line + more, id }),
            time: millis.map(|millis| UtcTime::from_nanos(millis * 1_000_000)),
        };
        let ths: Line = Ths { heading: Some(heading), mode: HeadingMode::Autonomous }.write(Talker::HE);
        let bytes = datagram(&[(block, &ths), (block, &ths)]).unwrap();
        let (found, skipped, damaged) = cut(&[&bytes]);
        prop_assert_eq!((found.len(), skipped, damaged), (2, 0, 0));
        for bytes in &found {
            let frame = Frame::parse(bytes).unwrap();
            prop_assert_eq!(frame.tag().unwrap_or_default(), block);
            prop_assert_eq!(Sentence::read(bytes).unwrap(), Sentence::read(ths.as_bytes()).unwrap());
        }
    }

    #[test]
    fn random_and_flipped_bytes_never_panic_and_never_depend_on_the_chunks(
        noise in prop::collection::vec(any::<u8>(), 0..200), at in 0..STREAM.len(), bit in 0..8_u8,
        split in 0..STREAM.len(),
    ) {
        let mut bytes = STREAM.to_vec();
        bytes[at] ^= 1 << bit;
        let whole = cut(&[&bytes]);
        prop_assert_eq!(&cut(&[&bytes[..split], &bytes[split..]]), &whole);
        for bytes in whole.0.iter().chain([&noise, &bytes]) {
            read_in_every_way(bytes);
        }
        let split = split.min(noise.len());
        prop_assert_eq!(cut(&[&noise]), cut(&[&noise[..split], &noise[split..]]));
    }

    #[test]
    fn arbitrary_fields_under_a_good_checksum_never_panic_the_readers(
        name in prop::sample::select(Sentence::NAMES), tag in "|\\\\s:[ -~]{0,9}",
        fields in prop::collection::vec("[ -)+-~]{0,12}|[0-9.,+-]{0,12}|[A-Z]|", 0..24),
    ) {
        let talker = if name.starts_with('P') && name.len() > 3 { "" } else { "IN" };
        let text = format!("{talker}{name},{}", fields.join(","));
        let sum = insd_wire::nmea::checksum(text.as_bytes());
        read_in_every_way(format!("${text}*{sum:02X}\r\n").as_bytes());
        read_in_every_way(format!("{tag}${text}*{sum:02X}\r\n").as_bytes());
    }

    #[test]
    fn what_is_read_is_written_so_that_it_reads_the_same(
        name in prop::sample::select(Sentence::NAMES),
        fields in prop::collection::vec("[0-9]{1,3}[.][0-9]|[0-9]|[AVENSWMTKN]|", 2..20),
    ) {
        let talker = if name.starts_with('P') && name.len() > 3 { "" } else { "IN" };
        let text = format!("{talker}{name},{}", fields.join(","));
        let sum = insd_wire::nmea::checksum(text.as_bytes());
        let Ok((_, sentence)) = Sentence::read(format!("${text}*{sum:02X}").as_bytes()) else {
            return Ok(());
        };
        let once = sentence.write(Talker::IN);
        let (_, again) = Sentence::read(once.as_bytes()).unwrap();
        prop_assert_eq!(again.write(Talker::IN), once);
    }
}
