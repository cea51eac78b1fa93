//! Under way: with GNSS, without it for a while, and without it for good.

use insd_base::units::DEG;
use insd_base::{Mode, Time};
use insd_lab::evaluation::Component;
use insd_simulator::simulate;
use insd_tests::noise_free::{self, Loss};
use insd_tests::sailing::{Passage, sail_all};
use insd_tests::scores::{Scores, dishonest, pooled};
use insd_tests::{scenario, variant};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::figure;

const HORIZONTAL: [Component; 5] = [
    Component::North,
    Component::East,
    Component::VelocityNorth,
    Component::VelocityEast,
    Component::Heading,
];

/// The mechanisation alone, from the true state, with a perfect IMU in sea state 6.
///
/// The free vertical channel is unstable: gravity falls with height, so that an error in height grows
/// with exp(t / 570 s), 23-fold in half an hour and 300,000-fold in two hours, and as a ship that
/// rises is thrown west, some of it comes into the horizontal. Only the horizontal and the attitude
/// are therefore held to a bar over the whole two hours, and the height over the first half hour;
/// after two hours it is off by some 60 m, grown from 0.2 mm. `just noise-free` prints the figures of
/// some seeds.
#[test]
fn s01_without_sensor_errors_the_mechanisation_stays_within_5_m_in_two_hours_of_rough_sea() {
    let losses: Vec<Loss> = [1800.0, 7200.0]
        .into_par_iter()
        .map(|length| noise_free::integrate(&simulate(&scenario(15).with_duration(length), 1)))
        .collect();
    figure!("s01 {losses:?}");
    assert!(losses[0].vertical < 0.1, "{losses:?}");
    assert!(losses[1].horizontal < 5.0, "{losses:?}");
    assert!(losses[1].attitude < 0.002 * DEG, "{losses:?}");
}

#[test]
fn s02_with_gnss_and_log_position_and_heading_are_good_and_honest() {
    let passages = sail_all(&scenario(2).with_duration(1500.0), 0..3);
    let scores: Vec<Scores> = passages.iter().map(|p| p.scores_from(900.0)).collect();
    let all = pooled(&scores);
    figure!("s02 {:?} {:?}", all.horizontal(), all.of(Component::Heading));
    assert!(all.horizontal().rms < 2.0, "{:?}", all.horizontal());
    assert!(all.of(Component::Heading).rms < 0.2, "{:?}", all.of(Component::Heading));
    assert!(all.of(Component::VelocityNorth).rms < 0.03);
    assert!(all.of(Component::VelocityEast).rms < 0.03);
    assert_eq!(dishonest(&scores, &Component::ALL), Vec::<String>::new());
    for passage in &passages {
        assert_eq!(passage.log.solutions.last().unwrap().mode, Mode::Aided);
    }
}

/// A MEMS voyage of 20 min whose GNSS is lost from 700 s to 1000 s.
const SHORT_OUTAGE: (&str, &str) = (
    "when = { at_s = [2064.5] }\nduration_s = 60.0",
    "when = { at_s = [700.5] }\nduration_s = 300.0",
);

#[test]
fn s03_in_an_outage_the_log_holds_the_drift_to_what_is_claimed() {
    let scenario = variant(3, &[SHORT_OUTAGE]).with_duration(1200.0);
    let passages = sail_all(&scenario, 0..3);
    let drifts: Vec<Scores> = passages.iter().map(|p| p.scores_between(990.0, 1000.0)).collect();
    let all = pooled(&drifts);
    figure!("s03 {:?}", all.horizontal());
    assert_eq!(dishonest(&drifts, &HORIZONTAL), Vec::<String>::new());
    // 0.5 % scale and 0.3 deg misalignment of the log over 750 m to 1,800 m, and its noise
    assert!(all.horizontal().rms < 20.0 && all.horizontal().mean_sigma < 20.0);
    for passage in &passages {
        assert_eq!(passage.log.mode_at(995.0), Some(Mode::DeadReckoning));
        assert_eq!(passage.log.mode_at(1190.0), Some(Mode::Aided));
    }
    let after = pooled(&passages.iter().map(|p| p.scores_from(1020.0)).collect::<Vec<_>>());
    assert!(after.horizontal().max < 8.0, "{:?}", after.horizontal());
}

#[test]
fn s04_on_the_log_alone_the_drift_is_a_small_share_of_the_way_and_honest() {
    let scenario = variant(4, &[("at_s = [1200.5]", "at_s = [700.5]")]).with_duration(2100.0);
    let passages = sail_all(&scenario, 0..2);
    let drifts: Vec<Scores> = passages.iter().map(|p| p.scores_between(2090.0, 2100.0)).collect();
    let all = pooled(&drifts).horizontal();
    figure!("s04 {all:?}");
    assert_eq!(dishonest(&drifts, &HORIZONTAL), Vec::<String>::new());
    assert!(all.rms < 0.01 * way(&passages[0], 700.0), "{all:?}");
    assert!(all.mean_sigma < 0.01 * way(&passages[0], 700.0), "{all:?}");
    assert!(passages.iter().all(|p| p.log.mode_at(2095.0) == Some(Mode::DeadReckoning)));
}

/// Length of the true track from an instant on, s, in m.
fn way(passage: &Passage, from: f64) -> f64 {
    let truth = passage.voyage.truth.iter().filter(|t| t.time >= Time::from_seconds(from));
    let speeds: Vec<f64> = truth.map(|t| t.velocity.unwrap().0.xy().norm()).collect();
    speeds.iter().sum::<f64>() * 0.1
}

#[test]
fn s14_when_the_log_sees_water_the_current_is_learnt_and_carried_through_an_outage() {
    let shortened = [
        ("water_from_s = 1800.0", "water_from_s = 400.0"),
        ("at_s = [3000.5] }\nduration_s = 1800.0", "at_s = [1000.5] }\nduration_s = 400.0"),
        ("window_s = [1000.0, 5000.0]", "window_s = [500.0, 1400.0]"),
    ];
    let passages = sail_all(&variant(14, &shortened).with_duration(1500.0), 0..3);
    let drifts: Vec<Scores> = passages.iter().map(|p| p.scores_between(1390.0, 1400.0)).collect();
    let all = pooled(&drifts).horizontal();
    figure!("s14 {all:?}");
    assert_eq!(dishonest(&drifts, &HORIZONTAL), Vec::<String>::new());
    // a current of 0.67 m/s that is not known carries the ship 270 m away in this time
    assert!(all.rms < 50.0, "{all:?}");
    for passage in &passages {
        assert!(passage.log.accepted("log_water") > 800, "{:?}", passage.log.counts);
        assert!(passage.log.accepted("log_bottom") > 250, "{:?}", passage.log.counts);
        assert_eq!(passage.log.mode_at(1490.0), Some(Mode::Aided));
    }
}
