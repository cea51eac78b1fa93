//! Where a satellite is that keeps to its Keplerian elements.

use insd_base::GpsTime;
use insd_base::satellites::{Constellation, KeplerOrbit, SPEED_OF_LIGHT};
use nalgebra::{Rotation3, Vector3};

/// Rate of turn of the Earth, rad/s (IS-GPS-200N, table 20-IV).
pub(crate) const EARTH_RATE: f64 = 7.292_115_146_7e-5;
/// The same in the control document of BeiDou (BDS-SIS-ICD-B1I 3.0, table 5-11).
const EARTH_RATE_BEIDOU: f64 = 7.292_115e-5;
/// The time of BeiDou is behind that of GPS by so many seconds (BDS-SIS-ICD-B1I 3.0, section 3.3).
pub(crate) const BEIDOU_BEHIND: f64 = 14.0;

/// Gravitational constant of the Earth as a constellation's control document has it, m^3/s^2.
pub(crate) fn gm(constellation: Constellation) -> f64 {
    match constellation {
        Constellation::Galileo | Constellation::BeiDou => 3.986_004_418e14,
        _ => 3.986_005e14,
    }
}

/// Rate of turn of the Earth as a constellation's control document has it, rad/s.
pub(crate) fn earth_rate(constellation: Constellation) -> f64 {
    if constellation == Constellation::BeiDou { EARTH_RATE_BEIDOU } else { EARTH_RATE }
}

/// Seconds of the week of an instant on the clock of a constellation.
pub(crate) fn week_seconds(constellation: Constellation, at: GpsTime) -> f64 {
    let seconds = at.to_week().1 as f64 * 1e-9;
    if constellation == Constellation::BeiDou { seconds - BEIDOU_BEHIND } else { seconds }
}

/// A satellite on its orbit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Position, Earth-fixed axes of that very instant, m.
    pub(crate) position: Vector3<f64>,
    /// Unit vector normal to the orbit, on the side from which the satellite is seen to go round to the left.
    pub(crate) normal: Vector3<f64>,
    /// What its clock is ahead by the eccentricity of its orbit, s: -2 r.v/c^2.
    pub(crate) relativity: f64,
}

/// The place `dt`, s, after the reference time of an orbit.
///
/// The orbit is laid out in its own plane, axes towards the ascending node, and turned into Earth-fixed axes by two rotations, about the
/// node and about the pole. Elements and their corrections: IS-GPS-200N, table 20-IV; radius r, argument of latitude u, inclination i,
/// longitude of the node Omega. Not for geostationary satellites of BeiDou, whose elements are in other axes.
pub(crate) fn place(orbit: &KeplerOrbit, constellation: Constellation, dt: f64) -> Place {
    let mu = gm(constellation);
    let (a, e) = (orbit.sqrt_a * orbit.sqrt_a, orbit.eccentricity);
    let mean = orbit.m0 + ((mu / a).sqrt() / a + orbit.delta_n) * dt;
    let anomaly = eccentric_anomaly(mean, e);
    let true_anomaly =
        anomaly + 2.0 * (beta(e) * anomaly.sin() / (1.0 - beta(e) * anomaly.cos())).atan();
    let latitude = true_anomaly + orbit.omega;
    let (sin2, cos2) = (2.0 * latitude).sin_cos();
    let u = latitude + orbit.cus * sin2 + orbit.cuc * cos2;
    let r = a * (1.0 - e * anomaly.cos()) + orbit.crs * sin2 + orbit.crc * cos2;
    let i = orbit.i0 + orbit.i_dot * dt + orbit.cis * sin2 + orbit.cic * cos2;
    let rate = earth_rate(constellation);
    let start = rate * week_seconds(constellation, orbit.reference);
    let node = orbit.omega0 - start + (orbit.omega_dot - rate) * dt;
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), node)
        * Rotation3::from_axis_angle(&Vector3::x_axis(), i);
    Place {
        position: turn * Vector3::new(r * u.cos(), r * u.sin(), 0.0),
        normal: turn * Vector3::z(),
        relativity: -2.0 * (mu * a).sqrt() * e * anomaly.sin() / SPEED_OF_LIGHT.powi(2),
    }
}

/// e/(1 + sqrt(1 - e^2)): tan((nu - E)/2) = beta sin E/(1 - beta cos E).
fn beta(e: f64) -> f64 {
    e / (1.0 + (1.0 - e * e).sqrt())
}

/// Solves Kepler's equation M = E - e sin E by Newton's method; rad.
fn eccentric_anomaly(mean: f64, e: f64) -> f64 {
    let mut anomaly = mean + e * mean.sin();
    for _ in 0..4 {
        anomaly -= (anomaly - e * anomaly.sin() - mean) / (1.0 - e * anomaly.cos());
    }
    anomaly
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn keplers_equation_is_solved_to_the_last_digits() {
        for step in 0..100 {
            let mean = f64::from(step) * 0.5 - 20.0;
            let anomaly = eccentric_anomaly(mean, 0.08);
            assert_relative_eq!(anomaly - 0.08 * anomaly.sin(), mean, epsilon = 1e-13);
        }
    }

    #[test]
    fn without_corrections_a_satellite_falls_towards_the_centre_of_the_earth() {
        let mut orbit = crate::sky::testing::orbit();
        (orbit.cuc, orbit.cus, orbit.crc, orbit.crs, orbit.cic, orbit.cis) =
            (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        (orbit.delta_n, orbit.omega_dot, orbit.i_dot) = (0.0, 0.0, 0.0);
        let inertial = |t: f64| {
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), EARTH_RATE * t);
            turn * place(&orbit, Constellation::Gps, t).position
        };
        let (t, h) = (1234.0, 10.0);
        let acceleration = (inertial(t + h) - 2.0 * inertial(t) + inertial(t - h)) / (h * h);
        let position = inertial(t);
        let gravity = -position * (gm(Constellation::Gps) / position.norm().powi(3));
        assert_relative_eq!(acceleration, gravity, epsilon = 1e-5);
        let velocity = (inertial(t + h) - inertial(t - h)) / (2.0 * h);
        let relativity = -2.0 * position.dot(&velocity) / SPEED_OF_LIGHT.powi(2);
        let now = place(&orbit, Constellation::Gps, t);
        assert_relative_eq!(now.relativity, relativity, epsilon = 1e-13);
    }
}
