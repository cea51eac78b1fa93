//! Solutions: of a replay, and out of `nav.csv`.

use std::path::PathBuf;

use insd_drivers::recording::{NavRow, Rows, read_nav_rows};
use insd_lab::commands::options;
use insd_lab::commands::replay::{ReplayOptions, rows};
use pyo3::prelude::*;

use crate::columns::of_nav;
use crate::faults::detached;
use crate::table::{Origin, Table};
use crate::voyage::Voyage;
use crate::words::{Stretch, Words};

/// A voyage, or the path of one or of a recording.
#[derive(FromPyObject)]
pub(crate) enum Sailed {
    /// A voyage.
    Voyage(Py<Voyage>),
    /// A path.
    Path(PathBuf),
}

impl Sailed {
    /// Where it lies.
    pub(crate) fn path(&self) -> PathBuf {
        match self {
            Self::Voyage(voyage) => voyage.get().directory().to_owned(),
            Self::Path(path) => path.clone(),
        }
    }
}

/// A recorded voyage through the same engine as the daemon.
#[pyfunction]
#[pyo3(signature = (voyage, *, rate=None, outages=Vec::new(), without=Vec::new(), gnss=None, camera=None,
    masks=Vec::new(), config=None, run=None, alignment=None, in_motion=None, stored_state=None, log_model=None))]
#[allow(clippy::too_many_arguments, clippy::needless_pass_by_value)] // they are those of the command
pub(crate) fn replay(
    py: Python<'_>,
    voyage: Sailed,
    rate: Option<f64>,
    outages: Vec<Stretch>,
    without: Vec<String>,
    gnss: Option<String>,
    camera: Option<String>,
    masks: Vec<String>,
    config: Option<PathBuf>,
    run: Option<u32>,
    alignment: Option<String>,
    in_motion: Option<String>,
    stored_state: Option<PathBuf>,
    log_model: Option<PathBuf>,
) -> PyResult<Table> {
    let mut words = Words::default();
    words.option("rate", rate);
    words.repeated("outage", outages);
    words.repeated("without", without);
    words.option("gnss", gnss);
    words.option("camera", camera);
    words.repeated("mask", masks);
    words.path("config", config.as_ref());
    words.option("run", run);
    words.option("alignment", alignment);
    words.option("in-motion", in_motion);
    words.path("stored-state", stored_state.as_ref());
    words.path("log-model", log_model.as_ref());
    words.push("--");
    words.push(&voyage.path().to_string_lossy());
    let words = words.into_inner();
    detached(py, || {
        let replayed = rows(&options::<ReplayOptions>(&words)?)?;
        Ok(solution(replayed.rows).summarized(replayed.summary))
    })
}

/// A solution out of a file `nav.csv`, plain or compressed.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // an argument of Python
pub(crate) fn read_nav(py: Python<'_>, path: PathBuf) -> PyResult<Table> {
    detached(py, || Ok(solution(read_nav_rows(&path)?)))
}

fn solution(rows: Rows<NavRow>) -> Table {
    Table::new(of_nav(&rows.rows), Origin::Nav(rows))
}
