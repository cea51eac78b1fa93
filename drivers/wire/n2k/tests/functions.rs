//! Group functions: recorded ones, and what a node makes of requests and commands.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod common;

use common::{Bus, frame, name, node, parts};
use insd_base::Span;
use insd_n2k::fast_packet::split;
use insd_n2k::groups::{
    Acknowledge, Command, Configuration, GroupFunction, GroupRequest, INTERVAL_DEFAULT,
    INTERVAL_KEEP, OFFSET_KEEP,
};
use insd_n2k::node::{Node, NodeEvent, Peer};
use insd_n2k::pgn::Group;
use insd_n2k::{N2kId, NameParts};

const BY: Peer = Peer { address: 3, name: None };

/// A bus with one node that holds address 40.
fn held() -> Bus {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    assert_eq!(bus.nodes[0].address(), Some(40));
    bus.take_messages();
    bus
}

/// Sends a group function to an address; what the node sent within 100 ms, group and contents.
fn tell(bus: &mut Bus, function: &[u8], destination: u8) -> Vec<(u32, Vec<u8>)> {
    let id = N2kId { priority: 3, pgn: 126_208, source: 3, destination };
    for frame in split(id, function, 0).unwrap() {
        bus.inject(&frame);
    }
    bus.run(0.1);
    let messages = bus.take_messages().into_iter().map(|(_, message)| message);
    let own = messages.filter(|message| message.source == 40);
    own.map(|message| (message.pgn, message.data)).collect()
}

fn request(pgn: u32, interval: u32, offset: u16) -> Vec<u8> {
    let (count, pairs) = (0, Vec::new());
    GroupFunction::Request(GroupRequest { pgn, interval, offset, count, pairs }).write()
}

fn request_fields(pgn: u32, count: u8, pairs: &[u8]) -> Vec<u8> {
    let (interval, offset, pairs) = (INTERVAL_KEEP, OFFSET_KEEP, pairs.to_vec());
    GroupFunction::Request(GroupRequest { pgn, interval, offset, count, pairs }).write()
}

fn command(pgn: u32, priority: u8, count: u8, pairs: &[u8]) -> Vec<u8> {
    let pairs = pairs.to_vec();
    GroupFunction::Command(Command { pgn, priority, count, pairs }).write()
}

/// An acknowledgement of these errors, as the node sends it.
fn acknowledge(pgn: u32, error: u8, interval: u8, parameters: &[u8]) -> Vec<(u32, Vec<u8>)> {
    let parameters = parameters.to_vec();
    let acknowledge = Acknowledge { pgn, error, interval, parameters };
    vec![(126_208, GroupFunction::Acknowledge(acknowledge).write())]
}

fn interval_of(bus: &Bus, pgn: u32) -> Option<Span> {
    let table = bus.nodes[0].transmit().iter();
    table.filter(|entry| entry.enabled).find(|entry| entry.pgn == pgn).map(|entry| entry.interval)
}

#[test]
fn a_recorded_switch_off_of_an_unknown_group_is_refused() {
    // canboat's sample scx20-setting-tool-pgn-130578to130846-off.raw, sent to this node
    let off = [0x00, 0x12, 0xFE, 0x01, 0, 0, 0, 0, 0xFF, 0xFF, 0];
    let answer = tell(&mut held(), &off, 40);
    assert_eq!(answer, [(126_208, vec![2, 0x12, 0xFE, 0x01, 0x01, 0])]);
}

#[test]
fn a_recorded_command_of_an_unknown_group_is_refused() {
    // canboat's sample dirona-actisense-serial.raw, sent to this node
    let command = [1, 0x0D, 0xF2, 1, 0xF8, 1, 6, 0];
    let answer = tell(&mut held(), &command, 40);
    assert_eq!(answer, [(126_208, vec![2, 0x0D, 0xF2, 1, 0x01, 1, 0xF0])]);
}

