//! What Python asks for, as the words of a command line: so that both understand the same.

use std::path::PathBuf;

use insd_simulator::Override;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

/// Words of a command line.
#[derive(Debug, Default)]
pub(crate) struct Words(Vec<String>);

impl Words {
    /// The words, in their order.
    pub(crate) fn into_inner(self) -> Vec<String> {
        self.0
    }

    /// What stands without a name.
    pub(crate) fn push(&mut self, word: &str) {
        self.0.push(word.to_owned());
    }

    /// An option with its value, if one is given. In one word, as a value may begin with a dash.
    pub(crate) fn option<T: ToString>(&mut self, name: &str, value: Option<T>) {
        self.0.extend(value.map(|value| format!("--{name}={}", value.to_string())));
    }

    /// The same with a path.
    pub(crate) fn path(&mut self, name: &str, path: Option<&PathBuf>) {
        self.option(name, path.map(|path| path.display()));
    }

    /// An option as often as there are values.
    pub(crate) fn repeated<T: ToString>(&mut self, name: &str, values: Vec<T>) {
        values.into_iter().for_each(|value| self.option(name, Some(value)));
    }
}

/// A stretch of time without a sensor, or with few satellites: `"gnss:600..900"` or `("gnss", 600, 900)`.
#[derive(FromPyObject)]
pub(crate) enum Stretch {
    /// As on the command line.
    Word(String),
    /// Sensor, from, to, s.
    Sensor(String, f64, f64),
}

impl std::fmt::Display for Stretch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Word(word) => f.write_str(word),
            Self::Sensor(sensor, from, to) => write!(f, "{sensor}:{from}..{to}"),
        }
    }
}

/// The keys of a scenario that are set to another value.
pub(crate) fn overrides(sets: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<Override>> {
    let one = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let key: String = key.extract()?;
        let value = match value.cast::<PyBool>() {
            Ok(value) => value.is_true().to_string(),
            Err(_) => value.str()?.to_string(),
        };
        format!("{key}={value}").parse::<Override>().map_err(PyTypeError::new_err)
    };
    sets.map_or(Ok(Vec::new()), |sets| sets.iter().map(one).collect())
}
