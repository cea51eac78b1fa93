//! What the alignment says of itself as a file, one row for each status; a field that is not known is
//! empty.

use insd_base::units::DEG;
use insd_base::{AlignmentStatus, Forecast};
use serde::{Deserialize, Serialize};

/// One status. The field names are the columns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AlignmentRow {
    /// Instant, s.
    pub t_s: f64,
    /// `levelling`, `searching`, `fine`, `in_motion`, `aligned`.
    pub phase: String,
    /// Whether the ship is taken as moored.
    pub moored: bool,
    /// 1-sigma of roll, deg.
    pub std_roll_deg: Option<f64>,
    /// 1-sigma of pitch, deg.
    pub std_pitch_deg: Option<f64>,
    /// 1-sigma of heading, deg.
    pub std_heading_deg: Option<f64>,
    /// Heading sigma that is asked for, deg.
    pub target_deg: Option<f64>,
    /// Heading sigma that the gyros' bias leaves to a gyrocompass, deg.
    pub gyrocompass_deg: Option<f64>,
    /// `reached`, `expected`, `unreachable`, `unknown`.
    pub forecast: String,
    /// When it was or will be reached, s.
    pub ready_s: Option<f64>,
    /// The best that can be had where the target cannot, deg.
    pub best_deg: Option<f64>,
    /// What limits the heading, or what the forecast lacks.
    pub because: Option<String>,
    /// Zero-crossing period of the heave, s.
    pub wave_period_s: Option<f64>,
    /// Significant heave, m.
    pub significant_heave_m: Option<f64>,
    /// Significant horizontal motion in the waves, m.
    pub significant_horizontal_m: Option<f64>,
    /// 1-sigma of the displacement by waves that is assumed, m.
    pub waves_std_m: Option<f64>,
    /// The same by swaying on the moorings, m.
    pub sway_std_m: Option<f64>,
    /// Shifts of the ship's mean place so far.
    pub shifts: u32,
    /// Samples that the model of the sea looks back.
    #[serde(default)]
    pub model_order: Option<usize>,
    /// What it leaves: `white`, `coloured`, `loud`.
    #[serde(default)]
    pub residual: Option<String>,
    /// The variance of that over the claimed one.
    #[serde(default)]
    pub residual_level: Option<f64>,
    /// The same of its slow part.
    #[serde(default)]
    pub residual_slow: Option<f64>,
    /// Its largest correlation with what was left before.
    #[serde(default)]
    pub residual_correlation: Option<f64>,
    /// So long before, s.
    #[serde(default)]
    pub residual_apart_s: Option<f64>,
    /// How often the model did not hold and was begun anew.
    #[serde(default)]
    pub model_fallbacks: Option<u32>,
}

impl From<&AlignmentStatus> for AlignmentRow {
    fn from(status: &AlignmentStatus) -> Self {
        let (sigma, sea) = (status.sigma, status.sea);
        let seen = status.fit.and_then(|fit| fit.seen);
        let (best, because) = match status.ready {
            Forecast::Reached { .. } => (None, None),
            Forecast::Expected { limiting, .. } => (None, Some(limiting.as_str())),
            Forecast::Unreachable { best, limiting } => (Some(best), Some(limiting.as_str())),
            Forecast::Unknown { lacks } => (None, Some(lacks.as_str())),
        };
        AlignmentRow {
            t_s: status.time.as_seconds(),
            phase: status.phase.as_str().to_owned(),
            moored: status.moored,
            std_roll_deg: sigma.map(|sigma| sigma.roll / DEG),
            std_pitch_deg: sigma.map(|sigma| sigma.pitch / DEG),
            std_heading_deg: sigma.map(|sigma| sigma.heading / DEG),
            target_deg: status.target.map(|target| target / DEG),
            gyrocompass_deg: status.gyrocompass.map(|sigma| sigma / DEG),
            forecast: status.ready.as_str().to_owned(),
            ready_s: status.ready.ready_at().map(insd_base::Time::as_seconds),
            best_deg: best.map(|best| best / DEG),
            because: because.map(str::to_owned),
            wave_period_s: sea.and_then(|sea| sea.period),
            significant_heave_m: sea.map(|sea| sea.significant_heave),
            significant_horizontal_m: sea.map(|sea| sea.significant_horizontal),
            waves_std_m: sea.and_then(|sea| sea.waves_std),
            sway_std_m: sea.and_then(|sea| sea.sway_std),
            shifts: status.shifts,
            model_order: status.fit.map(|fit| fit.order),
            residual: seen.map(|seen| seen.verdict.as_str().to_owned()),
            residual_level: seen.map(|seen| seen.level),
            residual_slow: seen.map(|seen| seen.slow),
            residual_correlation: seen.map(|seen| seen.correlation),
            residual_apart_s: seen.map(|seen| seen.apart),
            model_fallbacks: status.fit.map(|fit| fit.fallbacks),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::{RowWriter, read_rows};
    use insd_base::{AlignmentPhase, Lack, Limiting, Time};

    #[test]
    fn what_is_written_reads_back_and_what_is_unknown_stays_empty() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("alignment.csv");
        let mut status = AlignmentStatus {
            time: Time::from_seconds(1.5),
            phase: AlignmentPhase::Levelling,
            moored: true,
            sigma: None,
            target: None,
            gyrocompass: None,
            ready: Forecast::Unknown { lacks: Lack::Time },
            sea: None,
            fit: None,
            shifts: 2,
        };
        let first = AlignmentRow::from(&status);
        assert_eq!((first.because.as_deref(), first.best_deg), (Some("time"), None));
        status.ready = Forecast::Unreachable { best: 2.0 * DEG, limiting: Limiting::GyroBias };
        let second = AlignmentRow::from(&status);
        assert!((second.best_deg.unwrap() - 2.0).abs() < 1e-12);
        let mut writer = RowWriter::new(std::fs::File::create(&path).unwrap());
        writer.write(&first).unwrap();
        writer.write(&second).unwrap();
        writer.finish().unwrap();
        assert_eq!(read_rows::<AlignmentRow>(&path).unwrap(), [first, second]);
    }
}
