//! What a node answers, and that it never answers without end.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod common;

use common::{Bus, config, frame, iso_request, name, node};
use insd_base::can::CanFrame;
use insd_base::{Span, Time};
use insd_n2k::groups::{Configuration, IsoAcknowledgement, PgnList, ProductInfo};
use insd_n2k::node::{Node, NodeEvent};
use insd_n2k::pgn::Group;
use insd_n2k::{Assembler, N2kId};
use proptest::prelude::*;

/// A bus with one node that holds address 40 and has sent its first heartbeat.
fn held() -> Bus {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    assert_eq!(bus.nodes[0].address(), Some(40));
    bus.take_messages();
    bus
}

/// The groups that the node sent since the last call: number, receiver, contents.
fn sent(bus: &mut Bus) -> Vec<(u32, u8, Vec<u8>)> {
    let messages = bus.take_messages().into_iter().map(|(_, message)| message);
    let own = messages.filter(|message| message.source == 40);
    own.map(|message| (message.pgn, message.destination, message.data)).collect()
}

#[test]
fn requests_for_what_the_node_is_are_answered_whoever_asks() {
    for (source, destination) in [(3, 40), (3, 255), (254, 255), (254, 40)] {
        let mut bus = held();
        let to = if source == 254 { 255 } else { source };
        let mut ask = |pgn| {
            bus.inject(&iso_request(pgn, source, destination));
            bus.run(0.1);
            sent(&mut bus)
        };
        assert_eq!(ask(60_928), [(60_928, 255, name(1000).bytes().to_vec())]);
        let product = config(name(1000), 40).product;
        assert_eq!(ask(126_996), [(126_996, 255, product.write())]);
        let answer = ask(126_998);
        assert_eq!(Configuration::read(&answer[0].2).unwrap().manufacturer, "insd");
        assert_eq!(ask(126_993)[0].2[2], 1, "the second heartbeat");
        let lists = ask(126_464);
        assert_eq!((lists[0].1, lists[1].1), (to, to));
        let PgnList::Transmit(groups) = PgnList::read(&lists[0].2).unwrap() else { panic!() };
        assert!([60_928, 126_996, 126_998, 127_250].iter().all(|pgn| groups.contains(pgn)));
        let PgnList::Receive(groups) = PgnList::read(&lists[1].2).unwrap() else { panic!() };
        assert!([59_904, 126_208, 65_240, 128_259].iter().all(|pgn| groups.contains(pgn)));
    }
}

#[test]
fn product_information_goes_in_twenty_frames() {
    let mut bus = held();
    bus.inject(&iso_request(126_996, 3, 40));
    bus.run(0.1);
    assert_eq!(bus.frames.len(), 1 + 20);
    assert_eq!(bus.frames[1].1.data()[..4], [0x00, 134, 0x34, 0x08]);
    assert_eq!(bus.frames[20].1.data()[0], 0x13);
    let messages = bus.take_messages();
    let product = ProductInfo::read(&messages[1].1.data).unwrap();
    assert_eq!((product.model.as_str(), product.n2k_version), ("insd", 2100));
}

#[test]
fn an_unknown_group_is_refused_to_one_and_passed_over_for_all() {
    let mut bus = held();
    bus.inject(&iso_request(127_488, 3, 40));
    bus.inject(&iso_request(127_488, 3, 255));
    bus.inject(&iso_request(127_488, 3, 41));
    bus.run(0.1);
    let refusal = vec![0x01, 0xFF, 0xFF, 0xFF, 0xFF, 0x00, 0xF2, 0x01];
    assert_eq!(sent(&mut bus), [(59_392, 3, refusal)]);
}

