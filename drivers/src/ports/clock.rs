//! The clock that a port is given, and the kernel's times on it.

use insd_base::input::Stamp;
use insd_base::{Span, Time, UtcTime};

/// The computer's two clocks, read together. Whoever starts the ports gives them one; they read the
/// time nowhere else.
pub trait Clock: Send + Sync {
    /// Both clocks, now.
    fn now(&self) -> Stamp;
}

/// Both clocks, now. A thread that is interrupted between reading one and the other would put the
/// kernel's times where they were not: of three readings the one with the middle difference is taken.
pub(crate) fn both_clocks(clock: &dyn Clock) -> Stamp {
    let mut readings = [clock.now(), clock.now(), clock.now()];
    readings
        .sort_by_key(|stamp| stamp.system.as_nanos().saturating_sub(stamp.monotonic.as_nanos()));
    let [_, middle, _] = readings;
    middle
}

/// The time on the monotonic clock of what the kernel has dated on its realtime clock, from both clocks
/// shortly after: t_mono = now_mono - (now_utc - t_utc). `None` if it is not before, or longer before
/// than this: then the clock has stepped in between.
pub(crate) fn monotonic_at(after: Stamp, at: UtcTime, longest: Span) -> Option<Time> {
    let age = Span::from_nanos(after.system.as_nanos().checked_sub(at.as_nanos())?);
    (age >= Span::ZERO && age <= longest).then(|| after.monotonic - age)
}
