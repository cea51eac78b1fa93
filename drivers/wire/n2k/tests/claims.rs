//! Contests for addresses on a bus in memory.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod common;

use common::{Bus, claim, config, name, node, parts};
use insd_base::{Span, Time};
use insd_n2k::node::{Node, NodeEvent, NodeState};
use insd_n2k::{N2kId, NameParts};
use proptest::prelude::*;

/// Claims since the last call, by address.
fn claims(bus: &mut Bus) -> Vec<u8> {
    let messages = bus.take_messages().into_iter().map(|(_, message)| message);
    messages.filter(|message| message.pgn == 60_928).map(|message| message.source).collect()
}

#[test]
fn a_lone_node_asks_claims_waits_and_holds() {
    let mut bus = Bus::started(vec![node(1, 40)]);
    bus.run(0.24);
    assert_eq!((bus.nodes[0].address(), bus.nodes[0].status().state), (None, NodeState::Claiming));
    assert!(!bus.nodes[0].send(127_250, &[0; 8], bus.now), "silent while it waits");
    bus.run(0.1);
    assert_eq!(bus.nodes[0].address(), Some(40));
    assert!(bus.happened(0, &NodeEvent::Claimed { address: 40 }));
    let ids: Vec<(u32, u8)> = bus
        .frames
        .iter()
        .map(|(_, frame)| N2kId::parse(frame.id()).unwrap())
        .map(|id| (id.pgn, id.source))
        .collect();
    assert_eq!(ids, [(59_904, 254), (60_928, 40), (126_993, 40)]);
    let claim = &bus.frames[1].1;
    assert_eq!(claim.id().to_string(), "18EEFF28");
    assert_eq!(claim.data(), name(1).bytes());
    assert_eq!(bus.frames[2].1.data(), [0x60, 0xEA, 0, 0xFC, 255, 255, 255, 255]);
}

#[test]
fn the_lower_name_keeps_the_address_and_the_other_takes_the_next() {
    let mut bus = Bus::started(vec![node(2000, 40), node(1000, 40)]);
    bus.run(1.0);
    assert_eq!(bus.addresses(), [Some(41), Some(40)]);
    assert!(bus.happened(0, &NodeEvent::Lost { address: 40, to: name(1000) }));
    assert_eq!(bus.nodes[0].roster().name_at(40), Some(name(1000)));
    assert_eq!(bus.nodes[1].roster().address_of(name(2000)), Some(41));
}

#[test]
fn a_holder_defends_its_address_against_a_higher_name() {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    claims(&mut bus);
    bus.inject(&claim(name(2000), 40));
    bus.run(0.01);
    assert_eq!(claims(&mut bus), [40, 40], "the intruder's and the answer");
    assert_eq!((bus.nodes[0].address(), bus.nodes[0].counts().contests.won), (Some(40), 1));
}

#[test]
fn a_holder_gives_its_address_to_a_lower_name_at_once() {
    let mut bus = Bus::started(vec![node(1000, 251)]);
    bus.run(0.5);
    bus.inject(&claim(name(7), 0));
    bus.nodes[0].send(129_029, &[0; 43], bus.now);
    claims(&mut bus);
    bus.inject(&claim(name(5), 251));
    assert_eq!(bus.nodes[0].address(), None);
    bus.run(0.003);
    assert_eq!(claims(&mut bus), [251, 1], "the next address that is not taken");
    bus.run(0.5);
    assert_eq!(bus.nodes[0].address(), Some(1));
    assert_eq!(bus.nodes[0].counts().queue.cleared, 1);
}

#[test]
fn three_nodes_at_once_find_three_addresses() {
    let mut bus = Bus::started(vec![node(3, 40), node(2, 40), node(1, 40)]);
    bus.run(2.0);
    assert_eq!(bus.nodes[2].address(), Some(40));
    let mut addresses = bus.addresses();
    addresses.sort_unstable();
    assert_eq!(addresses, [Some(40), Some(41), Some(42)]);
}

