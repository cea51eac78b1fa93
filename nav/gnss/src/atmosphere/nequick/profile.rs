//! Electrons above one place: the layers E, F1 and F2 and the topside, each half a bell.
//!
//! Heights and thicknesses in km, densities in 1e11 electrons per cubic metre, frequencies in MHz.

use super::ccir::F2;
use super::smooth::{clipped_exp, epstein, join};

/// Height of the E layer's peak (equation 78).
const E_HEIGHT: f64 = 120.0;
/// Below it the density fades as Chapman's (equations 119 to 121).
const CHAPMAN_HEIGHT: f64 = 100.0;

/// What is the same for every place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Season {
    /// 1 to 12.
    pub(super) month: u8,
    /// Effective sunspot number.
    pub(super) sunspots: f64,
}

/// The density over a place as a function of the height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profile {
    f2: Layer,
    f1: Layer,
    e: Layer,
    /// Density at the peak of F2.
    peak: f64,
    /// Thickness of the topside.
    topside: f64,
}

/// One layer: four times its density at its peak, if it stood alone, and its thickness on both sides.
#[derive(Clone, Copy, Debug)]
struct Layer {
    amplitude: f64,
    height: f64,
    below: f64,
    above: f64,
}

impl Layer {
    fn thickness(&self, height: f64) -> f64 {
        if height > self.height { self.above } else { self.below }
    }

    fn density(&self, height: f64) -> f64 {
        self.amplitude * epstein((height - self.height) / self.thickness(height))
    }
}

impl Profile {
    /// From the critical frequency of the E layer and what the F2 layer is (equations 36 and 78 to 98).
    pub(super) fn new(e_critical: f64, f2: F2, season: Season) -> Self {
        let peak = density_of(f2.critical);
        let height = f2_height(e_critical, f2);
        let f1_height = 0.5 * (height + E_HEIGHT);
        let thickness = f2_thickness(f2, peak);
        let f1_below = 0.5 * (f1_height - E_HEIGHT);
        let bare = |height, below, above| Layer { amplitude: 0.0, height, below, above };
        let mut profile = Profile {
            f2: Layer { amplitude: 4.0 * peak, ..bare(height, thickness, thickness) },
            f1: bare(f1_height, f1_below, 0.3 * (height - f1_height)),
            e: bare(E_HEIGHT, 5.0, f1_below.max(7.0)),
            peak,
            topside: topside_thickness(thickness, height, peak, season),
        };
        profile.share(e_critical, f1_critical(e_critical, f2.critical));
        profile
    }

    /// Amplitudes of E and F1 such that with the feet of the others the peaks are as high as they should be
    /// (equations 91 to 98).
    fn share(&mut self, e_critical: f64, f1_critical: f64) {
        let e_peak = density_of(e_critical);
        let f2_at_e = self.f2.density(E_HEIGHT);
        let f1_peak = density_of(f1_critical);
        let f2_at_f1 = self.f2.density(self.f1.height);
        self.e.amplitude = 4.0 * e_peak;
        if f1_critical < 0.5 {
            self.e.amplitude -= 4.0 * f2_at_e;
        } else {
            for _ in 0..5 {
                let f1 = 4.0 * (f1_peak - f2_at_f1 - self.e.density(self.f1.height));
                self.f1.amplitude = join(f1, 0.8 * f1_peak, 1.0, f1 - 0.8 * f1_peak);
                self.e.amplitude = 4.0 * (e_peak - self.f1.density(E_HEIGHT) - f2_at_e);
            }
        }
        self.e.amplitude = join(self.e.amplitude, 0.05, 60.0, self.e.amplitude - 0.005);
    }

    /// Density at a height.
    pub(super) fn density(&self, height: f64) -> f64 {
        if height > self.f2.height { self.above(height) } else { self.below(height) }
    }

    /// Of the topside (equations 122 to 127).
    fn above(&self, height: f64) -> f64 {
        const G: f64 = 0.125;
        const R: f64 = 100.0;
        let rise = height - self.f2.height;
        let stretch = 1.0 + R * G * rise / (R * self.topside + G * rise);
        4.0 * self.peak * epstein(rise / (self.topside * stretch))
    }

