//! States over time, and what lies between them.

use insd_base::units::{wrap_pi, wrap_two_pi};
use insd_base::{Attitude, Ecef, Ned, Solution, Span, Time, Truth, earth};
use nalgebra::Matrix3;

/// Gaps up to this are bridged by interpolation, whatever the rate of the rows.
const SHORT_GAP: Span = Span::from_nanos(1_000_000_000);
/// Longer ones up to so many median intervals.
const BRIDGED_INTERVALS: i64 = 3;

/// A solution or a truth, for comparison.
#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    pub(super) time: Time,
    pub(super) position: Ecef,
    pub(super) velocity: Option<Ned>,
    pub(super) attitude: Option<Attitude>,
    pub(super) sigma: [f64; 9],
}

impl State {
    pub(super) fn from_solution(solution: &Solution) -> Self {
        let sigma = &solution.sigma;
        let (p, v) = (&sigma.position.0, &sigma.velocity.0);
        State {
            time: solution.time,
            position: earth::ecef(&solution.position),
            velocity: Some(solution.velocity),
            attitude: Some(solution.attitude),
            sigma: [p.x, p.y, p.z, v.x, v.y, v.z, sigma.roll, sigma.pitch, sigma.heading],
        }
    }

    pub(super) fn from_truth(truth: &Truth) -> Self {
        State {
            time: truth.time,
            position: earth::ecef(&truth.position),
            velocity: truth.velocity,
            attitude: truth.attitude,
            sigma: [0.0; 9],
        }
    }

    /// Rotation from ECEF to the NED axes of this position.
    pub(super) fn c_ne(&self) -> Matrix3<f64> {
        earth::c_ne(&earth::geodetic(&self.position))
    }

    /// The state at `time` on the straight line between two; what either lacks is lacking.
    fn between(before: &State, after: &State, time: Time) -> State {
        let whole = (after.time - before.time).as_nanos() as f64;
        let part = (time - before.time).as_nanos() as f64 / whole;
        let position = before.position.0.lerp(&after.position.0, part);
        let velocity = before.velocity.zip(after.velocity);
        let attitude = before.attitude.zip(after.attitude);
        State {
            time,
            position: Ecef(position),
            velocity: velocity.map(|(a, b)| Ned(a.0.lerp(&b.0, part))),
            attitude: attitude.map(|(a, b)| between_attitudes(&a, &b, part)),
            sigma: std::array::from_fn(|i| {
                before.sigma[i] + part * (after.sigma[i] - before.sigma[i])
            }),
        }
    }
}

/// Angles on the short arc between two attitudes.
fn between_attitudes(a: &Attitude, b: &Attitude, part: f64) -> Attitude {
    let short = |from: f64, to: f64| from + part * wrap_pi(to - from);
    Attitude {
        roll: wrap_pi(short(a.roll, b.roll)),
        pitch: short(a.pitch, b.pitch),
        heading: wrap_two_pi(short(a.heading, b.heading)),
    }
}

/// What a series knows of an instant.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lookup {
    /// The state, taken or interpolated.
    Found(State),
    /// Before the first or after the last row.
    Outside,
    /// Between rows too far apart.
    InGap,
}

/// States in order of time, one for each instant.
#[derive(Debug)]
pub(super) struct Series {
    states: Vec<State>,
    median_interval: Option<Span>,
}

impl Series {
    pub(super) fn new(mut states: Vec<State>) -> Self {
        states.sort_by_key(|state| state.time);
        states.dedup_by_key(|state| state.time);
        let mut intervals: Vec<Span> =
            states.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
        intervals.sort_unstable();
        let median_interval = intervals.get(intervals.len() / 2).copied();
        Series { states, median_interval }
    }

    pub(super) fn states(&self) -> &[State] {
        &self.states
    }

    /// Whether there is more time between rows than in another series. A single row is sparse.
    pub(super) fn is_sparser_than(&self, other: &Series) -> bool {
        match (self.median_interval, other.median_interval) {
            (Some(own), Some(others)) => own > others,
            (own, others) => own.is_none() && others.is_some(),
        }
    }

    /// The longest interval between rows that is interpolated.
    fn longest_bridge(&self) -> Span {
        let median = self.median_interval.unwrap_or(Span::ZERO).as_nanos();
        SHORT_GAP.max(Span::from_nanos(median.saturating_mul(BRIDGED_INTERVALS)))
    }

    /// The state at an instant.
    pub(super) fn at(&self, time: Time) -> Lookup {
        let place = self.states.partition_point(|state| state.time < time);
        let Some(after) = self.states.get(place) else { return Lookup::Outside };
        if after.time == time {
            return Lookup::Found(*after);
        }
        let Some(before) = place.checked_sub(1).map(|i| &self.states[i]) else {
            return Lookup::Outside;
        };
        if after.time - before.time > self.longest_bridge() {
            return Lookup::InGap;
        }
        Lookup::Found(State::between(before, after, time))
    }
}
