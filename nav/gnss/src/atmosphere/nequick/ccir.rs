//! The world maps of the F2 layer of CCIR (ITU-R): its critical frequency and M(3000)F2 by month, hour, place and activity of
//! the Sun.

/// Of the map of foF2: coefficients in space, and in time of each.
const FOF2: (usize, usize) = (76, 13);
/// Of the map of M(3000)F2.
const M3000: (usize, usize) = (49, 9);
/// Numbers of one month: both maps, each for a quiet and for an active Sun.
const OF_MONTH: usize = 2 * (FOF2.0 * FOF2.1 + M3000.0 * M3000.1);

/// Powers of sin(modip) with each harmonic of the longitude (equations 63 and 71).
const FOF2_DEGREES: [usize; 9] = [12, 12, 9, 5, 2, 1, 1, 1, 1];
const M3000_DEGREES: [usize; 7] = [7, 8, 6, 3, 2, 1, 1];

/// `f32` little-endian: month, map, Sun, place, time (`data/README.md`).
static MONTHS: &[u8; 4 * OF_MONTH * 12] = include_bytes!("data/ccir.bin");

/// What the F2 layer is at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct F2 {
    /// Critical frequency, MHz.
    pub(super) critical: f64,
    /// M(3000)F2: highest frequency that reaches 3000 km, over the critical one.
    pub(super) m3000: f64,
}

/// The maps of one hour of one month, for a quiet Sun (R12 = 0) and an active one (100).
#[derive(Clone, Debug)]
pub(super) struct Hour {
    quiet: Maps,
    active: Maps,
}

/// The maps of one hour, for one activity of the Sun.
#[derive(Clone, Debug)]
pub(super) struct Maps {
    fof2: [f64; FOF2.0],
    m3000: [f64; M3000.0],
}

impl Hour {
    /// `month` from 1 to 12; outside it the map is empty. `hour` in UTC, with its fraction (equations 49 to 51).
    pub(super) fn new(month: u8, hour: f64) -> Self {
        let month = usize::from(month).wrapping_sub(1);
        let (values, _) = MONTHS.as_chunks::<4>();
        let values = values.chunks_exact(OF_MONTH).nth(month).unwrap_or_default();
        let (fof2, m3000) = values.split_at(values.len().min(2 * FOF2.0 * FOF2.1));
        let time = (15.0 * hour - 180.0).to_radians();
        let maps = |sun: usize| Maps {
            fof2: at_time::<{ FOF2.0 }, { FOF2.1 }>(fof2, sun, time),
            m3000: at_time::<{ M3000.0 }, { M3000.1 }>(m3000, sun, time),
        };
        Hour { quiet: maps(0), active: maps(1) }
    }

    /// The maps at an activity of the Sun: twelve-month mean of the sunspot number (equation 44).
    pub(super) fn at_sunspots(&self, sunspots: f64) -> Maps {
        let share = sunspots / 100.0;
        let mix = |quiet: f64, active: f64| quiet * (1.0 - share) + active * share;
        Maps {
            fof2: std::array::from_fn(|k| mix(self.quiet.fof2[k], self.active.fof2[k])),
            m3000: std::array::from_fn(|k| mix(self.quiet.m3000[k], self.active.m3000[k])),
        }
    }
}

impl Maps {
    /// The layer at a place: dip latitude, latitude and longitude, rad (equations 57 to 71).
    pub(super) fn at(&self, modip: f64, latitude: f64, longitude: f64) -> F2 {
        let harmonics = Harmonics::new(modip, latitude, longitude);
        F2 {
            critical: harmonics.sum(&self.fof2, &FOF2_DEGREES),
            m3000: harmonics.sum(&self.m3000, &M3000_DEGREES),
        }
    }
}

/// The harmonics of time of each coefficient in space, summed.
fn at_time<const PLACES: usize, const TIMES: usize>(
    map: &[[u8; 4]],
    sun: usize,
    time: f64,
) -> [f64; PLACES] {
    let mut sums = [0.0; PLACES];
    let series = map.chunks_exact(TIMES).skip(sun * PLACES);
    for (sum, series) in sums.iter_mut().zip(series) {
        let terms = series.iter().enumerate().map(|(k, value)| {
            let (sin, cos) = (k.div_ceil(2) as f64 * time).sin_cos();
            f64::from(f32::from_le_bytes(*value)) * if k % 2 == 1 { sin } else { cos }
        });
        *sum = terms.sum();
    }
    sums
}

