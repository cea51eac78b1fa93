//! The ship's way as the analysis sees it: where she is and what she senses, step by step.

use nalgebra::{Matrix3, Vector3};

use insd_base::Geodetic;
use insd_base::earth::{normal_gravity, rate_n, transport_rate};
use insd_base::units::wrap_pi;

use crate::motion::{Motion, Swing};
use crate::scenario::Scenario;
use crate::track::{Track, start_of};

/// The seed of the waves that the ship meets under way.
const SEED: u64 = 0;

/// A step of the way: means over it, in axes north, east, down.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stretch {
    /// Where.
    pub(super) point: Geodetic,
    /// Velocity, m/s.
    pub(super) velocity: Vector3<f64>,
    /// Specific force, m/s^2.
    pub(super) force: Vector3<f64>,
    /// Heading, rad.
    pub(super) heading: f64,
    /// Rate of turn, rad/s.
    pub(super) turn_rate: f64,
}

/// The ship at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Heading, rad.
    pub(super) heading: f64,
    /// Antenna of the GNSS from the IMU, north, east, down, m.
    pub(super) lever: Vector3<f64>,
    /// Its velocity from that of the IMU, m/s.
    pub(super) lever_velocity: Vector3<f64>,
}

/// The way of a scenario: the true one, but just lying there at a berth that is all that is known.
/// There nothing tells the motion in the waves from the displacement; beside GNSS it is told, and the
/// accelerations of the waves help with the heading.
#[derive(Debug)]
pub(super) struct Way {
    motion: Motion,
    /// Not there if the berth is all that is known, to the end.
    track: Option<Track>,
    berth: Geodetic,
    lever: Vector3<f64>,
    knows_berth: bool,
    has_gnss: bool,
}

impl Way {
    /// The way up to `end`, s.
    pub(super) fn new(scenario: &Scenario, end: f64) -> Self {
        let mut way = Way {
            motion: Motion::new(scenario, SEED),
            track: None,
            berth: start_of(scenario),
            lever: Vector3::zeros(),
            knows_berth: scenario.knows_berth(),
            has_gnss: scenario.gnss.is_some(),
        };
        if let Some(gnss) = &scenario.gnss {
            way.lever = Vector3::from(gnss.lever_arm_m);
        }
        if !way.lies_still(end) {
            way.track = Some(Track::new(&scenario.clone().with_duration(end + 1.0), SEED));
        }
        way
    }

    /// Whether she lies at the known berth of the start at time `t`, s.
    pub(super) fn is_at_berth(&self, t: f64) -> bool {
        self.knows_berth && self.motion.path().is_at_first_berth(t)
    }

    /// Whether nothing but the berth is known of her at time `t`, s.
    fn lies_still(&self, t: f64) -> bool {
        self.is_at_berth(t) && !self.has_gnss
    }

    /// When she leaves the berth, s, or `end`; `None` if she does not begin there.
    pub(super) fn berth_end(&self, end: f64) -> Option<f64> {
        let left = self.motion.path().stages().iter().find(|stage| !stage.moored);
        // the instant of leaving belongs to the leg that leaves
        self.is_at_berth(0.0).then(|| left.map_or(end, |stage| (stage.start - 1e-3).min(end)))
    }

    /// Surge and sway in the moorings and in the waves at time `t`, s.
    pub(super) fn swings(&self, t: f64) -> [[Swing; 2]; 2] {
        self.motion.swings(t)
    }

    /// The ship at time `t`, s.
    pub(super) fn at(&self, t: f64) -> Place {
        match self.track.as_ref().filter(|_| !self.lies_still(t)) {
            Some(track) => {
                let ship = track.at(t);
                let c_nb = insd_base::earth::c_ne(&ship.point) * ship.c_eb;
                Place {
                    heading: ship.attitude().heading,
                    lever: c_nb * self.lever,
                    lever_velocity: c_nb * ship.omega_eb.cross(&self.lever),
                }
            }
            None => {
                let heading = self.motion.path().at(t).heading.value;
                let lever = level_turn(heading) * self.lever;
                Place { heading, lever, lever_velocity: Vector3::zeros() }
            }
        }
    }

    /// The means over (from, to], s.
    pub(super) fn between(&self, from: f64, to: f64) -> Stretch {
        match self.track.as_ref().filter(|_| !self.lies_still(to)) {
            Some(track) => sailed(track, from, to),
            None => self.moored(from, to),
        }
    }

    fn moored(&self, from: f64, to: f64) -> Stretch {
        let guidance = self.motion.path().at((from + to) / 2.0);
        Stretch {
            point: self.berth,
            velocity: Vector3::zeros(),
            force: -Vector3::z() * normal_gravity(self.berth.latitude, self.berth.height),
            heading: guidance.heading.value,
            turn_rate: guidance.heading.rate,
        }
    }
}

/// The mean specific force is what the change of velocity does not owe to gravity and to the turn of
/// the axes: f = dv/dt + (2 omega_ie + omega_en) x v - g (Groves, 2nd ed., eq. (5.53)).
fn sailed(track: &Track, from: f64, to: f64) -> Stretch {
    let (before, after) = (track.at(from), track.at(to));
    let middle = track.at((from + to) / 2.0);
    let dt = to - from;
    let (v_before, v_after) = (before.velocity_n().0, after.velocity_n().0);
    let velocity = (v_before + v_after) / 2.0;
    let point = middle.point;
    let turn = rate_n(point.latitude) * 2.0 + transport_rate(&point, &velocity);
    let gravity = Vector3::z() * normal_gravity(point.latitude, point.height);
    let turned = wrap_pi(after.attitude().heading - before.attitude().heading);
    Stretch {
        point,
        velocity,
        force: (v_after - v_before) / dt + turn.cross(&velocity) - gravity,
        heading: middle.attitude().heading,
        turn_rate: turned / dt,
    }
}

/// The turn from axes along the ship to north, east and down: by the heading, rad.
pub(super) fn level_turn(heading: f64) -> Matrix3<f64> {
    let (sin, cos) = heading.sin_cos();
    Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}
