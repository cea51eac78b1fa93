//! A snapshot as it leaves: each form is made once, when the first client asks for it, and shared by all.

use std::sync::OnceLock;

use axum::body::Bytes;
use serde::Serialize;

use crate::snapshot::{
    Alert, ShownAlignment, ShownDocking, ShownMode, ShownMotion, Snapshot, TimeInfo,
};

use super::metrics;

/// A snapshot and its forms.
#[derive(Debug)]
pub(super) struct Frame {
    number: u64,
    snapshot: Snapshot,
    json: OnceLock<Bytes>,
    whole: OnceLock<Bytes>,
    live: OnceLock<Bytes>,
    metrics: OnceLock<Bytes>,
}

/// What changes many times a second: the event `live`.
#[derive(Serialize)]
struct Live<'a> {
    version: u32,
    time: &'a TimeInfo,
    mode: &'a ShownMode,
    motion: &'a Option<ShownMotion>,
    docking: &'a Option<ShownDocking>,
    alignment: &'a Option<ShownAlignment>,
}

impl Frame {
    /// A snapshot as it is to be shown now, and its number.
    pub(super) fn new(number: u64, snapshot: Snapshot) -> Self {
        Frame {
            number,
            snapshot,
            json: OnceLock::new(),
            whole: OnceLock::new(),
            live: OnceLock::new(),
            metrics: OnceLock::new(),
        }
    }

    pub(super) fn number(&self) -> u64 {
        self.number
    }

    pub(super) fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }

    /// All of it as JSON.
    pub(super) fn json(&self) -> Bytes {
        self.json.get_or_init(|| json(self.snapshot()).into()).clone()
    }

    /// All of it as an event of the stream.
    pub(super) fn whole(&self) -> Bytes {
        self.whole.get_or_init(|| self.event("snapshot", &self.json())).clone()
    }

    /// What changes many times a second, as an event of the stream.
    pub(super) fn live(&self) -> Bytes {
        let Snapshot { version, time, mode, motion, docking, alignment, .. } = self.snapshot();
        let live = Live { version: *version, time, mode, motion, docking, alignment };
        self.live.get_or_init(|| self.event("live", &json(&live))).clone()
    }

    /// Whether a state differs from what it was in an earlier one: of the ship, a sensor, a port or an alert.
    pub(super) fn has_news_since(&self, earlier: &Frame) -> bool {
        let (now, before) = (self.snapshot(), earlier.snapshot());
        let alert = |one: &Alert| (one.id, one.instance, one.state);
        let berth = |own: &Snapshot| {
            own.docking.as_ref().map(|own| (own.berth.clone(), own.choice.clone()))
        };
        now.mode.name != before.mode.name
            || now
                .sensors
                .iter()
                .map(|one| one.state)
                .ne(before.sensors.iter().map(|one| one.state))
            || now.inputs.iter().map(|one| one.state).ne(before.inputs.iter().map(|one| one.state))
            || berth(now) != berth(before)
            || now.alerts.iter().map(alert).ne(before.alerts.iter().map(alert))
    }

    /// All of it as metrics.
    pub(super) fn metrics(&self) -> Bytes {
        self.metrics.get_or_init(|| metrics::text(self.snapshot()).into()).clone()
    }

    /// JSON has no line breaks of its own, so one line of data is enough.
    fn event(&self, name: &str, data: &[u8]) -> Bytes {
        let head = format!("id: {}\nevent: {name}\ndata: ", self.number());
        [head.as_bytes(), data, b"\n\n"].concat().into()
    }
}

/// What cannot be written as JSON does not occur in the model; if it did the answer would be empty.
pub(super) fn json(value: &impl Serialize) -> Vec<u8> {
    serde_json::to_vec(value).unwrap_or_default()
}
