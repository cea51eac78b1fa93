//! Voyages as directories of CSV files: the exchange format for recordings and simulations.
//!
//! [`VoyageReader`] streams the sensor messages of a directory in order of receipt and in constant
//! memory; [`write_voyage`] makes such a directory, [`write_raw`] adds raw GNSS, [`write_camera`] a camera; [`NavWriter`] writes the answer of a replay,
//! `nav.csv`. Files may be compressed (`NAME.csv.zst`).
//!
//! No input makes this module panic. Faults come in two kinds:
//!
//! - **structural**: a file that is missing or empty, a header without a required column, a line
//!   beyond [`MAX_LINE`], a truncated compressed stream. They end the reading with a
//!   [`RecordingError`].
//! - **of one row**: a field that is not a finite number, a missing field, a latitude of 91 deg.
//!   The row is skipped and counted with its reason; the first few are kept with file, line and
//!   column ([`FileReport`]). When more than 100 rows and more than 10 % of a file are faulty, that
//!   is an error too. So is a row of `nav.csv` that says of its integrity what the format does not know.

mod ahead;
mod camera;
mod camera_files;
mod error;
mod fields;
mod header;
mod header_text;
mod input;
mod lines;
mod nav;
mod nav_row;
mod nav_satellites;
mod nav_telling;
mod number;
mod odometry;
mod raw_files;
mod reader;
mod report;
mod rows;
mod stream;
mod table;
mod temperature;
mod writer;

pub use camera::{FEATURES_HEAD, ImageReader, feature_rows};
pub use camera_files::{CameraFiles, write_camera};
pub use error::RecordingError;
pub use header::read_header;
pub use lines::MAX_LINE;
pub use nav::{NavWriter, read_nav, read_nav_rows};
pub use nav_row::NavRow;
pub use nav_telling::NavTelling;
pub use odometry::StepReader;
pub use raw_files::{RawFiles, RawTexts, read_raw, read_raw_base, write_raw};
pub use reader::{Rows, VoyageReader, read_truth, read_truth_rows};
pub use report::{BadRow, FileReport, RowFault};
pub use temperature::TemperatureReader;
pub use writer::{Compression, write_voyage};
