//! GLONASS: the broadcast state, integrated (ICD L1, L2, edition 5.1, appendix 3, in the simplified form of section A.3.1.2).

use insd_base::GpsTime;
use insd_base::satellites::GlonassRecord;
use nalgebra::{Vector3, Vector6};

use super::state::SatelliteState;

/// Gravitational constant, m^3/s^2 (PZ-90.11).
const GM: f64 = 3.986_004_4e14;
/// Second zonal harmonic.
const J2: f64 = 1.082_625_7e-3;
/// Equatorial radius, m.
const RADIUS: f64 = 6_378_136.0;
/// Rate of the Earth's rotation, rad/s.
const RATE: f64 = 7.292_115e-5;
/// Longest step of the integration, s.
const STEP: f64 = 60.0;
/// Nobody is integrated further, s: a state holds for a quarter of an hour, and a wrong time could be years away.
const FARTHEST: f64 = 86_400.0;

/// The satellite at an instant.
pub(super) fn state(record: &GlonassRecord, time: GpsTime) -> SatelliteState {
    let elapsed = time.since(record.reference).as_seconds();
    let [x, y, z] = record.position;
    let [vx, vy, vz] = record.velocity;
    let pull = Vector3::from(record.acceleration);
    let mut state = Vector6::new(x, y, z, vx, vy, vz);
    let mut left = elapsed.clamp(-FARTHEST, FARTHEST);
    while left != 0.0 {
        let step = left.clamp(-STEP, STEP);
        state = runge_kutta(&state, &pull, step);
        left -= step;
    }
    SatelliteState {
        position: state.fixed_rows::<3>(0).into(),
        velocity: state.fixed_rows::<3>(3).into(),
        clock: clock(record, time),
        clock_drift: record.clock_drift,
    }
}

/// Offset of the clock; its relativistic part is in what is broadcast.
pub(super) fn clock(record: &GlonassRecord, time: GpsTime) -> f64 {
    record.clock_offset + record.clock_drift * time.since(record.reference).as_seconds()
}

fn runge_kutta(state: &Vector6<f64>, pull: &Vector3<f64>, step: f64) -> Vector6<f64> {
    let k1 = derivative(state, pull);
    let k2 = derivative(&(state + k1 * (step / 2.0)), pull);
    let k3 = derivative(&(state + k2 * (step / 2.0)), pull);
    let k4 = derivative(&(state + k3 * step), pull);
    state + (k1 + (k2 + k3) * 2.0 + k4) * (step / 6.0)
}

/// Rates of position and velocity in axes that turn with the Earth; `pull` is of sun and moon.
fn derivative(state: &Vector6<f64>, pull: &Vector3<f64>) -> Vector6<f64> {
    let (x, y, z) = (state[0], state[1], state[2]);
    let (vx, vy, vz) = (state[3], state[4], state[5]);
    let r_sq = x * x + y * y + z * z;
    let central = GM / (r_sq * r_sq.sqrt());
    let flat = 1.5 * J2 * central * RADIUS * RADIUS / r_sq;
    let z_sq = 5.0 * z * z / r_sq;
    let level = -central - flat * (1.0 - z_sq) + RATE * RATE;
    Vector6::new(
        vx,
        vy,
        vz,
        level * x + 2.0 * RATE * vy + pull.x,
        level * y - 2.0 * RATE * vx + pull.y,
        (-central - flat * (3.0 - z_sq)) * z + pull.z,
    )
}
