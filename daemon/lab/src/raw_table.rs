//! The table `[raw]` of `voyage.toml`: what the receiver of the raw GNSS is worth.

use std::fs;
use std::path::Path;

use insd_base::Geodetic;
use insd_config::BadInput;
use insd_gnss::Noise;
use insd_nav::config::RangeModel;
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
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(crate) struct RawTable {
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
        match file.raw.fault() {
            Some((key, value)) => {
                let expected = "expected a number that is not negative";
                Err(BadInput(format!("{}: raw.{key}: {expected}, found {value}", path.display()))
                    .into())
            }
            None => Ok(RawTable { base: file.base.map(BaseTable::place), ..file.raw }),
        }
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
}
