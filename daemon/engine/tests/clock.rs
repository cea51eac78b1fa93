//! A clock of the IMU that steps: seen by when samples are received, or, where nobody knows that, by what the others say.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Event, Judgement, Span, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::lies::{Grade, ImuLie, Lie, Suite, Told, Window, case, catalogue};

const STEP: f64 = 1.6;
/// A sample is received so long after it is valid.
const LATENCY: Span = Span::from_nanos(2_000_000);

/// Steps that were told, how far off she was at most, m, and whether anybody was named.
fn sailed(is_receipt_known: bool, lie: ImuLie) -> (Vec<f64>, f64, bool) {
    let kind = catalogue().iter().find(|it| it.name == "imu clock").unwrap();
    let mut voyage = case(kind, Grade::Mems, Suite::Both, 3).honest().unwrap();
    let window = Window { from: 700.0, until: f64::INFINITY };
    for sample in &mut voyage.imu {
        sample.arrival = Some(sample.message.time + LATENCY);
    }
    Told { lie: Lie::Imu(lie), window }.spoil_by(&mut voyage, 1);
    if !is_receipt_known {
        voyage.imu.iter_mut().for_each(|sample| sample.arrival = None);
    }
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let (mut steps, mut worst, mut is_named) = (Vec::new(), 0.0_f64, false);
    for received in voyage.received() {
        if received.message.time().as_seconds() > 1000.0 {
            break;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Event(Event::ImuClock { step, .. }) => steps.push(step),
                Output::Solution(said) => {
                    let Judgement { excluded, .. } = said.judgement;
                    is_named |= excluded.iter().next().is_some();
                    let at = voyage.truth.binary_search_by_key(&said.time, |row| row.time);
                    let truth = at.ok().map(|at| voyage.truth[at].position);
                    let apart =
                        truth.map(|truth| earth::ecef(&said.position).0 - earth::ecef(&truth).0);
                    if said.time.as_seconds() > 300.0 {
                        worst = worst.max(apart.map_or(0.0, |apart| apart.norm()));
                    }
                }
                _ => {}
            }
        }
    }
    (steps, worst, is_named)
}

#[test]
fn a_step_is_taken_back_and_nobody_is_named() {
    for is_receipt_known in [true, false] {
        let (steps, worst, is_named) = sailed(is_receipt_known, ImuLie::ClockStep(STEP));
        assert!(steps.len() == 1 && (steps[0] - STEP).abs() < 0.02, "{steps:?}");
        assert!(worst < 15.0 && !is_named, "{worst} m, named: {is_named}");
    }
}

#[test]
fn a_gap_is_none() {
    for is_receipt_known in [true, false] {
        let (steps, worst, is_named) = sailed(is_receipt_known, ImuLie::Gap(STEP));
        assert!(steps.is_empty(), "{steps:?}");
        assert!(worst < 15.0 && !is_named, "{worst} m, named: {is_named}");
    }
}
