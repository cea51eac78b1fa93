//! Which engine is used, and that a replay comes to the same.

use insd_base::{Arrival, Input};
use insd_engine::vote::{Doubt, VoteEvent};
use insd_tests::engines::Log;

use super::{FAULT, Fault, faulty, fleet, heading, position};

#[test]
fn when_the_first_imu_falls_silent_the_outputs_go_on() {
    let mut fleet = fleet().clone().until(300.0);
    fleet.imus.truncate(2);
    fleet.engines.truncate(2);
    let (mut arrivals, reception) = fleet.arrivals();
    let when = |stamp: insd_base::Stamp| (stamp.monotonic - reception.offset).as_seconds();
    arrivals.retain(|own| own.port.0 != 0 || !(FAULT..FAULT + 1.0).contains(&when(own.stamp)));
    let log = fleet.sail_on(&arrivals, &reception);
    println!("{:?}", log.votes);
    let [
        (left, VoteEvent::Switched { to: 1, why: Some(Doubt::Silent), .. }),
        (back, VoteEvent::Switched { to: 0, why: None, .. }),
    ] = log.votes[..]
    else {
        panic!("{:?}", log.votes)
    };
    assert!((0.1..0.3).contains(&(left - FAULT)), "{left}");
    assert!((30.0..33.0).contains(&(back - FAULT)), "{back}");
    let missing = log.told.iter().filter(|own| own.at > 60.0 && own.solution.is_none()).count();
    assert!(missing <= 1, "{missing} epochs without a solution");
    let (error, sigmas) = heading(&log, FAULT + 0.3);
    assert!(sigmas < 3.0, "{error} deg, {sigmas} sigmas");
    assert!(position(&log, FAULT + 0.3) < 8.0);
    // each epoch has one solution, whoever it is from
    let times: Vec<_> = log.solutions.iter().map(|solution| solution.time).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn an_engine_on_the_same_imu_never_differs() {
    let mut fleet = faulty(1, 0, Fault::Bias([0.0, 0.0, 3600.0]), 300.0);
    fleet.engines = vec![0, 0];
    let log = fleet.sail();
    assert_eq!(log.votes, []);
    assert_eq!(log.used, [0]);
}

#[test]
fn a_sound_spare_changes_nothing_of_what_is_said() {
    let mut fleet = fleet().clone().until(120.0);
    let (arrivals, reception) = fleet.arrivals();
    let with = fleet.sail_on(&arrivals, &reception);
    fleet.engines.truncate(1);
    let without = fleet.sail_on(&arrivals, &reception);
    assert!(without.sent.len() > 10_000);
    assert!(with == Log { votes: Vec::new(), ..without });
}

#[test]
fn a_replay_comes_to_the_same_choice_and_the_same_bytes_however_they_are_split() {
    let fleet = faulty(3, 0, Fault::Stuck, 300.0);
    let (arrivals, reception) = fleet.arrivals();
    let (once, taken) = fleet.record(&arrivals, &reception);
    assert_eq!(once.used.len(), 2);
    assert!(fleet.replay(&taken, &reception) == once);
    let split = taken.iter().flat_map(|own| {
        let Input::Bytes(bytes) = &own.input else { return vec![own.clone()] };
        let (head, tail) = bytes.split_at(bytes.len() / 2);
        let part = |bytes: &[u8]| Arrival { input: Input::Bytes(bytes.to_vec()), ..own.clone() };
        vec![part(head), part(tail)]
    });
    let split: Vec<_> = split.collect();
    assert!(fleet.replay(&split, &reception) == once);
}
