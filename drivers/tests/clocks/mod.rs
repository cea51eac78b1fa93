//! The real clocks, for tests of ports.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::time::{Instant, SystemTime, UNIX_EPOCH};

use insd_base::{Stamp, Time, UtcTime};
use insd_drivers::ports::Clock;

/// Both clocks of this computer; the monotonic one reads zero at the start.
pub(crate) struct Clocks(Instant);

impl Clocks {
    #[expect(clippy::disallowed_methods, reason = "tests run on the real clocks")]
    pub(crate) fn start() -> Self {
        Clocks(Instant::now())
    }
}

impl Clock for Clocks {
    #[expect(clippy::disallowed_methods, reason = "tests run on the real clocks")]
    fn now(&self) -> Stamp {
        let monotonic = Time::from_nanos(self.0.elapsed().as_nanos() as i64);
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap();
        Stamp { monotonic, system: UtcTime::from_nanos(since.as_nanos() as i64) }
    }
}
