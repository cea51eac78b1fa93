//! Statistics of one device of NMEA 2000, and of one identifier of other frames.

use std::collections::BTreeMap;

use insd_base::{CanFrame, Time};
use insd_n2k::groups::ProductInfo;
use insd_n2k::pgn::{self, Group as _, Known};
use insd_n2k::{Assembled, Name, class_name, function_name, manufacturer_name};

use super::report::{DeviceReport, GroupReport, IdReport};
use crate::sniff::message::Intervals;

/// Groups of a device that are told apart.
const GROUPS: usize = 64;
/// Groups that the sensors of NMEA 2000 consist of (`insd_intake`); what else is understood is shown.
const USED: [u32; 11] = [
    126_992, 127_250, 127_257, 128_259, 129_025, 129_026, 129_029, 129_033, 129_539, 129_542,
    130_578,
];
/// Former addresses that are kept.
const ADDRESSES: usize = 8;

/// What one device has sent.
#[derive(Clone, Debug, Default)]
pub(super) struct Device {
    pub(super) name: Option<Name>,
    product: Option<ProductInfo>,
    before: Vec<u8>,
    groups: BTreeMap<u32, Group>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Group {
    count: u64,
    refused: u64,
    intervals: Intervals,
}

/// What came under one identifier.
#[derive(Clone, Debug)]
pub(super) struct Identifier {
    count: u64,
    intervals: Intervals,
    last: CanFrame,
}

impl Device {
    /// Another message. Gives whether it could be told apart.
    pub(super) fn add(&mut self, assembled: &Assembled) -> bool {
        let message = &assembled.message;
        if message.pgn == ProductInfo::PGN
            && let Ok(product) = ProductInfo::read(&message.data)
        {
            self.product = Some(product);
        }
        if !self.groups.contains_key(&message.pgn) && self.groups.len() == GROUPS {
            return false;
        }
        let group = self.groups.entry(message.pgn).or_default();
        group.count += 1;
        group.refused += u64::from(matches!(Known::read(message.pgn, &message.data), Some(Err(_))));
        group.intervals.add(assembled.begun);
        true
    }

    /// The device was at this address before.
    pub(super) fn moved_from(&mut self, address: u8) {
        if self.before.len() < ADDRESSES && !self.before.contains(&address) {
            self.before.push(address);
        }
    }

    pub(super) fn report(&self, address: u8, now: Option<Time>) -> DeviceReport {
        let parts = self.name.map(Name::parts);
        let product = self.product.as_ref();
        let text = |text: &str| (!text.trim().is_empty()).then(|| text.trim().to_owned());
        DeviceReport {
            address,
            name: self.name.map(|name| name.to_string()),
            manufacturer: parts.map(|parts| {
                let code = parts.manufacturer;
                manufacturer_name(code).map_or_else(|| format!("maker {code}"), str::to_owned)
            }),
            function: parts.and_then(|parts| {
                let name = function_name(parts.class, parts.function).or(class_name(parts.class));
                name.map(str::to_owned)
            }),
            instance: parts.map(|parts| parts.instance()),
            model: product.and_then(|product| text(&product.model)),
            software: product.and_then(|product| text(&product.software)),
            serial: product.and_then(|product| text(&product.serial)),
            addresses_before: self.before.clone(),
            groups: self.groups.iter().map(|(pgn, group)| group.report(*pgn, now)).collect(),
        }
    }
}

impl Group {
    fn report(&self, pgn: u32, now: Option<Time>) -> GroupReport {
        let intervals = now.map(|_| &self.intervals);
        GroupReport {
            pgn,
            title: pgn::name(pgn),
            count: self.count,
            rate_hz: intervals.and_then(Intervals::rate),
            jitter_ms: intervals.and_then(Intervals::std).map(|std| std * 1e3),
            age_s: now.and_then(|now| self.intervals.age(now)),
            used: USED.contains(&pgn),
            refused: self.refused,
        }
    }
}

impl Identifier {
    pub(super) fn new(frame: CanFrame) -> Self {
        Identifier { count: 0, intervals: Intervals::default(), last: frame }
    }

    pub(super) fn add(&mut self, frame: &CanFrame, now: Time) {
        self.count += 1;
        self.intervals.add(now);
        self.last = *frame;
    }

    pub(super) fn report(&self, timed: bool) -> IdReport {
        let intervals = timed.then_some(&self.intervals);
        let digits = self.last.data().iter().map(|byte| format!("{byte:02X}"));
        IdReport {
            id: self.last.id().to_string(),
            count: self.count,
            rate_hz: intervals.and_then(Intervals::rate),
            jitter_ms: intervals.and_then(Intervals::std).map(|std| std * 1e3),
            last: digits.collect::<Vec<_>>().join(" "),
        }
    }
}
