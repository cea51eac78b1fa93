//! A bus that goes away, a controller that gives up, and a bus that is full.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::sleep;
use std::time::Duration;

use insd_base::BusEvent;

use super::guest::{SECOND, ip, make, run, turn};
use super::order::check;
use super::peer::{CLAIM, Peer};
use super::tap::{Heard, Tap};
use super::unit::{HEADING, HOME, Unit};

/// Classes of the controller's words.
const BUS_OFF: u32 = 0x40;
const RESTARTED: u32 = 0x100;

/// It answers within a second of now, from the address it had. Gives how long that took, s.
fn is_back(tap: &Tap, peer: &Peer) -> f64 {
    let took = peer.insist(HOME, tap, 3 * SECOND).expect("an answer");
    assert!(took < 1.0, "answered after {took} s");
    took
}

fn of_node(frames: &[Heard], pgn: u32) -> usize {
    frames.iter().filter(|frame| frame.source() == HOME && frame.pgn() == pgn).count()
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_link_that_goes_down_and_up_finds_it_again_at_once() {
    let _turn = turn();
    make("link0");
    let tap = Tap::on("link0");
    let unit = Unit::at_home("link0", &tap);
    let mut breaks = Vec::new();
    for pause in [Duration::ZERO, SECOND, 20 * SECOND] {
        ip("link set link0 down");
        let down = tap.now();
        breaks.push(down);
        sleep(pause);
        ip("link set link0 up");
        let took = is_back(&tap, &Peer::on("link0", 200));
        println!("down for {pause:?}: answered {took:.3} s after the link was up");
        assert!(of_node(&tap.since(down), CLAIM) >= 1, "no claim after the link was up");
    }
    let states = unit.got().states;
    let lost = states.iter().filter(|state| state.contains("lost")).count();
    let open = states.iter().filter(|state| state.contains("open")).count();
    assert_eq!((lost, open), (3, 4), "{states:?}");
    check(&tap.frames(), &breaks, |source| source == HOME);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn an_interface_that_is_deleted_and_made_anew_finds_it_again_at_once() {
    let _turn = turn();
    make("gone");
    let tap = Tap::on("gone");
    let unit = Unit::at_home("gone", &tap);
    let mut breaks = Vec::new();
    for pause in [Duration::ZERO, 5 * SECOND] {
        breaks.push(tap.now());
        ip("link delete gone");
        sleep(pause);
        make("gone");
        let took = is_back(&tap, &Peer::on("gone", 200));
        println!("gone for {pause:?}: answered {took:.3} s after the interface was up");
    }
    let states = unit.got().states;
    assert_eq!(states.iter().filter(|state| state.contains("lost")).count(), 2, "{states:?}");
    check(&tap.frames(), &breaks, |source| source == HOME);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_controller_that_leaves_the_bus_silences_it_until_it_is_back() {
    let _turn = turn();
    make("off");
    let (tap, peer) = (Tap::on("off"), Peer::on("off", 200));
    let unit = Unit::at_home("off", &tap);
    let mut breaks = Vec::new();
    for told in [true, false] {
        let off = tap.now();
        breaks.push(off);
        peer.controller(BUS_OFF);
        sleep(SECOND * 4 / 10);
        let sent = tap.since(off + 0.01);
        assert!(sent.is_empty(), "{} frames while the controller is off", sent.len());
        if told {
            peer.controller(RESTARTED);
            let took = is_back(&tap, &peer);
            println!("bus off: answered {took:.3} s after the restart");
        } else {
            // nobody says that it is back, and nothing is heard
            let spoke = unit.settles(&tap, off);
            println!("bus off: spoke {:.3} s after it, told of no restart", spoke - off);
            assert!(spoke - off < 1.0);
            is_back(&tap, &peer);
        }
        // what was on its way when the controller spoke is not silence broken
        let since = tap.since(off + 0.01);
        let claim = since.iter().find(|frame| frame.source() == HOME).unwrap();
        assert_eq!(claim.pgn(), CLAIM, "something is sent before the claim");
        sleep(SECOND);
    }
    assert_eq!(unit.got().bus, [BusEvent::BusOff, BusEvent::Restarted, BusEvent::BusOff]);
    assert!(unit.counts().queue.cleared <= 40, "{:?}", unit.counts().queue);
    check(&tap.frames(), &breaks, |source| source == HOME);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_bus_full_of_urgent_frames_is_heard_whole_and_spoken_on() {
    const SECONDS: usize = 10;
    const RATE: usize = 1800;
    let _turn = turn();
    make("busy");
    let (tap, peer) = (Tap::on("busy"), Peer::on("busy", 200));
    let unit = Unit::at_home("busy", &tap);
    let before = unit.got().frames;
    let begun = tap.now();
    for number in 0..RATE * SECONDS {
        // single frames, broken fast packets, other lengths of address: whatever a bus may carry
        let pgn = [HEADING, 129_029, 130_820, 61_184, 127_488][number % 5];
        peer.send(0, pgn, HOME, 200, &(number as u64).to_le_bytes());
        let due = begun + (number + 1) as f64 / RATE as f64;
        sleep(Duration::from_secs_f64((due - tap.now()).max(0.0)));
    }
    let ended = tap.now();
    let took = is_back(&tap, &peer);
    println!(
        "busy: {} frames in {:.3} s; answered {took:.3} s after",
        RATE * SECONDS,
        ended - begun
    );
    let during: Vec<Heard> =
        tap.since(begun).into_iter().filter(|frame| frame.at < ended).collect();
    let (headings, positions) = (of_node(&during, HEADING), of_node(&during, 129_029));
    println!("busy: {headings} headings, {positions} frames of 129029 meanwhile");
    assert!(headings >= 10 * SECONDS - 1 && positions >= 7 * (SECONDS - 1));
    let heard = unit.got().frames - before;
    assert!(heard >= (RATE * SECONDS) as u64, "{heard} frames heard");
    assert!(unit.got().bus.is_empty(), "{:?}", unit.got().bus);
    check(&tap.frames(), &[], |source| source == HOME);
}

/// Two controllers on one bus, the first of which shares its device with a program that fills the queue
/// whenever there is room, as frames of a higher priority hold up those of a lower one on a wire.
#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn on_a_bus_on_which_nothing_can_be_sent_only_what_is_fresh_is_sent_later() {
    let _turn = turn();
    for name in ["can0", "can1"] {
        ip(&format!("link set {name} type can bitrate 250000 restart-ms 100"));
        ip(&format!("link set {name} txqueuelen 10 up"));
    }
    // the emulated controllers send in no time: so slow as a bus, with room for ten frames of 16 bytes
    run("tc", "qdisc add dev can0 root tbf rate 230kbit burst 32 limit 160");
    let (tap, peer) = (Tap::on("can1"), Peer::on("can1", 200));
    let unit = Unit::at_home("can0", &tap);
    let stop = Arc::new(AtomicBool::new(false));
    let greedy = std::thread::spawn({
        let (stop, greedy) = (Arc::clone(&stop), Peer::on("can0", 201));
        move || {
            while !stop.load(Ordering::Relaxed) {
                while greedy.try_say(0x8000_0000 | 0x01F1_12C9, &[0; 8]).is_ok() {}
                sleep(Duration::from_micros(200));
            }
        }
    });
    let begun = tap.now();
    sleep(10 * SECOND);
    stop.store(true, Ordering::Relaxed);
    greedy.join().unwrap();
    let ended = tap.now();
    let took = is_back(&tap, &peer);
    let during: Vec<Heard> =
        tap.since(begun).into_iter().filter(|frame| frame.at < ended).collect();
    let own = during.iter().filter(|frame| frame.source() == HOME).count();
    let queue = unit.counts().queue;
    println!("full: {own} of {} frames are the node's; answered {took:.3} s after", during.len());
    println!("full: {queue:?}");
    assert!(queue.refused > 10 && queue.replaced > 100, "{queue:?}");
    assert!(unit.node.with(|node| node.status().waiting) < 20);
    check(&tap.frames(), &[], |source| source == HOME);
    ip("link set can0 down");
    ip("link set can1 down");
}
