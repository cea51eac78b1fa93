//! Where time enters. Nothing else in this workspace reads a clock.

use std::time::{Duration, Instant, SystemTime};

use insd_base::{Stamp, Time, UtcTime};
use insd_drivers::ports;

/// A monotonic clock that starts at zero.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    started: Instant,
}

impl Clock {
    /// A clock that reads zero now.
    #[must_use]
    #[expect(clippy::disallowed_methods, reason = "this is the one place")]
    pub fn start() -> Self {
        Clock { started: Instant::now() }
    }

    /// Time since the start, never going back.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }
}

/// The clocks of this computer, for times of receipt.
#[derive(Clone, Copy, Debug)]
pub struct HostClock {
    clock: Clock,
}

impl HostClock {
    /// Clocks of which the monotonic one reads zero now.
    #[must_use]
    pub fn start() -> Self {
        HostClock { clock: Clock::start() }
    }

    /// Both clocks, read together.
    #[must_use]
    #[expect(clippy::disallowed_methods, reason = "this is the one place")]
    pub fn now(&self) -> Stamp {
        let monotonic = nanos(self.clock.elapsed());
        let system = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, nanos);
        Stamp { monotonic: Time::from_nanos(monotonic), system: UtcTime::from_nanos(system) }
    }
}

impl ports::Clock for HostClock {
    fn now(&self) -> Stamp {
        HostClock::now(self)
    }
}

fn nanos(duration: Duration) -> i64 {
    i64::try_from(duration.as_nanos()).unwrap_or(i64::MAX)
}
