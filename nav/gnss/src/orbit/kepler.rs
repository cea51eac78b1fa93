//! Keplerian elements with harmonic corrections: GPS, QZSS, Galileo, BeiDou (IS-GPS-200N, table 20-IV; Galileo OS SIS ICD 2.1,
//! table 58; BDS-SIS-ICD-B1I 3.0, table 5-11).

use insd_base::satellites::{ClockPolynomial, KeplerOrbit, KeplerRecord};
use insd_base::{Constellation, GpsTime};
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::state::SatelliteState;

/// Tilt of the plane in which geostationary BeiDou satellites are told, rad (BDS-SIS-ICD-B1I 3.0, table 5-11).
const GEOSTATIONARY_TILT: f64 = -5.0 * std::f64::consts::PI / 180.0;

/// The Earth as each system's interface document has it.
#[derive(Clone, Copy, Debug)]
struct EarthModel {
    /// Gravitational constant, m^3/s^2.
    gm: f64,
    /// Rate of rotation, rad/s.
    rate: f64,
    /// Start of the system's week in GPS time of week, s.
    week_start: f64,
}

impl EarthModel {
    fn of(constellation: Constellation) -> Self {
        let (gm, rate, week_start) = match constellation {
            Constellation::Galileo => (3.986_004_418e14, 7.292_115_146_7e-5, 0.0),
            Constellation::BeiDou => (3.986_004_418e14, 7.292_115_0e-5, 14.0),
            _ => (3.986_005e14, 7.292_115_146_7e-5, 0.0),
        };
        Self { gm, rate, week_start }
    }
}

/// The satellite at an instant.
pub(super) fn state(record: &KeplerRecord, time: GpsTime) -> SatelliteState {
    let earth = EarthModel::of(record.satellite.constellation);
    let motion = Motion::at(&record.orbit, earth, time.since(record.orbit.reference).as_seconds());
    let (position, velocity) = if record.satellite.is_geostationary() {
        geostationary(&record.orbit, earth, &motion)
    } else {
        let node = Node {
            angle: record.orbit.omega0 - earth.rate * week_time(&record.orbit, earth)
                + (record.orbit.omega_dot - earth.rate) * motion.elapsed,
            rate: record.orbit.omega_dot - earth.rate,
        };
        motion.in_frame(node)
    };
    let (offset, drift) = polynomial(&record.clock, time);
    SatelliteState {
        position,
        velocity,
        clock: offset + motion.relativity,
        clock_drift: drift + motion.relativity_rate,
    }
}

/// Offset of the clock without its relativistic part, which is below 50 ns.
pub(super) fn clock(record: &KeplerRecord, time: GpsTime) -> f64 {
    polynomial(&record.clock, time).0
}

fn polynomial(clock: &ClockPolynomial, time: GpsTime) -> (f64, f64) {
    let elapsed = time.since(clock.reference).as_seconds();
    let offset = clock.a0 + elapsed * (clock.a1 + elapsed * clock.a2);
    (offset, clock.a1 + 2.0 * clock.a2 * elapsed)
}

/// Reference time within the system's own week, s.
fn week_time(orbit: &KeplerOrbit, earth: EarthModel) -> f64 {
    const WEEK: f64 = 604_800.0;
    let (_, nanos) = orbit.reference.to_week();
    (nanos as f64 * 1e-9 - earth.week_start).rem_euclid(WEEK)
}

/// The ascending node.
#[derive(Clone, Copy)]
struct Node {
    /// Its longitude, rad.
    angle: f64,
    /// Its rate, rad/s.
    rate: f64,
}

/// Motion in the plane of the orbit, and the plane's inclination.
#[derive(Clone, Copy)]
struct Motion {
    /// Since the reference time, s.
    elapsed: f64,
    /// Position in the plane, from the ascending node, m, and its rate.
    plane: [f64; 2],
    plane_rate: [f64; 2],
    /// Inclination, rad, and its rate.
    inclination: f64,
    inclination_rate: f64,
    /// Relativistic part of the clock, s, and its rate.
    relativity: f64,
    relativity_rate: f64,
}

