//! Protection levels of a ship that is led astray, and of one that is not.

use insd_base::{Time, earth};
use insd_engine::EngineConfig;
use insd_simulator::simulate;
use insd_tests::sailing::sail_messages;

use crate::figure;

/// Where a spoofer pulls a receiver away slowly, with a MEMS IMU and nothing else on board, nobody can tell for good. That it may be so was seen at its begin,
/// and is not forgotten. A lie that is hardly likelier than the risk is covered to its middle, and not to its end.
#[test]
fn a_level_grows_with_a_slow_drag_for_as_long_as_it_lasts_where_nobody_can_prove_it() {
    let scenario =
        insd_tests::variant(28, &[("[log]\n", ""), ("speed_mps = 0.5", "speed_mps = 0.15")])
            .with_duration(1200.0);
    for seed in [1, 2, 3] {
        let voyage = simulate(&scenario, seed);
        let config = EngineConfig::for_voyage(&voyage.header, 1.0);
        let log = sail_messages(&config, &voyage.received(), 100);
        let (mut worst, mut off) = (0.0_f64, 0.0_f64);
        for own in log.solutions.iter().filter(|own| own.time > Time::from_seconds(300.0)) {
            let truth = voyage.truth.binary_search_by_key(&own.time, |truth| truth.time);
            let Some(truth) = truth.ok().map(|at| &voyage.truth[at]) else { continue };
            let apart = earth::ecef(&own.position).0 - earth::ecef(&truth.position).0;
            let error = (earth::c_ne(&truth.position) * apart).xy().norm();
            worst = worst.max(error / own.protection().horizontal);
            off = off.max(error);
        }
        figure!("seed {seed}: {off:.0} m off, error over level {worst:.2}");
        assert!(off > 50.0, "nobody proves it: {off}");
        assert!(worst < 1.4, "{seed}: {worst}");
    }
}
