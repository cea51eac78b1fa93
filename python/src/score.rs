//! Scores: errors and claims, protection levels, many seeds.

use std::path::PathBuf;

use insd_base::{Time, Truth};
use insd_drivers::recording::{NavRow, Rows, read_nav_rows, read_truth_rows};
use insd_lab::commands::campaign::{CampaignArgs, reports};
use insd_lab::commands::evaluate::score;
use insd_lab::commands::integrity::judge;
use insd_lab::commands::options;
use insd_lab::evaluation::AlertLimit;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;

use crate::faults::detached;
use crate::table::{Origin, Table};
use crate::voyage::{Chosen, Voyage};
use crate::words::{Stretch, Words, overrides};

/// A solution or truth: a table of this package, a voyage, or the path of a file.
#[derive(FromPyObject)]
pub(crate) enum Scored {
    /// A table.
    Table(Py<Table>),
    /// A voyage, whose truth is meant.
    Voyage(Py<Voyage>),
    /// A file.
    Path(PathBuf),
}

/// Rows with a name for the report.
type Told<T> = (String, Lent<T>);

/// Rows that belong to a table, or were read.
enum Lent<T> {
    Table(Py<Table>, fn(&Table) -> Option<&Rows<T>>),
    Read(Rows<T>),
}

impl<T> Lent<T> {
    fn rows(&self) -> anyhow::Result<&Rows<T>> {
        match self {
            Self::Read(rows) => Ok(rows),
            Self::Table(table, pick) => {
                pick(table.get()).ok_or_else(|| anyhow::anyhow!("the table is of another kind"))
            }
        }
    }
}

fn nav_of(table: &Table) -> Option<&Rows<NavRow>> {
    if let Origin::Nav(rows) = &table.origin { Some(rows) } else { None }
}

fn truth_rows(table: &Table) -> Option<&Rows<Truth>> {
    if let Origin::Truth(rows) = &table.origin { Some(rows) } else { None }
}

impl Scored {
    fn nav(self, py: Python<'_>) -> PyResult<Told<NavRow>> {
        match self {
            Self::Table(table) if nav_of(table.get()).is_some() => {
                Ok(("solution".to_owned(), Lent::Table(table, nav_of)))
            }
            Self::Path(path) => {
                let rows = detached(py, || Ok(read_nav_rows(&path)?))?;
                Ok((path.display().to_string(), Lent::Read(rows)))
            }
            _ => Err(PyTypeError::new_err(
                "expected a solution: a table of insd.replay or insd.read_nav, or a path",
            )),
        }
    }

    fn truth(self, py: Python<'_>) -> PyResult<Told<Truth>> {
        match self {
            Self::Table(table) if truth_rows(table.get()).is_some() => {
                Ok(("truth".to_owned(), Lent::Table(table, truth_rows)))
            }
            Self::Table(_) => Err(PyTypeError::new_err(
                "expected truth: a voyage, a table of insd.read_truth, or a path",
            )),
            Self::Voyage(voyage) => {
                Self::Path(voyage.get().directory().join("truth.csv")).truth(py)
            }
            Self::Path(path) => {
                let rows = detached(py, || Ok(read_truth_rows(&path)?))?;
                Ok((path.display().to_string(), Lent::Read(rows)))
            }
        }
    }
}

/// Errors of a solution, and what its claims are worth.
#[pyfunction]
#[pyo3(signature = (nav, truth, *, start=None))]
pub(crate) fn evaluate(
    py: Python<'_>,
    nav: Scored,
    truth: Scored,
    start: Option<f64>,
) -> PyResult<Py<PyAny>> {
    let ((nav_name, nav), (truth_name, truth)) = (nav.nav(py)?, truth.truth(py)?);
    let text = detached(py, || {
        let from = start.map(Time::from_seconds);
        let names = [nav_name, truth_name];
        let (report, _) = score(names, nav.rows()?, truth.rows()?, from)?;
        json(&report)
    })?;
    object(py, &text)
}

