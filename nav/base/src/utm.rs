//! Universal Transverse Mercator: the grid in which surveyors and divers write positions.
//!
//! ```text
//! tau'  = tau sqrt(1 + sigma^2) - sigma sqrt(1 + tau^2),  tau = tan(latitude),
//! sigma = sinh(e atanh(e tau / sqrt(1 + tau^2)))                            conformal latitude
//! xi'   = atan2(tau', cos(lambda)),  eta' = asinh(sin(lambda) / sqrt(tau'^2 + cos(lambda)^2))
//! xi    = xi'  + sum over j of alpha_j sin(2 j xi') cosh(2 j eta')
//! eta   = eta' + sum over j of alpha_j cos(2 j xi') sinh(2 j eta')
//! east  = 500 km + k0 A eta,  north = k0 A xi, and 10000 km more south of the equator
//! ```
//! lambda is the longitude from the central meridian of the zone. The series is Krueger's (1912) to the
//! fourth order in the third flattening n, in the form of Karney, "Transverse Mercator with an accuracy
//! of a few nanometers", J. Geodesy 85 (2011), eqs. (7) to (14) and (35). It is good to some 0.2
//! micrometres within a zone (GeographicLib, `TransverseMercator`). Zones, their exceptions and the
//! letters of the bands of latitude are those of NGA.SIG.0012 (2014).
//!
//! Held by the tests of this file: records of units that write both, and the PROJ library.

use crate::earth::{ECCENTRICITY_SQ, FLATTENING, SEMI_MAJOR};
use crate::units::wrap_pi;

/// Scale on the central meridian.
const K0: f64 = 0.9996;
/// Easting of the central meridian, m.
const FALSE_EASTING: f64 = 500_000.0;
/// Northing of the equator for a position south of it, m.
const FALSE_NORTHING: f64 = 10_000_000.0;
/// Third flattening.
const N: f64 = FLATTENING / (2.0 - FLATTENING);
/// Radius of the sphere whose meridians are as long as those of the ellipsoid, m.
const RECTIFYING: f64 = SEMI_MAJOR / (1.0 + N) * (1.0 + N * N / 4.0 + N * N * N * N / 64.0);
/// Coefficients alpha of the series.
const ALPHA: [f64; 4] = [
    N * (1.0 / 2.0 + N * (-2.0 / 3.0 + N * (5.0 / 16.0 + N * 41.0 / 180.0))),
    N * N * (13.0 / 48.0 + N * (-3.0 / 5.0 + N * 557.0 / 1440.0)),
    N * N * N * (61.0 / 240.0 - N * 103.0 / 140.0),
    N * N * N * N * 49_561.0 / 161_280.0,
];
/// Letters of the bands of latitude, 8 deg each from 80 deg S, the last to 84 deg N.
const BANDS: &[u8; 20] = b"CDEFGHJKLMNPQRSTUVWX";

/// A position in the grid of its zone, on the WGS-84 ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Utm {
    /// Number of the zone, 1 to 60, eastward from the antimeridian.
    pub zone: u8,
    /// ASCII letter of the band of latitude: C to X without I and O; N and beyond are north.
    pub band: u8,
    /// Easting, m; the central meridian has 500 km.
    pub easting: f64,
    /// Northing, m; the equator has 0 for positions north of it and 10000 km for those south.
    pub northing: f64,
}

impl Utm {
    /// The grid position of a geodetic latitude and longitude, rad; `None` beyond 84 deg N and 80 deg S,
    /// where the grid ends.
    #[must_use]
    pub fn of(latitude: f64, longitude: f64) -> Option<Self> {
        let band = band(latitude.to_degrees())?;
        if !longitude.is_finite() {
            return None;
        }
        let zone = zone(latitude.to_degrees(), wrap_pi(longitude).to_degrees());
        let central = (f64::from(zone) * 6.0 - 183.0).to_radians();
        let (xi, eta) = transverse_mercator(latitude, wrap_pi(longitude - central));
        let origin = if latitude < 0.0 { FALSE_NORTHING } else { 0.0 };
        let scale = K0 * RECTIFYING;
        Some(Utm {
            zone,
            band,
            easting: FALSE_EASTING + scale * eta,
            northing: origin + scale * xi,
        })
    }
}

fn band(latitude_deg: f64) -> Option<u8> {
    let within = (-80.0..=84.0).contains(&latitude_deg);
    let index = ((latitude_deg + 80.0) / 8.0) as usize;
    within.then(|| BANDS[index.min(BANDS.len() - 1)])
}

/// The zone of a place. South-western Norway lies in zone 32, and Svalbard in the zones of odd number.
fn zone(latitude_deg: f64, longitude_deg: f64) -> u8 {
    let (lat, lon) = (latitude_deg, longitude_deg);
    if (56.0..64.0).contains(&lat) && (3.0..12.0).contains(&lon) {
        return 32;
    }
    if lat >= 72.0 && (0.0..42.0).contains(&lon) {
        return match lon {
            lon if lon < 9.0 => 31,
            lon if lon < 21.0 => 33,
            lon if lon < 33.0 => 35,
            _ => 37,
        };
    }
    let index = ((lon + 180.0) / 6.0).floor() as i32;
    index.rem_euclid(60) as u8 + 1
}

