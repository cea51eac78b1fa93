//! What goes over the ship's network, to which group and with which TAG block.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::collections::HashSet;

use insd_base::{Span, Time, UtcTime};
use insd_output::{
    Content, Datagram, Lan, LanConfig, MessageKind, OutputPortConfig, Port, PortMessage, Rate, Sfi,
    Talker, TransmissionGroup,
};
use insd_wire::nmea::{
    DATAGRAM_HEADER, Frame, HeadingMode, MAX_DATAGRAM, NmeaLine, Psxn, Sentence, TagBlock, Ths, Txt,
};
use proptest::prelude::*;

fn config() -> LanConfig {
    LanConfig {
        source: Sfi::new("IN0001").unwrap(),
        groups: Vec::new(),
        time: false,
        single: false,
    }
}

fn kind(name: &str) -> MessageKind {
    MessageKind::named(name).unwrap()
}

fn message(name: &str, lines: Vec<NmeaLine>) -> PortMessage {
    let slot = MessageKind::all().position(|own| own.name() == name).unwrap();
    PortMessage {
        slot: u16::try_from(slot).unwrap(),
        kind: kind(name),
        content: Content::Lines(lines),
        utc: None,
        valid: Time::START,
        period: Span::from_nanos(1_000_000_000),
    }
}

fn ths(degrees: f64) -> NmeaLine {
    Ths { heading: Some(degrees.to_radians()), mode: HeadingMode::Autonomous }.write(Talker::HE)
}

fn heading() -> PortMessage {
    message("THS", vec![ths(316.7)])
}

fn text(lines: usize) -> PortMessage {
    let sentences = Txt::message(2, &"x".repeat(lines * Txt::ROOM));
    message("TXT", sentences.iter().map(|sentence| sentence.write(Talker::IN)).collect())
}

/// The lines of a datagram, with their TAG blocks.
fn lines(bytes: &[u8]) -> Vec<(TagBlock<'_>, &str)> {
    let text = std::str::from_utf8(bytes.strip_prefix(DATAGRAM_HEADER).unwrap()).unwrap();
    let lines = text.split_inclusive("\r\n");
    let parted = lines.map(|line| {
        let tag = Frame::parse(line.as_bytes()).unwrap().tag().unwrap();
        (tag, line.rsplit_once('\\').unwrap().1)
    });
    parted.collect()
}

fn text_of(datagram: &Datagram) -> &str {
    std::str::from_utf8(&datagram.bytes).unwrap()
}

#[test]
fn the_published_datagram_leaves_byte_for_byte() {
    let datagrams = Lan::new(config()).datagrams(&[heading()], None);
    let [datagram] = &datagrams[..] else { panic!("{datagrams:?}") };
    assert_eq!(text_of(datagram), "UdPbC\0\\s:IN0001,n:1*06\\$HETHS,316.70,A*1E\r\n");
    assert_eq!(datagram.group.address(), [239, 192, 0, 3]);
    assert_eq!(datagram.group.port(), 60_003);
}

#[test]
fn the_time_of_validity_goes_along_where_it_is_asked_for_and_known() {
    let mut lan = Lan::new(LanConfig { time: true, ..config() });
    let mut sent = |nanos: Option<i64>| {
        let utc = nanos.map(UtcTime::from_nanos);
        text_of(&lan.datagrams(&[heading()], utc)[0])[6..].split('*').next().unwrap().to_owned()
    };
    assert_eq!(sent(None), "\\s:IN0001,n:1");
    assert_eq!(sent(Some(1_795_000_000_000_000_000)), "\\s:IN0001,n:2,c:1795000000");
    assert_eq!(sent(Some(1_795_000_000_100_000_000)), "\\s:IN0001,n:3,c:1795000000100");
}

#[test]
fn lines_are_counted_over_all_groups_up_to_999_and_from_1_again() {
    let mut lan = Lan::new(config());
    let mut counts = Vec::new();
    for _ in 0..334 {
        let messages = [heading(), message("GGA", vec![ths(1.0)]), heading()];
        for datagram in lan.datagrams(&messages, None) {
            counts.extend(lines(&datagram.bytes).iter().map(|(tag, _)| tag.line.unwrap()));
        }
    }
    assert_eq!(counts[..4], [1, 2, 3, 4]);
    assert_eq!(counts[997..1002], [998, 999, 1, 2, 3]);
}

