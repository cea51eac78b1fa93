//! Raw GNSS of a voyage as messages for the engine.

use std::collections::VecDeque;
use std::str::FromStr;
use std::sync::Arc;

use insd_base::satellites::SatelliteEpoch;
use insd_base::{GpsTime, Message, Received, RtkEpoch, SatelliteId, Source, Time};
use insd_gnss::{ArrayRanged, ArrayRanging, Context, PhaseRates, Ranged, RtkLink, TOGETHER, Turns};

/// What is made of GNSS.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum GnssUse {
    /// Fixes: those of the receiver.
    Loose,
    /// Ranges of each satellite, from raw GNSS.
    Tight,
    /// What the phases of each satellite change by, as range rates in the middle between two epochs, and the place as fixes tell it at the start: the
    /// berthing source's own method, beside which ours is held.
    PhaseRates,
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

/// What a receiver and a base measure on a voyage, and what each epoch comes to when its time has come.
#[derive(Debug)]
pub struct Epochs {
    /// Start of the voyage.
    pub start: GpsTime,
    /// What is known of orbits, the air and the receiver.
    pub context: Context,
    /// Of each antenna, in their order.
    pub rover: Vec<VecDeque<SatelliteEpoch>>,
    /// How the antennas stand.
    pub array: ArrayRanging,
    /// Of the base, in their order.
    pub base: VecDeque<Received>,
    /// Which satellites are taken away.
    pub masks: Vec<SatelliteMask>,
}

/// The ranges of each epoch of a receiver and the epochs of a base, with what they come to against each other, in the order in which they are received.
#[derive(Debug)]
pub struct RangeMaker {
    epochs: Epochs,
    link: RtkLink,
    highest: Vec<SatelliteId>,
    turns: Turns,
    ready: VecDeque<Received>,
    rates: Option<PhaseRates>,
}

impl RangeMaker {
    /// Of these epochs.
    #[must_use]
    pub fn new(epochs: Epochs) -> Self {
        RangeMaker {
            epochs,
            link: RtkLink::default(),
            highest: Vec::new(),
            turns: Turns::default(),
            ready: VecDeque::new(),
            rates: None,
        }
    }

    /// The same, with nothing but what phases change by.
    #[must_use]
    pub fn as_rates(self) -> Self {
        RangeMaker { rates: Some(PhaseRates::default()), ..self }
    }

    /// How the ship turns matters to phases.
    pub fn hear(&mut self, received: &Received) {
        if let Message::Imu(sample) = &received.message {
            self.turns.hear(sample);
        }
    }

    /// The next message that is received up to an instant.
    pub fn next_until(&mut self, receipt: Time) -> Option<Received> {
        while let Some(epochs) = self.epochs.next_until(receipt) {
            self.take(epochs);
        }
        let is_of_base = self.epochs.base.front().is_some_and(|next| next.receipt <= receipt);
        if self.ready.is_empty() && is_of_base {
            self.take_base();
        }
        self.ready.pop_front_if(|first| first.receipt <= receipt)
    }

    /// All messages of a voyage in the order of their receipt, with what else is received.
    #[must_use]
    pub fn among(mut self, others: Vec<Received>) -> Vec<Received> {
        let mut all = Vec::with_capacity(others.len() + self.epochs.rover.len());
        for received in others {
            all.extend(std::iter::from_fn(|| self.next_until(received.receipt)));
            self.hear(&received);
            all.push(received);
        }
        all
    }

    fn take(&mut self, mut epochs: Vec<Option<SatelliteEpoch>>) {
        let Some(tag) = epochs.iter().flatten().map(|epoch| epoch.tag).min() else { return };
        let seconds = tag.since(self.epochs.start).as_seconds();
        let mask = self.epochs.masks.iter().find(|mask| (mask.from..mask.to).contains(&seconds));
        let is_masked = mask.is_some();
        if let Some(mask) = mask {
            let left = &self.highest[..self.highest.len().min(mask.left)];
            for epoch in epochs.iter_mut().flatten() {
                epoch.signals.retain(|signal| left.contains(&signal.satellite));
            }
        }
        let heard: Vec<_> = epochs.iter().map(Option::as_ref).collect();
        let (context, array) = (&self.epochs.context, &mut self.epochs.array);
        let ArrayRanged { ranged, compass } = array.take(context, &heard, None, &self.turns);
        let Some((ranged, first)) = ranged.zip(heard.into_iter().flatten().next()) else { return };
        if !is_masked {
            self.highest = by_elevation(&ranged);
        }
        let told = message(first, ranged, self.epochs.start);
        let (receipt, time) = (told.receipt, told.message.time());
        while self.epochs.base.front().is_some_and(|next| next.receipt <= receipt) {
            self.take_base();
        }
        let source = told.source;
        let told = self.by_method(told);
        self.ready.extend(told);
        self.ready.extend(compass.map(|compass| {
            let message = Message::Compass(Arc::new(compass.at(time)));
            Received { receipt, source, message }
        }));
        let rtk = self.link.hear_rover(&self.epochs.context, first, time);
        self.ready.extend(rtk.into_iter().map(|rtk| against(receipt, rtk)));
    }

    /// Ranges as they are, or as rates.
    fn by_method(&mut self, received: Received) -> Option<Received> {
        let (Some(rates), Message::Ranges(told)) = (&mut self.rates, &received.message) else {
            return Some(received);
        };
        let message = Message::Ranges(Arc::new(rates.take(told)?));
        Some(Received { message, ..received })
    }

    fn take_base(&mut self) {
        let Some(next) = self.epochs.base.pop_front() else { return };
        let Message::Base(of_base) = &next.message else { return };
        let rtk = self.link.hear_base(&self.epochs.context, of_base);
        let receipt = next.receipt;
        self.ready.push_back(next);
        self.ready.extend(rtk.map(|rtk| against(receipt, rtk)));
    }
}

impl Epochs {
    /// The epochs of all antennas that are of the next instant, if that is none after a receipt.
    fn next_until(&mut self, receipt: Time) -> Option<Vec<Option<SatelliteEpoch>>> {
        let first = self.rover.iter().filter_map(|own| Some(own.front()?.tag)).min()?;
        let is_due = Time::START + first.since(self.start) <= receipt;
        let of_instant =
            |epoch: &mut SatelliteEpoch| epoch.tag.since(first).as_seconds() < TOGETHER;
        is_due.then(|| self.rover.iter_mut().map(|own| own.pop_front_if(of_instant)).collect())
    }
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
