//! What is wrong with a calibration.

/// What is wrong with a file, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}:{line}: {field}: {reason}")]
pub struct CalibrationFault {
    /// The file.
    pub place: String,
    /// From one.
    pub line: usize,
    /// The key, as the file calls it.
    pub field: String,
    /// In words.
    pub reason: String,
}

/// The same before the file is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Reason {
    line: usize,
    field: String,
    text: String,
}

impl Reason {
    pub(crate) fn new(line: usize, field: &str, text: &str) -> Self {
        Reason { line, field: field.to_owned(), text: text.to_owned() }
    }

    pub(crate) fn at(self, place: &str) -> CalibrationFault {
        CalibrationFault {
            place: place.to_owned(),
            line: self.line,
            field: self.field,
            reason: self.text,
        }
    }
}
