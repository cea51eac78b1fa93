//! Where bytes enter and leave: recordings of voyages.

pub mod recording;
