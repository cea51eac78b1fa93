//! Raw recordings: what the sensors said, decoded.

use std::path::PathBuf;

use insd_base::Time;
use insd_lab::raw_run::RawRun;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::faults::detached;
use crate::messages::Messages;
use crate::table::{Origin, Table};

/// The messages of one run of the daemon.
#[pyclass(frozen, module = "insd")]
pub(crate) struct Recording {
    /// Name and version of the program that wrote it.
    #[pyo3(get)]
    program: Option<String>,
    /// The configuration with which it ran, TOML.
    #[pyo3(get)]
    config: Option<String>,
    /// UTC of `t_s = 0` in seconds since 1970, as far as it was known at the end.
    #[pyo3(get)]
    start_utc_s: Option<f64>,
    messages: Messages,
}

#[pymethods]
impl Recording {
    /// What the sensors measured: a table for each kind that was heard.
    fn sensors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (kind, columns) in py.detach(|| self.messages.tables()) {
            all.set_item(kind, Py::new(py, Table::new(columns, Origin::Messages))?)?;
        }
        Ok(all)
    }

    /// How many messages there were of kinds that have no table.
    #[getter]
    fn others<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        self.messages.others().iter().try_for_each(|(kind, count)| all.set_item(kind, count))?;
        Ok(all)
    }
}

/// Decodes a raw recording: one of its files, or its folder.
#[pyfunction]
#[pyo3(signature = (path, *, config=None, run=1))]
#[allow(clippy::needless_pass_by_value)] // arguments of Python
pub(crate) fn read_recording(
    py: Python<'_>,
    path: PathBuf,
    config: Option<PathBuf>,
    run: u32,
) -> PyResult<Recording> {
    detached(py, || {
        let mut raw = RawRun::open(&path, config.as_deref(), run)?;
        let mut messages = Messages::default();
        let intake = raw.hear(|_, _| {}, |received| messages.take(&received))?;
        let start = intake.utc_at(Time::START);
        Ok(Recording {
            program: raw.header().map(|own| own.program.clone()),
            config: raw.header().map(|own| own.config.clone()),
            start_utc_s: start.map(|utc| utc.as_nanos() as f64 * 1e-9),
            messages,
        })
    })
}
