//! What is answered to whom, and how much of a storm of requests.

use std::thread::sleep;
use std::time::Duration;

use super::guest::{SECOND, make, turn};
use super::order::check;
use super::peer::{CLAIM, CONFIGURATION, EVERYBODY, LISTS, PRODUCT, Peer, REFUSAL};
use super::tap::{Heard, Tap};
use super::unit::{HEADING, HOME, Unit};

/// A group that nobody sends.
const UNKNOWN: u32 = 130_999;

fn text(data: &[u8]) -> String {
    String::from_utf8_lossy(data).into_owned()
}

/// Groups of a list: a byte for its kind, and three for each group.
fn listed(data: &[u8]) -> Vec<u32> {
    let group = |bytes: &[u8]| u32::from_le_bytes([bytes[0], bytes[1], bytes[2], 0]);
    data[1..].chunks_exact(3).map(group).collect()
}

/// Waits for the answer to the second of two lists that leave one after the other.
fn list(tap: &Tap, peer: &Peer, kind: u8) -> Vec<u32> {
    let since = tap.now();
    peer.request(LISTS, HOME);
    let mut lists: Vec<(usize, Vec<u8>)> = Vec::new();
    tap.wait(since, SECOND, |frame| {
        if frame.pgn() == LISTS && frame.source() == HOME {
            assert_eq!(frame.destination(), peer.address);
            if frame.data()[0] & 31 == 0 {
                lists.push((frame.data()[1].into(), frame.data()[2..].to_vec()));
            } else {
                lists.last_mut().unwrap().1.extend_from_slice(&frame.data()[1..]);
            }
        }
        lists.len() == 2 && lists.iter().all(|(length, data)| data.len() >= *length)
    })
    .expect("both lists");
    println!("two lists after {:.1} ms", 1e3 * (tap.now() - since));
    let (length, data) = lists.iter().find(|(_, data)| data[0] == kind).unwrap();
    listed(&data[..*length])
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn requests_are_answered_and_what_is_not_known_is_refused_to_who_asked_alone() {
    let _turn = turn();
    make("asked");
    let (tap, peer) = (Tap::on("asked"), Peer::on("asked", 200));
    let unit = Unit::at_home("asked", &tap);
    peer.claim(peer.address, u64::MAX - 5);
    for to in [HOME, EVERYBODY] {
        let asked = tap.now();
        peer.request(CLAIM, to);
        let claim = tap.wait(asked, SECOND, |frame| frame.data() == unit.name.bytes()).unwrap();
        assert_eq!((claim.pgn(), claim.source(), claim.destination()), (CLAIM, HOME, EVERYBODY));
        println!("claim after {:.1} ms", 1e3 * (claim.at - asked));
        sleep(SECOND / 10);
    }
    let (took, product) = peer.ask(PRODUCT, HOME, &tap).unwrap();
    println!("product information after {:.1} ms: {:?}", 1e3 * took, text(&product[4..36]));
    assert!(
        text(&product[4..36]).starts_with("insd") && text(&product[100..132]).starts_with("1000")
    );
    let (took, configuration) = peer.ask(CONFIGURATION, HOME, &tap).unwrap();
    println!("configuration after {:.1} ms: {:?}", 1e3 * took, text(&configuration));
    assert!(text(&configuration).contains("insd"));
    let sent = list(&tap, &peer, 0);
    for pgn in [CLAIM, LISTS, PRODUCT, CONFIGURATION, 126_993, HEADING, 129_025, 129_029] {
        assert!(sent.contains(&pgn), "{pgn} is not in {sent:?}");
    }
    sleep(SECOND / 4);
    let read = list(&tap, &peer, 1);
    assert!(read.contains(&59_904) && read.contains(&65_240), "{read:?}");

    let asked = tap.now();
    peer.request(UNKNOWN, HOME);
    let refusal = tap.wait(asked, SECOND, |frame| frame.pgn() == REFUSAL).unwrap();
    assert_eq!((refusal.source(), refusal.destination()), (HOME, peer.address));
    let [low, middle, high, _] = UNKNOWN.to_le_bytes();
    assert_eq!(refusal.data(), [1, 255, 255, 255, 255, low, middle, high]);
    let asked = tap.now();
    peer.request(UNKNOWN, EVERYBODY);
    assert!(tap.wait(asked, SECOND, |frame| frame.pgn() == REFUSAL).is_none());
    let requests = unit.counts().requests;
    assert_eq!((requests.requests, requests.refusals), (8, 1));
    check(&tap.frames(), &[], |source| source == HOME);
}

/// Frames of the node in a span, and how many of them are of a group.
fn of_node(frames: &[Heard], pgn: u32) -> (usize, usize) {
    let own: Vec<&Heard> = frames.iter().filter(|frame| frame.source() == HOME).collect();
    (own.len(), own.iter().filter(|frame| frame.pgn() == pgn).count())
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_storm_of_requests_starves_nothing_and_is_answered_in_measure() {
    const SECONDS: usize = 5;
    let _turn = turn();
    make("storm");
    let (tap, peer) = (Tap::on("storm"), Peer::on("storm", 200));
    let unit = Unit::at_home("storm", &tap);
    let begun = tap.now();
    let asked = [CLAIM, PRODUCT, CONFIGURATION, LISTS, UNKNOWN, HEADING, 126_993];
    for number in 0..1000 * SECONDS {
        let to = if number % 2 == 0 { HOME } else { EVERYBODY };
        peer.request(asked[number % asked.len()], to);
        let due = begun + (number + 1) as f64 * 1e-3;
        sleep(Duration::from_secs_f64((due - tap.now()).max(0.0)));
    }
    let ended = tap.now();
    println!("{} requests in {:.3} s", 1000 * SECONDS, ended - begun);
    let took = peer.insist(HOME, &tap, 2 * SECOND).expect("an answer after the storm");
    println!("answered {took:.3} s after the storm");
    assert!(took < 1.0);

    let frames: Vec<Heard> =
        tap.since(begun).into_iter().filter(|frame| frame.at < ended).collect();
    for pgn in [HEADING, CLAIM, PRODUCT, CONFIGURATION, LISTS, REFUSAL, 126_993, 129_025, 129_029] {
        let (all, own) = of_node(&frames, pgn);
        println!("{pgn}: {own} of {all} frames");
    }
    let (all, headings) = of_node(&frames, HEADING);
    // a bus carries some 1,800 frames a second
    assert!(all < 400 * SECONDS, "{all} frames");
    assert!(headings >= 10 * SECONDS - 1, "{headings} headings");
    assert!(of_node(&frames, 129_025).1 >= 10 * SECONDS - 1);
    assert!(of_node(&frames, 129_029).1 >= 7 * (SECONDS - 1));
    let (counts, got) = (unit.counts(), unit.got());
    println!("{:?}\n{:?}", counts.requests, counts.queue);
    assert!(counts.requests.requests >= 1000 * SECONDS as u64, "{:?}", counts.requests);
    assert_eq!((counts.queue.crowded, counts.queue.expired), (0, 0), "{:?}", counts.queue);
    assert!(got.frames >= 1000 * SECONDS as u64, "{got:?}");
    check(&tap.frames(), &[], |source| source == HOME);
}
