//! The laboratory of insd for Python: voyages made, replayed, scored and read, as arrays with names and units.
//!
//! It is a thin face of `insd_lab`, whose functions the commands use as well. The package is `../insd`, its words for people stand
//! in `../insd/_insd.pyi`. Whatever takes long gives the interpreter free while it works.

mod columns;
mod faults;
mod messages;
mod record;
mod score;
mod solve;
mod table;
mod voyage;
mod words;

use pyo3::pymodule;

/// The compiled part of the package.
#[pymodule(gil_used = false)]
mod _insd {
    #[pymodule_export]
    use crate::record::{Recording, read_recording};
    #[pymodule_export]
    use crate::score::{campaign, evaluate, integrity};
    #[pymodule_export]
    use crate::solve::{read_nav, replay};
    #[pymodule_export]
    use crate::table::Table;
    #[pymodule_export]
    use crate::voyage::{Voyage, convert, read_truth, read_voyage, scenarios, simulate};
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
