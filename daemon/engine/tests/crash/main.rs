//! Going on after a crash: how honest the claims are after the gap, what the trial lets pass, and that
//! bytes of any kind give a state or a reason.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod bytes;
mod gaps;
mod modes;
mod trial;
mod voyages;