#[test]
fn the_lines_of_one_message_are_a_tag_group_in_one_datagram() {
    let mut lan = Lan::new(config());
    for id in (1..=99).chain(1..=2) {
        let datagrams = lan.datagrams(&[text(3), message("GGA", vec![ths(1.0)])], None);
        let tags: Vec<_> = lines(&datagrams[0].bytes).iter().map(|(tag, _)| tag.group).collect();
        let places: Vec<_> =
            tags.iter().flatten().map(|tag| (tag.line, tag.lines, tag.id)).collect();
        assert_eq!(places, [(1, 3, id), (2, 3, id), (3, 3, id)]);
        assert!(text_of(&datagrams[0]).contains(&format!("\\g:1-3-{id},s:IN0001,n:")));
    }
}

#[test]
fn a_tag_group_that_does_not_fit_behind_others_begins_a_datagram() {
    let mut lan = Lan::new(config());
    let datagrams = lan.datagrams(&[text(7), text(7), text(2)], None);
    let places = |datagram: &Datagram| -> Vec<(u16, u16)> {
        let tags = lines(&datagram.bytes);
        tags.iter().filter_map(|(tag, _)| tag.group).map(|tag| (tag.line, tag.lines)).collect()
    };
    let whole: Vec<(u16, u16)> = (1..=7).map(|line| (line, 7)).collect();
    assert_eq!(places(&datagrams[0]), whole);
    assert_eq!(places(&datagrams[1]), [whole.as_slice(), &[(1, 2), (2, 2)]].concat());
    assert_eq!(datagrams.len(), 2);
}

#[test]
fn each_sentence_has_its_own_datagram_where_that_is_asked_for() {
    let mut lan = Lan::new(LanConfig { single: true, ..config() });
    let datagrams = lan.datagrams(&[heading(), text(2), heading()], None);
    assert_eq!(datagrams.len(), 4);
    assert!(datagrams.iter().all(|datagram| lines(&datagram.bytes).len() == 1));
    let slots: HashSet<u16> = datagrams.iter().map(|datagram| datagram.slot).collect();
    assert_eq!(slots.len(), 3, "two lines of the text, and the heading that is the same");
}

#[test]
fn a_message_goes_where_it_is_configured_to_go() {
    let groups = vec![(kind("THS"), TransmissionGroup::Usr3)];
    let mut lan = Lan::new(LanConfig { groups, ..config() });
    let psxn = message("PSXN.20", vec![ths(1.0)]);
    let groups: Vec<_> = lan.datagrams(&[psxn, heading()], None).iter().map(|d| d.group).collect();
    assert_eq!(groups, [TransmissionGroup::Satd, TransmissionGroup::Usr3]);
}

#[test]
fn the_groups_of_a_port_are_those_of_its_talkers() {
    let lan =
        Lan::new(LanConfig { groups: vec![(kind("ROT"), TransmissionGroup::Usr1)], ..config() });
    let rate = Rate::from_hertz(1.0);
    let kinds = ["PSXN.23", "ZDA", "GGA", "HDT", "ROT", "XDR"];
    let port = Port::new(OutputPortConfig {
        messages: kinds.map(|name| (kind(name), rate)).to_vec(),
        talkers: vec![
            (kind("ZDA"), Talker::new("ZA").unwrap()),
            (kind("PSXN.23"), Talker::IN),
            (kind("XDR"), Talker::new("II").unwrap()),
        ],
        ..OutputPortConfig::default()
    });
    use TransmissionGroup::{Misc, Navd, Prop, Satd, Time, Usr1};
    assert_eq!(lan.groups(&port), [Misc, Satd, Navd, Time, Prop, Usr1]);
}

#[test]
fn a_binary_telegram_is_not_sent_and_counted() {
    let mut lan = Lan::new(config());
    let binary = PortMessage { content: Content::Binary(vec![0, 0x90]), ..heading() };
    assert_eq!(lan.datagrams(&[binary.clone(), heading(), binary], None).len(), 1);
    assert_eq!(lan.unsent(), 2);
}

