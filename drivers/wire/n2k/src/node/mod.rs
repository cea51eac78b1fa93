//! A node of the bus: frames in, frames and wake-up out.

mod transmit;

pub use transmit::Transmit;
