//! What a base says, written: the messages of an epoch, and those of records.

use std::collections::{BTreeMap, BTreeSet};

use insd_base::GpsTime;
use insd_base::satellites::{
    BroadcastRecord, Constellation, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation,
};

use super::super::kepler::SECOND;
use super::super::state::{DAY, MOSCOW, time_of_day};
use super::collector::BEIDOU;
use super::frame::Frame;
use super::msm::{MOST_CELLS, Msm};
use super::{glonass, kepler, signal};

/// Nanoseconds of a millisecond and of a week.
const MILLI: i64 = 1_000_000;
const WEEK: i64 = 7 * DAY;

/// A phase that lies farther from its code is counted anew, m: a message has room for 1170 m from the first code of the satellite.
const FARTHEST: f64 = 700.0;

/// Writes the epochs of one base as MSM7, all signals that it has places for.
#[derive(Clone, Debug)]
pub struct MsmWriter {
    station: u16,
    /// The whole cycles that are taken off each phase, so that it begins at its code: messages tell it within a kilometre of that.
    whole: BTreeMap<(SatelliteId, SignalCode), f64>,
}

impl MsmWriter {
    /// Of a base with a number, 0 to 4095, that has written nothing yet.
    #[must_use]
    pub fn new(station: u16) -> Self {
        MsmWriter { station, whole: BTreeMap::new() }
    }

    /// The frames of an epoch, constellation by constellation; all but the last say that more is to come. Its time is told to a whole
    /// millisecond. A phase that has drifted too far from its code begins anew, with a lock time of zero.
    pub fn write(&mut self, epoch: &SatelliteEpoch) -> Vec<Vec<u8>> {
        let leap = epoch.leap_seconds.unwrap_or_else(|| crate::gnss::leap_seconds(epoch.tag));
        let mut of_each = BTreeMap::<u16, Vec<SignalObservation>>::new();
        for own in &epoch.signals {
            if signal::places(own.satellite, own.signal).is_some() {
                let number = signal::number(own.satellite.constellation, 7);
                of_each.entry(number).or_default().push(self.counted(own));
            }
        }
        let mut messages: Vec<Msm> = Vec::new();
        for (_, signals) in of_each {
            for signals in parts(signals) {
                let constellation = signals[0].satellite.constellation;
                let (station, time) = (self.station, time(constellation, epoch.tag, leap));
                messages.push(Msm { constellation, station, time, more: true, signals });
            }
        }
        if let Some(last) = messages.last_mut() {
            last.more = false;
        }
        messages.iter().map(Msm::write).collect()
    }

    /// A signal whose phase is counted from its code.
    fn counted(&mut self, own: &SignalObservation) -> SignalObservation {
        let key = (own.satellite, own.signal);
        let known = self.whole.get(&key).copied();
        let beyond = |cycles: f64| {
            let (code, wavelength) = (own.code?, own.wavelength()?);
            Some(cycles - code / wavelength).filter(|beyond| beyond.is_finite())
        };
        let far = |cycles: f64| Some(beyond(cycles)?.abs() * own.wavelength()? > FARTHEST);
        let Some(phase) = own.phase else { return *own };
        let begins = match (known, far(phase - known.unwrap_or_default())) {
            // without a code nobody knows where it would begin
            (None, None) => return SignalObservation { phase: None, ..*own },
            (_, far) => far.unwrap_or(false),
        };
        let whole = if begins { beyond(phase).map(f64::round) } else { known }.unwrap_or_default();
        self.whole.insert(key, whole);
        let is_anew = begins && known.is_some();
        SignalObservation {
            phase: Some(phase - whole),
            lock: if is_anew { Some(0.0) } else { own.lock },
            ..*own
        }
    }
}

/// Signals of one constellation, satellite by satellite in messages that have room for them.
fn parts(mut signals: Vec<SignalObservation>) -> Vec<Vec<SignalObservation>> {
    signals.sort_by_key(|own| own.satellite);
    let codes: BTreeSet<SignalCode> = signals.iter().map(|own| own.signal).collect();
    let satellites: Vec<_> = signals.chunk_by(|a, b| a.satellite == b.satellite).collect();
    let most = (MOST_CELLS / codes.len().max(1)).max(1);
    satellites.chunks(most).map(<[_]>::concat).collect()
}

/// The time of a message: ms of the system's week, of GLONASS the day of the week and ms of Moscow's day.
fn time(constellation: Constellation, tag: GpsTime, leap: i8) -> u32 {
    let rounded = (tag.as_nanos() + MILLI / 2).div_euclid(MILLI) * MILLI;
    let of_week = |behind: i64| (rounded - behind * SECOND).rem_euclid(WEEK);
    match constellation {
        Constellation::Glonass => {
            let of_day = time_of_day(GpsTime::from_nanos(rounded), leap);
            let day = of_week(i64::from(leap) - MOSCOW / SECOND).div_euclid(DAY);
            ((day << 27) | (of_day / MILLI)) as u32
        }
        Constellation::BeiDou => (of_week(BEIDOU) / MILLI) as u32,
        _ => (of_week(0) / MILLI) as u32,
    }
}

/// The frame of a record: 1019, 1020, 1042, 1044, 1045, 1046; `None` if there is no message of its kind. What is not read of these messages
/// (codes on L2, intervals of fit, more of GLONASS) is left zero.
#[must_use]
pub fn write_record(record: &BroadcastRecord) -> Option<Vec<u8>> {
    let bits = match record {
        BroadcastRecord::Kepler(record) => kepler::write(record)?,
        BroadcastRecord::Glonass(record) => {
            glonass::write(record, crate::gnss::leap_seconds(record.reference))
        }
    };
    Some(Frame { message: bits.bytes() }.write())
}
