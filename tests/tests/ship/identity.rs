//! The same messages give the same bits.

use insd_base::{Received, Solution, Time, Voyage};
use insd_engine::EngineConfig;
use insd_simulator::simulate;
use insd_tests::sailing::{Logbook, sail_messages};
use insd_tests::scenario;

/// A solution as bits, so that -0 and NaN count as what they are.
fn bits(solution: &Solution) -> Vec<u64> {
    let sigma = &solution.sigma;
    let place = &solution.position;
    let attitude = &solution.attitude;
    let vectors = [&solution.velocity.0, &solution.rate.0, &sigma.position.0, &sigma.velocity.0];
    let scalars = [place.latitude, place.longitude, place.height];
    let angles = [attitude.roll, attitude.pitch, attitude.heading];
    let sigmas = [sigma.roll, sigma.pitch, sigma.heading];
    let all = vectors.into_iter().flat_map(|v| v.iter().copied());
    let all = all.chain(scalars).chain(angles).chain(sigmas).map(f64::to_bits);
    [solution.time.as_nanos() as u64, solution.mode as u64].into_iter().chain(all).collect()
}

fn all_bits(solutions: &[Solution]) -> Vec<Vec<u64>> {
    solutions.iter().map(bits).collect()
}

/// Late messages, gaps and jitter included.
fn voyage(number: usize) -> Voyage {
    simulate(&scenario(number).with_duration(150.0), 4)
}

fn sail(voyage: &Voyage, rate: f64, batch: usize) -> Logbook {
    let messages: Vec<Received> = voyage.received();
    sail_messages(&EngineConfig::for_voyage(&voyage.header, rate), &messages, batch)
}

#[test]
fn the_same_messages_give_the_same_bits_in_batches_of_any_size() {
    for number in [13, 16] {
        let voyage = voyage(number);
        let once = sail(&voyage, 10.0, 1);
        assert!(once.solutions.len() > 1000);
        for batch in [1, 7, 1000, usize::MAX] {
            let again = sail(&voyage, 10.0, batch);
            assert!(all_bits(&again.solutions) == all_bits(&once.solutions), "batch {batch}");
            assert_eq!(again.innovations, once.innovations);
            assert_eq!(again.events, once.events);
            assert_eq!(again.counts, once.counts);
        }
    }
}

#[test]
fn solutions_asked_for_more_often_are_the_same_bits_at_the_same_epochs() {
    for number in [13, 16] {
        let voyage = voyage(number);
        let seldom = sail(&voyage, 10.0, 1);
        let mut often = sail(&voyage, 50.0, 1).solutions;
        let tenth = Time::from_seconds(0.1).as_nanos();
        often.retain(|solution| solution.time.as_nanos() % tenth == 0);
        assert!(all_bits(&often) == all_bits(&seldom.solutions), "scenario {number}");
    }
}
