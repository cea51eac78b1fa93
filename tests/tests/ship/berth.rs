//! At the berth: near the limit, honest, and not to be upset by gusts, tugs and steep swells.

use insd_alignment::AlignmentConfig;
use insd_base::units::{DEG, wrap_pi};
use insd_lab::evaluation::Component;
use insd_nav::berth::Method;
use insd_simulator::{Scenario, limit, simulate};
use insd_tests::sailing::{Passage, sail_aligned, sail_all};
use insd_tests::scores::{Scores, pooled};
use insd_tests::{scenario, variant};

use super::figure;

/// Heading error and claimed sigma at an instant, rad.
fn heading_at(passage: &Passage, at: f64) -> (f64, f64) {
    let close = |time: insd_base::Time| (time.as_seconds() - at).abs() < 0.02;
    let solution = passage.log.solutions.iter().find(|s| close(s.time)).unwrap();
    let truth = passage.voyage.truth.iter().find(|t| close(t.time)).unwrap();
    let error = wrap_pi(solution.attitude.heading - truth.attitude.unwrap().heading);
    (error, solution.sigma.heading)
}

/// Voyages of a ship that is held at her berth by a method.
fn moored_by(method: Method, ship: &Scenario, seeds: std::ops::Range<u64>) -> Vec<Passage> {
    let alignment = AlignmentConfig { moored: method, ..AlignmentConfig::default() };
    let sailed = |seed: u64| {
        let voyage = simulate(ship, seed);
        let log = sail_aligned(&voyage, &alignment);
        Passage { voyage, log }
    };
    seeds.map(sailed).collect()
}

/// Largest heading error in claimed sigmas after the first half minute.
fn worst(passages: &[Passage]) -> f64 {
    let of = |passage: &Passage| {
        let last = passage.voyage.truth.last().unwrap().time.as_seconds() as u32;
        (30..last)
            .map(|t| heading_at(passage, f64::from(t)))
            .map(|(error, sigma)| (error / sigma).abs())
            .fold(0.0, f64::max)
    };
    passages.iter().map(of).fold(0.0, f64::max)
}

#[test]
fn s07_the_claimed_heading_is_near_that_of_the_optimal_filter() {
    for method in [Method::Moorings, Method::Autoregressive] {
        for number in [7, 8, 17] {
            let ship = scenario(number).with_duration(620.0);
            let passages = moored_by(method, &ship, 0..2);
            let bound = limit(&ship, &[300.0, 600.0]).unwrap();
            for (at, limit) in [300.0, 600.0].into_iter().zip(bound) {
                let (_, sigma) = heading_at(&passages[0], at);
                let name = method.as_str();
                figure!(
                    "s{number} {name} {at} s: {} deg, limit {}",
                    sigma / DEG,
                    limit.heading / DEG
                );
                assert!(sigma < 1.1 * limit.heading, "s{number} {name} at {at} s");
            }
            assert!(worst(&passages) < 4.5, "s{number}: {}", worst(&passages));
        }
    }
}

#[test]
fn s24_steps_and_an_engine_leave_the_claimed_heading_near_that_of_the_optimal_filter() {
    for step in ["0.1", "0.7", "2.0"] {
        let steps = format!("gyro_arcsec = {step}");
        let ship = variant(24, &[("gyro_arcsec = 0.7", &steps)]).with_duration(620.0);
        let passages = sail_all(&ship, 0..2);
        let bound = limit(&ship, &[300.0, 600.0]).unwrap();
        for (at, limit) in [300.0, 600.0].into_iter().zip(bound) {
            for passage in &passages {
                let (error, sigma) = heading_at(passage, at);
                figure!("s24 {step} arcsec, {at} s: {} off, {} deg", error / DEG, sigma / DEG);
                assert!(sigma < 1.2 * limit.heading, "{step} arcsec at {at} s");
            }
        }
        assert!(worst(&passages) < 4.5, "{step} arcsec: {}", worst(&passages));
    }
}

#[test]
fn s09_a_tactical_imu_never_grows_surer_of_the_heading_than_its_gyros_allow() {
    let passages = sail_all(&scenario(9).with_duration(900.0), 0..4);
    // 0.5 deg/h of bias against the 12.3 deg/h of the Earth's rate to the north at 35 degrees
    let floor = 0.5 / (15.041 * (35.0 * DEG).cos());
    for passage in &passages {
        let (error, sigma) = heading_at(passage, 890.0);
        figure!("s09 {} deg claimed, {} deg off", sigma / DEG, error / DEG);
        assert!(sigma > 0.95 * floor && sigma < 1.15 * floor);
        assert!(error.abs() < 4.0 * sigma);
    }
}

#[test]
fn s19_s20_gusts_and_tugs_do_not_mislead_a_ship_at_her_berth() {
    for number in [19, 20, 21] {
        let passages = sail_all(&scenario(number).with_duration(900.0), 0..3);
        let scores: Vec<Scores> = passages.iter().map(|p| p.scores_from(600.0)).collect();
        let heading = pooled(&scores).of(Component::Heading);
        figure!("s{number} {heading:?}, worst {}", worst(&passages));
        assert!(heading.rms < 0.15, "s{number} {heading:?}");
        assert!(worst(&passages) < 4.5, "s{number}: {}", worst(&passages));
    }
}

#[test]
fn s23_a_ship_that_leaves_her_berth_while_aligning_goes_on_aligning_in_motion() {
    let passages = sail_all(&scenario(23).with_duration(600.0), 0..3);
    for passage in &passages {
        let end = passage.log.solutions.last().unwrap();
        figure!("s23 {:?} {} deg", end.mode, end.sigma.heading / DEG);
        assert_eq!(end.mode, insd_base::Mode::Aided);
        let scores = passage.scores_from(300.0);
        assert!(scores.of(Component::North).rms < 5.0);
    }
    assert!(worst(&passages) < 4.5, "{}", worst(&passages));
}
