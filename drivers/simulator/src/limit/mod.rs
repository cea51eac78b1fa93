//! The limit of a scenario: how well the optimal filter could know attitude and position.
//!
//! A covariance analysis, no filter: the Riccati equation of the linear Kalman filter that knows every
//! error model of the scenario, the spectrum of the ship's motion in waves and moorings, but not the
//! motion itself. For linear Gaussian systems that covariance is the Cramer-Rao bound (Van Trees, Bell
//! and Tian, Detection, Estimation and Modulation Theory I, section 4.3.3). No navigator is involved,
//! and nothing of the one that is judged by it: its mechanisation and tuning are elsewhere.
//!
//! The errors are those of a local-level inertial system ([`model`]) along the ship's true way
//! ([`way`]); at a berth without GNSS along her mean heading, without the waves. What aids it is in
//! [`aid`]. Roll and pitch are taken as small where sensor errors are turned into level axes, and the
//! vertical channel is left out: it is coupled with the rest by products of small quantities only.

mod aid;
mod block;
mod covariance;
mod hindsight;
mod model;
mod satellites;
mod way;

use crate::scenario::{Gnss, HeadingReference, Imu, Scenario};

use aid::{Berth, Fixes};
use covariance::Covariance;
pub use satellites::{CameraUse, SegmentLimit, camera_limit, satellite_limit};
use way::Way;

/// The 1-sigma of the optimal filter at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Instant, s.
    pub at: f64,
    /// Heading, rad.
    pub heading: f64,
    /// Roll, rad.
    pub roll: f64,
    /// Pitch, rad.
    pub pitch: f64,
    /// Horizontal position as a radius, m: the root of the sum of both variances.
    pub horizontal_position: f64,
    /// Horizontal velocity, likewise, m/s.
    pub horizontal_velocity: f64,
}

/// What is asked of the limit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LimitQuestion {
    /// Instants, s.
    pub at: Vec<f64>,
    /// Stretches without fixes, from and to, s: a fix at their end counts.
    pub outages: Vec<(f64, f64)>,
    /// Whether all of the voyage is known, and not what was measured up to each instant alone.
    pub is_afterwards: bool,
}

/// Why there is no limit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LimitError {
    /// The scenario has something that the analysis has no model of.
    #[error("the limit is not known for a scenario with {0}")]
    NotCovered(&'static str),
    /// An instant outside the voyage.
    #[error("expected instants from 0 s to the end of the voyage at {end} s, found {at} s")]
    Instant {
        /// The instant.
        at: String,
        /// Length of the voyage.
        end: String,
    },
}

/// Longest step of the analysis, s: short against the waves.
const LONGEST_STEP: f64 = 0.5;
/// Shortest step, s. Fixes that come faster are taken together.
const SHORTEST_STEP: f64 = 0.1;

/// The limits at some instants, s, in order of time. Instants are rounded to the steps of the
/// analysis, half a second or less. It is about the voyage of one seed in so far as a ship under way
/// meets waves; nothing else is random.
///
/// Taken as known: shifts of the moored ship, the motion during lost single samples of the IMU, and
/// when a late message was valid.
///
/// # Errors
/// The scenario has sensors or faults that are not modelled: see [`LimitError`].
pub fn limit(scenario: &Scenario, at: &[f64]) -> Result<Vec<Limit>, LimitError> {
    limit_of(scenario, &LimitQuestion { at: at.to_vec(), ..LimitQuestion::default() })
}

/// The same with fixes taken away, or of who knows all of the voyage.
///
/// # Errors
/// As [`limit`].
pub fn limit_of(scenario: &Scenario, asked: &LimitQuestion) -> Result<Vec<Limit>, LimitError> {
    check(scenario)?;
    let end = scenario.duration();
    if let Some(at) = asked.at.iter().find(|at| !(0.0..=end).contains(*at)) {
        return Err(LimitError::Instant { at: at.to_string(), end: end.to_string() });
    }
    let mut at = asked.at.clone();
    at.sort_by(f64::total_cmp);
    let last = if asked.is_afterwards { end } else { at.last().copied().unwrap_or(0.0) };
    let way = Way::new(scenario, last);
    check_berth(scenario, &way)?;
    let mut analysis = Analysis::new(scenario, way);
    analysis.outages.clone_from(&asked.outages);
    Ok(if asked.is_afterwards { analysis.run_and_back(&at, end) } else { analysis.run(&at) })
}

/// Refuses what is not modelled.
fn check(scenario: &Scenario) -> Result<(), LimitError> {
    let reference = scenario.reference.as_ref();
    let at_berth =
        scenario.knows_berth() && scenario.route.legs.first().is_some_and(|leg| leg.moored);
    let refused = [
        (scenario.log.is_some(), "a velocity log"),
        (reference.is_some_and(|r| r.velocity_std_mps.is_some()), "a reference of velocity"),
        (reference.is_some_and(|r| r.heading_std_deg.is_some()), "a reference of heading"),
        (!at_berth && scenario.gnss.is_none(), "neither a known berth nor GNSS"),
        (scenario.gnss.as_ref().is_some_and(has_faults), "faults of the GNSS"),
    ];
    covered(scenario, &refused)
}

