//! What can go wrong when images are fetched.

use std::io;

/// Why a source of images cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CaptureFault {
    /// A file cannot be read or written.
    #[error("{place}: {fault}")]
    Io {
        /// The file or device.
        place: String,
        /// What the system says.
        fault: io::Error,
    },
    /// A file is not what it should be.
    #[error("{place}:{line}: {reason}")]
    Line {
        /// The file.
        place: String,
        /// Of the text, from one.
        line: usize,
        /// In words.
        reason: String,
    },
    /// A picture that cannot be read.
    #[error("{place}: {reason}")]
    Picture {
        /// The file.
        place: String,
        /// In words.
        reason: String,
    },
    /// A device or child process that does not do what is asked.
    #[error("{place}: {reason}")]
    Source {
        /// The device or command.
        place: String,
        /// In words.
        reason: String,
    },
}

impl CaptureFault {
    pub(crate) fn io(place: &impl ToString, fault: io::Error) -> Self {
        CaptureFault::Io { place: place.to_string(), fault }
    }

    pub(crate) fn picture(place: &impl ToString, reason: &impl ToString) -> Self {
        CaptureFault::Picture { place: place.to_string(), reason: reason.to_string() }
    }
}
