//! Offering the time to chronyd: samples for its SOCK reference clock.
//!
//! chronyd makes the socket (`refclock SOCK /run/chrony.insd.sock`) and takes datagrams of 40 bytes:
//! `struct sock_sample` of its `refclock_sock.c`, in the machine's own byte order, here for machines
//! whose `struct timeval` is two 64-bit numbers:
//!
//! | bytes | type | what |
//! |---|---|---|
//! | 0..16 | `timeval` | system time of the sample: s, us |
//! | 16..24 | `double` | true time - system time, s |
//! | 24..28 | `int` | not 0: a pulse, of which only the fraction of the second counts |
//! | 28..32 | `int` | leap second: 0 none, 1 inserted, 2 deleted |
//! | 32..36 | `int` | nothing |
//! | 36..40 | `int` | 0x534f434b, "SOCK" |

use std::io;
use std::os::unix::net::UnixDatagram;
use std::path::PathBuf;

use insd_base::{PortId, Span, UtcTime};

use super::surroundings::Surroundings;
use super::teller::Teller;

const MAGIC: i32 = 0x534f_434b;

/// Length of a sample, bytes.
pub const SAMPLE_LENGTH: usize = 40;

/// A comparison of the system's clock with the true time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample {
    /// What the system's clock said.
    pub system: UtcTime,
    /// True time less the system's.
    pub offset: Span,
    /// Whether it is a pulse: then chronyd takes the full second from another source.
    pub pulse: bool,
    /// A leap second at the end of this day.
    pub leap: Leap,
}

/// A leap second to come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Leap {
    /// There is none.
    #[default]
    None,
    /// The last minute has 61 seconds.
    Inserted,
    /// The last minute has 59 seconds.
    Deleted,
}

impl Sample {
    /// The datagram.
    #[must_use]
    pub fn encode(&self) -> [u8; SAMPLE_LENGTH] {
        let micros = self.system.as_nanos().div_euclid(1000);
        // what the microseconds cut off belongs to the offset
        let cut = self.system.as_nanos().rem_euclid(1000);
        let offset = Span::from_nanos(self.offset.as_nanos().saturating_add(cut)).as_seconds();
        let leap: i32 = match self.leap {
            Leap::None => 0,
            Leap::Inserted => 1,
            Leap::Deleted => 2,
        };
        let fields: [&[u8]; 7] = [
            &micros.div_euclid(1_000_000).to_ne_bytes(),
            &micros.rem_euclid(1_000_000).to_ne_bytes(),
            &offset.to_ne_bytes(),
            &i32::from(self.pulse).to_ne_bytes(),
            &leap.to_ne_bytes(),
            &0_i32.to_ne_bytes(),
            &MAGIC.to_ne_bytes(),
        ];
        let mut datagram = [0; SAMPLE_LENGTH];
        for (to, from) in datagram.iter_mut().zip(fields.iter().copied().flatten()) {
            *to = *from;
        }
        datagram
    }
}

/// The sender. It never waits; a sample that cannot be delivered is dropped, as it would be old.
pub struct ChronySock {
    path: PathBuf,
    socket: Option<UnixDatagram>,
    teller: Teller,
}

impl ChronySock {
    /// A sender to the socket at this path, which need not exist yet. Its states are told as those of
    /// this port.
    #[must_use]
    pub fn new(port: PortId, path: PathBuf, surroundings: Surroundings) -> Self {
        let teller = Teller::new(port, surroundings.clock, surroundings.queue, None);
        ChronySock { path, socket: None, teller }
    }

    /// Sends a sample; gives whether it was delivered. Without a connection it tries to connect, so it
    /// is to be called at the pace of the samples, some a second at most.
    pub fn send(&mut self, sample: &Sample) -> bool {
        if self.socket.is_none() {
            self.connect();
        }
        let Some(socket) = &self.socket else { return false };
        match socket.send(&sample.encode()) {
            Ok(length) => length == SAMPLE_LENGTH,
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => false,
            Err(error) => {
                self.socket = None;
                self.teller.lost(format!("{}: {error}", self.path.display()));
                false
            }
        }
    }

    fn connect(&mut self) {
        let path = self.path.display();
        let connected = UnixDatagram::unbound().and_then(|socket| {
            socket.set_nonblocking(true)?;
            socket.connect(&self.path)?;
            Ok(socket)
        });
        match connected {
            Ok(socket) => {
                self.socket = Some(socket);
                self.teller.open(format!("chrony at {path}"));
            }
            Err(error) => self.teller.absent(format!("{path}: {error}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_endian = "little")]
    fn a_sample_is_what_chronyd_takes() {
        let sample = Sample {
            system: UtcTime::from_nanos(0x1234_5678 * 1_000_000_000 + 42_000_500),
            offset: Span::from_nanos(-500_000_500),
            pulse: true,
            leap: Leap::Deleted,
        };
        let expected: [u8; SAMPLE_LENGTH] = [
            0x78, 0x56, 0x34, 0x12, 0, 0, 0, 0, // 305419896 s
            0x10, 0xa4, 0, 0, 0, 0, 0, 0, // 42000 us
            0, 0, 0, 0, 0, 0, 0xe0, 0xbf, // -0.5 s
            1, 0, 0, 0, // a pulse
            2, 0, 0, 0, // leap second deleted
            0, 0, 0, 0, // nothing
            0x4b, 0x43, 0x4f, 0x53, // SOCK
        ];
        assert_eq!(sample.encode(), expected);
    }
}
