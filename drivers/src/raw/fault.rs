//! What can be wrong with a recording.

use std::io;
use std::path::PathBuf;

use super::header::VERSION;

/// What is wrong with a recording. Reading goes on behind it.
#[derive(Debug, thiserror::Error)]
pub enum RawFault {
    /// The system refuses to give the file, or more of it.
    #[error("{}: cannot be read beyond byte {offset}: {source}", .file.display())]
    Unreadable {
        /// The file or folder.
        file: PathBuf,
        /// Bytes that could be read.
        offset: u64,
        /// What the system said.
        source: io::Error,
    },
    /// A folder without a recording.
    #[error("{}: no recording in this folder", .folder.display())]
    NoFiles {
        /// The folder.
        folder: PathBuf,
    },
    /// A folder with recordings of several names. Name one of its files to read that one alone.
    #[error("{}: several recordings in one folder: {}", .folder.display(), .names.join(", "))]
    SeveralSeries {
        /// The folder.
        folder: PathBuf,
        /// The names.
        names: Vec<String>,
    },
    /// A file without a byte: the power failed when it was new.
    #[error("{}: empty", .file.display())]
    Empty {
        /// The file.
        file: PathBuf,
    },
    /// Another kind of file.
    #[error("{}: not a raw recording", .file.display())]
    Foreign {
        /// The file.
        file: PathBuf,
    },
    /// A recording by a later version of the program.
    #[error("{}: format version {version}; this program reads up to {VERSION}", .file.display())]
    Newer {
        /// The file.
        file: PathBuf,
        /// The version of its format.
        version: u16,
    },
    /// The header is damaged or cut short. The blocks behind it are read.
    #[error("{}: the header is damaged; the configuration is not known", .file.display())]
    Header {
        /// The file.
        file: PathBuf,
    },
    /// The file ends within a block: the power failed while it was written.
    #[error("{}: ends within the block at byte {offset}, {bytes} bytes are of no use", .file.display())]
    CutShort {
        /// The file.
        file: PathBuf,
        /// Where the block begins.
        offset: u64,
        /// Bytes from there to the end.
        bytes: u64,
    },
    /// Bytes that are not a good block. They are skipped.
    #[error("{}: {bytes} damaged bytes at byte {offset}", .file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// Where they begin.
        offset: u64,
        /// How many.
        bytes: u64,
    },
    /// Records that were written and are not there: in damaged blocks or missing files. Told by the
    /// first good block behind them.
    #[error("{}: {records} records are missing before byte {offset}", .file.display())]
    Missing {
        /// The file of the good block.
        file: PathBuf,
        /// Where that begins.
        offset: u64,
        /// How many.
        records: u64,
    },
    /// Files of the series that are not there.
    #[error("{}: files {from} to {to} of the series are missing before it", .file.display())]
    FilesMissing {
        /// The file behind the gap.
        file: PathBuf,
        /// Number of the first that is missing.
        from: u32,
        /// Number of the last.
        to: u32,
    },
    /// The program started anew here: its monotonic clock began again.
    #[error("{}: the program started anew", .file.display())]
    NewRun {
        /// The first file of the new run.
        file: PathBuf,
    },
    /// Arrivals that were not recorded: the disk was full or too slow.
    #[error("{}: {arrivals} arrivals were not recorded here", .file.display())]
    NotRecorded {
        /// The file.
        file: PathBuf,
        /// How many.
        arrivals: u64,
    },
}
