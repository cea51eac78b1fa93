//! The Sun: how high it stands, and the E layer that it makes.

use super::smooth::{clipped_exp, join};

/// Zenith angle of the passage from day to night, degrees (equation 28).
const TWILIGHT_DEG: f64 = 86.232_927_962_116_15;

/// The Sun at the middle of a month, at an hour of the day.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sun {
    /// Sine and cosine of the declination.
    declination: (f64, f64),
    /// From the Sun's meridian to Greenwich's, rad.
    hour_angle: f64,
    /// -1 in winter, 1 in summer of the northern hemisphere, 0 between.
    season: f64,
}

impl Sun {
    /// `month` from 1 to 12, `hour` in UTC with its fraction (equations 20 to 25 and 30 to 32).
    pub(super) fn new(month: u8, hour: f64) -> Self {
        let day = 30.5 * f64::from(month) - 15.0 + (18.0 - hour) / 24.0;
        let anomaly = (0.9856 * day - 3.289).to_radians();
        let equation = 1.916 * anomaly.sin() + 0.020 * (2.0 * anomaly).sin() + 282.634;
        let sin = 0.39782 * (anomaly + equation.to_radians()).sin();
        let season = match month {
            1 | 2 | 11 | 12 => -1.0,
            3 | 4 | 9 | 10 => 0.0,
            _ => 1.0,
        };
        Sun {
            declination: (sin, (1.0 - sin * sin).sqrt()),
            hour_angle: (15.0 * (12.0 - hour)).to_radians(),
            season,
        }
    }

    /// Critical frequency of the E layer, MHz, at a place, rad, for an effective ionisation level in units of solar
    /// flux (equations 33 to 35).
    pub(super) fn e_layer(&self, latitude: f64, longitude: f64, ionisation: f64) -> f64 {
        let tilt = clipped_exp(0.3 * latitude.to_degrees());
        let season = self.season * (tilt - 1.0) / (tilt + 1.0);
        let height = self.zenith_angle(latitude, longitude).cos().powf(0.6);
        ((1.112 - 0.019 * season).powi(2) * ionisation.sqrt() * height + 0.49).sqrt()
    }

    /// Effective zenith angle, rad: that of the Sun by day, just below 90 degrees by night (equations 26 to 28).
    fn zenith_angle(&self, latitude: f64, longitude: f64) -> f64 {
        let (sin, cos) = latitude.sin_cos();
        let meridian = (self.hour_angle - longitude).cos();
        let cos_zenith = sin * self.declination.0 + cos * self.declination.1 * meridian;
        let zenith = cos_zenith.clamp(-1.0, 1.0).acos().to_degrees();
        let night = 90.0 - 0.24 * clipped_exp(20.0 - 0.2 * zenith);
        join(night, zenith, 12.0, zenith - TWILIGHT_DEG).to_radians()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_stands_over_the_tropic_at_noon_of_june_and_below_the_horizon_at_midnight() {
        let tropic = 23.3_f64.to_radians();
        let noon = Sun::new(6, 12.0).zenith_angle(tropic, 0.0).to_degrees();
        assert!(noon < 0.5, "{noon}");
        let midnight = Sun::new(6, 0.0).zenith_angle(tropic, 0.0).to_degrees();
        assert!((89.9..90.0).contains(&midnight), "{midnight}");
    }

    #[test]
    fn the_e_layer_is_strong_by_day_and_nearly_gone_by_night() {
        let day = Sun::new(3, 12.0).e_layer(0.0, 0.0, 100.0);
        let night = Sun::new(3, 0.0).e_layer(0.0, 0.0, 100.0);
        assert!((3.3..3.6).contains(&day), "{day}");
        assert!((0.7..0.8).contains(&night), "{night}");
    }
}
