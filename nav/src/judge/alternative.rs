//! What follows from what the judge finds, for the estimate.

use insd_base::Fault;

use crate::error_state::{Covariance, Errors};

/// Somebody is found to lie.
#[derive(Clone, Debug)]
pub struct Ruling {
    /// What he does.
    pub fault: Fault,
    /// The estimate without it, where that is another.
    pub mended: Option<Alternative>,
}

/// What the estimate may be instead.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// What the navigator's estimate lacks to it.
    pub error: Errors,
    /// The covariance of its errors.
    pub covariance: Covariance,
}