/// What the coefficients in space are multiplied by.
struct Harmonics {
    sin_modip: f64,
    /// cos(latitude) e^(i longitude): its powers are the harmonics with the latitude's power that belongs to them.
    turn: (f64, f64),
}

impl Harmonics {
    fn new(modip: f64, latitude: f64, longitude: f64) -> Self {
        let (sin, cos) = longitude.sin_cos();
        let cos_latitude = latitude.cos();
        Harmonics { sin_modip: modip.sin(), turn: (cos_latitude * cos, cos_latitude * sin) }
    }

    /// Sum over the harmonics of the longitude, of a map with so many powers of sin(modip) in each.
    fn sum(&self, coefficients: &[f64], degrees: &[usize]) -> f64 {
        let (zonal, mut rest) = coefficients.split_at(degrees[0]);
        let mut sum = zonal.iter().rev().fold(0.0, |sum, c| sum * self.sin_modip + c);
        let mut harmonic = self.turn;
        for &degree in &degrees[1..] {
            let (own, behind) = rest.split_at(2 * degree);
            let (cos, sin) = own.as_chunks::<2>().0.iter().rev().fold((0.0, 0.0), |sum, c| {
                (sum.0 * self.sin_modip + c[0], sum.1 * self.sin_modip + c[1])
            });
            sum += cos * harmonic.0 + sin * harmonic.1;
            harmonic = (
                harmonic.0 * self.turn.0 - harmonic.1 * self.turn.1,
                harmonic.0 * self.turn.1 + harmonic.1 * self.turn.0,
            );
            rest = behind;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// Amplitude of cos(`order` t) in what changes with the hour.
    fn amplitude(order: f64, of_hour: impl Fn(f64) -> f64) -> f64 {
        let term = |hour: i32| {
            let hour = f64::from(hour);
            of_hour(hour) * (order * (15.0 * hour - 180.0).to_radians()).cos()
        };
        let mean = (0..24).map(term).sum::<f64>() / 24.0;
        if order > 0.0 { 2.0 * mean } else { mean }
    }

    #[test]
    fn the_tables_begin_and_end_with_the_numbers_of_ccir() {
        let first = amplitude(0.0, |hour| Hour::new(1, hour).quiet.fof2[0]);
        assert!((first - 5.239_659_3).abs() < 1e-6, "{first}");
        let last = amplitude(6.0, |hour| Hour::new(12, hour).active.fof2[75]);
        assert!((last - 0.064_126_67).abs() < 1e-8, "{last}");
        let m3000 = amplitude(0.0, |hour| Hour::new(7, hour).quiet.m3000[0]);
        assert!((m3000 - 3.080_285_1).abs() < 1e-6, "{m3000}");
    }

    #[test]
    fn every_month_has_maps_and_no_other() {
        for month in 1..=12 {
            let hour = Hour::new(month, 7.5);
            let all = [&hour.quiet, &hour.active].map(|maps| (maps.fof2[0], maps.m3000[0]));
            for (fof2, m3000) in all {
                assert!((3.0..20.0).contains(&fof2) && (2.5..3.5).contains(&m3000));
            }
        }
        for month in [0, 13, 255] {
            assert_eq!(Hour::new(month, 7.5).quiet.fof2, [0.0; 76]);
        }
    }

    #[test]
    fn at_the_pole_only_the_zonal_terms_are_left() {
        let maps = Hour::new(4, 3.0).at_sunspots(40.0);
        let f2 = maps.at(0.0, FRAC_PI_2, 1.0);
        assert!((f2.critical - maps.fof2[0]).abs() < 1e-12);
        assert!((f2.m3000 - maps.m3000[0]).abs() < 1e-12);
    }

    #[test]
    fn the_last_coefficients_go_with_eight_times_the_longitude() {
        let mut maps = Maps { fof2: [0.0; 76], m3000: [0.0; 49] };
        (maps.fof2[74], maps.fof2[75], maps.fof2[14]) = (2.0, 3.0, 5.0);
        let (modip, latitude, longitude) = (0.4_f64, 0.3_f64, 1.1_f64);
        let (sin, cos) = (8.0 * longitude).sin_cos();
        let first = 5.0 * modip.sin() * latitude.cos() * longitude.cos();
        let expected = latitude.cos().powi(8) * (2.0 * cos + 3.0 * sin) + first;
        assert!((maps.at(modip, latitude, longitude).critical - expected).abs() < 1e-12);
    }
}