#[test]
fn the_last_contents_of_a_stream_are_sent_again_while_they_are_young() {
    let mut bus = held();
    let now = bus.now;
    bus.nodes[0].send(127_250, &[7; 8], now);
    bus.run(0.05);
    bus.inject(&iso_request(127_250, 3, 40));
    bus.run(0.01);
    let again = (127_250, 255, vec![7; 8]);
    assert_eq!(sent(&mut bus), [again.clone(), again]);
    bus.run(0.1);
    bus.inject(&iso_request(127_250, 3, 40));
    bus.run(0.01);
    let busy = vec![0x03, 0xFF, 0xFF, 0xFF, 0xFF, 0x12, 0xF1, 0x01];
    assert_eq!(sent(&mut bus), [(59_392, 3, busy)]);
}

#[test]
fn a_refusal_is_counted_and_not_answered() {
    let mut bus = held();
    let refusal = IsoAcknowledgement::read(&[1, 255, 255, 255, 255, 0, 0xF2, 1]).unwrap();
    bus.inject(&frame(6, 59_392, 3, 40, &refusal.write()));
    bus.run(0.1);
    assert_eq!((sent(&mut bus), bus.nodes[0].counts().requests.refused), (vec![], 1));
}

#[test]
fn heartbeats_come_every_minute() {
    let mut bus = held();
    bus.run(240.0);
    let beats = bus.take_group(126_993, 40);
    assert_eq!(beats.iter().map(|data| data[2]).collect::<Vec<_>>(), [1, 2, 3, 4]);
}

#[test]
fn a_storm_of_requests_gets_few_answers_and_the_last_one_is_answered() {
    for (pgn, most, spacing) in [(60_928, 40, 0.05), (126_996, 11, 0.2), (126_464, 22, 0.2)] {
        let mut bus = held();
        let start = bus.now;
        for _ in 0..2000 {
            bus.inject(&iso_request(pgn, 3, 255));
            bus.run(0.001);
        }
        let last = bus.now;
        bus.run(1.0);
        let messages = bus.take_messages();
        let answers: Vec<Time> = messages
            .iter()
            .filter(|(_, message)| (message.pgn, message.source) == (pgn, 40))
            .map(|(time, _)| *time)
            .collect();
        assert!((most - 3..=most + 2).contains(&answers.len()), "{pgn}: {}", answers.len());
        assert!((answers[0] - start).as_seconds() < 0.02);
        let final_answer = *answers.last().unwrap();
        assert!(final_answer > last - Span::from_nanos(2_000_000), "{pgn}: the last is answered");
        assert!((final_answer - last).as_seconds() < spacing + 0.02);
    }
}

#[test]
fn a_storm_of_unanswerable_requests_gets_fifty_refusals_a_second() {
    let mut bus = held();
    for pgn in 0..4000_u32 {
        bus.inject(&iso_request(0x1_F200 + pgn % 256, 3, 40));
        bus.run(0.0005);
    }
    assert!(sent(&mut bus).len() <= 32 + 101);
    assert!(bus.nodes[0].counts().requests.rationed > 3800);
}

#[test]
fn messages_need_an_address_a_place_in_the_table_and_to_be_switched_on() {
    let mut node = Node::new(
        {
            let mut config = config(name(1), 40);
            config.transmit[1].enabled = false;
            config
        },
        1,
    );
    assert!(!node.send(127_250, &[0; 8], Time::START));
    let mut bus = Bus::started(vec![node]);
    bus.run(0.5);
    let now = bus.now;
    assert!(bus.nodes[0].send(127_250, &[0; 8], now));
    assert!(!bus.nodes[0].send(129_029, &[0; 43], now));
    assert!(!bus.nodes[0].send(127_251, &[0; 8], now));
    let counts = bus.nodes[0].counts().requests;
    assert_eq!((counts.without_address, counts.not_in_table), (1, 1));
}