#[test]
fn the_interval_of_a_stream_can_be_changed_switched_off_and_set_back() {
    let mut bus = held();
    let granted = acknowledge(127_250, 0, 0, &[]);
    assert_eq!(tell(&mut bus, &request(127_250, 500, OFFSET_KEEP), 40), granted);
    let half = Some(Span::from_seconds(0.5));
    assert_eq!(interval_of(&bus, 127_250), half);
    let changed =
        |interval, offset| NodeEvent::IntervalChanged { pgn: 127_250, interval, offset, by: BY };
    assert!(bus.happened(0, &changed(half, None)));
    assert_eq!(tell(&mut bus, &request(127_250, 0, OFFSET_KEEP), 40), granted);
    assert_eq!(interval_of(&bus, 127_250), None);
    assert!(bus.happened(0, &changed(None, None)));
    let now = bus.now;
    assert!(!bus.nodes[0].send(127_250, &[0; 8], now), "switched off");
    tell(&mut bus, &request(127_250, INTERVAL_DEFAULT, 20), 40);
    assert_eq!(interval_of(&bus, 127_250), Some(Span::from_seconds(0.1)));
    let offset = Some(Span::from_seconds(0.2));
    assert!(bus.happened(0, &changed(Some(Span::from_seconds(0.1)), offset)));
}

#[test]
fn a_node_that_nobody_may_command_denies_and_changes_nothing() {
    let mut config = common::config(name(1000), 40);
    config.commands = false;
    let mut bus = Bus::started(vec![Node::new(config, 1)]);
    bus.run(0.5);
    bus.take_messages();
    let before = bus.nodes[0].config().clone();
    let refused = |pgn| NodeEvent::CommandRefused { pgn, by: BY };
    for (pgn, function, answer) in [
        (127_250, request(127_250, 0, OFFSET_KEEP), acknowledge(127_250, 3, 0, &[])),
        (126_993, request(126_993, 5000, OFFSET_KEEP), acknowledge(126_993, 3, 0, &[])),
        (127_250, command(127_250, 1, 0, &[]), acknowledge(127_250, 3, 0, &[])),
        (60_928, command(60_928, 8, 1, &[3, 1]), acknowledge(60_928, 3, 0, &[2])),
    ] {
        assert_eq!(tell(&mut bus, &function, 40), answer, "{pgn}");
        assert!(bus.happened(0, &refused(pgn)), "{pgn}");
    }
    // to be sent something once is no command
    let answer = tell(&mut bus, &request(126_993, INTERVAL_KEEP, OFFSET_KEEP), 40);
    assert_eq!(answer[0].0, 126_993);
    assert_eq!(*bus.nodes[0].config(), before);
}

#[test]
fn a_granted_request_is_answered_by_the_group_itself() {
    let mut bus = held();
    for (interval, pause) in [(INTERVAL_KEEP, 0.0), (1000, 0.5)] {
        let now = bus.now;
        bus.nodes[0].send(127_250, &[7; 8], now);
        bus.run(0.05);
        bus.take_messages();
        let answer = tell(&mut bus, &request(127_250, interval, OFFSET_KEEP), 40);
        assert_eq!(answer, [(127_250, vec![7; 8])]);
        bus.run(pause);
    }
    bus.run(1.0);
    let once = request(127_250, INTERVAL_KEEP, OFFSET_KEEP);
    assert_eq!(tell(&mut bus, &once, 40), acknowledge(127_250, 2, 0, &[]), "nothing young");
}

#[test]
fn intervals_and_offsets_out_of_their_limits_are_refused_with_the_right_code() {
    for (pgn, interval, offset, code) in [
        (127_250, 49, OFFSET_KEEP, 2),
        (127_250, 60_001, OFFSET_KEEP, 1),
        (127_250, 1000, 6001, 1),
        (126_993, 999, OFFSET_KEEP, 2),
        (126_993, 60_001, OFFSET_KEEP, 1),
        (126_993, 0, OFFSET_KEEP, 1),
        (126_996, 1000, OFFSET_KEEP, 1),
        (60_928, INTERVAL_KEEP, 5, 1),
    ] {
        let mut bus = held();
        let answer = tell(&mut bus, &request(pgn, interval, offset), 40);
        assert_eq!(answer, acknowledge(pgn, 0, code, &[]), "{pgn} {interval} {offset}");
        assert_eq!(bus.nodes[0].transmit(), held().nodes[0].transmit());
        assert_eq!(bus.nodes[0].counts().requests.denied, 1);
    }
}

