//! The estimation kernel: linear error states that have names, and what a Kalman filter does with them.
//!
//! It knows nothing of navigation. Who uses it declares [`Block`]s of error states; they *join* a
//! [`Covariance`] and *leave* it at run time, and are cloned in it. A measurement is an [`Innovation`] of any
//! number of rows that depends on states by their names: of one that is not there nothing is known to
//! be wrong, and its column is left out. There is one update ([`Weighed::update`]), one with a gain that leaves
//! some states alone ([`Weighed::update_considering`]), one gate ([`Gate`]), and one propagation ([`Transition`]).
//!
//! Errors are true minus estimated. The estimate itself is not here: what an error means for it is known to who
//! declares the state.

/// Its example is held by the compiler.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod block;
mod checkpoint;
mod covariance;
mod covariance_of_block;
mod effects;
mod errors;
mod gate;
mod innovation;
mod jacobian;
mod key;
mod layout;
mod release;
mod smoothing;
mod sums;
mod trail;
mod transition;
mod triangle;
mod weighed;

pub use block::Block;
pub use covariance::Covariance;
pub use effects::Effects;
pub use errors::Errors;
pub use gate::Gate;
pub use innovation::Innovation;
pub use jacobian::Jacobian;
pub use key::Key;
pub use layout::{Layout, Place};
pub use release::Release;
pub use smoothing::{Hindsight, KeptCovariance};
pub use trail::{ErrorTrail, KeptTrail};
pub use transition::{Decay, Feed, Transition};
pub use weighed::Weighed;
