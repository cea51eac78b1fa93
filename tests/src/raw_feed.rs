//! Raw GNSS of a voyage as the bytes of a u-blox receiver.

use insd_base::satellites::{BroadcastRecord, KeplerRecord, SatelliteEpoch, SignalCode};
use insd_base::{Constellation, GpsTime, Input, Span, Time};
use insd_simulator::RawGnss;
use insd_wire::gnss::navigation::lnav_words;
use insd_wire::gnss::ubx::{RxmRawx, RxmSfrbx, Signal};

use crate::feed::Sending;

/// Time from an epoch to the last byte of its message, s.
const LATE: f64 = 0.06;
/// Each satellite sends a subframe so often, s: thrice as often as in the sky, so that a voyage may be short.
const SUBFRAME: i64 = 2;

/// What the receiver of the first antenna sends, for a voyage that starts at an instant of GPS time: the measurements of each epoch, and of GPS and
/// QZSS the subframes of the orbits that hold.
#[must_use]
pub fn ubx(raw: &RawGnss, start: GpsTime, port: usize) -> Vec<Sending> {
    let mut all = Vec::new();
    for epoch in &raw.antennas[0] {
        let seconds = epoch.tag.since(start).as_seconds();
        let mut send = |late: f64, bytes: Vec<u8>| {
            let at = Time::from_seconds((seconds + late).max(0.0));
            all.push(Sending { at, port, input: Input::Bytes(bytes) });
        };
        let told = SatelliteEpoch { leap_seconds: Some(18), ..epoch.clone() };
        send(LATE, RxmRawx::of(&told).write());
        for frame in subframes(raw, epoch) {
            send(LATE + 0.02, frame);
        }
    }
    all
}

/// The subframes that end in the second of an epoch.
fn subframes(raw: &RawGnss, epoch: &SatelliteEpoch) -> Vec<Vec<u8>> {
    let second = (epoch.tag.as_nanos() + 500_000_000).div_euclid(1_000_000_000);
    if second % SUBFRAME != 0 {
        return Vec::new();
    }
    let number = (second / SUBFRAME).rem_euclid(3) as usize;
    let satellites = epoch.signals.chunk_by(|a, b| a.satellite == b.satellite);
    let records = satellites.filter_map(|signals| record(raw, signals[0].satellite, epoch.tag));
    records.filter_map(|record| subframe(&record, number)).collect()
}

/// The record of a satellite whose reference time is nearest.
fn record(raw: &RawGnss, satellite: insd_base::SatelliteId, time: GpsTime) -> Option<KeplerRecord> {
    let of_it = raw.broadcast.iter().filter_map(|record| match record {
        BroadcastRecord::Kepler(record) if record.satellite == satellite => Some(*record),
        _ => None,
    });
    of_it.min_by_key(|record| time.since(record.orbit.reference).as_nanos().abs())
}

/// One of the three subframes of a record of GPS or QZSS.
#[must_use]
pub fn subframe(record: &KeplerRecord, number: usize) -> Option<Vec<u8>> {
    let is_lnav =
        matches!(record.satellite.constellation, Constellation::Gps | Constellation::Qzss);
    let signal = Signal::of(record.satellite, SignalCode::new(1, b'C'), None);
    let words = lnav_words(record).into_iter().nth(number).filter(|_| is_lnav)?;
    Some(RxmSfrbx { signal: signal?, channel: 1, version: 2, words }.write())
}

/// An instant of GPS time on the time line of a voyage that starts at another.
#[must_use]
pub fn on_time_line(start: GpsTime, instant: GpsTime) -> Time {
    Time::START + Span::from_nanos(instant.as_nanos() - start.as_nanos())
}
