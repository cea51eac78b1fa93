//! Going alongside: how bow, stern and manifold stand to the quay of a berth, how sure that is, and when she touches.
//!
//! A berth is a line of two points with fenders before it ([`Quay`]); the ship a [`Hull`] in body axes. [`BerthDesk`] keeps which berth
//! is told of, and makes of each [`Motion`](insd_base::Motion) a [`Docking`]. Nothing of the navigation depends on it.
//! `docs/berthing.md` has what it means to a mariner.

mod approach;
mod config;
mod desk;
mod hull;
mod quay;
#[cfg(test)]
mod tests;
mod types;

pub use config::{DockingConfig, DockingLimits};
pub use desk::BerthDesk;
pub use hull::Hull;
pub use quay::{Fender, Quay, WaterSide};
pub use types::{
    BerthChoice, Contact, Docking, DockingDoubt, DockingPoint, DockingSide, DockingState, HullPart,
    NotDocking,
};
