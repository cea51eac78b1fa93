//! What the computer sees of the bytes on the wire, and when.

use insd_base::{Arrival, PortId, Span, Stamp, Time, UtcTime};

use super::line::LineSending;

/// How bytes reach the computer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reception {
    /// The computer's monotonic clock at the start of the voyage.
    pub offset: Span,
    /// Its system clock then.
    pub system: UtcTime,
    /// Least and greatest time from the last byte to the return of the read, s.
    pub jitter: (f64, f64),
    /// Decides the lateness of each read.
    pub seed: u64,
}

impl Reception {
    /// A computer that was switched on some minutes before, with its system clock right, that takes 30
    /// to 180 us for a read.
    #[must_use]
    pub fn new(start: UtcTime, seed: u64) -> Self {
        let offset = Span::from_nanos(321_987_654_321);
        Reception { offset, system: start, jitter: (30e-6, 180e-6), seed }
    }

    /// The stamp of an instant of the voyage.
    #[must_use]
    pub fn stamp(&self, time: Time) -> Stamp {
        Stamp { monotonic: time + self.offset, system: self.system.plus(time - Time::START) }
    }
}

/// One read for each message, in order of receipt. The lateness of a read depends on nothing but the
/// seed, its port and its number, so that a fault on one port leaves the others as they were.
#[must_use]
pub fn arrivals(sendings: &[LineSending], reception: &Reception) -> Vec<Arrival> {
    let ports = sendings.iter().map(|sending| sending.port + 1).max().unwrap_or(0);
    let mut counts = vec![0_u64; ports];
    let mut reads = vec![Time::START; ports];
    let mut all = Vec::with_capacity(sendings.len());
    for sending in sendings {
        let count = &mut counts[sending.port];
        *count += 1;
        let key = reception.seed << 40 | (sending.port as u64) << 32 | *count;
        let (least, greatest) = reception.jitter;
        let late = least + (greatest - least) * share(key).powi(4);
        // what comes from one port keeps its order
        let read = (sending.at + Span::from_seconds(late)).max(reads[sending.port]);
        reads[sending.port] = read;
        all.push(Arrival {
            stamp: reception.stamp(read),
            port: PortId(sending.port as u16),
            input: sending.input.clone(),
        });
    }
    all.sort_by_key(|arrival| arrival.stamp.monotonic);
    all
}

/// A number from 0 to 1 that looks random (the finaliser of `SplitMix64`: Steele, Lea, Flood, Fast
/// splittable pseudorandom number generators, OOPSLA 2014).
pub(super) fn share(key: u64) -> f64 {
    let mut z = key.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ z >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 53) as f64
}
