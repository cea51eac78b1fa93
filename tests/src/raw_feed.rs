//! Raw GNSS of a voyage as the bytes of a u-blox or Septentrio receiver, and of a base.

use std::collections::BTreeMap;

use insd_base::satellites::{
    BroadcastRecord, KeplerRecord, SPEED_OF_LIGHT, SatelliteEpoch, SignalCode,
};
use insd_base::{Constellation, GpsTime, Input, SatelliteId, SignalObservation, Span, Time, earth};
use insd_simulator::RawGnss;
use insd_wire::gnss::navigation::lnav_words;
use insd_wire::gnss::rtcm::{BaseStation, MsmWriter, write_record};
use insd_wire::gnss::sbf::{MeasChannel, MeasEpoch, RawNavigation, RawNavigationKind, SbfStamp};
use insd_wire::gnss::ubx::{RxmRawx, RxmSfrbx, Signal};

use crate::feed::LineSending;

/// Time from an epoch to the last byte of its message, s.
const LATE: f64 = 0.06;
/// The same of the base's, which have come over a network, s.
const BASE_LATE: f64 = 0.3;
/// Each satellite sends a subframe so often, s: thrice as often as in the sky, so that a voyage may be short.
const SUBFRAME: i64 = 2;

/// What the receiver of the first antenna sends, for a voyage that starts at an instant of GPS time: the measurements of each epoch, and of GPS and
/// QZSS the subframes of the orbits that hold.
#[must_use]
pub fn ubx(raw: &RawGnss, start: GpsTime, port: usize) -> Vec<LineSending> {
    ubx_of(raw, 0, start, port)
}

/// The same of another antenna, counted from 0.
#[must_use]
pub fn ubx_of(raw: &RawGnss, antenna: usize, start: GpsTime, port: usize) -> Vec<LineSending> {
    let mut all = Vec::new();
    for epoch in &raw.antennas[antenna] {
        let seconds = epoch.tag.since(start).as_seconds();
        let mut send = |late: f64, bytes: Vec<u8>| {
            let at = Time::from_seconds((seconds + late).max(0.0));
            all.push(LineSending { at, port, input: Input::Bytes(bytes) });
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
fn record(raw: &RawGnss, satellite: SatelliteId, time: GpsTime) -> Option<KeplerRecord> {
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

/// What the base says, by its number: where it is and its orbits every five seconds, and MSM7 of each epoch.
#[must_use]
pub fn rtcm(raw: &RawGnss, start: GpsTime, port: usize) -> Vec<LineSending> {
    let Some(base) = &raw.base else { return Vec::new() };
    let place =
        BaseStation { station: 7, position: earth::ecef(&base.position).0.into(), height: None };
    let mut writer = MsmWriter::new(place.station);
    let mut all = Vec::new();
    for (number, epoch) in base.epochs.iter().enumerate() {
        let mut frames = if number % 5 == 0 { vec![place.write()] } else { Vec::new() };
        let satellites = epoch.signals.chunk_by(|a, b| a.satellite == b.satellite);
        let of_time = satellites.filter(|_| number % 5 == 0);
        let records = of_time.filter_map(|own| record(raw, own[0].satellite, epoch.tag));
        frames.extend(records.filter_map(|own| write_record(&BroadcastRecord::Kepler(own))));
        frames.extend(writer.write(epoch));
        let at = Time::from_seconds((epoch.tag.since(start).as_seconds() + BASE_LATE).max(0.0));
        all.push(LineSending { at, port, input: Input::Bytes(frames.concat()) });
    }
    all
}

/// The same in SBF: MeasEpoch with GPS and QZSS on L1, GPSRawCA and QZSRawL1CA.
#[must_use]
pub fn sbf(raw: &RawGnss, start: GpsTime, port: usize) -> Vec<LineSending> {
    let mut all = Vec::new();
    let mut whole = BTreeMap::new();
    for epoch in &raw.antennas[0] {
        let seconds = epoch.tag.since(start).as_seconds();
        let mut send = |late: f64, bytes: Vec<u8>| {
            let at = Time::from_seconds((seconds + late).max(0.0));
            all.push(LineSending { at, port, input: Input::Bytes(bytes) });
        };
        let stamp = SbfStamp::of(epoch.tag);
        let of_l1 = epoch.signals.iter().filter(|own| own.signal == SignalCode::new(1, b'C'));
        let channels = of_l1.filter_map(|own| channel(own, &mut whole)).collect();
        send(LATE, MeasEpoch { stamp, flags: 0, clock_jumps: Some(0), channels }.write());
        for (kind, satellite, words) in numbered_words(raw, epoch) {
            let block = RawNavigation {
                kind,
                stamp,
                satellite,
                passed: true,
                mended: 0,
                source: if kind == RawNavigationKind::Gps { 0 } else { 6 },
                frequency: 0,
                receiver_channel: 1,
                words,
            };
            send(LATE + 0.02, block.write());
        }
    }
    all
}

/// What SBF calls a satellite, with the number of its signal on L1.
fn numbers(satellite: SatelliteId) -> Option<(RawNavigationKind, u8, u8)> {
    match satellite.constellation {
        Constellation::Gps => Some((RawNavigationKind::Gps, satellite.number, 0)),
        Constellation::Qzss => Some((RawNavigationKind::Qzss, satellite.number + 180, 6)),
        _ => None,
    }
}

/// A signal in full. `whole`: the cycles by which phases are moved, so that they begin at their code, as a receiver's do.
fn channel(own: &SignalObservation, whole: &mut BTreeMap<SatelliteId, f64>) -> Option<MeasChannel> {
    let (_, satellite, kind) = numbers(own.satellite)?;
    let millimetres = (own.code? * 1e3).round() as u64;
    let waves = own.signal.frequency(own.satellite.constellation, None)? / SPEED_OF_LIGHT;
    let beyond = own.phase? - millimetres as f64 * 1e-3 * waves;
    let whole = *whole.entry(own.satellite).or_insert_with(|| beyond.round());
    let steps = ((beyond - whole) * 1e3).round() as i64;
    Some(MeasChannel {
        receiver_channel: satellite,
        kind,
        satellite,
        misc: (millimetres >> 32) as u8,
        code: millimetres as u32,
        doppler: (own.doppler? * 1e4).round() as i32,
        carrier_low: steps.rem_euclid(1 << 16) as u16,
        carrier_high: i8::try_from(steps.div_euclid(1 << 16)).ok()?,
        density: ((own.cn0? - 10.0) * 4.0).round() as u8,
        lock_time: own.lock.map_or(u16::MAX, |lock| lock.min(65534.0) as u16),
        ..MeasChannel::default()
    })
}

/// The subframes that end in the second of an epoch, with what SBF calls their blocks and satellites.
fn numbered_words(raw: &RawGnss, epoch: &SatelliteEpoch) -> Vec<(RawNavigationKind, u8, Vec<u32>)> {
    let frames = subframes(raw, epoch);
    let read = frames.iter().filter_map(|frame| RxmSfrbx::read(frame).ok());
    let told = read.filter_map(|frame| {
        let (kind, number, _) = numbers(frame.signal.known()?.0)?;
        Some((kind, number, frame.words))
    });
    told.collect()
}

/// An instant of GPS time on the time line of a voyage that starts at another.
#[must_use]
pub fn on_time_line(start: GpsTime, instant: GpsTime) -> Time {
    Time::START + Span::from_nanos(instant.as_nanos() - start.as_nanos())
}