#[test]
fn a_transfer_that_stops_is_asked_for_again_and_then_given_up() {
    let mut bus = held();
    bus.inject(&frame(6, 60_416, 3, 40, &[16, 20, 0, 3, 255, 0x00, 0xED, 0x01]));
    bus.run(0.01);
    bus.inject(&frame(6, 60_160, 3, 40, &[1, 1, 2, 3, 4, 5, 6, 7]));
    bus.run(10.0);
    let answers: Vec<Vec<u8>> = bus.take_frames(60_416, 40);
    assert_eq!(answers.len(), 5);
    assert_eq!(answers[0], [17, 3, 1, 255, 255, 0x00, 0xED, 0x01]);
    assert!(answers[1..4].iter().all(|data| data == &[17, 2, 2, 255, 255, 0x00, 0xED, 0x01]));
    assert_eq!(answers[4], [255, 3, 255, 255, 255, 0x00, 0xED, 0x01]);
}

#[test]
fn too_many_transfers_at_once_are_refused() {
    let mut bus = held();
    for source in 1..=5 {
        bus.inject(&frame(6, 60_416, source, 40, &[16, 20, 0, 3, 255, 0x00, 0xED, 0x01]));
    }
    bus.run(0.02);
    let kinds: Vec<u8> = bus.take_frames(60_416, 40).iter().map(|data| data[0]).collect();
    assert_eq!(kinds, [17, 17, 17, 17, 255]);
}

#[test]
fn a_long_group_function_is_received_and_its_end_acknowledged() {
    let mut bus = held();
    // A command of both texts of the installer, 24 bytes in four packets, allowed three and one.
    let mut command = vec![1, 0x16, 0xF0, 0x01, 0xF8, 2, 1, 8, 1];
    command.extend(b"bridge");
    command.extend([2, 8, 1]);
    command.extend(b"port A");
    bus.inject(&frame(6, 60_416, 3, 40, &[16, 24, 0, 4, 3, 0x00, 0xED, 0x01]));
    bus.run(0.01);
    for (number, bytes) in (1..).zip(command.chunks(7)) {
        let mut packet = vec![number];
        packet.extend(bytes);
        packet.resize(8, 255);
        bus.inject(&frame(6, 60_160, 3, 40, &packet));
        bus.run(0.01);
    }
    let management = bus.take_frames(60_416, 40);
    assert_eq!(management[0][..3], [17, 3, 1]);
    assert_eq!(management[1][..3], [17, 1, 4]);
    assert_eq!(management[2], [19, 24, 0, 4, 255, 0x00, 0xED, 0x01]);
    assert_eq!(bus.nodes[0].config().installation, ["bridge", "port A"]);
}

