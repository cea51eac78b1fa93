//! Contests for an address.

use std::thread::sleep;
use std::time::Duration;

use insd_n2k::Name;
use insd_n2k::node::{NodeEvent, NodeState};

use super::guest::{SECOND, make, turn};
use super::order::check;
use super::peer::{CLAIM, EVERYBODY, PRODUCT, Peer};
use super::tap::{Heard, Tap};
use super::unit::{HEADING, HOME, Unit};

/// The silence after a claim, s.
const SILENCE: f64 = 0.25;
/// Instants of the log are those of the tap, which hears a little later, s.
const LATER: f64 = 0.005;
const LAST: u8 = 251;
const NULL: u8 = 254;

/// A NAME that loses to all of ours, and one that wins.
const HIGH: u64 = u64::MAX;
const LOW: u64 = 1;

fn claims(frames: &[Heard], name: Name) -> Vec<Heard> {
    let own = |frame: &&Heard| frame.pgn() == CLAIM && frame.data() == name.bytes();
    frames.iter().filter(own).copied().collect()
}

fn addresses(claims: &[Heard]) -> Vec<u8> {
    claims.iter().map(Heard::source).collect()
}

/// Whether it still answers, and every fast packet of the log is in order.
fn ends_well(tap: &Tap, peer: &Peer, at: u8, breaks: &[f64]) {
    let (took, data) = peer.ask(PRODUCT, at, tap).expect("product information");
    assert!(took < 1.0, "answered after {took} s");
    assert_eq!(data.len(), 134);
    let order = check(&tap.frames(), breaks, |source| source != peer.address);
    assert!(order.whole > 0, "{order:?}");
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn against_a_higher_name_the_address_is_defended_at_once() {
    let _turn = turn();
    make("won");
    let (tap, peer) = (Tap::on("won"), Peer::on("won", 200));
    let unit = Unit::at_home("won", &tap);
    let first = claims(&tap.frames(), unit.name)[0].at;
    let spoke = tap.frames().iter().find(|frame| frame.pgn() == HEADING).unwrap().at;
    assert!(spoke - first > SILENCE - LATER, "spoke {} s after the claim", spoke - first);

    let begun = tap.now();
    peer.claim(HOME, HIGH);
    let again = tap.wait(begun, SECOND, |frame| frame.data() == unit.name.bytes()).unwrap();
    println!("won: claimed again after {:.1} ms", 1e3 * (again.at - begun));
    assert_eq!((again.pgn(), again.source()), (CLAIM, HOME));
    assert!(again.at - begun < 0.05);
    sleep(SECOND);
    assert_eq!(addresses(&claims(&tap.since(begun), unit.name)), [HOME]);
    let contests = unit.counts().contests;
    assert_eq!((contests.won, contests.lost, contests.same_name), (1, 0, 0));
    assert_eq!(unit.address(), Some(HOME));
    ends_well(&tap, &peer, HOME, &[]);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn against_a_lower_name_the_next_free_address_is_taken_and_the_old_one_left_at_once() {
    let _turn = turn();
    make("lost");
    let (tap, peer) = (Tap::on("lost"), Peer::on("lost", 200));
    let unit = Unit::at_home("lost", &tap);
    // the next two are taken
    peer.claim(HOME + 1, LOW + 1);
    peer.claim(HOME + 2, LOW + 2);
    sleep(SECOND / 10);
    let begun = tap.now();
    peer.claim(HOME, LOW);
    let spoke = unit.settles(&tap, begun);
    let own = tap.since(begun);
    let claims = claims(&own, unit.name);
    assert_eq!(addresses(&claims), [HOME + 3]);
    println!(
        "lost: claimed the next after {:.1} ms, spoke again after {:.1} ms",
        1e3 * (claims[0].at - begun),
        1e3 * (spoke - begun)
    );
    assert!(claims[0].at - begun < 0.05);
    assert!(spoke - claims[0].at > SILENCE - LATER);
    let stale = own.iter().filter(|frame| frame.source() == HOME && frame.at > begun + LATER);
    assert_eq!(stale.count(), 0, "frames from an address that is another's");
    let lost = NodeEvent::Lost { address: HOME, to: Name::new(LOW) };
    assert!(unit.events().contains(&lost));
    assert_eq!(unit.counts().contests.lost, 1);
    ends_well(&tap, &peer, HOME + 3, &[begun]);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn against_its_own_name_it_gives_way_and_tells_so_however_often_it_is_claimed() {
    let _turn = turn();
    make("same");
    let (tap, peer) = (Tap::on("same"), Peer::on("same", 200));
    let unit = Unit::at_home("same", &tap);
    let begun = tap.now();
    let mut breaks = Vec::new();
    // ten seconds of a double that comes after it wherever it goes
    for _ in 0..100 {
        let address = unit.node.with(|node| node.address()).unwrap_or(HOME);
        peer.claim(address, unit.name.bits());
        breaks.push(tap.now());
        sleep(SECOND / 10);
    }
    let sent = claims(&tap.since(begun), unit.name).len() - 100;
    println!("same NAME: {sent} claims in ten seconds against a hundred");
    assert!(sent <= 40, "{sent} claims");
    let settled = unit.settles(&tap, tap.now());
    let alarms = unit.events();
    let same = |event: &&NodeEvent| matches!(event, NodeEvent::SameName { .. });
    assert!(alarms.iter().filter(same).count() >= 1, "{alarms:?}");
    assert_eq!(unit.counts().contests.same_name, 100);
    println!("same NAME: spoke again {:.3} s after the end", settled - breaks[99]);
    ends_well(&tap, &peer, unit.address().unwrap(), &breaks);
}

/// Others own every address.
fn claim_all(peer: &Peer) {
    for address in 0..=LAST {
        peer.claim(address, LOW + u64::from(address));
        // one frame after the other, as a wire carries them
        sleep(Duration::from_micros(600));
    }
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn where_no_address_is_free_it_says_so_and_is_quiet_until_one_is() {
    let _turn = turn();
    make("full");
    let (tap, peer) = (Tap::on("full"), Peer::on("full", 200));
    let unit = Unit::at_home("full", &tap);
    let begun = tap.now();
    claim_all(&peer);
    let full = tap.now();
    sleep(SECOND);
    let own = claims(&tap.since(begun), unit.name);
    println!("none free: claims from {:?}", addresses(&own));
    assert_eq!(own.last().unwrap().source(), NULL);
    assert_eq!(unit.node.with(|node| node.status().state), NodeState::CannotClaim);
    assert!(unit.events().contains(&NodeEvent::NoneFree));

    // asked who it is, it says that it has no address; it answers nothing else
    let asked = tap.now();
    peer.request(CLAIM, EVERYBODY);
    peer.request(PRODUCT, EVERYBODY);
    let answer = tap.wait(asked, SECOND, |frame| frame.data() == unit.name.bytes()).unwrap();
    assert_eq!((answer.pgn(), answer.source()), (CLAIM, NULL));
    sleep(5 * SECOND);
    let quiet = tap.since(full + 0.3);
    let others = quiet.iter().filter(|frame| ![CLAIM, 59_904].contains(&frame.pgn()));
    assert_eq!(others.count(), 0, "it is not quiet");
    assert_eq!(claims(&tap.since(full + 0.3), unit.name).len(), 1);

    // one moves away: its address is free
    let moved = tap.now();
    peer.claim(NULL, LOW + 77);
    let spoke = unit.settles(&tap, moved);
    assert_eq!(unit.address(), Some(77));
    println!("none free: spoke {:.3} s after an address was left", spoke - moved);
    ends_well(&tap, &peer, 77, &[begun]);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn two_units_with_one_configuration_part_and_tell_so() {
    let _turn = turn();
    make("twins");
    let (tap, peer) = (Tap::on("twins"), Peer::on("twins", 200));
    let one = Unit::on("twins", 1000, 1);
    let two = Unit::on("twins", 1000, 2);
    one.settles(&tap, 0.0);
    two.settles(&tap, 0.0);
    // what one says in the other's silence may set it going again
    sleep(2 * SECOND);
    let at = [one.address().unwrap(), two.address().unwrap()];
    let sent = claims(&tap.frames(), one.name);
    println!(
        "twins: at {at:?} after {} claims, the last at {:.3} s",
        sent.len(),
        sent.last().unwrap().at
    );
    assert_ne!(at[0], at[1]);
    assert!(sent.len() <= 12, "{:?}", addresses(&sent));
    for unit in [&one, &two] {
        let same = |event: &NodeEvent| matches!(event, NodeEvent::SameName { .. });
        assert!(unit.events().iter().any(same), "no alarm");
    }
    // nothing moves any more
    let settled = tap.now();
    sleep(10 * SECOND);
    assert_eq!(claims(&tap.since(settled), one.name).len(), 0);
    for address in at {
        ends_well(&tap, &peer, address, &[]);
    }
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn commanded_to_another_address_it_goes_there() {
    let _turn = turn();
    make("told");
    let (tap, peer) = (Tap::on("told"), Peer::on("told", 200));
    let unit = Unit::at_home("told", &tap);
    let mut breaks = Vec::new();
    let name = unit.name.bits();
    for (round, address) in [77, 78].into_iter().enumerate() {
        let from = unit.address().unwrap();
        let begun = tap.now();
        if round == 0 {
            // for another node: not ours to follow
            peer.command(name ^ 1, 99);
            peer.command(name, address);
        } else {
            assert!(peer.command_one(name, address, from, &tap), "no acknowledgement");
        }
        let spoke = unit.settles(&tap, tap.now());
        let claims = claims(&tap.since(begun), unit.name);
        println!("commanded: spoke from {address} {:.3} s after the claim", spoke - claims[0].at);
        assert_eq!(addresses(&claims), [address]);
        assert!(spoke - claims[0].at > SILENCE - LATER);
        assert_eq!(unit.address(), Some(address));
        breaks.push(claims[0].at - LATER);
    }
    assert_eq!(unit.counts().requests.commanded, 2);
    ends_well(&tap, &peer, 78, &breaks);
}
