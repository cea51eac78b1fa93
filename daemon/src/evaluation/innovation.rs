//! Innovations of the filter as a file: `t_s,aid,component,innovation,sigma,accepted`.

use std::io::{self, Write};
use std::path::Path;

use anyhow::Context;
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

/// Writes innovations.
#[derive(Debug)]
pub struct InnovationWriter<W: Write> {
    target: csv::Writer<W>,
}

impl<W: Write> InnovationWriter<W> {
    /// A writer that begins with the header line.
    pub fn new(target: W) -> Self {
        InnovationWriter { target: csv::Writer::from_writer(target) }
    }

    /// Appends a row.
    ///
    /// # Errors
    /// The target cannot be written.
    pub fn write(&mut self, row: &InnovationRow) -> io::Result<()> {
        self.target.serialize(row).map_err(io::Error::other)
    }

    /// Flushes and gives the target back.
    ///
    /// # Errors
    /// The target cannot be written.
    pub fn finish(self) -> io::Result<W> {
        self.target.into_inner().map_err(csv::IntoInnerError::into_error)
    }
}

/// Reads what [`InnovationWriter`] wrote.
///
/// # Errors
/// The file is missing or a row is not as written, with its line.
pub fn read_innovations(path: &Path) -> anyhow::Result<Vec<InnovationRow>> {
    let file = || path.display().to_string();
    let mut reader = csv::Reader::from_path(path).with_context(file)?;
    reader.deserialize().collect::<Result<_, _>>().with_context(file)
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let mut writer = InnovationWriter::new(std::fs::File::create(&path).unwrap());
        writer.write(&row).unwrap();
        writer.finish().unwrap();
        assert_eq!(read_innovations(&path).unwrap(), [row]);
        assert!(read_innovations(&dir.path().join("none.csv")).is_err());
    }
}