#[test]
fn a_node_that_may_not_move_is_quiet_until_its_address_is_free() {
    let fixed = NameParts { arbitrary_address: false, unique_number: 9, ..parts(9) };
    let mut bus = Bus::started(vec![Node::new(config(fixed.name().unwrap(), 40), 1)]);
    bus.run(0.5);
    // A name of no class and function is lower than any other.
    let lower = NameParts { function: 0, class: 0, ..fixed }.name().unwrap();
    bus.inject(&claim(lower, 40));
    claims(&mut bus);
    bus.run(2.0);
    assert_eq!(claims(&mut bus), [254], "it says once that it cannot claim");
    assert!(bus.happened(0, &NodeEvent::NoneFree));
    assert_eq!(bus.nodes[0].status().state, NodeState::CannotClaim);
    assert!(!bus.nodes[0].send(127_250, &[0; 8], bus.now));
    bus.inject(&common::iso_request(60_928, 254, 255));
    bus.run(0.2);
    assert_eq!(claims(&mut bus), [254]);
    bus.inject(&claim(lower, 50));
    bus.run(2.0);
    assert_eq!(bus.nodes[0].address(), Some(40));
}

#[test]
fn a_full_bus_leaves_no_address_until_one_is_given_up() {
    let mut bus = Bus::started(vec![node(1000, 100)]);
    bus.run(0.5);
    for address in 0..=251_u8 {
        bus.inject(&claim(name(u32::from(address)), address));
    }
    bus.run(1.0);
    assert_eq!(bus.nodes[0].status().state, NodeState::CannotClaim);
    assert_eq!(claims(&mut bus).last(), Some(&254));
    bus.run(60.0);
    assert_eq!(claims(&mut bus), [], "quiet");
    bus.inject(&claim(name(7), 254));
    bus.run(2.0);
    assert_eq!(bus.nodes[0].address(), Some(7));
}

#[test]
fn a_survey_finds_an_address_whose_holder_went_silently() {
    let mut bus = Bus::started(vec![node(1000, 100)]);
    bus.run(0.5);
    for address in 0..=251_u8 {
        bus.inject(&claim(name(u32::from(address)), address));
    }
    bus.run(310.0);
    assert_eq!(bus.nodes[0].address(), Some(100));
}

#[test]
fn two_units_with_one_name_part_and_raise_an_alarm() {
    let twins = |seed| Node::new(config(name(5), 40), seed);
    let mut bus = Bus::started(vec![twins(1), twins(2)]);
    bus.run(3.0);
    let addresses = bus.addresses();
    assert!(addresses[0].is_some() && addresses[1].is_some() && addresses[0] != addresses[1]);
    let alarms = |at| {
        let alarm = |(who, event): &&(usize, NodeEvent)| {
            *who == at && matches!(event, NodeEvent::SameName { .. })
        };
        bus.events.iter().filter(alarm).count()
    };
    assert!(alarms(0) + alarms(1) >= 1);
    assert!(claims(&mut bus).len() < 12);
}

#[test]
fn who_meets_its_own_name_gives_way_after_a_random_delay() {
    let delays: Vec<i64> = (0..60)
        .map(|seed| {
            let mut bus = Bus::started(vec![Node::new(config(name(5), 40), seed)]);
            bus.run(0.5);
            claims(&mut bus);
            bus.inject(&claim(name(5), 40));
            assert_eq!(bus.nodes[0].address(), None);
            let start = bus.now;
            bus.run(0.16);
            let last = bus.frames.last().unwrap();
            assert_eq!(N2kId::parse(last.1.id()).unwrap().source, 41);
            (last.0 - start).as_nanos() / 1_000_000
        })
        .collect();
    let (least, most) = (delays.iter().min().unwrap(), delays.iter().max().unwrap());
    assert!(*least < 20 && *most > 130 && *most <= 154, "{least} to {most} ms");
}

