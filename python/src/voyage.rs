//! Voyages: directories, and what lies in them.

use std::path::{Path, PathBuf};

use insd_base::StartCondition;
use insd_drivers::recording::{Compression, VoyageReader, read_header, read_truth_rows};
use insd_lab::commands::convert::{self as conversion, ConvertArgs};
use insd_lab::commands::options;
use insd_lab::commands::simulate::write;
use insd_lab::scenario;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tempfile::TempDir;

use crate::columns::of_truth;
use crate::faults::{detached, exception};
use crate::messages::Messages;
use crate::table::{Origin, Table};
use crate::words::{Words, overrides};

/// A voyage directory.
#[pyclass(frozen, module = "insd")]
pub(crate) struct Voyage {
    directory: PathBuf,
    /// Where nobody named a directory: it goes with the object.
    _temporary: Option<TempDir>,
    /// UTC of `t_s = 0`, RFC 3339.
    #[pyo3(get)]
    start_utc: String,
    /// Whether the ship lies at her berth at the start.
    #[pyo3(get)]
    is_moored: bool,
    /// Samples of the IMU per second, Hz, as its data sheet says.
    #[pyo3(get)]
    imu_rate_hz: f64,
}

impl Voyage {
    /// Where it lies.
    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }

    fn open(directory: PathBuf, temporary: Option<TempDir>) -> anyhow::Result<Self> {
        let header = read_header(&directory)?;
        Ok(Voyage {
            directory,
            _temporary: temporary,
            start_utc: header.start_utc,
            is_moored: header.start == StartCondition::Moored,
            imu_rate_hz: header.imu.rate,
        })
    }

    fn messages(&self) -> anyhow::Result<Messages> {
        let mut messages = Messages::default();
        for received in VoyageReader::open(&self.directory)? {
            messages.take(&received?);
        }
        Ok(messages)
    }
}

#[pymethods]
impl Voyage {
    /// Its directory.
    #[getter]
    fn path(&self) -> PathBuf {
        self.directory.clone()
    }

    /// What the sensors measured: a table for each that was there.
    fn sensors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let tables = detached(py, || Ok(self.messages()?.tables()))?;
        let all = PyDict::new(py);
        for (kind, columns) in tables {
            all.set_item(kind, Py::new(py, Table::new(columns, Origin::Messages))?)?;
        }
        Ok(all)
    }

    /// Where she was; an error where nobody knows.
    fn truth(&self, py: Python<'_>) -> PyResult<Table> {
        truth_of(py, &self.directory.join("truth.csv"))
    }

    fn __repr__(&self) -> String {
        format!("<insd.Voyage in {}>", self.directory.display())
    }
}

/// A scenario by its file, its text, its name or its number.
#[derive(FromPyObject)]
pub(crate) enum Chosen {
    /// The number of a shipped one.
    Number(u32),
    /// Name, file or text.
    Word(String),
    /// A file.
    Path(PathBuf),
}

impl Chosen {
    /// As it is written on a command line.
    pub(crate) fn word(&self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Word(word) => word.clone(),
            Self::Path(path) => path.display().to_string(),
        }
    }
}

/// A voyage of a scenario.
#[pyfunction]
#[pyo3(signature = (scenario, seed=1, *, sets=None, out=None, compress=false))]
#[allow(clippy::needless_pass_by_value)] // arguments of Python
pub(crate) fn simulate(
    py: Python<'_>,
    scenario: Chosen,
    seed: u64,
    sets: Option<Bound<'_, PyDict>>,
    out: Option<PathBuf>,
    compress: bool,
) -> PyResult<Voyage> {
    let sets = overrides(sets.as_ref())?;
    let word = scenario.word();
    detached(py, || {
        let named = match word.contains('\n') {
            true => scenario::of_text("scenario", &word, &sets)?,
            false => scenario::find(&word, &sets)?,
        };
        let (directory, temporary) = chosen(out)?;
        let compression = if compress { Compression::Zstd } else { Compression::None };
        write(&named, seed, &directory, compression)?;
        Voyage::open(directory, temporary)
    })
}

/// A voyage that is there already.
#[pyfunction]
pub(crate) fn read_voyage(py: Python<'_>, path: PathBuf) -> PyResult<Voyage> {
    Voyage::open(path, None).map_err(|fault| exception(py, &fault))
}

/// A raw recording as a voyage.
#[pyfunction]
#[pyo3(signature = (recording, out=None, *, config=None, run=1))]
#[allow(clippy::needless_pass_by_value)] // arguments of Python
pub(crate) fn convert(
    py: Python<'_>,
    recording: PathBuf,
    out: Option<PathBuf>,
    config: Option<PathBuf>,
    run: u32,
) -> PyResult<Voyage> {
    let words = |directory: &PathBuf| {
        let mut words = Words::default();
        words.path("out", Some(directory));
        words.path("config", config.as_ref());
        words.option("run", Some(run));
        words.push("--");
        words.push(&recording.to_string_lossy());
        words.into_inner()
    };
    detached(py, || {
        let (directory, temporary) = chosen(out)?;
        conversion::write(&options::<ConvertArgs>(&words(&directory))?)?;
        Voyage::open(directory, temporary)
    })
}

/// The directory that was named, or a temporary one.
fn chosen(out: Option<PathBuf>) -> anyhow::Result<(PathBuf, Option<TempDir>)> {
    match out {
        Some(directory) => Ok((directory, None)),
        None => {
            let temporary = TempDir::new()?;
            Ok((temporary.path().to_owned(), Some(temporary)))
        }
    }
}

/// Where a ship was, out of a file `truth.csv`, plain or compressed.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // an argument of Python
pub(crate) fn read_truth(py: Python<'_>, path: PathBuf) -> PyResult<Table> {
    truth_of(py, &path)
}

fn truth_of(py: Python<'_>, path: &Path) -> PyResult<Table> {
    detached(py, || {
        let rows = read_truth_rows(path)?;
        Ok(Table::new(of_truth(&rows.rows), Origin::Truth(rows)))
    })
}

/// The shipped scenarios, a line for each: number, name and what it is for.
#[pyfunction]
pub(crate) fn scenarios() -> String {
    scenario::list()
}
