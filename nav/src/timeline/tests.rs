//! The order of things on a time line, told by an estimator that only keeps a diary.

use insd_base::{
    Attitude, Body, Geodetic, LogReference, LogVelocity, Message, Mode, Ned, SolutionSigma,
};
use nalgebra::Vector3;

use super::*;

/// What happened, in order: `(time, None)` an advance to a time, `(time, Some(id))` a measurement.
type Diary = Vec<(Time, Option<i64>)>;

#[derive(Clone, Default)]
struct Scribe {
    diary: Diary,
}

impl Estimator for Scribe {
    fn advance(&mut self, increment: &Increment) {
        self.diary.push((increment.to, None));
    }

    fn apply(&mut self, received: &Received) -> Report {
        let Message::Log(log) = received.message else { return Report::default() };
        self.diary.push((log.time, log.u.map(|u| u as i64)));
        Report { log_likelihood: log.u.unwrap_or(0.0), ..Report::default() }
    }

    fn solution(&self) -> Solution {
        Solution {
            time: Time::START,
            position: Geodetic::default(),
            velocity: Ned::default(),
            attitude: Attitude::default(),
            rate: Body::default(),
            sigma: SolutionSigma::default(),
            mode: Mode::Inertial,
            judgement: insd_base::Judgement::default(),
            source: None,
            hidden: insd_base::Protection::default(),
        }
    }

    fn solution_at(&self, _: &Increment, _: Time) -> Solution {
        self.solution()
    }
}

fn seconds(t: f64) -> Time {
    Time::from_seconds(t)
}

fn increment(to: f64) -> Increment {
    Increment {
        from: seconds(to - 0.1),
        to: seconds(to),
        rotation: Vector3::zeros(),
        velocity: Vector3::zeros(),
        end_rate: Vector3::zeros(),
        end_rate_variance: 0.0,
        angular_acceleration: Vector3::zeros(),
        rate_noise: Vector3::zeros(),
        force_noise: Vector3::zeros(),
        bridged: None,
        celsius: None,
    }
}

fn measurement(time: f64, id: i64) -> Received {
    let time = seconds(time);
    let log = LogVelocity {
        time,
        u: Some(id as f64),
        v: None,
        w: None,
        std: None,
        reference: LogReference::Water,
    };
    Received { receipt: time, source: Source::Log(0), message: Message::Log(log) }
}

/// Sails to `end` s; each measurement `(valid, id)` comes when the IMU is `delay` s past it.
fn sail(end: f64, measurements: &[(f64, i64)], delay: f64) -> Timeline<Scribe> {
    let mut line = Timeline::new(Scribe::default(), seconds(0.0));
    let mut waiting = measurements.to_vec();
    for step in 1..=(end * 10.0).round() as i64 {
        let now = step as f64 / 10.0;
        line.advance(&increment(now));
        let due = |(valid, _): &(f64, i64)| valid + delay <= now + 1e-9;
        for (valid, id) in waiting.iter().filter(|m| due(m)) {
            line.measure(&measurement(*valid, *id));
        }
        waiting.retain(|m| !due(m));
    }
    line
}

#[test]
fn late_measurements_leave_the_same_history_as_prompt_ones() {
    let measurements = [(0.5, 1), (1.0, 2), (1.23, 3), (1.27, 4), (2.0, 5), (2.0, 6)];
    let prompt = sail(5.0, &measurements, 0.0);
    for delay in [0.1, 0.35, 1.0, 2.0] {
        let late = sail(5.0, &measurements, delay);
        assert_eq!(late.estimator().diary, prompt.estimator().diary, "{delay} s late");
    }
}

#[test]
fn a_measurement_ahead_of_the_imu_waits_for_it() {
    let mut line = Timeline::new(Scribe::default(), seconds(0.0));
    assert!(line.measure(&measurement(0.15, 7)).is_none());
    assert!(line.advance(&increment(0.1)).is_empty());
    assert_eq!(line.advance(&increment(0.2)).len(), 1);
    let wanted: Diary = vec![
        (seconds(0.1), None),
        (seconds(0.15), None),
        (seconds(0.15), Some(7)),
        (seconds(0.2), None),
    ];
    assert_eq!(line.estimator().diary, wanted);
}

#[test]
fn the_report_of_a_late_measurement_is_its_own() {
    let mut line = sail(2.0, &[(0.5, 1), (1.5, 2)], 0.0);
    let report = line.measure(&measurement(1.0, 9)).unwrap();
    assert_eq!(report.log_likelihood, 9.0);
}

#[test]
fn a_measurement_older_than_the_history_is_refused_with_its_reason() {
    let mut line = sail(10.0, &[], 0.0);
    let report = line.measure(&measurement(6.0, 1)).unwrap();
    assert_eq!(report.aids[0].outcome, Outcome::Rejected(Rejection::TooLate));
    assert!(line.measure(&measurement(8.0, 2)).unwrap().aids.is_empty());
}
