//! Innovations of the filter as a file: `t_s,aid,component,innovation,sigma,accepted`.

use serde::{Deserialize, Serialize};

/// One component of one innovation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InnovationRow {
    /// Time of validity of the measurement, s.
    pub t_s: f64,
    /// Which aid: `gnss_position`, `log_bottom`, ...
    pub aid: String,
    /// Component of the measurement, from 0.
    pub component: u8,
    /// Measured minus predicted, in the SI unit of the aid.
    pub innovation: f64,
    /// Predicted 1-sigma of the innovation.
    pub sigma: f64,
    /// Whether the gate let it pass.
    pub accepted: bool,
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
            component: 2,
            innovation: -0.5,
            sigma: 0.4,
            accepted: true,
        };
        let mut writer = RowWriter::new(std::fs::File::create(&path).unwrap());
        writer.write(&row).unwrap();
        writer.finish().unwrap();
        assert_eq!(read_rows::<InnovationRow>(&path).unwrap(), [row]);
        assert!(read_rows::<InnovationRow>(&dir.path().join("none.csv")).is_err());
    }
}
