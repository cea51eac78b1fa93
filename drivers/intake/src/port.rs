//! The bytes of one port: frames, and when their bytes came.

use std::collections::VecDeque;

use insd_base::{Span, Stamp, Time};
use insd_wire::stream::{Cutter, Protocol};

/// A silence after which the beginning of a frame has no end any more, s.
const IDLE: f64 = 1.0;
/// Longest that a frame of a stream without timing of its own takes from first to last byte, s: an
/// ensemble of a Doppler log behind a slow serial line.
const SLOW: f64 = 3.0;
/// Longest frame of all protocols, bytes.
const LONGEST: f64 = 8200.0;

/// What carries the bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Link {
    /// A serial line: bytes come one after the other, each taking this long, s.
    Serial {
        /// Time for a byte with its start and stop bits.
        byte_time: f64,
    },
    /// A stream without timing of its own: TCP, pipe.
    Stream,
    /// A file: a stream that was written at another time than that of the computer's clock.
    File,
    /// Datagrams: no frame goes over the end of one.
    Datagrams,
    /// A CAN bus: frames instead of bytes.
    Can {
        /// Time for a bit, s: 4e-6 on NMEA 2000.
        bit_time: f64,
    },
}

/// A frame and when it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PortFrame<'a> {
    /// How it is framed.
    pub protocol: Protocol,
    /// Its bytes.
    pub bytes: &'a [u8],
    /// When its first byte came, as nearly as the link tells.
    pub begun: Time,
    /// When its last byte came.
    pub ended: Time,
}

/// Counters of one port.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct PortCounts {
    /// Bytes taken.
    pub bytes: u64,
    /// Frames found.
    pub frames: u64,
    /// Bytes that belonged to no frame.
    pub skipped: u64,
    /// Frames with a wrong checksum.
    pub damaged: u64,
}

/// Finds the frames of one port.
#[derive(Clone, Debug)]
pub struct PortIntake {
    link: Link,
    cutter: Cutter,
    bytes: u64,
    frames: u64,
    last: Option<Time>,
    /// Reads of which bytes wait: bytes of the stream up to their end, and when they returned.
    reads: VecDeque<(u64, Time)>,
}

impl PortIntake {
    /// A port on which these protocols are spoken.
    #[must_use]
    pub fn new(link: Link, protocols: &[Protocol]) -> Self {
        PortIntake {
            link,
            cutter: Cutter::new(protocols),
            bytes: 0,
            frames: 0,
            last: None,
            reads: VecDeque::new(),
        }
    }

