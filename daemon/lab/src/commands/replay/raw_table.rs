//! The table `[raw]` of `voyage.toml`: what the receiver of the raw GNSS is worth.

use std::fs;
use std::path::Path;

use insd_config::BadInput;
use insd_gnss::Noise;
use insd_nav::config::RangeModel;
use serde::Deserialize;

/// What of `voyage.toml` concerns raw GNSS; the rest is read elsewhere.
#[derive(Debug, Default, Deserialize)]
struct File {
    #[serde(default)]
    raw: RawTable,
}

/// The errors of a receiver; one that is not stated is that of a good receiver.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(super) struct RawTable {
    code_std_m: Option<f64>,
    phase_std_m: Option<f64>,
    doppler_std_mps: Option<f64>,
    multipath_code_std_m: Option<f64>,
    clock_bias_walk_m_sqrt_s: Option<f64>,
    clock_drift_walk_mps_sqrt_s: Option<f64>,
}

impl RawTable {
    /// Reads the table; the defaults where there is none.
    ///
    /// # Errors
    /// The file is no TOML, or a value of the table is no number.
    pub(super) fn read(dir: &Path) -> anyhow::Result<Self> {
        let path = dir.join("voyage.toml");
        let text = fs::read_to_string(&path)?;
        let file: File = toml::from_str(&text)
            .map_err(|error| BadInput(format!("{}: {error}", path.display())))?;
        Ok(file.raw)
    }

    /// Noise of the measurements.
    pub(super) fn noise(&self) -> Noise {
        let usual = Noise::default();
        Noise {
            code: self.code_std_m.unwrap_or(usual.code),
            phase: self.phase_std_m.unwrap_or(usual.phase),
            rate: self.doppler_std_mps.unwrap_or(usual.rate),
            multipath: self.multipath_code_std_m.unwrap_or(usual.multipath),
        }
    }

    /// The receiver's clock.
    pub(super) fn model(&self) -> RangeModel {
        let usual = RangeModel::default();
        RangeModel {
            clock_walk: self.clock_bias_walk_m_sqrt_s.unwrap_or(usual.clock_walk),
            drift_walk: self.clock_drift_walk_mps_sqrt_s.unwrap_or(usual.drift_walk),
        }
    }
}