/// Errors of a solution against its protection levels.
#[pyfunction]
#[pyo3(signature = (nav, truth, *, alert_limit=None, vertical_alert_limit=None, start=None))]
#[allow(clippy::needless_pass_by_value)] // arguments of Python
pub(crate) fn integrity(
    py: Python<'_>,
    nav: Scored,
    truth: Scored,
    alert_limit: Option<Bound<'_, PyAny>>,
    vertical_alert_limit: Option<Bound<'_, PyAny>>,
    start: Option<f64>,
) -> PyResult<Py<PyAny>> {
    let ((nav_name, nav), (truth_name, truth)) = (nav.nav(py)?, truth.truth(py)?);
    let horizontal = limit(alert_limit.as_ref())?.map_or_else(|| named("harbour"), Ok)?;
    let vertical = limit(vertical_alert_limit.as_ref())?.unwrap_or(horizontal);
    let text = detached(py, || {
        let from = start.map(Time::from_seconds);
        let (names, limits) = ([nav_name, truth_name], [horizontal, vertical]);
        json(&judge(names, nav.rows()?, truth.rows()?, limits, from)?)
    })?;
    object(py, &text)
}

fn limit(given: Option<&Bound<'_, PyAny>>) -> PyResult<Option<AlertLimit>> {
    given.map(|given| named(&given.str()?.to_cow()?)).transpose()
}

fn named(word: &str) -> PyResult<AlertLimit> {
    word.parse().map_err(PyValueError::new_err)
}

/// A scenario with many seeds.
#[pyfunction]
#[pyo3(signature = (scenario, seeds, *, sets=None, outages=Vec::new(), at=Vec::new(), start=None, rate=None, jobs=None))]
#[allow(clippy::too_many_arguments, clippy::needless_pass_by_value)] // they are those of the command
pub(crate) fn campaign(
    py: Python<'_>,
    scenario: Chosen,
    seeds: Bound<'_, PyAny>,
    sets: Option<Bound<'_, PyDict>>,
    outages: Vec<Stretch>,
    at: Vec<f64>,
    start: Option<f64>,
    rate: Option<f64>,
    jobs: Option<usize>,
) -> PyResult<Py<PyAny>> {
    let mut words = Words::default();
    let (from, to) = ends(&seeds)?;
    words.option("seeds", Some(format!("{from}..{to}")));
    words.repeated("set", overrides(sets.as_ref())?);
    words.repeated("outage", outages);
    words.repeated("at", at);
    words.option("from", start);
    words.option("rate", rate);
    words.option("jobs", jobs);
    words.push("--");
    words.push(&scenario.word());
    let words = words.into_inner();
    let text = detached(py, || {
        let all = reports(&options::<CampaignArgs>(&words)?)?;
        json(&all.first())
    })?;
    object(py, &text)
}

/// The ends of a range of seeds with a step of one, or of a pair.
fn ends(seeds: &Bound<'_, PyAny>) -> PyResult<(u64, u64)> {
    if let Ok(pair) = seeds.extract::<(u64, u64)>() {
        return Ok(pair);
    }
    let expected = || PyTypeError::new_err("seeds: expected range(A, B) or (A, B)");
    let ends = |name: &str| seeds.getattr(name)?.extract::<u64>();
    let (from, to, step) = (ends("start"), ends("stop"), ends("step"));
    match (from, to, step) {
        (Ok(from), Ok(to), Ok(1)) => Ok((from, to)),
        _ => Err(expected()),
    }
}

fn json(report: &impl Serialize) -> anyhow::Result<String> {
    Ok(serde_json::to_string(report)?)
}

/// What `--json` of a command prints, as an object of Python.
fn object(py: Python<'_>, text: &str) -> PyResult<Py<PyAny>> {
    Ok(py.import("json")?.call_method1("loads", (text,))?.unbind())
}
