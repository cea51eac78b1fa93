//! The fault of who gave the input.

/// The input is to blame, not the machine: the program ends with exit status 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct BadInput(pub String);
