//! A camera that sees points at rest: a multi-state constraint filter (Mourikis and Roumeliotis, A Multi-State Constraint Kalman Filter for
//! Vision-aided Inertial Navigation, ICRA 2007).
//!
//! Poses at times of images are cloned into the state. A point that was seen from several of them ties these together: it is triangulated, what
//! the measurements say of where it is is projected out, and what is left is an innovation of the poses alone. A few points that stay in
//! sight for long are states themselves (landmarks), which hold a hovering ship where she is.
//!
//! Or another's visual odometry has made steps of the images, from pose to pose ([`step`]).
//!
//! Nothing here knows a filter; [`crate::filter`] puts it together.

pub mod sight;
pub mod step;
pub mod track;
pub mod triangulation;
pub mod window;
