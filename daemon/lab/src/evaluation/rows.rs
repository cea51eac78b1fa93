//! Rows of a kind as a CSV file whose header line names their fields.

use std::io::{self, Write};
use std::marker::PhantomData;
use std::path::Path;

use anyhow::Context;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Writes rows.
#[derive(Debug)]
pub struct RowWriter<R, W: Write> {
    target: csv::Writer<W>,
    row: PhantomData<R>,
}

impl<R: Serialize, W: Write> RowWriter<R, W> {
    /// A writer that begins with the header line.
    pub fn new(target: W) -> Self {
        RowWriter { target: csv::Writer::from_writer(target), row: PhantomData }
    }

    /// Appends a row.
    ///
    /// # Errors
    /// The target cannot be written.
    pub fn write(&mut self, row: &R) -> io::Result<()> {
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

/// Reads what [`RowWriter`] wrote.
///
/// # Errors
/// The file is missing or a row is not as written, with its line.
pub fn read_rows<R: DeserializeOwned>(path: &Path) -> anyhow::Result<Vec<R>> {
    let file = || path.display().to_string();
    let mut reader = csv::Reader::from_path(path).with_context(file)?;
    reader.deserialize().collect::<Result<_, _>>().with_context(file)
}
