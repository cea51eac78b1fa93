//! Lines in a stream: TAG blocks, datagrams, splitting, damage.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::UtcTime;
use insd_wire::gnss;
use insd_wire::nmea::{
    ChecksumPolicy, DATAGRAM_HEADER, Frame, HeadingMode, MAX_DATAGRAM, NmeaLine, Sentence,
    TagBlock, TagGroup, Talker, Ths, datagram, datagrams, others,
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

/// Blocks of lines in groups of so many; none is no group.
fn blocks(groups: &[u16]) -> Vec<TagBlock<'static>> {
    let of_group = |(id, lines): (u32, &u16)| {
        let lines = *lines;
        (1..=lines.max(1)).map(move |line| TagBlock {
            source: Some("IN0001"),
            group: (lines > 0).then_some(TagGroup { line, lines, id }),
            ..TagBlock::default()
        })
    };
    (1..).zip(groups).flat_map(of_group).collect()
}

#[test]
fn a_group_that_no_datagram_can_hold_is_not_written() {
    let ths = Ths { heading: None, mode: HeadingMode::NotValid }.write(Talker::HE);
    let lines =
        |groups: &[u16]| blocks(groups).into_iter().map(|block| (block, &ths)).collect::<Vec<_>>();
    assert_eq!(datagrams(&lines(&[60])), None);
    assert_eq!(datagrams(&[]), Some(Vec::new()));
    let two = datagrams(&lines(&[30, 30])).unwrap();
    assert_eq!(two.len(), 2);
    assert!(two.iter().all(|bytes| bytes.windows(3).filter(|three| three == b"THS").count() == 30));
}

proptest! {
    #[test]
    fn lines_are_packed_into_few_datagrams_and_no_group_is_split(
        groups in prop::collection::vec(prop_oneof![Just(0_u16), 2..=9_u16], 0..60),
    ) {
        let ths = Ths { heading: Some(1.0), mode: HeadingMode::Autonomous }.write(Talker::HE);
        let blocks = blocks(&groups);
        let lines: Vec<_> = blocks.iter().map(|block| (*block, &ths)).collect();
        let packed = datagrams(&lines).unwrap();
        let mut told = Vec::new();
        for bytes in &packed {
            prop_assert!(bytes.len() <= MAX_DATAGRAM && bytes.starts_with(DATAGRAM_HEADER));
            let (found, skipped, damaged) = cut(&[bytes]);
            prop_assert_eq!((skipped, damaged), (0, 0));
            let tags: Vec<_> =
                found.iter().map(|line| Frame::parse(line).unwrap().tag().unwrap().group).collect();
            let first = tags.first().copied().flatten().map_or(1, |group| group.line);
            let last = tags.last().copied().flatten().map_or((1, 1), |group| (group.line, group.lines));
            prop_assert_eq!((first, last.0), (1, last.1));
            told.extend(tags);
        }
        prop_assert_eq!(told, blocks.iter().map(|block| block.group).collect::<Vec<_>>());
        let longest_group = 9 * (lines.first().map_or(0, |(block, line)| {
            block.write().len() + 9 + line.as_bytes().len()
        }));
        for pair in packed.windows(2) {
            prop_assert!(pair[0].len() + longest_group > MAX_DATAGRAM, "a datagram is half empty");
        }
    }

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
        let ths: NmeaLine = Ths { heading: Some(heading), mode: HeadingMode::Autonomous }.write(Talker::HE);
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
