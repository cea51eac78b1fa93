//! The clock that a port is given.

use insd_base::input::Stamp;

/// The computer's two clocks, read together. Whoever starts the ports gives them one; they read the
/// time nowhere else.
pub trait Clock: Send + Sync {
    /// Both clocks, now.
    fn now(&self) -> Stamp;
}
