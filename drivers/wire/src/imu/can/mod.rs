//! IMUs that send plain CAN frames: one table says what stands where, and how frames make a sample.
//!
//! A [`CanLayout`] is a table that a configuration may hold, or one of those that are shipped
//! ([`Shipped`]). It lists the frames of a sample **in the order in which the device sends them**;
//! within one sample that is mostly the order of their identifiers, as lower ones win the bus. A frame
//! that does not stand behind the one before it in the table begins the next sample; so does one with
//! another counter, and one that comes much too late. A sample is complete with the last of its
//! frames that are not optional; one of which a frame is missing is counted and dropped.
//!
//! Rates, forces, increments, time and counter must come with each sample. Status, temperature and
//! what else is optional may come more rarely; the last that was told of status and temperature holds.
//!
//! Readers never panic, whatever the frames.

mod bits;
mod group;
mod layout;
mod read;
mod shipped;
mod write;

pub use layout::{ByteOrder, CanLayout, Field, FrameLayout, What};
pub use read::{CanImu, CanPart};
pub use shipped::{LayoutChoice, Shipped};
