//! The node of NMEA 2000 and the whole daemon on interfaces of a real kernel, in the guest of `tests/vm`.
//!
//! Others on the bus are scripted on a socket of their own. A tap hears every frame of every test, and
//! what it heard is held against the rules of fast packets by a reader of its own ([`order`]).

// helpers of tests are not seen as tests
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod answers;
mod contest;
mod daemon;
mod guest;
mod order;
mod peer;
mod readback;
mod tap;
mod trouble;
mod unit;