    /// Of the bottomside (equations 109 to 121).
    fn below(&self, height: f64) -> f64 {
        let from = height.max(CHAPMAN_HEIGHT);
        let fade = clipped_exp(10.0 / (1.0 + (from - self.f2.height).abs()));
        let layers = [(self.f2, 1.0), (self.f1, fade), (self.e, fade)].map(|(layer, fade)| {
            let thickness = layer.thickness(height);
            let x = (from - layer.height) / thickness * fade;
            // equations 114 to 117
            let here = if x.abs() > 25.0 { 0.0 } else { layer.amplitude * epstein(x) };
            (here, -(0.5 * x).tanh() / thickness)
        });
        let sum: f64 = layers.iter().map(|(here, _)| here).sum();
        if height >= CHAPMAN_HEIGHT || sum == 0.0 {
            return sum;
        }
        let slope: f64 = layers.iter().map(|(here, slope)| here * slope).sum();
        let z = 0.1 * (height - CHAPMAN_HEIGHT);
        sum * clipped_exp(1.0 - (1.0 - 10.0 * slope / sum) * z - clipped_exp(-z))
    }
}

/// Density of a plasma with a critical frequency (equation 36).
fn density_of(critical: f64) -> f64 {
    0.124 * critical * critical
}

/// Critical frequency of the F1 layer: 1.4 times that of E by day, none by night and none above 0.85 that of F2
/// (annex F).
fn f1_critical(e: f64, f2: f64) -> f64 {
    let by_day = join(1.4 * e, 0.0, 1000.0, e - 2.0);
    let known = join(0.0, by_day, 1000.0, e - by_day);
    join(known, 0.85 * known, 60.0, 0.85 * f2 - known)
}

/// Height of the peak of F2 (equation 80).
fn f2_height(e_critical: f64, f2: F2) -> f64 {
    let ratio = f2.critical / e_critical;
    let ratio = join(ratio, 1.75, 20.0, ratio - 1.75);
    let m = f2.m3000;
    let delta = 0.253 / (ratio - 1.215) - 0.012;
    let root = ((0.0196 * m * m + 1.0) / (1.2967 * m * m - 1.0)).sqrt();
    1490.0 * m * root / (m + delta) - 176.0
}

/// Thickness of F2 below its peak (equation 85).
fn f2_thickness(f2: F2, peak: f64) -> f64 {
    let gradient = -3.467 + 0.857 * (f2.critical * f2.critical).ln() + 2.02 * f2.m3000.ln();
    0.385 * peak / (0.01 * clipped_exp(gradient))
}

/// Thickness of the topside from that of F2, the height and the density of its peak (equations 99 to 106).
fn topside_thickness(f2: f64, height: f64, peak: f64, season: Season) -> f64 {
    let ka = if (4..=9).contains(&season.month) {
        6.705 - 0.014 * season.sunspots - 0.008 * height
    } else {
        -7.77 + 0.097 * (height / f2).powi(2) + 0.153 * peak
    };
    let kb = join(ka, 2.0, 1.0, ka - 2.0);
    let kb = join(8.0, kb, 1.0, kb - 8.0);
    let ha = kb * f2;
    let x = 0.01 * (ha - 150.0);
    ha / ((0.041_163 * x - 0.183_981) * x + 1.424_472)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noon() -> Profile {
        let season = Season { month: 4, sunspots: 100.0 };
        Profile::new(3.5, F2 { critical: 10.0, m3000: 3.0 }, season)
    }

    #[test]
    fn the_density_is_highest_at_the_peak_of_f2_and_has_no_step_there() {
        let (profile, peak) = (noon(), density_of(10.0));
        let height = profile.f2.height;
        assert!((250.0..350.0).contains(&height), "{height}");
        assert!((profile.density(height) / peak - 1.0).abs() < 0.02);
        assert!((profile.density(height + 1e-6) / peak - 1.0).abs() < 1e-9);
        for other in [0.0, 90.0, 120.0, height - 40.0, height + 40.0, 1000.0, 20_000.0] {
            let density = profile.density(other);
            assert!((0.0..0.97 * peak).contains(&density), "{other} km: {density}");
        }
    }

    #[test]
    fn the_density_has_no_step_where_chapmans_begins() {
        let profile = noon();
        let (below, above) = (profile.density(100.0 - 1e-9), profile.density(100.0));
        assert!((below / above - 1.0).abs() < 1e-6, "{below} {above}");
    }

    #[test]
    fn the_peak_of_e_is_as_dense_as_its_critical_frequency_says() {
        let profile = noon();
        let density = profile.density(E_HEIGHT);
        assert!((density / density_of(3.5) - 1.0).abs() < 0.05, "{density}");
    }

    #[test]
    fn there_is_no_f1_by_night() {
        assert!(f1_critical(0.8, 5.0) < 1e-6);
        assert!((f1_critical(3.5, 10.0) - 4.9).abs() < 1e-3);
    }
}
