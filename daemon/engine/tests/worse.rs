//! An IMU that is worse than its data sheet: it is found out from what the others say, told, and covered by the claim.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::units::wrap_pi;
use insd_base::{Event, Finding, Solution, Truth, Voyage};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::lies::{Grade, Suite, case, catalogue};

/// The better part of an hour with a MEMS IMU, a log and four turns.
fn voyage() -> Voyage {
    case(&catalogue()[0], Grade::Mems, Suite::Log, 6).honest().unwrap()
}

/// With a data sheet that promises so many times smaller biases and scale factors.
fn promising(mut voyage: Voyage, times: f64) -> Voyage {
    for triad in [&mut voyage.header.imu.gyro, &mut voyage.header.imu.accel] {
        triad.instability_std /= times;
        triad.scale_std /= times;
    }
    voyage
}

/// Mean square of the error of the heading over its claimed variance after half an hour, and by how much worse the IMU
/// was found to be.
fn sailed(voyage: &Voyage) -> (f64, Option<f64>) {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let (mut squares, mut found) = (Vec::new(), None);
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(solution) => squares.extend(square(&solution, &voyage.truth)),
                Output::Event(Event::InstallationFound { finding, .. }) => match finding {
                    Finding::ImuWorse { times } => found = Some(times),
                    other => assert_eq!(other.to_string(), "", "is found, too"),
                },
                Output::Event(Event::Judged { stands, .. }) => assert_eq!(stands.to_string(), ""),
                _ => {}
            }
        }
    }
    (squares.iter().sum::<f64>() / squares.len() as f64, found)
}

fn square(solution: &Solution, truth: &[Truth]) -> Option<f64> {
    const SETTLED: f64 = 1800.0;
    let at = truth.binary_search_by_key(&solution.time, |row| row.time).ok()?;
    let off = wrap_pi(solution.attitude.heading - truth[at].attitude?.heading);
    (solution.time.as_seconds() > SETTLED).then(|| (off / solution.sigma.heading).powi(2))
}

#[test]
fn an_imu_that_is_worse_than_its_data_sheet_is_found_out_and_covered() {
    let (nees, found) = sailed(&promising(voyage(), 10.0));
    assert!(found.is_some_and(|times| times > 5.0), "{found:?}");
    assert!((0.2..2.5).contains(&nees), "NEES {nees}");
}

#[test]
fn an_imu_that_is_as_its_data_sheet_says_is_believed() {
    let (nees, found) = sailed(&voyage());
    assert_eq!(found, None);
    assert!((0.2..2.5).contains(&nees), "NEES {nees}");
}