#[test]
fn fields_of_a_stream_cannot_be_asked_for() {
    let answer = tell(&mut held(), &request_fields(127_250, 2, &[1, 0, 5, 0]), 40);
    assert_eq!(answer, acknowledge(127_250, 4, 0, &[5, 5]));
}

#[test]
fn the_heartbeat_takes_another_interval() {
    let mut bus = held();
    let answer = tell(&mut bus, &request(126_993, 2000, OFFSET_KEEP), 40);
    assert_eq!(answer, [(126_993, vec![0xD0, 0x07, 1, 0xFC, 255, 255, 255, 255])]);
    bus.run(10.0);
    assert_eq!(bus.take_group(126_993, 40).len(), 5);
    tell(&mut bus, &request(126_993, INTERVAL_DEFAULT, OFFSET_KEEP), 40);
    bus.run(59.0);
    assert_eq!(bus.take_group(126_993, 40).len(), 0);
    tell(&mut bus, &request(126_993, 60_000, 500), 40);
    bus.run(5.0);
    assert_eq!(bus.take_group(126_993, 40).len(), 1, "after the offset");
}

#[test]
fn groups_of_management_are_sent_if_their_fields_match() {
    let own = name(1000).bytes();
    for (pgn, count, pairs) in [
        (60_928, 0, &[][..]),
        (60_928, 2, &[5, 175, 7, 60]),
        (60_928, 1, &[1, own[0], own[1], own[2] & 0x1F]),
        (60_928, 2, &[2, 0xE7, 0xFB, 9, 0xFC]),
        (126_996, 2, &[1, 0x34, 0x08, 7, 255]),
        (126_998, 2, &[1, 8, 1, b'b', b'r', b'i', b'd', b'g', b'e', 2, 2, 1]),
    ] {
        let answer = tell(&mut held(), &request_fields(pgn, count, pairs), 40);
        assert_eq!(answer.len(), 1);
        assert_eq!(answer[0].0, pgn, "{pairs:?}");
    }
    for (list, first) in [(0, 0), (1, 1)] {
        let answer = tell(&mut held(), &request_fields(126_464, 1, &[1, list]), 40);
        assert_eq!((answer.len(), answer[0].0, answer[0].1[0]), (1, 126_464, first));
    }
    let both = tell(&mut held(), &request_fields(126_464, 0, &[]), 40);
    assert_eq!(both.len(), 2);
}

#[test]
fn what_does_not_match_is_acknowledged_to_one_and_passed_over_for_all() {
    for (pgn, count, pairs, codes) in [
        (60_928, 2, &[5, 175, 7, 61][..], &[0, 3][..]),
        (60_928, 3, &[5, 175, 11, 0, 7, 60], &[0, 1, 2]),
        (126_996, 1, &[1, 0x35, 0x08], &[3]),
        (126_464, 1, &[1, 2], &[3]),
        (126_998, 1, &[1, 90, 1, b'x'], &[1]),
    ] {
        let function = request_fields(pgn, count, pairs);
        let answer = tell(&mut held(), &function, 40);
        assert_eq!(answer, acknowledge(pgn, 0, 0, codes), "{pgn} {pairs:?}");
        assert_eq!(tell(&mut held(), &function, 255), []);
    }
}

#[test]
fn a_request_to_all_is_granted_like_one_to_the_node() {
    let mut bus = held();
    assert_eq!(tell(&mut bus, &request(60_928, INTERVAL_KEEP, OFFSET_KEEP), 255).len(), 1);
    assert_eq!(tell(&mut bus, &request(127_250, 500, OFFSET_KEEP), 255), []);
    assert_eq!(interval_of(&bus, 127_250), Some(Span::from_seconds(0.5)));
    assert_eq!(tell(&mut bus, &request(127_488, 500, OFFSET_KEEP), 255), []);
}

