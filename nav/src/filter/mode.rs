//! Which aids carry the solution.

use insd_base::{Mode, SolutionSource, Time};

use super::Filter;

/// After this long without GNSS the solution no longer counts as aided by it, s.
pub(super) const GNSS_TIMEOUT: f64 = 5.0;
/// The same for logs and references, which may be slower, s.
const RELATIVE_TIMEOUT: f64 = 15.0;

impl Filter {
    pub(super) fn gnss_is_fresh(&self) -> bool {
        self.receiver
            .trust
            .last_used()
            .is_some_and(|last| (self.state.time - last).as_seconds() < GNSS_TIMEOUT)
    }

    /// Whether nothing tells how she moves but the IMU, with a heading or without.
    pub(super) fn is_carried_by_imu(&self) -> bool {
        let is_fresh = |last: Time| (self.state.time - last).as_seconds() < RELATIVE_TIMEOUT;
        !self.gnss_is_fresh() && !self.heard.motion.is_some_and(is_fresh)
    }

    /// The best source in use; `None` before the ship navigates.
    pub(super) fn source(&self) -> Option<SolutionSource> {
        self.navigating.then(|| self.sources.best(self.state.time))
    }

    /// Which aids carry the solution.
    #[must_use]
    pub fn mode(&self) -> Mode {
        let relative = self
            .heard
            .relative
            .is_some_and(|last| (self.state.time - last).as_seconds() < RELATIVE_TIMEOUT);
        if self.gnss_is_fresh() {
            Mode::Aided
        } else if relative {
            Mode::DeadReckoning
        } else {
            Mode::Inertial
        }
    }
}
