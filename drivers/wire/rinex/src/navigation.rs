//! Files of navigation messages: what satellites broadcast.

mod entry;
mod glonass;
mod ionosphere;
mod kepler;
mod reader;
#[cfg(test)]
mod tests;
mod write;

pub use reader::{NavigationMessages, read_navigation};
pub use write::write_navigation;
