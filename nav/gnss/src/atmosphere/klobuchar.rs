//! Klobuchar's model of the ionosphere, as GPS broadcasts it (IS-GPS-200N, 20.3.3.5.2.5, figure 20-4).

use std::f64::consts::PI;

use insd_base::satellites::SPEED_OF_LIGHT;
use insd_base::{Geodetic, GpsTime};

use super::LookAngles;

/// Delay of the code on L1 (1575.42 MHz), m; other frequencies times (f_L1/f)^2. `alpha` and `beta` as broadcast, angles
/// in semicircles. Never below its value at night, 1.5 m at the zenith.
#[must_use]
pub fn klobuchar(
    (alpha, beta): (&[f64; 4], &[f64; 4]),
    antenna: &Geodetic,
    direction: LookAngles,
    time: GpsTime,
) -> f64 {
    const DAY: f64 = 86_400.0;
    let elevation = direction.elevation / PI;
    // angle at the Earth's centre to the point where the ray meets 350 km
    let psi = 0.0137 / (elevation + 0.11) - 0.022;
    let latitude = (antenna.latitude / PI + psi * direction.azimuth.cos()).clamp(-0.416, 0.416);
    let longitude = antenna.longitude / PI + psi * direction.azimuth.sin() / (latitude * PI).cos();
    let magnetic = latitude + 0.064 * ((longitude - 1.617) * PI).cos();
    let (_, nanos) = time.to_week();
    let local = (43_200.0 * longitude + nanos as f64 * 1e-9).rem_euclid(DAY);
    let slant = 1.0 + 16.0 * (0.53 - elevation).powi(3);
    let amplitude = polynomial(alpha, magnetic).max(0.0);
    let period = polynomial(beta, magnetic).max(72_000.0);
    let x = 2.0 * PI * (local - 50_400.0) / period;
    let day = if x.abs() < 1.57 {
        let x_sq = x * x;
        amplitude * (1.0 - x_sq / 2.0 + x_sq * x_sq / 24.0)
    } else {
        0.0
    };
    SPEED_OF_LIGHT * slant * (5e-9 + day)
}

fn polynomial(coefficients: &[f64; 4], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the shared vectors: two codes agree to a micrometre.
    #[test]
    fn klobuchar_is_the_published_value_to_the_millimetre() {
        let alpha = [8.3819e-09, 1.4901e-08, -5.9605e-08, -5.9605e-08];
        let beta = [83968.0, 16384.0, -131_070.0, -65536.0];
        for (tow, lat, lon, az, el, expected) in [
            (
                339_744.7,
                -46.652092486553485,
                84.4820316150898,
                92.052640428623,
                50.17332382215194,
                1.87939442,
            ),
            (
                93_823.5,
                40.06574519852131,
                -8.42321946866258,
                325.7136955868563,
                35.71539081639686,
                2.37330207,
            ),
            (
                550_439.6,
                48.77947544692361,
                51.31381002428168,
                291.1634469392064,
                71.35212512698658,
                3.643568561,
            ),
        ] {
            let time = GpsTime::from_week(2100, (tow * 1e9) as i64);
            let direction =
                LookAngles { azimuth: f64::to_radians(az), elevation: f64::to_radians(el) };
            let delay =
                klobuchar((&alpha, &beta), &Geodetic::from_degrees(lat, lon, 0.0), direction, time);
            assert!((delay - expected).abs() < 1e-4, "{delay} for {expected}");
        }
    }
}
