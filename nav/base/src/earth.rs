//! The Earth: WGS-84 ellipsoid, normal gravity, rotation, and the axes that hang on a position.

use nalgebra::{Matrix3, Vector3};

use crate::frames::{Ecef, Geodetic};

/// Semi-major axis, m (NGA.STND.0036, WGS-84, table 3.1).
pub const SEMI_MAJOR: f64 = 6_378_137.0;
/// Flattening (NGA.STND.0036, table 3.1).
pub const FLATTENING: f64 = 1.0 / 298.257_223_563;
/// Square of the first eccentricity.
pub const ECCENTRICITY_SQ: f64 = FLATTENING * (2.0 - FLATTENING);
/// Rotation rate, rad/s (NGA.STND.0036, table 3.1).
pub const RATE: f64 = 7.292_115e-5;
/// Geocentric gravitational constant, m^3/s^2 (NGA.STND.0036, table 3.1).
pub const GM: f64 = 3.986_004_418e14;

const GRAVITY_EQUATOR: f64 = 9.780_325_335_9;
const SOMIGLIANA_K: f64 = 0.001_931_852_652_41;

/// Earth rate in ECEF axes, rad/s.
#[must_use]
pub fn rate_e() -> Vector3<f64> {
    Vector3::new(0.0, 0.0, RATE)
}

/// Radii of curvature (meridian M, prime vertical N) at a geodetic latitude, m.
///
/// Groves, 2nd ed., eqs. (2.105), (2.106).
#[must_use]
pub fn radii(latitude: f64) -> (f64, f64) {
    let sin_sq = latitude.sin().powi(2);
    let w_sq = 1.0 - ECCENTRICITY_SQ * sin_sq;
    let w = w_sq.sqrt();
    (SEMI_MAJOR * (1.0 - ECCENTRICITY_SQ) / (w_sq * w), SEMI_MAJOR / w)
}

/// ECEF position of a geodetic point. Groves, 2nd ed., eq. (2.112).
#[must_use]
pub fn ecef(point: &Geodetic) -> Ecef {
    let (_, n) = radii(point.latitude);
    let (sin_lat, cos_lat) = point.latitude.sin_cos();
    let (sin_lon, cos_lon) = point.longitude.sin_cos();
    Ecef(Vector3::new(
        (n + point.height) * cos_lat * cos_lon,
        (n + point.height) * cos_lat * sin_lon,
        (n * (1.0 - ECCENTRICITY_SQ) + point.height) * sin_lat,
    ))
}

/// Geodetic coordinates of an ECEF position, valid everywhere outside the Earth's core, the poles
/// and the antimeridian included. At a pole the longitude is that of the x, y residue (0 exactly
/// on the axis).
///
/// Bowring's iteration on the reduced latitude (Bowring, Survey Review 1976); two rounds leave less
/// than a nanometre at terrestrial heights.
#[must_use]
pub fn geodetic(position: &Ecef) -> Geodetic {
    let r = &position.0;
    let p = r.x.hypot(r.y);
    let semi_minor = SEMI_MAJOR * (1.0 - FLATTENING);
    let second_ecc_sq = ECCENTRICITY_SQ / (1.0 - ECCENTRICITY_SQ);
    let mut reduced = (r.z * SEMI_MAJOR).atan2(p * semi_minor);
    let mut latitude = 0.0;
    for _ in 0..2 {
        let (s, c) = reduced.sin_cos();
        latitude = (r.z + second_ecc_sq * semi_minor * s.powi(3))
            .atan2(p - ECCENTRICITY_SQ * SEMI_MAJOR * c.powi(3));
        reduced = ((1.0 - FLATTENING) * latitude.sin()).atan2(latitude.cos());
    }
    let (sin_lat, cos_lat) = latitude.sin_cos();
    let w = (1.0 - ECCENTRICITY_SQ * sin_lat * sin_lat).sqrt();
    let height = p * cos_lat + r.z * sin_lat - SEMI_MAJOR * w;
    Geodetic { latitude, longitude: r.y.atan2(r.x), height }
}

/// Rotation from ECEF to north-east-down axes at a point. Groves, 2nd ed., eq. (2.150).
#[must_use]
pub fn c_ne(point: &Geodetic) -> Matrix3<f64> {
    let (sin_lat, cos_lat) = point.latitude.sin_cos();
    let (sin_lon, cos_lon) = point.longitude.sin_cos();
    Matrix3::new(
        -sin_lat * cos_lon,
        -sin_lat * sin_lon,
        cos_lat,
        -sin_lon,
        cos_lon,
        0.0,
        -cos_lat * cos_lon,
        -cos_lat * sin_lon,
        -sin_lat,
    )
}

