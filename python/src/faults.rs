//! Faults of the house as exceptions of `insd.errors`.

use std::path::PathBuf;

use insd_drivers::recording::RecordingError;
use insd_lab::blame::is_bad_input;
use pyo3::prelude::*;

/// A fault of the house as an exception; its words name file, line and column, `file` and `line` are attributes.
pub(crate) fn exception(py: Python<'_>, fault: &anyhow::Error) -> PyErr {
    match raised(py, fault) {
        Ok(raised) => PyErr::from_value(raised),
        Err(other) => other,
    }
}

fn raised<'py>(py: Python<'py>, fault: &anyhow::Error) -> PyResult<Bound<'py, PyAny>> {
    let errors = py.import("insd.errors")?;
    let words = format!("{fault:#}");
    if !is_bad_input(fault) {
        return errors.getattr("Error")?.call1((words,));
    }
    let place = fault.chain().find_map(|cause| cause.downcast_ref::<RecordingError>());
    let place = place.map(RecordingError::place);
    let file: Option<PathBuf> = place.map(|(file, _)| file.to_owned());
    let line = place.and_then(|(_, line)| line);
    errors.getattr("InputError")?.call1((words, file, line))
}

/// Does something of the house while the interpreter is free.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> anyhow::Result<T> + Send,
) -> PyResult<T> {
    py.detach(work).map_err(|fault| exception(py, &fault))
}
