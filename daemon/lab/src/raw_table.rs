//! The table `[raw]` of `voyage.toml`: what the receiver of the raw GNSS is worth.

use std::fs;
use std::path::Path;

use insd_base::Geodetic;
use insd_config::BadInput;
use insd_gnss::{ArrayRanging, Noise};
use insd_nav::config::RangeModel;
use nalgebra::Vector3;
use serde::Deserialize;

/// What of `voyage.toml` concerns raw GNSS; the rest is read elsewhere.
#[derive(Debug, Default, Deserialize)]
struct File {
    #[serde(default)]
    raw: RawTable,
    base: Option<BaseTable>,
}

/// Where the base is: the table `[base]`.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
struct BaseTable {
    lat_deg: f64,
    lon_deg: f64,
    height_m: f64,
}

/// The errors of a receiver; one that is not stated is that of a good receiver.
#[derive(Clone, Debug, Default, Deserialize)]
pub(crate) struct RawTable {
    #[serde(default)]
    antennas_m: Vec<[f64; 3]>,
    #[serde(default)]
    common_clock: Vec<usize>,
    code_std_m: Option<f64>,
    phase_std_m: Option<f64>,
    doppler_std_mps: Option<f64>,
    multipath_code_std_m: Option<f64>,
    clock_bias_walk_m_sqrt_s: Option<f64>,
    clock_drift_walk_mps_sqrt_s: Option<f64>,
    #[serde(skip)]
    base: Option<Geodetic>,
}

impl BaseTable {
    fn place(self) -> Geodetic {
        Geodetic::from_degrees(self.lat_deg, self.lon_deg, self.height_m)
    }
}

impl RawTable {
    /// Reads the table; the defaults where there is none.
    ///
    /// # Errors
    /// The file is no TOML, or a value of the table is no number that an error can have.
    pub(crate) fn read(dir: &Path) -> anyhow::Result<Self> {
        let path = dir.join("voyage.toml");
        let text = fs::read_to_string(&path)?;
        let file: File = toml::from_str(&text)
            .map_err(|error| BadInput(format!("{}: {error}", path.display())))?;
        let fault = |key: &str, expected: &str, found: String| {
            BadInput(format!("{}: raw.{key}: {expected}, found {found}", path.display()))
        };
        if let Some((key, value)) = file.raw.fault() {
            let expected = "expected a number that is not negative";
            return Err(fault(key, expected, value.to_string()).into());
        }
        if let Some(number) = file.raw.unknown_antenna() {
            let expected = format!("expected numbers of antennas, 1 to {}", file.raw.antennas());
            return Err(fault("common_clock", &expected, number.to_string()).into());
        }
        Ok(RawTable { base: file.base.map(BaseTable::place), ..file.raw })
    }

    /// How many antennas there are.
    pub(crate) fn antennas(&self) -> usize {
        self.antennas_m.len().max(1)
    }

    fn unknown_antenna(&self) -> Option<usize> {
        let known = 1..=self.antennas();
        self.common_clock.iter().copied().find(|number| !known.contains(number))
    }

    /// The antennas with a receiver each: those that share a clock, every other on its own.
    pub(crate) fn array(&self) -> ArrayRanging {
        let levers: Vec<Vector3<f64>> = (0..self.antennas()).map(|own| self.lever(own)).collect();
        let clock = |own: usize| {
            if self.common_clock.contains(&(own + 1)) { 0 } else { own + 1 }
        };
        let clocks: Vec<usize> = (0..levers.len()).map(clock).collect();
        ArrayRanging::new(&levers, &clocks)
    }

    fn lever(&self, antenna: usize) -> Vector3<f64> {
        self.antennas_m.get(antenna).copied().unwrap_or_default().into()
    }

    /// A value that no error has.
    fn fault(&self) -> Option<(&'static str, f64)> {
        let all = [
            ("code_std_m", self.code_std_m),
            ("phase_std_m", self.phase_std_m),
            ("doppler_std_mps", self.doppler_std_mps),
            ("multipath_code_std_m", self.multipath_code_std_m),
            ("clock_bias_walk_m_sqrt_s", self.clock_bias_walk_m_sqrt_s),
            ("clock_drift_walk_mps_sqrt_s", self.clock_drift_walk_mps_sqrt_s),
        ];
        let mut told = all.into_iter().filter_map(|(key, value)| Some((key, value?)));
        let is_none = |value: f64| !value.is_finite() || value < 0.0;
        told.find(|(_, value)| is_none(*value))
    }

    /// Where the base is, if the voyage says so.
    pub(crate) fn base(&self) -> Option<Geodetic> {
        self.base
    }

    /// Noise of the measurements.
    pub(crate) fn noise(&self) -> Noise {
        let usual = Noise::default();
        Noise {
            code: self.code_std_m.unwrap_or(usual.code),
            phase: self.phase_std_m.unwrap_or(usual.phase),
            rate: self.doppler_std_mps.unwrap_or(usual.rate),
            multipath: self.multipath_code_std_m.unwrap_or(usual.multipath),
        }
    }

    /// The receiver's clock.
    pub(crate) fn model(&self) -> RangeModel {
        let usual = RangeModel::default();
        RangeModel {
            clock_walk: self.clock_bias_walk_m_sqrt_s.unwrap_or(usual.clock_walk),
            drift_walk: self.clock_drift_walk_mps_sqrt_s.unwrap_or(usual.drift_walk),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_that_none_has_is_refused_with_its_key() {
        let fault = |text: &str| toml::from_str::<File>(text).unwrap().raw.fault();
        assert_eq!(fault("[raw]\ncode_std_m = 0.3\nphase_std_m = 0.0\n"), None);
        assert_eq!(fault("[imu]\nrate_hz = 100.0\n"), None);
        assert_eq!(fault("[raw]\nphase_std_m = -0.1\n"), Some(("phase_std_m", -0.1)));
        assert!(fault("[raw]\ndoppler_std_mps = nan\n").is_some());
    }

    #[test]
    fn a_clock_of_an_antenna_that_is_not_there_is_refused() {
        let unknown = |text: &str| toml::from_str::<File>(text).unwrap().raw.unknown_antenna();
        let two = "[raw]\nantennas_m = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\ncommon_clock = ";
        assert_eq!(unknown(&format!("{two}[1, 2]")), None);
        assert_eq!(unknown(&format!("{two}[1, 3]")), Some(3));
        assert_eq!(unknown(&format!("{two}[0]")), Some(0));
    }
}
