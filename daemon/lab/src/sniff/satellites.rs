//! Satellites and signals of a receiver that sends raw messages.

use std::collections::{BTreeMap, BTreeSet};

use insd_base::satellites::{Constellation, SatelliteId, SignalCode};
use insd_base::{SatelliteEpoch, Stamp};
use insd_gnss::Ephemerides;
use insd_intake::satellites::{RawReading, SatelliteFollower, SatelliteNews};
use insd_wire::gnss::navigation::Broadcast;
use insd_wire::stream::Protocol;

use super::report::{ConstellationReport, SatelliteReport};

/// What the raw messages of one protocol tell.
#[derive(Clone, Debug, Default)]
pub(super) struct Satellites {
    follower: SatelliteFollower,
    epochs: u64,
    refused: u64,
    seen: BTreeMap<SatelliteId, Seen>,
    orbits: Ephemerides,
    has_ionosphere: bool,
}

/// What was seen of one satellite.
#[derive(Clone, Debug, Default)]
struct Seen {
    signals: BTreeSet<SignalCode>,
    /// Least and greatest, dB Hz.
    densities: Option<(f64, f64)>,
    has_orbit: bool,
}

fn name(constellation: Constellation) -> &'static str {
    match constellation {
        Constellation::Gps => "GPS",
        Constellation::Glonass => "GLONASS",
        Constellation::Galileo => "Galileo",
        Constellation::BeiDou => "BeiDou",
        Constellation::Qzss => "QZSS",
        Constellation::Navic => "NavIC",
        Constellation::Sbas => "SBAS",
    }
}

impl Satellites {
    /// Takes a frame. What it says of times is right as far as the receiver's or the computer's clock is.
    pub(super) fn take(&mut self, protocol: Protocol, stamp: &Stamp, frame: &[u8]) {
        let Some(reading) = RawReading::of_frame(protocol, frame) else { return };
        // words are dated by the receiver's own epochs, which a file's time of reading is not
        let about = (protocol == Protocol::Rtcm).then(|| stamp.system.to_gps());
        for told in self.follower.take(&reading, about) {
            match told {
                Ok(SatelliteNews::Epoch { epoch, .. }) => self.epoch(&epoch),
                Ok(SatelliteNews::Broadcast(told)) => self.broadcast(told),
                Err(_) => self.refused += 1,
            }
        }
    }

    fn epoch(&mut self, epoch: &SatelliteEpoch) {
        self.epochs += 1;
        for signal in &epoch.signals {
            let seen = self.seen.entry(signal.satellite).or_default();
            seen.signals.insert(signal.signal);
            if let Some(density) = signal.cn0 {
                let (least, greatest) = seen.densities.unwrap_or((density, density));
                seen.densities = Some((least.min(density), greatest.max(density)));
            }
        }
    }

    fn broadcast(&mut self, told: Broadcast) {
        match told {
            Broadcast::Record(record) if self.orbits.insert(record).is_ok() => {
                self.seen.entry(record.satellite()).or_default().has_orbit = true;
            }
            Broadcast::Record(_) => self.refused += 1,
            Broadcast::Ionosphere(_) => self.has_ionosphere = true,
            Broadcast::LeapSeconds(_) => {}
        }
    }

    /// What is known; `None` where nothing raw came.
    pub(super) fn report(&self) -> Option<SatelliteReport> {
        let of = |constellation: Constellation| {
            let own = |(id, seen): &(&SatelliteId, &Seen)| {
                id.constellation == constellation && !seen.signals.is_empty()
            };
            let seen: Vec<&Seen> = self.seen.iter().filter(own).map(|(_, seen)| seen).collect();
            let signals: BTreeSet<_> = seen.iter().flat_map(|own| &own.signals).collect();
            let densities = seen.iter().filter_map(|own| own.densities);
            let densities = densities.reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)));
            ConstellationReport {
                constellation: name(constellation).to_owned(),
                satellites: seen.len(),
                signals: signals.iter().map(ToString::to_string).collect(),
                least_dbhz: densities.map(|(least, _)| least),
                greatest_dbhz: densities.map(|(_, greatest)| greatest),
                orbits: seen.iter().filter(|own| own.has_orbit).count(),
            }
        };
        let constellations = Constellation::ALL.into_iter().map(of);
        let constellations: Vec<_> = constellations.filter(|own| own.satellites > 0).collect();
        (self.epochs + self.refused > 0 || self.has_ionosphere).then_some(SatelliteReport {
            epochs: self.epochs,
            constellations,
            ionosphere: self.has_ionosphere,
            refused: self.refused,
        })
    }
}
