//! Whether corrections come, and not something else, or too little of it.

use std::time::Duration;

use insd_base::{Span, Time};
use insd_wire::stream::{Cutter, Protocol};

/// Fewer bytes than this in a whole time-out are no epoch of any base.
const LEAST: u64 = 64;

/// Looks at a stream, one time-out after the other.
pub(super) struct Watch {
    timeout: Span,
    since: Time,
    bytes: u64,
    frames: u64,
    cutter: Cutter,
}

impl Watch {
    pub(super) fn new(timeout: Span, now: Time) -> Self {
        let cutter = Cutter::new(&[Protocol::Rtcm]);
        Watch { timeout, since: now, bytes: 0, frames: 0, cutter }
    }

    /// Bytes of the stream came.
    pub(super) fn hear(&mut self, bytes: &[u8]) {
        self.bytes += bytes.len() as u64;
        self.cutter.push(bytes);
        while self.cutter.cut().is_some() {
            self.frames += 1;
        }
    }

    /// Why the stream is given up, if it is. A time-out that was good is followed by the next.
    pub(super) fn look(&mut self, now: Time) -> Option<String> {
        if now - self.since < self.timeout {
            return None;
        }
        let (seconds, bytes) = (self.timeout.as_seconds(), self.bytes);
        if bytes == 0 {
            return Some(format!("nothing for {seconds} s"));
        }
        if bytes < LEAST {
            return Some(format!("too slow: {bytes} bytes in {seconds} s"));
        }
        if self.frames == 0 {
            return Some(format!("no RTCM 3 in {seconds} s"));
        }
        (self.since, self.bytes, self.frames) = (now, 0, 0);
        None
    }

    /// How long nothing is to be looked at.
    pub(super) fn rest(&self, now: Time) -> Duration {
        let left = self.since + self.timeout - now;
        Duration::from_nanos(left.as_nanos().max(0).unsigned_abs()) + Duration::from_millis(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1005 of a published example (RTCM 10403, 4.2).
    const FRAME: [u8; 25] = [
        0xD3, 0x00, 0x13, 0x3E, 0xD7, 0xD3, 0x02, 0x02, 0x98, 0x0E, 0xDE, 0xEF, 0x34, 0xB4, 0xBD,
        0x62, 0xAC, 0x09, 0x41, 0x98, 0x6F, 0x33, 0x36, 0x0B, 0x98,
    ];

    fn after(bytes: &[u8]) -> Option<String> {
        let mut watch = Watch::new(Span::from_seconds(30.0), Time::START);
        bytes.chunks(7).for_each(|part| watch.hear(part));
        assert_eq!(watch.look(Time::from_seconds(29.0)), None);
        watch.look(Time::from_seconds(30.0))
    }

    #[test]
    fn a_stream_that_is_silent_slow_or_something_else_is_given_up() {
        assert_eq!(after(&FRAME.repeat(3)), None);
        assert_eq!(after(&[]).unwrap(), "nothing for 30 s");
        assert_eq!(after(&FRAME).unwrap(), "too slow: 25 bytes in 30 s");
        assert_eq!(after(&[b'x'; 5000]).unwrap(), "no RTCM 3 in 30 s");
    }

    #[test]
    fn each_time_out_is_looked_at_for_itself() {
        let mut watch = Watch::new(Span::from_seconds(10.0), Time::START);
        watch.hear(&FRAME.repeat(3));
        assert_eq!(watch.look(Time::from_seconds(10.0)), None);
        assert!(watch.rest(Time::from_seconds(10.0)) > Duration::from_secs(9));
        assert_eq!(watch.look(Time::from_seconds(20.5)).unwrap(), "nothing for 10 s");
    }
}