#[test]
fn the_texts_of_the_installer_can_be_commanded() {
    let mut bus = held();
    let pairs = [&[1, 6, 1][..], b"mast", &[2, 6, 0, 0xFC, 0, b'b', 0]].concat();
    let answer = tell(&mut bus, &command(126_998, 8, 2, &pairs), 40);
    assert_eq!(answer, acknowledge(126_998, 0, 0, &[0, 0]));
    let installation = ["mast".to_owned(), "üb".to_owned()];
    assert!(bus.happened(0, &NodeEvent::InstallationChanged { installation, by: BY }));
    let asked = tell(&mut bus, &request(126_998, INTERVAL_KEEP, OFFSET_KEEP), 40);
    let configuration = Configuration::read(&asked[0].1).unwrap();
    assert_eq!(configuration.installation, ["mast", "üb"]);
    let fixed = tell(&mut bus, &command(126_998, 8, 1, &[3, 3, 1, b'x']), 40);
    assert_eq!(fixed, acknowledge(126_998, 0, 0, &[5]));
}

#[test]
fn the_instances_of_the_name_can_be_commanded_and_are_told_at_once() {
    let mut bus = held();
    let answer = tell(&mut bus, &command(60_928, 8, 3, &[3, 5, 4, 17, 8, 2]), 40);
    let new =
        NameParts { instance_lower: 5, instance_upper: 17, system_instance: 2, ..parts(1000) };
    let new = new.name().unwrap();
    let claims: Vec<_> = answer.iter().filter(|(pgn, _)| *pgn == 60_928).collect();
    assert_eq!(claims, [&(60_928, new.bytes().to_vec())]);
    assert_eq!(answer.iter().filter(|(pgn, _)| *pgn == 126_208).count(), 1);
    assert!(bus.happened(0, &NodeEvent::NameChanged { name: new, by: BY }));
    assert_eq!((bus.nodes[0].config().name, bus.nodes[0].status().name), (new, new));
    let wrong = tell(&mut bus, &command(60_928, 8, 3, &[3, 8, 5, 140, 8, 16]), 40);
    assert_eq!(wrong, acknowledge(60_928, 0, 0, &[3, 5, 3]));
    assert_eq!(bus.nodes[0].config().name, new);
}

#[test]
fn the_priority_of_a_stream_can_be_commanded_and_set_back() {
    let mut bus = held();
    let granted = acknowledge(127_250, 0, 0, &[]);
    let mut priority = |wanted: u8| {
        let answer = tell(&mut bus, &command(127_250, wanted, 0, &[]), 40);
        (answer == granted, bus.nodes[0].transmit()[0].priority)
    };
    assert_eq!(priority(5), (true, 5));
    assert_eq!(priority(8), (true, 5));
    assert_eq!(priority(9), (true, 2));
    assert_eq!(priority(15), (true, 2));
    assert_eq!(priority(10), (false, 2));
    let changed = NodeEvent::PriorityChanged { pgn: 127_250, priority: 5, by: BY };
    assert!(bus.happened(0, &changed));
    let wrong = tell(&mut bus, &command(127_250, 10, 1, &[1, 0]), 40);
    assert_eq!(wrong, acknowledge(127_250, 0, 1, &[5]));
}

#[test]
fn a_command_to_all_is_passed_over() {
    let mut bus = held();
    assert_eq!(tell(&mut bus, &command(127_250, 5, 0, &[]), 255), []);
    assert_eq!(bus.nodes[0].transmit()[0].priority, 2);
}

#[test]
fn fields_can_neither_be_read_nor_written_one_by_one() {
    for function in [3, 5] {
        let known = tell(&mut held(), &[function, 0x12, 0xF1, 0x01, 255, 0, 1, 1], 40);
        assert_eq!(known, acknowledge(127_250, 6, 0, &[]));
        let unknown = tell(&mut held(), &[function, 0x00, 0xF2, 0x01, 255, 0, 1, 1], 40);
        assert_eq!(unknown, acknowledge(127_488, 1, 0, &[]));
    }
    for function in [4, 6, 9] {
        assert_eq!(tell(&mut held(), &[function, 0x12, 0xF1, 0x01, 255, 0, 1, 1], 40), []);
    }
}

#[test]
fn acknowledgements_are_counted() {
    let mut bus = held();
    bus.inject(&frame(3, 126_208, 24, 40, &[0, 7, 2, 0x0D, 0xF2, 1, 0, 1]));
    bus.inject(&frame(3, 126_208, 24, 40, &[1, 0xF0, 255, 255, 255, 255, 255, 255]));
    assert_eq!(bus.nodes[0].counts().requests.acknowledged, 1);
}