    /// Takes what one read gave, and hands over the frames that it completes.
    pub fn take(&mut self, stamp: &Stamp, bytes: &[u8], mut each: impl FnMut(&PortFrame<'_>)) {
        let now = stamp.monotonic;
        if self.last.is_some_and(|last| (now - last).as_seconds() > IDLE) {
            self.finish(now, &mut each);
        }
        self.last = Some(now);
        self.bytes += bytes.len() as u64;
        self.reads.push_back((self.bytes, now));
        self.cutter.push(bytes);
        self.cut(now, &mut each);
        if self.link == Link::Datagrams {
            self.finish(now, &mut each);
        }
        self.release(now, &mut each);
    }

    /// Gives up a beginning that has waited for longer than any frame takes: it is none, and hides
    /// frames behind it.
    fn release(&mut self, now: Time, each: &mut impl FnMut(&PortFrame<'_>)) {
        let longest = match self.link {
            Link::Serial { byte_time } => IDLE + LONGEST * byte_time,
            _ => SLOW,
        };
        while self.reads.front().is_some_and(|(_, read)| (now - *read).as_seconds() > longest) {
            self.cutter.give_up();
            self.cut(now, each);
        }
    }

    /// The port was lost: what waits for its end will not get it.
    pub fn interrupt(&mut self, stamp: &Stamp, mut each: impl FnMut(&PortFrame<'_>)) {
        self.finish(stamp.monotonic, &mut each);
    }

    /// Counters since the start.
    #[must_use]
    pub fn counts(&self) -> PortCounts {
        PortCounts {
            bytes: self.bytes,
            frames: self.frames,
            skipped: self.cutter.skipped(),
            damaged: self.cutter.damaged(),
        }
    }

    fn finish(&mut self, now: Time, each: &mut impl FnMut(&PortFrame<'_>)) {
        while self.cutter.is_waiting() {
            self.cutter.give_up();
            self.cut(now, each);
        }
    }

    fn cut(&mut self, now: Time, each: &mut impl FnMut(&PortFrame<'_>)) {
        let byte_time = match self.link {
            Link::Serial { byte_time } => byte_time,
            _ => 0.0,
        };
        while let Some(cut) = self.cutter.cut() {
            self.frames += 1;
            // the read that gave its last byte, which may have waited behind a false beginning
            while self.reads.front().is_some_and(|(end, _)| *end < cut.end) {
                self.reads.pop_front();
            }
            let (end, read) = self.reads.front().copied().unwrap_or((self.bytes, now));
            let after = end.saturating_sub(cut.end) as f64;
            let ended = read - Span::from_seconds(after * byte_time);
            let begun = ended - Span::from_seconds(cut.bytes.len() as f64 * byte_time);
            each(&PortFrame { protocol: cut.protocol, bytes: cut.bytes, begun, ended });
        }
        let dealt_with = self.cutter.position();
        while self.reads.front().is_some_and(|(end, _)| *end <= dealt_with) {
            self.reads.pop_front();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::UtcTime;

    fn at(seconds: f64) -> Stamp {
        Stamp { monotonic: Time::from_seconds(seconds), system: UtcTime::from_nanos(0) }
    }

    fn taken(port: &mut PortIntake, stamp: &Stamp, bytes: &[u8]) -> Vec<(f64, f64)> {
        let mut times = Vec::new();
        port.take(stamp, bytes, |frame| {
            times.push((frame.begun.as_seconds(), frame.ended.as_seconds()));
        });
        times
    }

    #[test]
    fn on_a_serial_line_bytes_before_the_last_came_earlier() {
        let link = Link::Serial { byte_time: 1e-3 };
        let mut port = PortIntake::new(link, &[Protocol::Nmea]);
        let times = taken(&mut port, &at(10.0), b"$HETHS,316.70,E*1A\r\n$HETHS,316.70,E*1A\r\n");
        assert_eq!(times, [(9.960, 9.978), (9.980, 9.998)]);
    }

    #[test]
    fn a_frame_behind_a_false_beginning_comes_to_light_with_the_time_of_its_own_read() {
        let mut port = PortIntake::new(Link::Stream, &[Protocol::Nmea, Protocol::Ubx]);
        // a beginning that promises 8000 bytes
        assert!(taken(&mut port, &at(1.0), b"\xB5\x62\x01\x07\x40\x1F").is_empty());
        let mut times = Vec::new();
        for k in 0..8 {
            let seconds = 1.5 + 0.5 * f64::from(k);
            times.extend(taken(&mut port, &at(seconds), b"$HETHS,316.70,E*1A\r\n"));
        }
        let own: Vec<f64> = times.iter().map(|(begun, _)| *begun).collect();
        assert_eq!(own, [1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0]);
        assert_eq!(port.counts().skipped, 6);
    }

    #[test]
    fn a_frame_does_not_go_on_in_the_next_datagram_nor_after_a_silence() {
        for (link, pause) in [(Link::Datagrams, 0.001), (Link::Stream, 2.0)] {
            let mut port = PortIntake::new(link, &[Protocol::Nmea]);
            assert!(taken(&mut port, &at(1.0), b"$HETHS,3").is_empty());
            assert!(taken(&mut port, &at(1.0 + pause), b"16.70,E*1A\r\n").is_empty());
            assert_eq!(port.counts().skipped, 8 + 10);
        }
    }
}
