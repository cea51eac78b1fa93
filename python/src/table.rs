//! A table: columns by name, as arrays of NumPy and as a stream of Arrow.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, Float64Array, RecordBatch, RecordBatchIterator, StringArray};
use arrow_schema::{ArrowError, Field, Schema};
use insd_base::Truth;
use insd_drivers::recording::{NavRow, Rows};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyKeyError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyCapsule, PyDict, PyList, PyString};

use crate::columns::{Column, Values};

/// The rows behind a table, where something else is made of them.
#[derive(Debug)]
pub(crate) enum Origin {
    /// A solution.
    Nav(Rows<NavRow>),
    /// Truth.
    Truth(Rows<Truth>),
    /// Messages of a sensor.
    Messages,
}

/// Columns by name.
#[pyclass(frozen, module = "insd")]
pub(crate) struct Table {
    columns: Vec<(Column, PyOnceLock<Py<PyAny>>)>,
    rows: usize,
    /// What it is a table of.
    pub(crate) origin: Origin,
    /// What a replay says of itself.
    #[pyo3(get)]
    summary: Option<String>,
}

impl Table {
    pub(crate) fn new(columns: Vec<Column>, origin: Origin) -> Self {
        let rows = columns.first().map_or(0, |column| column.values.len());
        let columns = columns.into_iter().map(|column| (column, PyOnceLock::new())).collect();
        Table { columns, rows, origin, summary: None }
    }

    /// The same with what a replay says of itself.
    pub(crate) fn summarized(self, summary: String) -> Self {
        Table { summary: Some(summary), ..self }
    }

    fn batch(&self) -> Result<RecordBatch, ArrowError> {
        let fields = self.columns.iter().map(|(column, _)| column.field());
        let arrays = self.columns.iter().map(|(column, _)| column.values.arrow());
        let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
        RecordBatch::try_new(schema, arrays.collect())
    }
}

#[pymethods]
impl Table {
    /// Names of the columns in their order.
    #[getter]
    fn columns(&self) -> Vec<&'static str> {
        self.columns.iter().map(|(column, _)| column.name).collect()
    }

    /// Unit of each column, empty where it has none.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        self.columns.iter().try_for_each(|(own, _)| units.set_item(own.name, own.unit))?;
        Ok(units)
    }

    /// Names of the columns: with `__getitem__` a table is a mapping.
    fn keys(&self) -> Vec<&'static str> {
        self.columns()
    }

    /// All columns as arrays.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        self.columns
            .iter()
            .try_for_each(|(own, array)| all.set_item(own.name, own.values.array(py, array)?))?;
        Ok(all)
    }

    fn __len__(&self) -> usize {
        self.rows
    }

    fn __contains__(&self, name: &str) -> bool {
        self.columns.iter().any(|(column, _)| column.name == name)
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyList::new(py, self.columns())?.try_iter()?.into_any())
    }

    fn __getitem__(&self, py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
        let found = self.columns.iter().find(|(column, _)| column.name == name);
        let (column, array) = found.ok_or_else(|| {
            PyKeyError::new_err(format!(
                "{name}: no such column, but {}",
                self.columns().join(", ")
            ))
        })?;
        column.values.array(py, array)
    }

    fn __repr__(&self) -> String {
        format!("<insd.Table of {} rows: {}>", self.rows, self.columns().join(", "))
    }

    /// The Arrow PyCapsule interface. What schema the reader would like better is not heeded.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        drop(requested_schema);
        let batch = self.batch().map_err(|fault| PyRuntimeError::new_err(fault.to_string()))?;
        let schema = batch.schema();
        let reader = RecordBatchIterator::new([Ok(batch)], schema);
        let stream = FFI_ArrowArrayStream::new(Box::new(reader));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }
}

impl Column {
    fn field(&self) -> Field {
        let kind = self.values.arrow_type();
        let field = Field::new(self.name, kind, true);
        field.with_metadata(HashMap::from([("unit".to_owned(), self.unit.to_owned())]))
    }
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Values::Numbers(values) => values.len(),
            Values::Words(values) => values.len(),
        }
    }

    fn arrow_type(&self) -> arrow_schema::DataType {
        match self {
            Values::Numbers(_) => arrow_schema::DataType::Float64,
            Values::Words(_) => arrow_schema::DataType::Utf8,
        }
    }

    /// What is unknown is null.
    fn arrow(&self) -> ArrayRef {
        match self {
            Values::Numbers(values) => {
                let known = values.iter().map(|value| Some(*value).filter(|own| !own.is_nan()));
                Arc::new(known.collect::<Float64Array>())
            }
            Values::Words(values) => {
                Arc::new(values.iter().map(Option::as_deref).collect::<StringArray>())
            }
        }
    }

    /// The array of a column, the same each time, which cannot be written to.
    fn array(&self, py: Python<'_>, made: &PyOnceLock<Py<PyAny>>) -> PyResult<Py<PyAny>> {
        made.get_or_try_init(py, || self.make(py)).map(|array| array.clone_ref(py))
    }

    fn make(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        match self {
            Values::Numbers(values) => {
                let array = PyArray1::from_slice(py, values);
                array.readwrite().make_nonwriteable();
                Ok(array.into_any().unbind())
            }
            Values::Words(values) => {
                let word = |own: &Option<Cow<'static, str>>| match own {
                    Some(word) => PyString::intern(py, word).into_any().unbind(),
                    None => py.None(),
                };
                let array = PyArray1::from_vec(py, values.iter().map(word).collect());
                array.readwrite().make_nonwriteable();
                Ok(array.into_any().unbind())
            }
        }
    }
}