/// Magnitude of normal gravity at a geodetic latitude and height, m/s^2.
///
/// Somigliana's closed formula on the ellipsoid with the second-order height correction:
/// NGA.STND.0036, eqs. (4-1) and (4-3).
#[must_use]
pub fn normal_gravity(latitude: f64, height: f64) -> f64 {
    let sin_sq = latitude.sin().powi(2);
    let surface =
        GRAVITY_EQUATOR * (1.0 + SOMIGLIANA_K * sin_sq) / (1.0 - ECCENTRICITY_SQ * sin_sq).sqrt();
    let semi_minor = SEMI_MAJOR * (1.0 - FLATTENING);
    let m = RATE * RATE * SEMI_MAJOR * SEMI_MAJOR * semi_minor / GM;
    let ratio = height / SEMI_MAJOR;
    surface
        * (1.0 - 2.0 * (1.0 + FLATTENING + m - 2.0 * FLATTENING * sin_sq) * ratio
            + 3.0 * ratio * ratio)
}

/// Normal gravity (attraction and centrifugal) as a vector in ECEF axes along the ellipsoid's
/// normal, m/s^2.
#[must_use]
pub fn gravity_e(point: &Geodetic) -> Vector3<f64> {
    let g = normal_gravity(point.latitude, point.height);
    let (sin_lat, cos_lat) = point.latitude.sin_cos();
    let (sin_lon, cos_lon) = point.longitude.sin_cos();
    -g * Vector3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat)
}

/// Derivative of gravity with respect to ECEF position, 1/s^2: that of a point mass,
/// -(g/R)(I - 3 u u^T), u upwards. It holds the Schuler oscillation and the unstable vertical.
///
/// Groves, 2nd ed., section 14.2.2; the ellipsoid's share is below 1 % and left out.
#[must_use]
pub fn gravity_gradient_e(position: &Ecef) -> Matrix3<f64> {
    let radius = position.0.norm().max(1.0);
    let up = position.0 / radius;
    (up * up.transpose() * 3.0 - Matrix3::identity()) * (GM / radius.powi(3))
}

/// Earth rate in NED axes at a latitude, rad/s. Groves, 2nd ed., eq. (2.123).
#[must_use]
pub fn rate_n(latitude: f64) -> Vector3<f64> {
    let (sin_lat, cos_lat) = latitude.sin_cos();
    Vector3::new(RATE * cos_lat, 0.0, -RATE * sin_lat)
}

/// Transport rate: the turn of NED axes over the Earth under a ship with NED velocity `v_n`, rad/s.
///
/// Groves, 2nd ed., eq. (5.44). Near the poles the down component grows without bound, as north
/// itself does turn there; the mechanisation, which works in ECEF axes, does not use it. It serves
/// the rate of turn, which is the change of the heading from true north.
#[must_use]
pub fn transport_rate(point: &Geodetic, v_n: &Vector3<f64>) -> Vector3<f64> {
    let (m, n) = radii(point.latitude);
    let east_angle = v_n.y / (n + point.height);
    Vector3::new(east_angle, -v_n.x / (m + point.height), -east_angle * point.latitude.tan())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn geodetic_and_ecef_are_inverse_at_every_latitude(
            lat in -90.0..=90.0_f64, lon in -180.0..=180.0_f64, height in -500.0..20_000.0_f64,
        ) {
            let position = ecef(&Geodetic::from_degrees(lat, lon, height));
            let back = ecef(&geodetic(&position));
            prop_assert!((back.0 - position.0).norm() < 1e-7);
        }

        #[test]
        fn the_gradient_agrees_with_perturbed_gravitation(
            lat in -89.0..89.0_f64, lon in -180.0..180.0_f64, axis in 0..3_usize,
        ) {
            let centre = ecef(&Geodetic::from_degrees(lat, lon, 0.0));
            let mut offset = Vector3::zeros();
            offset[axis] = 500.0;
            let moved = |d: Vector3<f64>| gravity_e(&geodetic(&Ecef(centre.0 + d)));
            let slope = (moved(offset) - moved(-offset)) / 1000.0;
            let model = gravity_gradient_e(&centre) * Vector3::from_fn(|i, _| f64::from(u8::from(i == axis)));
            prop_assert!((slope - model).norm() < 0.02 * 3.1e-6);
        }
    }

    #[test]
    fn gravity_agrees_with_published_values() {
        assert_relative_eq!(normal_gravity(0.0, 0.0), 9.780_325_335_9, epsilon = 1e-9);
        assert_relative_eq!(
            normal_gravity(std::f64::consts::FRAC_PI_2, 0.0),
            9.832_184_937_9,
            epsilon = 1e-9
        );
        // free-air gradient: about -3.086e-6 per metre at mid latitudes
        let slope = normal_gravity(0.785, 1.0) - normal_gravity(0.785, 0.0);
        assert_relative_eq!(slope, -3.086e-6, epsilon = 5e-9);
    }

    #[test]
    fn ned_axes_are_orthonormal_and_point_home() {
        let point = Geodetic::from_degrees(35.0, 139.0, 0.0);
        let c = c_ne(&point);
        assert_relative_eq!(c * c.transpose(), Matrix3::identity(), epsilon = 1e-14);
        let north = ecef(&Geodetic::from_degrees(35.001, 139.0, 0.0)).0 - ecef(&point).0;
        assert!((c * north).normalize().x > 0.999_999);
    }
}
