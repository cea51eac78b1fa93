//! Navigation messages: words of satellites, subframe by subframe, put together to records of their orbits and clocks.
//!
//! Whatever the words are, nothing panics; what is refused is refused with a reason. Weeks of ten, twelve or thirteen bits and
//! times of day are resolved by the time of reception, which has to be right to a few hours for GLONASS and to ten years for the others.

mod assembler;
mod beidou;
mod broadcast;
mod checks;
mod galileo;
mod glonass;
mod leap;
mod lnav;

pub use assembler::NavigationAssembler;

pub use broadcast::{Broadcast, WordsRefusal};
pub use lnav::words as lnav_words;

#[cfg(test)]
mod tests;
