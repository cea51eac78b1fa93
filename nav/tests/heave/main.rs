//! Heave against the truth: in seas that are sums of waves, and on simulated voyages.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod campaign;
mod disturbances;
mod figures;
mod sea;
mod trial;
mod voyage;