/// Northing and easting on a sphere of radius one whose scale on the central meridian is one.
fn transverse_mercator(latitude: f64, from_central: f64) -> (f64, f64) {
    let tau = latitude.tan();
    let secant = tau.hypot(1.0);
    let e = ECCENTRICITY_SQ.sqrt();
    let sigma = (e * (e * tau / secant).atanh()).sinh();
    let conformal = tau * sigma.hypot(1.0) - sigma * secant;
    let (sin, cos) = from_central.sin_cos();
    let xi = conformal.atan2(cos);
    let eta = (sin / conformal.hypot(cos)).asinh();
    let terms = ALPHA.iter().enumerate().map(|(index, alpha)| {
        let order = 2.0 * (index as f64 + 1.0);
        let north = alpha * (order * xi).sin() * (order * eta).cosh();
        (north, alpha * (order * xi).cos() * (order * eta).sinh())
    });
    terms.fold((xi, eta), |(north, east), term| (north + term.0, east + term.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::DEG;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn of(latitude_deg: f64, longitude_deg: f64) -> Utm {
        Utm::of(latitude_deg * DEG, longitude_deg * DEG).unwrap()
    }

    fn check(place: (f64, f64), zone: u8, band: u8, grid: (f64, f64), within: f64) {
        let utm = of(place.0, place.1);
        assert_eq!((utm.zone, utm.band), (zone, band), "{place:?}");
        let error = (utm.easting - grid.0).hypot(utm.northing - grid.1);
        assert!(error < within, "{place:?}: {error} m");
    }

    #[test]
    fn positions_that_inertial_units_wrote_both_ways_agree_to_their_last_digit() {
        // records of Phins units, published with the parsers of rock-drivers, ds_msgs and others
        for (place, zone, band, grid) in [
            ((53.102_457_14, 8.839_943_82), 32, b'U', (489_284.019, 5_883_680.109)),
            ((39.273_015_45, 14.380_445_97), 33, b'S', (446_558.301, 4_347_257.020)),
            ((47.980_959_19, 243.432_241_20), 11, b'T', (532_255.081, 5_314_274.311)),
            ((0.0, 0.0), 31, b'N', (166_021.443, 0.0)),
        ] {
            check(place, zone, band, grid, 0.002);
        }
    }

    #[test]
    fn the_grid_is_that_of_proj() {
        for (place, zone, band, grid) in [
            ((60.0, 5.0), 32, b'V', (276_979.926_4, 6_658_157.202_4)),
            ((59.9999, 2.9999), 31, b'V', (499_994.422_2, 6_651_400.053_6)),
            ((78.2, 15.6), 33, b'X', (513_696.945_4, 8_680_760.053_2)),
            ((75.0, 9.0), 33, b'X', (326_931.734_1, 8_332_368.952_5)),
            ((83.99999, 41.99), 37, b'X', (534_878.167_9, 9_328_998.003_3)),
            ((-79.99, -180.0), 1, b'C', (441_810.253_5, 1_118_029.759_0)),
            ((-33.8568, 151.2153), 56, b'H', (334_900.569_7, 6_252_288.752_9)),
            ((1.3, 179.999_999), 60, b'N', (833_892.899_5, 143_887.762_3)),
        ] {
            check(place, zone, band, grid, 0.000_1);
        }
    }

    #[test]
    fn norway_and_svalbard_have_zones_of_their_own() {
        let zones = [
            ((63.9, 3.1), 32),
            ((64.1, 3.1), 31),
            ((55.9, 3.1), 31),
            ((63.9, 11.9), 32),
            ((71.9, 8.9), 32),
            ((72.1, 8.9), 31),
            ((72.1, 20.9), 33),
            ((72.1, 21.1), 35),
            ((72.1, 33.1), 37),
            ((72.1, 42.1), 38),
            ((72.1, -0.1), 30),
        ];
        for ((latitude, longitude), zone) in zones {
            assert_eq!(of(latitude, longitude).zone, zone, "{latitude} {longitude}");
        }
    }

    #[test]
    fn there_is_no_grid_beyond_84_north_and_80_south_nor_for_what_is_no_number() {
        assert_eq!(Utm::of(84.1 * DEG, 0.0), None);
        assert_eq!(Utm::of(-80.1 * DEG, 0.0), None);
        assert_eq!(Utm::of(f64::NAN, 0.0), None);
        assert_eq!(Utm::of(0.5, f64::INFINITY), None);
        assert_eq!(of(83.9, 0.0).band, b'X');
        assert_eq!(of(-79.9, 0.0).band, b'C');
    }

    #[test]
    fn the_antimeridian_belongs_to_zone_1() {
        assert_eq!(of(10.0, 180.0).zone, 1);
        assert_eq!(of(10.0, -180.0).zone, 1);
        assert_eq!(of(10.0, 540.0), of(10.0, 180.0));
    }

    proptest! {
        #[test]
        fn a_step_of_a_metre_is_a_metre_of_grid_to_the_scale_of_the_zone(
            latitude in -79.0..83.0_f64, longitude in -180.0..180.0_f64, bearing in 0.0..TAU,
        ) {
            let (meridian, normal) = crate::earth::radii(latitude * DEG);
            let north = bearing.cos() / meridian / DEG;
            let east = bearing.sin() / (normal * (latitude * DEG).cos()) / DEG;
            let (from, to) = (of(latitude, longitude), of(latitude + north, longitude + east));
            prop_assume!(from.zone == to.zone && (from.band < b'N') == (to.band < b'N'));
            let step = (to.easting - from.easting).hypot(to.northing - from.northing);
            // the wide zones of Svalbard reach 6 deg from their central meridians, others 3
            prop_assert!((0.9995..1.0013).contains(&step), "{}", step);
        }
    }
}
