//! All that is decided on board, and nothing that touches the world: bytes with times go in, bytes and
//! words come out.
//!
//! A [`Pipeline`] is made of a [`Plan`] of plain values. It takes [`Arrival`](insd_base::Arrival)s in their
//! order, hands over each [`Product`], and says when and why it wants to be woken ([`Pipeline::wake_up`]).
//! It has no clock, no thread, no file and no format of a configuration: daemon, replay and report run this
//! very code, and the same arrivals give the same products to the byte.

mod alert_commands;
mod checkpoints;
mod names;
mod outputs;
mod pipeline;
mod plan;
mod spares;
mod watch;
pub mod words;

pub use alert_commands::Who;
pub use checkpoints::Checkpoints;
pub use names::Names;
pub use outputs::{Commanded, Knows, Outputs, Spoken};
pub use pipeline::{Obeyed, OrderReader, Pipeline, Product};
pub use plan::{Change, OutputPlan, Plan, Spare};
pub use spares::{Dispute, EngineStatus, FIRST, Vote, loosened};
pub use watch::{
    MOST_WATCHED, WatchChange, WatchComparison, WatchLimits, WatchPlan, WatchQuantity,
};
