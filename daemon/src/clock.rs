//! Where time enters. Nothing else in this workspace reads a clock.

use std::time::{Duration, Instant, SystemTime};

use insd_base::{Span, Stamp, Time, UtcTime};
use insd_drivers::ports;

use crate::state::Boot;

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

/// This moment, as another run of the program can place it.
#[must_use]
pub fn boot_now(stamp: &Stamp) -> Boot {
    let since = rustix::time::clock_gettime(rustix::time::ClockId::Boottime);
    let nanos = since.tv_sec.saturating_mul(1_000_000_000).saturating_add(since.tv_nsec);
    Boot::new(boot_id(), Span::from_nanos(nanos), stamp.system)
}

/// Which start of the computer this is: as the kernel says, or as the service is told where it cannot ask.
fn boot_id() -> String {
    let told = || std::env::var("INSD_BOOT_ID").map_err(|_| std::io::ErrorKind::NotFound);
    let id = std::fs::read_to_string("/proc/sys/kernel/random/boot_id").or_else(|_| told());
    id.unwrap_or_default().chars().filter(char::is_ascii_hexdigit).collect()
}

impl ports::Clock for HostClock {
    fn now(&self) -> Stamp {
        HostClock::now(self)
    }
}

fn nanos(duration: Duration) -> i64 {
    i64::try_from(duration.as_nanos()).unwrap_or(i64::MAX)
}
