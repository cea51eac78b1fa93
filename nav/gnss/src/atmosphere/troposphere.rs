//! The troposphere: Saastamoinen's zenith delays in a standard atmosphere, mapped to the elevation by Niell.

use std::f64::consts::PI;

use insd_base::{Geodetic, GpsTime};

/// Latitudes of Niell's tables, degrees.
const LATITUDES: [f64; 5] = [15.0, 30.0, 45.0, 60.0, 75.0];

/// Coefficients a, b, c of the mapping at those latitudes.
type Table = [[f64; 3]; 5];

/// Dry, mean of the year (Niell, J. Geophys. Res. 101(B2), 1996, table 3).
const DRY: Table = [
    [1.276_993_4e-3, 2.915_369_5e-3, 62.610_505e-3],
    [1.268_323_0e-3, 2.915_229_9e-3, 62.837_393e-3],
    [1.246_539_7e-3, 2.928_844_5e-3, 63.721_774e-3],
    [1.219_604_9e-3, 2.902_256_5e-3, 63.824_265e-3],
    [1.204_599_6e-3, 2.902_491_2e-3, 64.258_455e-3],
];

/// Dry, amplitude over the year.
const SEASON: Table = [
    [0.0, 0.0, 0.0],
    [1.270_962_6e-5, 2.141_497_9e-5, 9.012_840_0e-5],
    [2.652_366_2e-5, 3.016_077_9e-5, 4.349_703_7e-5],
    [3.400_045_2e-5, 7.256_272_2e-5, 84.795_348e-5],
    [4.120_219_1e-5, 11.723_375e-5, 170.372_06e-5],
];

/// Wet (table 4).
const WET: Table = [
    [5.802_189_7e-4, 1.427_526_8e-3, 4.347_296_1e-2],
    [5.679_484_7e-4, 1.513_862_5e-3, 4.672_951_0e-2],
    [5.811_801_9e-4, 1.457_275_2e-3, 4.390_893_1e-2],
    [5.972_754_2e-4, 1.500_742_8e-3, 4.462_698_2e-2],
    [6.164_169_3e-4, 1.759_908_2e-3, 5.473_603_8e-2],
];

/// Correction for the height above the sea.
const HEIGHT: [f64; 3] = [2.53e-5, 5.49e-3, 1.14e-3];

/// Delays at the zenith of an antenna, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Troposphere {
    /// Of air without vapour.
    pub dry: f64,
    /// Of the vapour.
    pub wet: f64,
}

impl Troposphere {
    /// In the standard atmosphere (15 deg C and 1013.25 hPa at the sea, 6.5 K/km) at this relative humidity, 0 to 1.
    ///
    /// Saastamoinen, "Atmospheric correction for the troposphere and stratosphere in radio ranging of satellites", 1972.
    /// Heights are taken within 0 to 10 km.
    #[must_use]
    pub fn standard(antenna: &Geodetic, humidity: f64) -> Self {
        let height = antenna.height.clamp(0.0, 1e4);
        let pressure = 1013.25 * (1.0 - 2.2557e-5 * height).powf(5.2568);
        let temperature = 288.16 - 6.5e-3 * height;
        let vapour =
            6.108 * humidity * ((17.15 * temperature - 4684.0) / (temperature - 38.45)).exp();
        let shape = 1.0 - 0.002_66 * (2.0 * antenna.latitude).cos() - 0.000_28 * height / 1e3;
        Self {
            dry: 0.002_276_8 * pressure / shape,
            wet: 0.002_277 * (1255.0 / temperature + 0.05) * vapour,
        }
    }

    /// Delay along a ray, m.
    #[must_use]
    pub fn slant(&self, mapping: Mapping) -> f64 {
        self.dry * mapping.dry + self.wet * mapping.wet
    }
}

/// By how much more air a ray goes through than one from the zenith.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping {
    /// Of the dry delay.
    pub dry: f64,
    /// Of the wet delay.
    pub wet: f64,
}

impl Mapping {
    /// At an elevation, rad, of 3 degrees and more (Niell 1996, eqs. 4 to 6).
    #[must_use]
    pub fn niell(antenna: &Geodetic, elevation: f64, time: GpsTime) -> Self {
        let sin = elevation.max(0.05).sin();
        let latitude = antenna.latitude.to_degrees();
        let south = if latitude < 0.0 { 0.5 } else { 0.0 };
        let season = (2.0 * PI * ((day_of_year(time) - 28.0) / 365.25 + south)).cos();
        let mean = interpolated(&DRY, latitude.abs());
        let amplitude = interpolated(&SEASON, latitude.abs());
        let coefficients = std::array::from_fn(|i| mean[i] - amplitude[i] * season);
        let above_sea = (1.0 / sin - fraction(&HEIGHT, sin)) * antenna.height.max(0.0) / 1e3;
        Self {
            dry: fraction(&coefficients, sin) + above_sea,
            wet: fraction(&interpolated(&WET, latitude.abs()), sin),
        }
    }
}

/// Marini's continued fraction, one at the zenith.
fn fraction([a, b, c]: &[f64; 3], sin: f64) -> f64 {
    (1.0 + a / (1.0 + b / (1.0 + c))) / (sin + a / (sin + b / (sin + c)))
}

fn interpolated(table: &Table, latitude: f64) -> [f64; 3] {
    let place = ((latitude - LATITUDES[0]) / 15.0).clamp(0.0, 4.0);
    let row = (place as usize).min(3);
    let share = place - row as f64;
    std::array::from_fn(|i| table[row][i] * (1.0 - share) + table[row + 1][i] * share)
}

/// Day of the year with its fraction, one on the first of January.
fn day_of_year(time: GpsTime) -> f64 {
    const DAY: f64 = 86_400.0;
    let utc = time.to_utc(None);
    let ((year, _, _), _) = utc.to_civil();
    let start = insd_base::UtcTime::from_civil((year, 1, 1), (0, 0, 0), 0);
    start.map_or(1.0, |start| utc.since(start).as_seconds() / DAY + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Latitude, height, elevation in degrees and metres, humidity; slant delay with 1/sin, Niell's dry and wet mapping:
    /// computed by two independent codes.
    const PUBLISHED: [(f64, f64, f64, f64, f64, f64, f64); 3] = [
        (
            -73.05762326825244,
            147.02961783508795,
            43.01582957196333,
            0.0,
            3.315928438,
            1.463896545,
            1.464817699,
        ),
        (
            -81.5819264015132,
            2553.8476258694363,
            60.885070795114196,
            0.7,
            1.975957158,
            1.144239299,
            1.144411217,
        ),
        (
            -25.363957394959343,
            184.14032848308804,
            55.08642575924339,
            0.5,
            2.85473005,
            1.218746295,
            1.219149758,
        ),
    ];

    #[test]
    fn delays_and_mapping_are_the_published_ones_to_a_tenth_of_a_millimetre() {
        let time = GpsTime::from_week(2320, 116_400_000_000_000);
        for (latitude, height, elevation, humidity, slant, dry, wet) in PUBLISHED {
            let antenna = Geodetic::from_degrees(latitude, 10.0, height);
            let elevation = elevation.to_radians();
            let zenith = Troposphere::standard(&antenna, humidity);
            let flat = (zenith.dry + zenith.wet) / elevation.sin();
            assert!((flat - slant).abs() < 1e-4, "{flat} for {slant}");
            let mapping = Mapping::niell(&antenna, elevation, time);
            assert!((mapping.dry - dry).abs() < 2e-6, "{} for {dry}", mapping.dry);
            assert!((mapping.wet - wet).abs() < 2e-6, "{} for {wet}", mapping.wet);
        }
    }
}
