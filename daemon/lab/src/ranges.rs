//! Raw GNSS of a voyage as messages for the engine.

use std::collections::VecDeque;
use std::str::FromStr;
use std::sync::Arc;

use insd_base::satellites::SatelliteEpoch;
use insd_base::{GpsTime, Message, Received, RtkEpoch, SatelliteId, Source, Time};
use insd_gnss::{Context, Guess, Ranged, Ranging, RtkLink};

/// What is made of GNSS.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum GnssUse {
    /// Fixes: those of the receiver.
    Loose,
    /// Ranges of each satellite, from raw GNSS.
    Tight,
    /// Nothing.
    None,
}

/// A stretch of time in which only so many satellites are left, those that stand highest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SatelliteMask {
    from: f64,
    to: f64,
    left: usize,
}

impl SatelliteMask {
    /// Whether at a time of a voyage fewer satellites are left than a fix takes.
    #[must_use]
    pub fn leaves_no_fix(&self, time: Time) -> bool {
        self.left < 4 && (self.from..self.to).contains(&time.as_seconds())
    }
}

impl FromStr for SatelliteMask {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || {
            "expected FROM..TO:N with FROM < TO in seconds and N satellites, for example 300..360:3"
                .to_owned()
        };
        let (span, left) = text.split_once(':').ok_or_else(expected)?;
        let (from, to) = span.split_once("..").ok_or_else(expected)?;
        let seconds = |text| crate::commands::seconds(text).map_err(|_| expected());
        let (from, to) = (seconds(from)?, seconds(to)?);
        let left = left.parse().map_err(|_| expected())?;
        if from < to { Ok(SatelliteMask { from, to, left }) } else { Err(expected()) }
    }
}

/// The ranges of each epoch of a receiver and the epochs of a base, with what they come to against each other, in the order in which they are received, for a
/// voyage that starts at an instant of GPS time.
#[must_use]
pub fn messages(
    context: &Context,
    epochs: impl Iterator<Item = SatelliteEpoch>,
    start: GpsTime,
    masks: &[SatelliteMask],
    base: &[Received],
) -> VecDeque<Received> {
    let mut ranging = Ranging::default();
    let mut link = RtkLink::default();
    let mut base = base.iter().peekable();
    let mut highest: Vec<SatelliteId> = Vec::new();
    let mut messages = VecDeque::new();
    for mut epoch in epochs {
        let seconds = epoch.tag.since(start).as_seconds();
        let mask = masks.iter().find(|mask| (mask.from..mask.to).contains(&seconds));
        if let Some(mask) = mask {
            let left = &highest[..highest.len().min(mask.left)];
            epoch.signals.retain(|signal| left.contains(&signal.satellite));
        }
        let ranged = ranging.take(context, &epoch, Guess::default());
        if mask.is_none() {
            highest = by_elevation(&ranged);
        }
        let told = message(&epoch, ranged, start);
        while let Some(next) = base.next_if(|next| next.receipt <= told.receipt) {
            let Message::Base(of_base) = &next.message else { continue };
            messages.push_back(next.clone());
            messages.extend(link.hear_base(context, of_base).map(|rtk| against(next.receipt, rtk)));
        }
        let (receipt, time) = (told.receipt, told.message.time());
        messages.push_back(told);
        let rtk = link.hear_rover(context, &epoch, time);
        messages.extend(rtk.into_iter().map(|rtk| against(receipt, rtk)));
    }
    messages.extend(base.cloned());
    messages
}

fn against(receipt: Time, told: RtkEpoch) -> Received {
    Received { receipt, source: Source::Gnss(0), message: Message::Rtk(told) }
}

fn by_elevation(ranged: &Ranged) -> Vec<SatelliteId> {
    let mut all: Vec<_> = ranged.ranges.iter().collect();
    all.sort_by(|a, b| b.elevation.total_cmp(&a.elevation));
    all.into_iter().map(|range| range.satellite).collect()
}

fn message(epoch: &SatelliteEpoch, ranged: Ranged, start: GpsTime) -> Received {
    let at = |instant: GpsTime| Time::START + instant.since(start);
    let (receipt, time) = (at(epoch.tag), at(ranged.sampled));
    Received {
        receipt: receipt.max(time),
        source: Source::Gnss(0),
        message: Message::Ranges(Arc::new(ranged.told(time))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_fewer_than_four_satellites_there_is_no_fix() {
        let mask = |left| SatelliteMask { from: 300.0, to: 360.0, left };
        let at = Time::from_seconds;
        assert!(mask(3).leaves_no_fix(at(300.0)) && !mask(4).leaves_no_fix(at(300.0)));
        assert!(!mask(3).leaves_no_fix(at(360.0)) && !mask(3).leaves_no_fix(at(299.9)));
    }

    #[test]
    fn a_mask_is_read_and_one_that_is_none_says_what_was_expected() {
        let mask: SatelliteMask = "300..360.5:3".parse().unwrap();
        assert_eq!(mask, SatelliteMask { from: 300.0, to: 360.5, left: 3 });
        for wrong in ["", "300:3", "360..300:3", "300..360", "300..360:-1", "a..b:c"] {
            assert!(wrong.parse::<SatelliteMask>().unwrap_err().contains("300..360:3"), "{wrong}");
        }
    }
}