/// Frames that a node is likely to react to.
fn any_frame() -> impl Strategy<Value = CanFrame> {
    let managed = prop::sample::select(vec![
        59_904_u32, 59_392, 126_208, 60_416, 60_160, 65_240, 126_996, 127_250,
    ]);
    // Few claims, so that the node mostly has the address that the others are sent to.
    let groups = prop_oneof![1 => Just(60_928_u32), 300 => managed, 100 => Just(59_904)];
    let wanted = prop::sample::select(vec![
        60_928_u32, 126_464, 126_996, 126_998, 126_993, 127_250, 127_488, 129_029,
    ]);
    let data = prop_oneof![
        prop::collection::vec(any::<u8>(), 0..=8),
        wanted.clone().prop_map(|pgn| pgn.to_le_bytes()[..3].to_vec()),
        (0..1100_u32).prop_map(|unique| name(unique).bytes().to_vec()),
        (0..7_u8, wanted).prop_map(|(function, pgn)| {
            let [low, middle, high, _] = pgn.to_le_bytes();
            vec![0, 6, function, low, middle, high, 0xF8, 0]
        }),
        (prop::sample::select(vec![16_u8, 17, 19, 32, 255]), 0..40_u8, 0..6_u8)
            .prop_map(|(kind, length, packets)| vec![kind, length, 0, packets, 3, 0, 0xED, 1]),
    ];
    let sources = prop_oneof![1 => Just(40_u8), 20 => Just(3), 5 => Just(254), 20 => any::<u8>()];
    let destinations = prop_oneof![Just(40_u8), Just(255), Just(41), any::<u8>()];
    (groups, sources, destinations, data, 0..8_u8).prop_map(
        |(pgn, source, destination, data, priority)| {
            frame(priority, pgn, source, destination, &data)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// A thousand arbitrary frames a second: no panic, and less than a third of the bus for the answers.
    #[test]
    fn arbitrary_frames_are_survived_and_answered_with_measure(
        frames in prop::collection::vec(any_frame(), 1..4000),
    ) {
        let mut bus = Bus::started(vec![node(1000, 40)]);
        bus.run(0.4);
        bus.frames.clear();
        for frame in &frames {
            bus.inject(frame);
            bus.run(0.001);
        }
        let seconds = frames.len() as f64 / 1000.0;
        let own = bus.frames.len() - frames.len();
        prop_assert!(own as f64 <= 500.0 * (seconds + 1.0), "{} frames in {} s", own, seconds);
        prop_assert!(bus.nodes[0].status().waiting <= 160);
        bus.frames.clear();
        bus.run(30.0);
        let after = bus.frames.len();
        prop_assert!(after <= 200, "{} frames in the calm", after);
    }

    /// A link that refuses at will, and an owner that hands in at will: what comes out is whole.
    #[test]
    fn no_link_ever_makes_half_a_fast_packet(
        steps in prop::collection::vec((0..6_u8, 0..4_i64), 1..800),
    ) {
        let mut node = node(1000, 40);
        let mut now = Time::from_seconds(1.0);
        node.up(now);
        let mut out = Vec::new();
        let mut step = |node: &mut Node, kind: u8, now: Time| {
            if node.wake_at().is_some_and(|at| at <= now) {
                node.wake(now);
            }
            match kind {
                0 => { node.send(129_029, &[1; 60], now); }
                1 => { node.send(127_250, &[2; 8], now); }
                2 => node.hear(&iso_request(126_996, 3, 255), now),
                3 => {
                    if node.next_frame(now).is_some() {
                        node.refused(now);
                    }
                }
                _ => {
                    if let Some(frame) = node.next_frame(now) {
                        out.push(frame);
                        node.sent(now);
                    }
                }
            }
        };
        for _ in 0..400 {
            now = now + Span::from_nanos(1_000_000);
            step(&mut node, 5, now);
        }
        for (kind, pause) in steps {
            now = now + Span::from_nanos(pause * 1_000_000);
            step(&mut node, kind, now);
        }
        for _ in 0..400 {
            now = now + Span::from_nanos(1_000_000);
            step(&mut node, 5, now);
        }
        let mut assembler = Assembler::new();
        for frame in &out {
            assembler.take(frame, now);
        }
        let counts = assembler.counts();
        prop_assert_eq!((counts.gaps, counts.orphans, counts.superseded), (0, 0, 0));
        prop_assert_eq!(assembler.under_way(), 0);
        let mut ids = out.iter().map(|frame| N2kId::parse(frame.id()).unwrap());
        prop_assert!(ids.all(|id| id.source == 40 || id.source == 254));
    }
}

#[test]
fn events_nobody_fetches_do_not_pile_up() {
    let mut bus = held();
    let mut node = bus.nodes.remove(0);
    for round in 0..500_i64 {
        let now = bus.now + Span::from_nanos(round * 300_000_000);
        let priority = (round % 2) as u8;
        let command = [0, 6, 1, 0x12, 0xF1, 0x01, 0xF0 | priority, 0];
        node.hear(&frame(3, 126_208, 3, 40, &command), now);
    }
    let events = std::iter::from_fn(|| node.poll_event()).collect::<Vec<_>>();
    assert_eq!(events.len(), 64);
    assert!(events.iter().all(|event| matches!(event, NodeEvent::PriorityChanged { .. })));
}
