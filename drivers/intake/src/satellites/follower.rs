//! Epochs and records out of raw messages.

use insd_base::satellites::SatelliteId;
use insd_base::{GpsTime, SatelliteEpoch};
use insd_wire::gnss::navigation::{Broadcast, NavigationAssembler, WordsRefusal};
use insd_wire::gnss::rtcm::{Correction, MsmCollector};
use insd_wire::gnss::{Locks, NavigationWords};

use super::RawReading;

/// Words that wait until the time is known.
const WAITING: usize = 64;

/// What a raw message, or the last of several, has told.
#[derive(Clone, Debug, PartialEq)]
pub enum SatelliteNews {
    /// What was measured; signals in their order, each once, slips marked.
    Epoch {
        /// The epoch.
        epoch: SatelliteEpoch,
        /// The receiver says that it knows the time.
        is_dated: bool,
    },
    /// What a satellite has broadcast.
    Broadcast(Broadcast),
}

/// Why a raw message says nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordsFault {
    /// Words of this satellite are refused.
    Words(SatelliteId, WordsRefusal),
    /// The frame's contents are not what its format says.
    Malformed,
    /// Nobody knows when it was.
    NoTime,
}

/// Puts the raw messages of one receiver together.
#[derive(Clone, Debug, Default)]
pub struct SatelliteFollower {
    assembler: NavigationAssembler,
    collector: MsmCollector,
    locks: Locks,
    jumps: Option<u8>,
    /// Tag of the newest epoch of a receiver that knows the time.
    newest: Option<GpsTime>,
    /// Words that came before any time was known.
    early: Vec<NavigationWords>,
}

impl SatelliteFollower {
    /// Takes what a message says. `about`: GPS time, right to some hours, by whoever else knows it.
    pub fn take(
        &mut self,
        reading: &RawReading,
        about: Option<GpsTime>,
    ) -> Vec<Result<SatelliteNews, WordsFault>> {
        match reading {
            RawReading::Measured { epoch, is_dated, jumps } => {
                let told = self.measured(epoch, *is_dated, *jumps);
                let early = std::mem::take(&mut self.early);
                let early = early.iter().flat_map(|words| self.words(words, about)).collect();
                [early, vec![Ok(told)]].concat()
            }
            RawReading::Words(words, received) => self.words(words, received.or(about)),
            RawReading::Rtcm(frame) => self.rtcm(frame, about),
        }
    }

    fn measured(
        &mut self,
        epoch: &SatelliteEpoch,
        is_dated: bool,
        jumps: Option<u8>,
    ) -> SatelliteNews {
        if is_dated {
            self.newest = Some(epoch.tag);
        }
        if let Some(leap_seconds) = epoch.leap_seconds {
            self.set_leap_seconds(leap_seconds);
        }
        let before = self.jumps;
        self.jumps = jumps.or(before);
        let was_set = jumps.zip(before).is_some_and(|(now, before)| now != before);
        let clock_reset = epoch.clock_reset || was_set;
        SatelliteNews::Epoch {
            epoch: self.tidied(SatelliteEpoch { clock_reset, ..epoch.clone() }),
            is_dated,
        }
    }

    /// Receivers tell signals in any order, and a bad one tells one of them twice.
    fn tidied(&mut self, mut epoch: SatelliteEpoch) -> SatelliteEpoch {
        epoch.signals.sort_by_key(|signal| (signal.satellite, signal.signal));
        epoch.signals.dedup_by_key(|signal| (signal.satellite, signal.signal));
        self.locks.mark(&mut epoch);
        epoch
    }

    fn words(
        &mut self,
        words: &NavigationWords,
        received: Option<GpsTime>,
    ) -> Vec<Result<SatelliteNews, WordsFault>> {
        let Some(received) = received.or(self.newest) else {
            if self.early.len() == WAITING {
                return vec![Err(WordsFault::NoTime)];
            }
            self.early.push(words.clone());
            return Vec::new();
        };
        match self.assembler.take(words, received) {
            Ok(told) => told.into_iter().map(|told| Ok(self.broadcast(told))).collect(),
            Err(refusal) => vec![Err(WordsFault::Words(words.satellite, refusal))],
        }
    }

    fn broadcast(&mut self, told: Broadcast) -> SatelliteNews {
        if let Broadcast::LeapSeconds(leap_seconds) = told {
            self.set_leap_seconds(leap_seconds);
        }
        SatelliteNews::Broadcast(told)
    }

    fn set_leap_seconds(&mut self, leap_seconds: i8) {
        self.assembler.set_leap_seconds(leap_seconds);
        self.collector.set_leap_seconds(leap_seconds);
    }

    fn rtcm(
        &mut self,
        frame: &[u8],
        about: Option<GpsTime>,
    ) -> Vec<Result<SatelliteNews, WordsFault>> {
        let Some(received) = about.or(self.newest) else { return vec![Err(WordsFault::NoTime)] };
        let Ok(corrections) = self.collector.take(frame, received) else {
            return vec![Err(WordsFault::Malformed)];
        };
        let news = corrections.into_iter().filter_map(|told| match told {
            Correction::Epoch(epoch) => {
                Some(SatelliteNews::Epoch { epoch: self.tidied(epoch), is_dated: false })
            }
            Correction::Record(record) => Some(SatelliteNews::Broadcast(Broadcast::Record(record))),
            Correction::Base(_) => None,
        });
        news.map(Ok).collect()
    }
}
