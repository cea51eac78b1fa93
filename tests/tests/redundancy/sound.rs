//! Sound engines on voyages of all kinds: they agree.

use insd_engine::vote::VoteEvent;
use insd_tests::engines::Fleet;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// A harbour departure, MEMS, outages and faults of the receiver, a berth in a seaway, the pole, a berth
/// with a receiver: scenario and length, s.
const VOYAGES: [(usize, f64); 6] =
    [(1, 900.0), (3, 900.0), (5, 1800.0), (8, 1800.0), (12, 2100.0), (22, 600.0)];

#[test]
fn sound_engines_never_disagree() {
    VOYAGES.into_par_iter().for_each(|(number, seconds)| {
        let scenario = insd_tests::scenario(number).with_duration(seconds);
        let fleet = Fleet::new(&scenario, 3, &[[-12.0, 2.0, 0.5]]);
        let mut navigated = 0;
        fleet.watch(|at, said, found| {
            let navigates = |own: &insd_engine::vote::Testimony| {
                own.motion.is_some_and(|motion| motion.solution.mode.is_navigating())
            };
            navigated += u32::from(said.iter().all(navigates));
            for event in found {
                println!("s{number:02} {at:.1} {event:?}");
                assert!(matches!(event, VoteEvent::Switched { .. }), "s{number:02} {event:?}");
            }
        });
        assert!(navigated > 1000, "s{number:02}: {navigated}");
    });
}