#[test]
fn two_networks_that_are_joined_settle_who_has_an_address_used_twice() {
    for (first, second) in [(1000, 2000), (5, 5)] {
        let mut bus = Bus::started(vec![node(first, 40)]);
        let mut other = Bus::started(vec![node(second, 40)]);
        bus.run(0.5);
        other.run(0.5);
        bus.nodes.append(&mut other.nodes);
        assert_eq!(bus.addresses(), [Some(40), Some(40)]);
        let now = bus.now;
        bus.nodes[0].send(127_250, &[0; 8], now);
        bus.run(1.0);
        let addresses = bus.addresses();
        assert!(addresses[0].is_some() && addresses[1].is_some() && addresses[0] != addresses[1]);
        assert_eq!(bus.nodes[1].counts().contests.address_used, 1);
        if first != second {
            assert_eq!(addresses, [Some(40), Some(41)]);
        }
    }
}

#[test]
fn even_units_with_one_name_and_one_seed_do_not_fight_for_ever() {
    let twins = || Node::new(config(name(5), 40), 1);
    let mut bus = Bus::started(vec![twins(), twins(), twins()]);
    bus.run(5.0);
    claims(&mut bus);
    bus.run(10.0);
    assert!(claims(&mut bus).len() < 60, "bounded whatever happens");
    let mut addresses: Vec<u8> = bus.addresses().into_iter().flatten().collect();
    addresses.dedup();
    assert_eq!(addresses.len(), 3);
}

#[test]
fn an_opponent_that_never_gives_in_gets_the_address_in_the_end() {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    let start = bus.frames.len();
    for _ in 0..200 {
        bus.inject(&claim(name(2000), 40));
        bus.run(0.02);
    }
    assert!(bus.happened(0, &NodeEvent::GaveWay { address: 40, to: name(2000) }));
    assert_eq!(bus.nodes[0].address(), Some(41));
    assert!(bus.frames.len() - start < 200 + 25, "{}", bus.frames.len() - start);
}

#[test]
fn an_opponent_that_follows_everywhere_is_met_with_few_claims() {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    bus.frames.clear();
    let mut injected = 0;
    for round in 0..2000_u32 {
        let last = bus.frames.iter().rev().map(|(_, frame)| N2kId::parse(frame.id()).unwrap());
        let at = last.into_iter().find(|id| id.pgn == 60_928).map_or(40, |id| id.source);
        if at < 252 {
            bus.inject(&claim(name(round % 900), at));
            injected += 1;
        }
        bus.run(0.005);
    }
    let own = bus.frames.len() - injected;
    assert!(own < 32 + 45, "{own} frames in ten seconds");
}

#[test]
fn a_stranger_that_sends_from_the_address_is_told_and_reported() {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    claims(&mut bus);
    for _ in 0..50 {
        bus.inject(&common::frame(2, 127_250, 40, 255, &[0; 8]));
        bus.run(0.1);
    }
    assert!(bus.happened(0, &NodeEvent::AddressUsed { address: 40 }));
    assert_eq!(claims(&mut bus), [40]);
}

#[test]
fn after_bus_off_the_address_is_claimed_anew() {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    let now = bus.now;
    bus.nodes[0].bus_off(now);
    assert_eq!((bus.nodes[0].address(), bus.nodes[0].next_frame(now)), (None, None));
    assert_eq!((bus.nodes[0].status().state, bus.nodes[0].wake_at()), (NodeState::Down, None));
    bus.nodes[0].restarted(now);
    claims(&mut bus);
    bus.run(0.5);
    assert_eq!((claims(&mut bus), bus.nodes[0].address()), (vec![40], Some(40)));
}

