//! Messages of one base: epochs over several of them, records, its place.

use std::collections::BTreeMap;

use insd_base::GpsTime;
use insd_base::satellites::{BroadcastRecord, Constellation, SatelliteEpoch, SatelliteId};

use super::super::bits::Bits;
use super::super::kepler::SECOND;
use super::super::state::nearest_time_of_day;
use super::frame::Frame;
use super::glonass;
use super::kepler;
use super::msm::Msm;
use super::signal;
use super::station::{self, BaseStation};
use crate::binary::BinaryFault;

/// Nanoseconds of a millisecond.
const MILLI: i64 = 1_000_000;

/// GPS time - BeiDou time, s.
pub(super) const BEIDOU: i64 = 14;

/// Something that a message or the last of several has told.
#[derive(Clone, Debug, PartialEq)]
pub enum Correction {
    /// What the base measured.
    Epoch(SatelliteEpoch),
    /// A record of a satellite.
    Record(BroadcastRecord),
    /// Where the base is.
    Base(BaseStation),
}

/// Whether a message of this number tells measurements of satellites, or their orbits, that are read.
#[must_use]
pub fn is_of_satellites(number: u16) -> bool {
    signal::message(number).is_some_and(|(_, variant)| variant >= 4)
        || number == glonass::NUMBER
        || kepler::is_read(number)
}

/// Puts the messages of one base together.
#[derive(Clone, Debug, Default)]
pub struct MsmCollector {
    /// An epoch of which more is to come.
    open: Option<SatelliteEpoch>,
    channels: BTreeMap<SatelliteId, i8>,
    leap_seconds: Option<i8>,
}

impl MsmCollector {
    /// A collector that has heard nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Says how many leap seconds there are, by which GLONASS' times are read; otherwise the table of this version holds.
    pub fn set_leap_seconds(&mut self, leap_seconds: i8) {
        self.leap_seconds = Some(leap_seconds);
    }

    /// Takes a frame that was received at a time, which has to be right to three days, for GLONASS to half a day; gives what is whole by it. An
    /// epoch whose last message is missing is given when the next one begins.
    ///
    /// # Errors
    /// What is wrong with the bytes. A message that is not read says nothing.
    pub fn take(
        &mut self,
        frame: &[u8],
        received: GpsTime,
    ) -> Result<Vec<Correction>, BinaryFault> {
        let frame = Frame::open(frame)?;
        let Some(number) = frame.number() else { return Ok(Vec::new()) };
        let bits = Bits::of(frame.message);
        if let Some(msm) = Msm::read(number, &bits, |id| self.channels.get(&id).copied()) {
            return Ok(self.epochs(msm?, received));
        }
        let one = match number {
            _ if station::NUMBERS.contains(&number) => {
                Some(Correction::Base(station::read(number, &bits)?))
            }
            glonass::NUMBER => {
                let record = glonass::read(&bits, received, self.leap_seconds(received))?;
                self.channels.insert(record.satellite, record.channel);
                Some(Correction::Record(BroadcastRecord::Glonass(record)))
            }
            _ => kepler::read(number, &bits, received)
                .transpose()?
                .map(|record| Correction::Record(BroadcastRecord::Kepler(record))),
        };
        Ok(one.into_iter().collect())
    }

    /// Adds a message to its epoch; gives those that are whole or will not be.
    fn epochs(&mut self, msm: Msm, received: GpsTime) -> Vec<Correction> {
        let told = msm.signals.iter().filter_map(|own| Some((own.satellite, own.channel?)));
        self.channels.extend(told);
        let tag = self.tag(&msm, received);
        let ended = self.open.take_if(|open| open.tag != tag);
        let begun =
            SatelliteEpoch { tag, signals: Vec::new(), leap_seconds: None, clock_reset: false };
        let open = self.open.get_or_insert(begun);
        open.signals.extend(msm.signals);
        let whole = if msm.more { None } else { self.open.take() };
        ended.into_iter().chain(whole).map(Correction::Epoch).collect()
    }

    fn tag(&self, msm: &Msm, received: GpsTime) -> GpsTime {
        let of_week = i64::from(msm.time) * MILLI;
        match msm.constellation {
            Constellation::Glonass => {
                let of_day = i64::from(msm.time & 0x7FF_FFFF) * MILLI;
                nearest_time_of_day(of_day, received, self.leap_seconds(received))
            }
            Constellation::BeiDou => received.nearest_with_tow(of_week + BEIDOU * SECOND),
            _ => received.nearest_with_tow(of_week),
        }
    }

    fn leap_seconds(&self, at: GpsTime) -> i8 {
        self.leap_seconds.unwrap_or_else(|| crate::gnss::leap_seconds(at))
    }
}
