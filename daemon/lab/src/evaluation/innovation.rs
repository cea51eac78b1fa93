//! Innovations of the filter as a file: `t_s,aid,component,innovation,sigma,accepted`.

use insd_base::{AidInnovation, SatelliteInnovation};
use serde::{Deserialize, Serialize};

/// One component of one innovation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InnovationRow {
    /// Time of validity of the measurement, s.
    pub t_s: f64,
    /// Which aid: `gnss_position`, `log_bottom`, ...
    pub aid: String,
    /// Component of the measurement, from 0, or the satellite (`G07`).
    pub component: String,
    /// Measured minus predicted, in the SI unit of the aid.
    pub innovation: f64,
    /// Predicted 1-sigma of the innovation.
    pub sigma: f64,
    /// Whether the gate let it pass.
    pub accepted: bool,
}

impl InnovationRow {
    /// Whether it is of one satellite.
    #[must_use]
    pub fn is_of_satellite(&self) -> bool {
        self.component.starts_with(|first: char| first.is_ascii_alphabetic())
    }
}

impl From<&AidInnovation> for InnovationRow {
    fn from(own: &AidInnovation) -> Self {
        InnovationRow {
            t_s: own.time.as_seconds(),
            aid: own.aid.to_owned(),
            component: own.component.to_string(),
            innovation: own.innovation,
            sigma: own.sigma,
            accepted: own.accepted,
        }
    }
}

impl From<&SatelliteInnovation> for InnovationRow {
    fn from(own: &SatelliteInnovation) -> Self {
        InnovationRow {
            t_s: own.time.as_seconds(),
            aid: own.aid.to_owned(),
            component: own.satellite.to_string(),
            innovation: own.innovation,
            sigma: own.sigma,
            accepted: own.accepted,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluation::{RowWriter, read_rows};

    #[test]
    fn what_is_written_reads_back() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("innovations.csv");
        let row = InnovationRow {
            t_s: 1.25,
            aid: "gnss_position".to_owned(),
            component: "2".to_owned(),
            innovation: -0.5,
            sigma: 0.4,
            accepted: true,
        };
        let of_satellite = InnovationRow {
            aid: "satellite_code".to_owned(),
            component: "G07".to_owned(),
            accepted: false,
            ..row.clone()
        };
        let mut writer = RowWriter::new(std::fs::File::create(&path).unwrap());
        writer.write(&row).unwrap();
        writer.write(&of_satellite).unwrap();
        writer.finish().unwrap();
        assert!(!row.is_of_satellite() && of_satellite.is_of_satellite());
        assert_eq!(read_rows::<InnovationRow>(&path).unwrap(), [row, of_satellite]);
        assert!(read_rows::<InnovationRow>(&dir.path().join("none.csv")).is_err());
    }
}
