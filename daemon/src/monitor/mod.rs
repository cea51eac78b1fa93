//! What the status page shows, in a terminal and over the same interface.

mod board;
mod client;
mod text;
mod view;

pub use board::{Board, Link};
pub use client::Client;
pub use text::{line, summary};
pub use view::{MonitorView, draw};