/// Whether none of this is there, nor what no limit covers.
fn covered(scenario: &Scenario, refused: &[(bool, &'static str)]) -> Result<(), LimitError> {
    let always = [
        (!scenario.imu.gaps.is_empty(), "gaps in the data of the IMU"),
        (is_perfect(&scenario.imu), "an IMU without errors"),
        (
            scenario.route.heading_reference == HeadingReference::Grid,
            "headings that count from grid north",
        ),
    ];
    match refused.iter().chain(&always).find(|(is_there, _)| *is_there) {
        Some((_, what)) => Err(LimitError::NotCovered(what)),
        None => Ok(()),
    }
}

fn has_faults(gnss: &Gnss) -> bool {
    let faults = [
        gnss.outages.len(),
        gnss.jumps.len(),
        gnss.dop_spikes.len(),
        gnss.spoofing.len(),
        gnss.bad_stds.len(),
    ];
    faults.iter().any(|count| *count > 0)
}

/// Without noise of gyros and accelerometers there is nothing to bound.
fn is_perfect(imu: &Imu) -> bool {
    let spec = imu.simulated();
    spec.gyro.random_walk <= 0.0 || spec.accel.random_walk <= 0.0
}

/// The motion about the berth is modelled as stationary.
fn check_berth(scenario: &Scenario, way: &Way) -> Result<(), LimitError> {
    let end = way.berth_end(scenario.duration());
    let differs = |t: f64| way.swings(t) != way.swings(0.0);
    match end {
        Some(end) if (0..=20).any(|part| differs(end * f64::from(part) / 20.0)) => {
            Err(LimitError::NotCovered("a sea at the berth that changes"))
        }
        _ => Ok(()),
    }
}

/// Everything that the recursion goes through again and again.
struct Analysis {
    way: Way,
    berth: Option<Berth>,
    fixes: Option<Fixes>,
    covariance: Covariance,
    /// Step, s.
    step: f64,
    /// Steps from fix to fix.
    steps_per_fix: usize,
    /// Stretches without fixes, from and to, s.
    outages: Vec<(f64, f64)>,
}

impl Analysis {
    fn new(scenario: &Scenario, way: Way) -> Self {
        let (step, steps_per_fix, fixes_per_step) = steps(scenario.gnss.as_ref());
        let spec = scenario.imu.simulated();
        let swings = way.is_at_berth(0.0).then(|| way.swings(0.0));
        let mut covariance = Covariance::new(&spec, model::start(swings.as_ref()), step);
        let berth = swings.map(|swings| Berth::new(&swings, step, &mut covariance));
        let gnss = scenario.gnss.as_ref();
        let fixes = gnss.map(|gnss| Fixes::new(gnss, fixes_per_step, &mut covariance));
        Analysis { way, berth, fixes, covariance, step, steps_per_fix, outages: Vec::new() }
    }

    fn run(mut self, at: &[f64]) -> Vec<Limit> {
        let mut found = Vec::with_capacity(at.len());
        let mut index = 0;
        for &instant in at {
            let last = (instant / self.step).round() as usize;
            while index < last {
                self.advance(index);
                index += 1;
            }
            found.push(self.limit(instant, index as f64 * self.step));
        }
        found
    }

    /// From step `index` to the next, with the measurements at its end.
    fn advance(&mut self, index: usize) {
        let from = index as f64 * self.step;
        let to = from + self.step;
        let stretch = self.way.between(from, to);
        self.covariance.predict(&stretch);
        let (place, size) = (self.way.at(to), self.covariance.size());
        if let Some(berth) = self.berth.as_ref().filter(|_| self.way.is_at_berth(to)) {
            self.covariance.update(&berth.measurement(&place, size));
        }
        let is_out = self.outages.iter().any(|(from, until)| (*from..*until).contains(&to));
        let is_due = (index + 1).is_multiple_of(self.steps_per_fix) && !is_out;
        if let Some(fixes) = self.fixes.as_ref().filter(|_| is_due) {
            self.covariance.update(&fixes.measurement(&place, size));
        }
    }

    fn limit(&self, at: f64, t: f64) -> Limit {
        let heading = self.way.at(t).heading;
        let (sin, cos) = heading.sin_cos();
        let state = |weights: &[(usize, f64)]| self.covariance.std_of(weights);
        let [north, east, down] = [0, 1, 2].map(|axis| model::ATTITUDE.at(axis));
        let radius =
            |block: block::Block| state(&[(block.at(0), 1.0)]).hypot(state(&[(block.at(1), 1.0)]));
        Limit {
            at,
            heading: state(&[(down, 1.0)]),
            roll: state(&[(north, cos), (east, sin)]),
            pitch: state(&[(north, -sin), (east, cos)]),
            horizontal_position: radius(model::POSITION),
            horizontal_velocity: radius(model::VELOCITY),
        }
    }
}

/// Length of a step, s, steps from fix to fix, and fixes in a step.
fn steps(gnss: Option<&Gnss>) -> (f64, usize, f64) {
    let Some(gnss) = gnss else { return (LONGEST_STEP, 1, 1.0) };
    let interval = 1.0 / gnss.rate_hz;
    if interval < SHORTEST_STEP {
        let together = (SHORTEST_STEP / interval).ceil();
        return (interval * together, 1, together);
    }
    let parts = (interval / LONGEST_STEP).ceil().max(1.0);
    (interval / parts, parts as usize, 1.0)
}

#[cfg(test)]
mod tests;
