//! Ports that are unplugged, flooded, silent and absent: on real pseudo terminals and sockets.

// helpers of tests are not seen as tests
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod can;
#[path = "../clocks/mod.rs"]
mod clocks;
mod files;
mod host;
mod network;
mod node;
mod ntrip;
mod ntrip_tls;
mod output;
mod pace;
mod serial;
mod strangers;
