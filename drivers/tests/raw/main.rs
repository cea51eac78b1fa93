//! Raw recordings give back what was recorded, and tell what they can not.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod arrivals;
mod damage;
mod files;
mod round_trip;
