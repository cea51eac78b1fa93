//! The pace of a line: when it has carried what was written to it.
//!
//! The system takes 4 KiB for a serial line at once: 8 s at 4800 baud, in which messages would grow old
//! out of reach. So nothing is given to it before the line is nearly free, as reckoned from the bytes
//! written and the time that each takes. Where the driver tells what it still holds, that counts too: a
//! line may be slower than its name, or be held up by the other end.

use std::sync::Arc;
use std::time::Duration;

use insd_base::{Span, Time};
use tokio::time::sleep;

use super::clock::Clock;
use super::waiting::{Start, times};

/// How long what was written before may still take when the next is written. Sleeps end at the next
/// whole millisecond and then some: with less the line would wait for us between two messages.
const LEAD: Span = Span::from_nanos(3_000_000);

/// A driver that holds something is asked again after so long at the latest.
const ASKING: Duration = Duration::from_millis(20);

/// Bytes that the driver still holds, if it tells.
type Held<'a> = Box<dyn Fn() -> Option<u32> + Send + Sync + 'a>;

/// The pace of one line.
pub(super) struct Pace<'a> {
    clock: Arc<dyn Clock>,
    per_byte: Span,
    held: Held<'a>,
    /// When the line has carried all that was written.
    free: Time,
}

impl<'a> Pace<'a> {
    /// The pace of a line on which each character takes so many of so many symbols per second.
    pub(super) fn new(clock: Arc<dyn Clock>, symbols: u32, baud: u32) -> Self {
        let per_byte = Span::from_seconds(f64::from(symbols) / f64::from(baud.max(1)));
        Pace { clock, per_byte, held: Box::new(|| None), free: Time::START }
    }

    /// The same line, of which the driver tells how much it still holds.
    pub(super) fn asking(self, held: impl Fn() -> Option<u32> + Send + Sync + 'a) -> Self {
        Pace { held: Box::new(held), ..self }
    }

    /// Waits until the line is nearly free.
    pub(super) async fn room(&mut self) {
        loop {
            let now = self.clock.now().monotonic;
            let held = (self.held)().unwrap_or(0) as usize;
            let by_driver = times(self.per_byte, held);
            let ahead = (self.free - now).max(by_driver);
            if ahead <= LEAD {
                return;
            }
            let span = Duration::from_nanos((ahead.as_nanos() - LEAD.as_nanos()).unsigned_abs());
            sleep(if by_driver > LEAD { span.min(ASKING) } else { span }).await;
        }
    }

    /// When what is written now starts to leave.
    pub(super) fn start(&self, now: Time) -> Start {
        Start { at: self.free.max(now), per_byte: self.per_byte }
    }

    /// So many bytes have been written now. Gives when the last will have left.
    pub(super) fn carry(&mut self, now: Time, bytes: usize) -> Time {
        self.free = self.free.max(now) + times(self.per_byte, bytes);
        self.free
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use insd_base::{Stamp, UtcTime};

    use super::*;

    /// A clock that goes on by 10 ms with each reading.
    #[derive(Default)]
    struct Ticking(Mutex<Time>);

    impl Clock for Ticking {
        fn now(&self) -> Stamp {
            let mut time = self.0.lock().unwrap();
            *time = *time + Span::from_nanos(10_000_000);
            Stamp { monotonic: *time, system: UtcTime::from_nanos(0) }
        }
    }

    fn pace<'a>() -> Pace<'a> {
        Pace::new(Arc::new(Ticking::default()), 10, 4800)
    }

    #[tokio::test(start_paused = true)]
    async fn a_line_is_waited_for_until_it_is_nearly_free() {
        let mut pace = pace();
        let out = pace.carry(Time::from_seconds(0.01), 48);
        assert!((out.as_seconds() - 0.11).abs() < 1e-6);
        assert_eq!(pace.start(Time::from_seconds(0.05)).at, out);
        pace.room().await;
        let now = pace.clock.now().monotonic.as_seconds();
        assert!(now > 0.11 && now < 0.13, "{now}");
        assert_eq!(pace.start(Time::from_seconds(0.2)).at, Time::from_seconds(0.2));
    }

    #[tokio::test(start_paused = true)]
    async fn a_driver_that_still_holds_something_is_waited_for() {
        let holds = Mutex::new(vec![0, 1, 100, 480]);
        let mut pace = pace().asking(|| holds.lock().unwrap().pop());
        pace.room().await;
        assert_eq!(*holds.lock().unwrap(), [0], "one byte takes less than the lead");
    }
}
