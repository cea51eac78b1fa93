//! Alerts: when they are raised, what becomes of them, and what the bridge hears.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod board;
mod outputs;
mod watch;

use insd_base::units::DEG;
use insd_base::{Attitude, Body, Geodetic, Mode, Ned, Solution, SolutionSigma, Time, UtcTime};
use insd_output::Boundary;
use insd_output::alerts::Condition;
use insd_wire::nmea::{Acn, AlertCommand};

/// So many seconds after 2026-01-02 03:04:00.
fn at(seconds: f64) -> Boundary {
    let time = Time::from_seconds(seconds);
    let start = UtcTime::from_civil((2026, 1, 2), (3, 4, 0), 0).unwrap();
    let utc = Some(UtcTime::from_nanos(start.as_nanos() + time.as_nanos()));
    Boundary { time, utc }
}

fn acn(condition: Condition, command: AlertCommand) -> Acn {
    Acn { time: None, alert: condition.alert(), command }
}

/// A ship that knows all.
fn solution(time: Time) -> Solution {
    Solution {
        time,
        position: Geodetic::from_degrees(54.0, 8.0, 10.0),
        velocity: Ned::new(5.0, 0.0, 0.0),
        attitude: Attitude { roll: 0.0, pitch: 0.0, heading: 0.0 },
        rate: Body::default(),
        sigma: SolutionSigma {
            position: Ned::new(0.5, 0.5, 1.0),
            heading: 0.1 * DEG,
            ..SolutionSigma::default()
        },
        mode: Mode::Aided,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    }
}
