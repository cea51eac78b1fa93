//! Where bytes and frames enter and leave: the ports of the computer, raw recordings of all that arrives
//! at them, and voyage directories.

pub mod can;
pub mod ports;
pub mod raw;
pub mod recording;
