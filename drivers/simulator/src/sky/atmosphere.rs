//! The true ionosphere and troposphere. Neither is what a receiver's models make of them.

use std::f64::consts::PI;

use insd_base::Geodetic;
use insd_base::satellites::SPEED_OF_LIGHT;

use super::records::{ALPHA, BETA};

/// Radius of the Earth and height of the thin shell of the ionosphere, m.
const EARTH: f64 = 6_371_000.0;
const SHELL: f64 = 400_000.0;

/// The delay of the code on L1, m, that the ionosphere is broadcast to make of a ray, on a true thin shell.
///
/// The vertical delay is Klobuchar's (IS-GPS-200N, 20.3.3.5.2.5); the pierce point, on a sphere, and the slope of the ray there are exact, where
/// Klobuchar approximates both.
pub(crate) fn ionosphere(point: &Geodetic, azimuth: f64, elevation: f64, gps_seconds: f64) -> f64 {
    let sine = EARTH * elevation.cos() / (EARTH + SHELL);
    let angle = PI / 2.0 - elevation - sine.asin();
    let (sin_lat, cos_lat) = point.latitude.sin_cos();
    let latitude = (sin_lat * angle.cos() + cos_lat * angle.sin() * azimuth.cos()).asin();
    let across = (angle.sin() * azimuth.sin())
        .atan2(cos_lat * angle.cos() - sin_lat * angle.sin() * azimuth.cos());
    let longitude = point.longitude + across;
    vertical(latitude / PI, longitude / PI, gps_seconds) / (1.0 - sine * sine).sqrt()
}

/// Vertical delay on L1, m, over a place in semicircles.
fn vertical(latitude: f64, longitude: f64, gps_seconds: f64) -> f64 {
    let magnetic = latitude + 0.064 * ((longitude - 1.617) * PI).cos();
    let local = (43_200.0 * longitude + gps_seconds).rem_euclid(86_400.0);
    let poly = |c: &[f64; 4]| c.iter().rev().fold(0.0, |sum, c| sum * magnetic + c);
    let (amplitude, period) = (poly(&ALPHA).max(0.0), poly(&BETA).max(72_000.0));
    let x = 2.0 * PI * (local - 50_400.0) / period;
    // the cosine itself, of which the broadcast model has the first terms
    let day = if x.abs() < PI / 2.0 { amplitude * x.cos() } else { 0.0 };
    SPEED_OF_LIGHT * (5e-9 + day)
}

/// The air above an antenna.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Troposphere {
    /// Factor on all of it.
    pub(crate) factor: f64,
    /// Zenith delay of its water above the mean at sea level, m.
    pub(crate) wet_error: f64,
}

/// Zenith delay of the water in the air at sea level, m, and the height in which it falls to 1/e, m: a mild day.
const WET: (f64, f64) = (0.15, 2000.0);

impl Troposphere {
    /// Delay of a ray, m.
    ///
    /// Dry zenith delay 0.0022768 P/(1 - 0.00266 cos 2 lat - 0.00028 h/km), P of the standard atmosphere (Saastamoinen 1972; Davis et al.
    /// 1985); mapping functions of Niell (1996, tables 3 and 4) at 45 degrees, without season.
    pub(crate) fn delay(&self, point: &Geodetic, elevation: f64) -> f64 {
        let h = point.height.clamp(-500.0, 10_000.0);
        let pressure = 1013.25 * (1.0 - 2.2557e-5 * h).powf(5.2568);
        let dry = 0.002_276_8 * pressure
            / (1.0 - 0.002_66 * (2.0 * point.latitude).cos() - 0.000_28 * h * 1e-3);
        let wet = (WET.0 + self.wet_error).max(0.0) * (-h / WET.1).exp();
        let dry_map = mapping(elevation, [1.246_539_7e-3, 2.928_844_5e-3, 63.721_774e-3]);
        let wet_map = mapping(elevation, [5.811_801_9e-4, 1.457_275_2e-3, 4.390_893_1e-2]);
        self.factor * (dry * dry_map + wet * wet_map)
    }
}

/// Marini's continued fraction, one at the zenith.
fn mapping(elevation: f64, [a, b, c]: [f64; 3]) -> f64 {
    let s = elevation.sin();
    (1.0 + a / (1.0 + b / (1.0 + c))) / (s + a / (s + b / (s + c)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::units::DEG;

    #[test]
    fn delays_are_those_of_textbooks() {
        let port = Geodetic::from_degrees(35.0, 136.0, 30.0);
        let air = Troposphere { factor: 1.0, wet_error: 0.0 };
        let zenith = air.delay(&port, 90.0 * DEG);
        assert!((2.4..2.5).contains(&zenith), "{zenith}");
        let low = air.delay(&port, 10.0 * DEG) / zenith;
        assert!((5.5..5.65).contains(&low), "{low}");
        // five in the morning, and two in the afternoon, UTC + 9 h
        let night = ionosphere(&port, 1.0, 90.0 * DEG, 20.0 * 3600.0);
        let day = ionosphere(&port, 1.0, 90.0 * DEG, 5.0 * 3600.0);
        assert!((1.4..1.6).contains(&night) && (3.0..12.0).contains(&day), "{night} {day}");
        let slant = ionosphere(&port, 1.0, 10.0 * DEG, 20.0 * 3600.0) / night;
        assert!((2.5..2.9).contains(&slant), "{slant}");
    }
}
