//! The daemon as a service, run as it is installed: what becomes of it when things go wrong. Sensors are
//! simulated and speak over UDP in real time.
//!
//! The program must have been built before: `cargo test --workspace` does so.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod browser;
mod daemon;
#[path = "../../../daemon/web/tests/browser/driver.rs"]
#[allow(dead_code)] // the page's own tests need more of it
mod driver;
mod guards;
mod heard;
mod kill;
mod manners;
mod page;
mod saving;
#[path = "../../../daemon/web/tests/scene/mod.rs"]
mod scene;
mod screen;
mod ship;
mod watched;