impl Motion {
    fn at(orbit: &KeplerOrbit, earth: EarthModel, elapsed: f64) -> Self {
        let e = orbit.eccentricity;
        let a = orbit.sqrt_a * orbit.sqrt_a;
        let n = (earth.gm / (a * a * a)).sqrt() + orbit.delta_n;
        let anomaly = eccentric_anomaly(orbit.m0 + n * elapsed, e);
        let (sin, cos) = anomaly.sin_cos();
        let anomaly_rate = n / (1.0 - e * cos);
        let root = (1.0 - e * e).sqrt();
        let latitude = (root * sin).atan2(cos - e) + orbit.omega;
        let latitude_rate = root * anomaly_rate / (1.0 - e * cos);

        let (s2, c2) = (2.0 * latitude).sin_cos();
        let double = 2.0 * latitude_rate;
        let harmonic = |c: f64, s: f64| (s * s2 + c * c2, double * (s * c2 - c * s2));
        let (du, du_rate) = harmonic(orbit.cuc, orbit.cus);
        let (dr, dr_rate) = harmonic(orbit.crc, orbit.crs);
        let (di, di_rate) = harmonic(orbit.cic, orbit.cis);

        let (u, u_rate) = (latitude + du, latitude_rate + du_rate);
        let (r, r_rate) = (a * (1.0 - e * cos) + dr, a * e * sin * anomaly_rate + dr_rate);
        let (sin_u, cos_u) = u.sin_cos();
        let lightspeed = insd_base::satellites::SPEED_OF_LIGHT;
        let f = -2.0 * earth.gm.sqrt() * orbit.sqrt_a * e / (lightspeed * lightspeed);
        Self {
            elapsed,
            plane: [r * cos_u, r * sin_u],
            plane_rate: [r_rate * cos_u - r * sin_u * u_rate, r_rate * sin_u + r * cos_u * u_rate],
            inclination: orbit.i0 + di + orbit.i_dot * elapsed,
            inclination_rate: orbit.i_dot + di_rate,
            relativity: f * sin,
            relativity_rate: f * cos * anomaly_rate,
        }
    }

    /// Position and velocity where the node has this longitude.
    fn in_frame(&self, node: Node) -> (Vector3<f64>, Vector3<f64>) {
        let [x, y] = self.plane;
        let [dx, dy] = self.plane_rate;
        let (sin_o, cos_o) = node.angle.sin_cos();
        let (sin_i, cos_i) = self.inclination.sin_cos();
        let position =
            Vector3::new(x * cos_o - y * cos_i * sin_o, x * sin_o + y * cos_i * cos_o, y * sin_i);
        // of y cos i, and of y sin i
        let level_rate = dy * cos_i - y * sin_i * self.inclination_rate;
        let up_rate = dy * sin_i + y * cos_i * self.inclination_rate;
        let velocity = Vector3::new(
            dx * cos_o - level_rate * sin_o - position.y * node.rate,
            dx * sin_o + level_rate * cos_o + position.x * node.rate,
            up_rate,
        );
        (position, velocity)
    }
}

/// Solves Kepler's equation `E - e sin E = M` by Newton's steps from `M + e sin M`; five are enough for any eccentricity that is broadcast.
fn eccentric_anomaly(mean: f64, eccentricity: f64) -> f64 {
    let mut anomaly = mean + eccentricity * mean.sin();
    for _ in 0..10 {
        let (sin, cos) = anomaly.sin_cos();
        let step = (anomaly - eccentricity * sin - mean) / (1.0 - eccentricity * cos);
        anomaly -= step;
        if step.abs() < 1e-15 * anomaly.abs().max(1.0) {
            break;
        }
    }
    anomaly
}

/// Geostationary BeiDou satellites: a frame that does not turn and is tilted, then the Earth's turn since the reference time
/// (BDS-SIS-ICD-B1I 3.0, table 5-11).
fn geostationary(
    orbit: &KeplerOrbit,
    earth: EarthModel,
    motion: &Motion,
) -> (Vector3<f64>, Vector3<f64>) {
    let node = Node {
        angle: orbit.omega0 + orbit.omega_dot * motion.elapsed
            - earth.rate * week_time(orbit, earth),
        rate: orbit.omega_dot,
    };
    let (position, velocity) = motion.in_frame(node);
    // turning the axes is turning the vectors the other way
    let tilt = Rotation3::from_axis_angle(&Vector3::x_axis(), -GEOSTATIONARY_TILT);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), -earth.rate * motion.elapsed);
    let position = turn * tilt * position;
    let rate: Matrix3<f64> = Vector3::new(0.0, 0.0, earth.rate).cross_matrix();
    (position, turn * tilt * velocity - rate * position)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keplers_equation_is_solved_to_the_last_bit_that_counts() {
        for eccentricity in [0.0, 0.01, 0.2, 0.7] {
            for step in 0..100 {
                let mean = f64::from(step) * 0.2 - 10.0;
                let anomaly = eccentric_anomaly(mean, eccentricity);
                let back = anomaly - eccentricity * anomaly.sin();
                assert!((back - mean).abs() < 1e-14 * mean.abs().max(1.0), "{mean} {eccentricity}");
            }
        }
    }
}