#[test]
fn only_datagrams_with_the_same_messages_share_a_slot() {
    let mut lan = Lan::new(config());
    let gga = message("GGA", vec![ths(1.0)]);
    let mut slots = |messages: &[PortMessage]| -> Vec<u16> {
        lan.datagrams(messages, None).iter().map(|datagram| datagram.slot).collect()
    };
    let (alone, both) = (slots(&[heading()]), slots(&[heading(), gga.clone()]));
    assert_ne!(alone, both);
    assert_ne!(alone, slots(std::slice::from_ref(&gga)));
    assert_eq!(both, slots(&[heading(), gga]));
    assert_eq!(alone, slots(&[heading()]));
}

#[test]
fn slots_stay_few_however_many_sets_of_messages_there_are() {
    let mut lan = Lan::new(config());
    for slot in 0..5000 {
        let usual = lan.datagrams(&[heading()], None)[0].slot;
        assert_eq!(usual, 0, "what is always sent keeps its slot");
        let other =
            lan.datagrams(&[PortMessage { slot: 10_000 + slot, ..heading() }], None)[0].slot;
        assert!((1..1024).contains(&other), "{other}");
    }
}

#[test]
fn a_datagram_is_as_old_as_its_oldest_message_and_due_with_its_most_frequent() {
    let mut lan = Lan::new(config());
    let fast = PortMessage { period: Span::from_nanos(1000), ..heading() };
    let old = PortMessage { valid: Time::from_nanos(-5), ..heading() };
    let [datagram] = &lan.datagrams(&[fast, old], None)[..] else { panic!() };
    assert_eq!((datagram.valid, datagram.period.as_nanos()), (Time::from_nanos(-5), 1000));
}

fn any_line() -> impl Strategy<Value = NmeaLine> {
    let text = ("[ -~]{0,61}", any::<u8>()).prop_map(|(text, kind)| {
        Txt::message(kind % 100, &text)[0]
            .write(Talker::new(["IN", "II", "HE"][usize::from(kind % 3)]).unwrap())
    });
    let psxn = any::<[f64; 2]>().prop_map(|[heading, heave]| {
        Psxn::Motion { roll: None, pitch: None, heading: Some(heading), heave: Some(heave) }.write()
    });
    prop_oneof![(0.0..360.0).prop_map(ths), text, psxn]
}

fn any_message() -> impl Strategy<Value = PortMessage> {
    let kinds: Vec<&str> = MessageKind::all().map(MessageKind::name).collect();
    let lines = prop::collection::vec(any_line(), 0..40);
    (prop::sample::select(kinds), lines).prop_map(|(name, lines)| message(name, lines))
}

/// The group that the first line of a message decides, and all its lines.
fn expected(messages: &[PortMessage], group: TransmissionGroup) -> String {
    let mut all = String::new();
    for message in messages {
        let text = String::from_utf8(message.content.to_bytes()).unwrap();
        if text.get(1..).map(TransmissionGroup::of_address) == Some(group) {
            all += &text;
        }
    }
    all
}

proptest! {
    #[test]
    fn every_message_is_delivered_whole_and_readable_in_its_group(
        messages in prop::collection::vec(any_message(), 0..30),
        single: bool, nanos in prop::option::of(0..4_000_000_000_000_000_000_i64),
    ) {
        let mut lan = Lan::new(LanConfig { single, time: true, ..config() });
        let datagrams = lan.datagrams(&messages, nanos.map(UtcTime::from_nanos));
        let mut count = 0;
        for datagram in &datagrams {
            prop_assert!(datagram.bytes.len() <= MAX_DATAGRAM);
            let mut left = 0;
            for (tag, line) in lines(&datagram.bytes) {
                count += 1;
                prop_assert_eq!(tag.source, Some("IN0001"));
                prop_assert_eq!(tag.line, Some((count - 1) % 999 + 1));
                prop_assert!(Sentence::read(line.as_bytes()).is_ok(), "{}", line);
                let after = tag.group.map_or(0, |place| place.lines - place.line);
                prop_assert!(single || left == 0 || after == left - 1, "a group is parted");
                left = after;
            }
            prop_assert!(single || left == 0, "a group is cut");
        }
        for group in TransmissionGroup::ALL {
            let own = datagrams.iter().filter(|datagram| datagram.group == group);
            let sent: String = own
                .flat_map(|datagram| lines(&datagram.bytes).into_iter().map(|(_, line)| line))
                .collect();
            prop_assert_eq!(sent, expected(&messages, group));
        }
    }
}
