//! The velocity log.

use nalgebra::{Rotation3, Vector3};

use insd_base::earth::{c_ne, geodetic};
use insd_base::units::DEG;
use insd_base::{Body, LogReference, LogVelocity, Stamped, Time};

use super::windows::{Window, windows};
use super::{delayed, epochs};
use crate::random::{GaussMarkov, Purpose, normal, normal3, stream};
use crate::scenario::{Current, Log, LogAxes};
use crate::track::{Kinematics, Track};

/// The velocity of the water over the ground, north, east, down, m/s.
#[derive(Debug)]
struct Water {
    mean: Vector3<f64>,
    slow: GaussMarkov,
}

impl Water {
    fn new(current: &Current, seed: u64) -> Self {
        let std = current.random_std_mps;
        Water {
            mean: Vector3::new(current.north_mps, current.east_mps, 0.0),
            slow: GaussMarkov::new(
                Vector3::new(std, std, 0.0),
                current.correlation_time_s,
                stream(seed, Purpose::Current),
            ),
        }
    }

    fn next(&mut self, dt: f64) -> Vector3<f64> {
        self.mean + self.slow.advance(dt)
    }
}

/// The log's velocity of the hull in body axes at the log, m/s, relative to `water`, m/s NED.
fn through(ship: &Kinematics, lever_arm: &Body, water: &Vector3<f64>) -> Vector3<f64> {
    let (place, velocity) = ship.at_lever(lever_arm);
    let c_ne = c_ne(&geodetic(&place));
    ship.c_eb.tr_mul(&(velocity - c_ne.tr_mul(water)))
}

/// The axes of the log as it is mounted, and its scale factor: measured = scale C_lb v_b.
fn constant_errors(log: &Log, seed: u64) -> (Rotation3<f64>, f64) {
    let mut rng = stream(seed, Purpose::LogConstant);
    let std = log.misalignment_std_deg * DEG;
    let (pitch, yaw) = (normal(&mut rng) * std, normal(&mut rng) * std);
    let scale = 1.0 + normal(&mut rng) * log.scale_std;
    (Rotation3::from_euler_angles(0.0, pitch, yaw).inverse(), scale)
}

fn message(log: &Log, time: Time, v: &Vector3<f64>) -> LogVelocity {
    let in_water = log.is_in_water_track(time.as_seconds());
    LogVelocity {
        time,
        u: Some(v.x),
        v: (log.axes != LogAxes::U).then_some(v.y),
        w: (log.axes == LogAxes::Uvw).then_some(v.z),
        std: Some(log.white_mps),
        reference: if in_water { LogReference::Water } else { LogReference::Bottom },
    }
}

/// The messages of a voyage of `duration`, s.
pub(crate) fn velocities(
    log: &Log,
    current: &Current,
    track: &Track,
    duration: f64,
    seed: u64,
) -> Vec<Stamped<LogVelocity>> {
    let lever_arm = Body(Vector3::from(log.lever_arm_m));
    let (c_lb, scale) = constant_errors(log, seed);
    let mut water = Water::new(current, seed);
    let mut white = stream(seed, Purpose::LogWhite);
    let mut lateness = stream(seed, Purpose::LogArrival);
    let mut rng = stream(seed, Purpose::LogDropouts);
    let dropouts = log.dropouts.iter().flat_map(|d| windows(&d.when, d.duration_s, &mut rng));
    let dropouts: Vec<Window> = dropouts.collect();
    let mut velocities = Vec::with_capacity((duration * log.rate_hz) as usize + 1);
    for time in epochs(log.rate_hz, 0, duration) {
        let t = time.as_seconds();
        let current = water.next(1.0 / log.rate_hz);
        let against = if log.is_in_water_track(t) { current } else { Vector3::zeros() };
        let v_b = through(&track.at(t), &lever_arm, &against);
        let measured = c_lb * v_b * scale + normal3(&mut white) * log.white_mps;
        let stamped = delayed(message(log, time, &measured), time, log.arrival, &mut lateness);
        if !dropouts.iter().any(|dropout| dropout.contains(t)) {
            velocities.push(stamped);
        }
    }
    velocities
}