#[test]
fn a_commanded_address_is_claimed_and_kept() {
    for (destination, management) in [(255, 32), (40, 16)] {
        let mut bus = Bus::started(vec![node(1000, 40)]);
        bus.run(0.5);
        bus.take_messages();
        let mut data = name(1000).bytes().to_vec();
        data.push(77);
        let send = |bus: &mut Bus, pgn: u32, bytes: &[u8]| {
            bus.inject(&common::frame(6, pgn, 3, destination, bytes));
            bus.run(0.01);
        };
        send(&mut bus, 60_416, &[management, 9, 0, 2, 255, 0xD8, 0xFE, 0]);
        let mut packet = vec![1];
        packet.extend(&data[..7]);
        send(&mut bus, 60_160, &packet);
        let answers: Vec<Vec<u8>> =
            bus.frames.iter().skip(1).map(|f| f.1.data().to_vec()).collect();
        if destination == 40 {
            assert_eq!(answers[0], [17, 2, 1, 255, 255, 0xD8, 0xFE, 0], "clear to send two");
        }
        send(&mut bus, 60_160, &[2, data[7], data[8], 255, 255, 255, 255, 255]);
        bus.run(0.5);
        let ends = bus.frames.iter().filter(|f| f.1.data() == [19, 9, 0, 2, 255, 0xD8, 0xFE, 0]);
        assert_eq!(ends.count(), usize::from(destination == 40), "acknowledged before it goes");
        assert_eq!(bus.nodes[0].address(), Some(77));
        let by = insd_n2k::node::Peer { address: 3, name: None };
        assert!(bus.happened(0, &NodeEvent::Commanded { address: 77, by }));
    }
}

#[test]
fn a_command_for_another_name_or_to_no_address_is_passed_over() {
    let mut bus = Bus::started(vec![node(1000, 40)]);
    bus.run(0.5);
    for (unique_number, address) in [(1001, 77), (1000, 252), (1000, 255), (1000, 40)] {
        let bytes = name(unique_number).bytes();
        let announce = [32, 9, 0, 2, 255, 0xD8, 0xFE, 0];
        bus.inject(&common::frame(6, 60_416, 3, 255, &announce));
        let [a, b, c, d, e, f, g, h] = bytes;
        bus.inject(&common::frame(6, 60_160, 3, 255, &[1, a, b, c, d, e, f, g]));
        bus.inject(&common::frame(6, 60_160, 3, 255, &[2, h, address, 255, 255, 255, 255, 255]));
        bus.run(0.5);
        assert_eq!(bus.nodes[0].address(), Some(40));
    }
    assert_eq!(bus.nodes[0].counts().requests.commanded, 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Nodes of arbitrary names come up at arbitrary times and want few addresses.
    #[test]
    fn all_nodes_find_addresses_and_the_lowest_name_keeps_its_own(
        wants in prop::collection::btree_map(0..0x1F_FFFF_u32, (40..44_u8, 0..600_i64), 2..9),
    ) {
        let lowest = wants.iter().next().map(|(_, (address, _))| *address);
        let mut starts: Vec<(i64, u32, u8)> =
            wants.into_iter().map(|(unique, (address, start))| (start, unique, address)).collect();
        starts.sort_unstable();
        let nodes = starts.iter().map(|(_, unique, address)| node(*unique, *address)).collect();
        let mut bus = Bus::new(nodes);
        for (at, (start, _, _)) in starts.iter().enumerate() {
            let until = Time::from_seconds(10.0) + Span::from_nanos(start * 1_000_000);
            while bus.now < until {
                bus.run(0.0005);
            }
            let now = bus.now;
            bus.nodes[at].up(now);
        }
        bus.run(3.0);
        let mut held: Vec<u8> = bus.addresses().into_iter().flatten().collect();
        held.sort_unstable();
        held.dedup();
        prop_assert_eq!(held.len(), starts.len(), "all have different addresses");
        let first = starts.iter().enumerate().min_by_key(|(_, (_, unique, _))| *unique);
        let keeper = first.map(|(at, _)| bus.nodes[at].address());
        prop_assert_eq!(keeper.flatten(), lowest);
        let claims = claims(&mut bus).len();
        prop_assert!(claims <= starts.len() * starts.len() * 3 + 60, "{} claims", claims);
    }
}
