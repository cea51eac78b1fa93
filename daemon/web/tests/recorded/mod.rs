//! A recording of which a script makes the reports, for pages of tests.

use std::fs;
use std::path::Path;

/// The program that makes them: it does what the script beside the recording says.
pub(crate) const REPORTER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/recorded/reporter");

/// Lays a recording into a folder, and the script: `$4` the language, `$6` the run, `$8` where to, `${10}` of what.
pub(crate) fn record(folder: &Path, script: &str) {
    fs::write(folder.join("insd-000001.insdraw"), "recorded").unwrap();
    fs::write(folder.join("reporter.sh"), script).unwrap();
}
