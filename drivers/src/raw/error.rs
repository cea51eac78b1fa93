//! Why something could not be recorded.

use std::io;
use std::path::{Path, PathBuf};

use super::block::LONGEST_PAYLOAD;

/// Why something could not be recorded.
#[derive(Debug, thiserror::Error)]
pub enum RawWriteError {
    /// No space is left on the disk, or none of the quota that the system grants.
    #[error("{}: the disk is full", .file.display())]
    Full {
        /// The file or folder.
        file: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The disk, or the folder for this user, is read-only.
    #[error("{}: not writable: {source}", .file.display())]
    ReadOnly {
        /// The file or folder.
        file: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Another failure of the disk.
    #[error("{}: cannot be written: {source}", .file.display())]
    Disk {
        /// The file or folder.
        file: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The folder was there and is not any more: deleted, or its disk was taken out. It is not made
    /// anew, as what is written would go to another disk.
    #[error("{}: the folder is gone", .folder.display())]
    Gone {
        /// The folder.
        folder: PathBuf,
    },
    /// An arrival with more bytes than a block may have.
    #[error("an arrival of {bytes} bytes is not recorded, the limit is {LONGEST_PAYLOAD}")]
    TooLong {
        /// Its bytes.
        bytes: usize,
    },
    /// A series cannot have this name.
    #[error("{0:?} is no name of a recording: letters, digits, '-', '_' and '.' are allowed")]
    Name(String),
    /// Configuration and program version have more bytes than a header may have.
    #[error("the configuration is too long for a recording: {bytes} bytes, the limit is 1 MiB")]
    Header {
        /// Bytes of the two.
        bytes: usize,
    },
}

impl RawWriteError {
    /// Sorts a failure of the disk.
    pub(crate) fn disk(file: &Path, source: io::Error) -> Self {
        let file = file.to_owned();
        match source.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                RawWriteError::Full { file, source }
            }
            io::ErrorKind::ReadOnlyFilesystem | io::ErrorKind::PermissionDenied => {
                RawWriteError::ReadOnly { file, source }
            }
            _ => RawWriteError::Disk { file, source },
        }
    }
}
