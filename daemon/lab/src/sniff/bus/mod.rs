//! Statistics of a CAN bus: which devices are on it, and what each of them sends.

mod device;
pub mod file;
pub mod report;
pub(super) mod suggestion;
#[cfg(test)]
mod tests;
pub(super) mod text;

use std::collections::BTreeMap;

use insd_base::{BusEvent, CanFrame, CanId, Stamp, Time};
use insd_n2k::{ADDRESS_CLAIM, Assembler, N2kId, NULL_ADDRESS, Roster};
use insd_output::n2k::BITS_PER_SECOND;

use super::tally::Tally;
use device::{Device, Identifier};
use report::BusReport;

/// Identifiers of other frames that are told apart.
const IDENTIFIERS: usize = 64;

/// What came on a bus.
#[derive(Clone, Debug, Default)]
pub(super) struct Bus {
    frames: u64,
    bits: u64,
    assembler: Assembler,
    roster: Roster,
    devices: BTreeMap<u8, Device>,
    others: BTreeMap<CanId, Identifier>,
    events: Tally,
    more: u64,
}

impl Bus {
    /// Another frame.
    pub(super) fn frame(&mut self, stamp: &Stamp, frame: &CanFrame) {
        let now = stamp.monotonic;
        self.frames += 1;
        self.bits += u64::from(frame.wire_bits());
        match N2kId::parse(frame.id()) {
            Some(_) => self.message(frame, now),
            None => self.other(frame, now),
        }
    }

    /// The controller said something.
    pub(super) fn event(&mut self, event: BusEvent) {
        let kind = match event {
            BusEvent::Active => "few errors again",
            BusEvent::Warning => "many errors",
            BusEvent::Passive => "error passive",
            BusEvent::BusOff => "bus off",
            BusEvent::Restarted => "on the bus again",
            BusEvent::Error { .. } => "error",
            BusEvent::Dropped { .. } => "frames dropped by the kernel",
        };
        self.events.add(kind);
    }

    fn message(&mut self, frame: &CanFrame, now: Time) {
        let Some(assembled) = self.assembler.take(frame, now) else { return };
        let address = assembled.message.source;
        if assembled.message.pgn == ADDRESS_CLAIM
            && let Some(change) = self.roster.learn(&assembled.message)
            && let Some(from) = change.from
            && let Some(mut moved) = self.devices.remove(&from)
        {
            moved.moved_from(from);
            self.devices.insert(address, moved);
        }
        if address >= NULL_ADDRESS {
            return;
        }
        let device = self.devices.entry(address).or_default();
        device.name = self.roster.name_at(address).or(device.name);
        self.more += u64::from(!device.add(&assembled));
    }

    fn other(&mut self, frame: &CanFrame, now: Time) {
        if !self.others.contains_key(&frame.id()) && self.others.len() == IDENTIFIERS {
            self.more += 1;
            return;
        }
        let own = self.others.entry(frame.id()).or_insert_with(|| Identifier::new(*frame));
        own.add(frame, now);
    }

    /// What is known at this time, or without time; `None` if not one frame came. `seconds` is how
    /// long it was listened to.
    pub(super) fn report(&self, now: Option<Time>, seconds: Option<f64>) -> Option<BusReport> {
        let per_second = |amount: f64| seconds.map(|seconds| amount / seconds);
        let devices = self.devices.iter().map(|(address, device)| device.report(*address, now));
        let others = self.others.values().map(|own| own.report(now.is_some()));
        let report = BusReport {
            frames: self.frames,
            frames_per_s: per_second(self.frames as f64),
            load: per_second(self.bits as f64 / BITS_PER_SECOND),
            broken: self.assembler.counts().incomplete(),
            events: self.events.sorted(),
            devices: devices.collect(),
            others: others.collect(),
            more: self.more,
        };
        (self.frames > 0 || !report.events.is_empty()).then_some(report)
    }
}
