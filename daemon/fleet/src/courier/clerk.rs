//! Writes down what is due: from the newest snapshot to the spool.

use std::io;
use std::sync::PoisonError;

use insd_base::{Span, Time, UtcTime};
use insd_web::Viewer;
use insd_web::snapshot::Snapshot;
use serde_json::{Map, Value, json};

use super::status::{FleetStatus, Shared};
use crate::key::{RecordKey, RunId};
use crate::plan::FleetPlan;
use crate::spool::{Spool, SpoolBatch, SpoolClass, SpoolRecord};
use crate::steady::SteadyUtc;
use crate::watch::{AlertWatch, Interval};
use crate::{payload, told};

/// Time between two moments at which the history is made safe against a power cut.
const SYNC: Span = Span::from_nanos(10_000_000_000);
/// Time after which a spool that could not be opened is tried again.
const AGAIN: Span = Span::from_nanos(5_000_000_000);
/// Records of a message at the most.
const MOST: usize = 400;
/// Bytes of text of a message that is sent as it is, and of one that is compressed to an eighth or less, at the most: some seconds
/// on a link of 2 kB/s.
const PLAIN: usize = 12 * 1024;
const PACKED: usize = 48 * 1024;

/// The clerk.
pub(super) struct Clerk {
    /// Name of the fleet, for the journal.
    name: String,
    viewer: Viewer,
    status: Shared,
    run: RunId,
    sequence: u64,
    /// `None` while it cannot be opened.
    spool: Option<Spool>,
    opened: Interval,
    synced: Interval,
    history: Interval,
    alerts: AlertWatch,
    /// Number of the newest snapshot, and when it was seen first.
    seen: (u64, Time),
    /// UTC as the ship knows it.
    utc: Option<UtcTime>,
    /// By which what waits grows too old.
    steady: SteadyUtc,
}

impl Clerk {
    pub(super) fn new(plan: &FleetPlan, viewer: Viewer, status: Shared) -> io::Result<Self> {
        Ok(Clerk {
            name: plan.name.clone(),
            viewer,
            status,
            run: RunId::drawn()?,
            sequence: 0,
            spool: None,
            opened: Interval::new(Some(AGAIN)),
            synced: Interval::new(Some(SYNC)),
            history: Interval::new(plan.history),
            alerts: AlertWatch::default(),
            seen: (0, Time::START),
            utc: None,
            steady: SteadyUtc::default(),
        })
    }

    /// Puts away what is due.
    pub(super) fn look(&mut self, plan: &FleetPlan, now: Time) {
        self.open(plan, now);
        if let Some(number) = self.viewer.look(|number, _| number).filter(|own| *own != self.seen.0)
        {
            self.seen = (number, now);
        }
        let is_due = self.history.is_due(now);
        let Some(alerts) = self.viewer.look(|_, own| own.alerts.clone()) else { return };
        let changed = if plan.alerts { self.alerts.changes(&alerts) } else { Vec::new() };
        if is_due || !changed.is_empty() {
            let Some(snapshot) = self.snapshot(now) else { return };
            let utc = snapshot.time.utc.clone();
            for alert in &changed {
                let told = [("time", json!({ "utc": utc })), ("alert", told::alert(alert))];
                self.put(
                    SpoolClass::Alerts,
                    told.map(|(key, own)| (key.to_owned(), own)).into_iter().collect(),
                );
            }
            if is_due {
                self.history.done(now);
                self.put(SpoolClass::History, told::history(&snapshot));
            }
        }
        if self.synced.is_due(now) || !changed.is_empty() {
            self.synced.done(now);
            self.attempt(Spool::sync);
        }
        self.account();
    }

    /// The newest snapshot as it is to be shown now.
    fn snapshot(&mut self, now: Time) -> Option<Snapshot> {
        let age = (now - self.seen.1).as_seconds();
        let snapshot = self.viewer.look(|_, own| own.after(age))?;
        self.utc = snapshot.time.utc.as_deref().and_then(utc_of);
        if let Some(utc) = self.utc {
            self.steady.hear(now, utc);
        }
        Some(snapshot)
    }

    /// The state as it is now, with a key of its own; `None` before the first word of the navigator.
    pub(super) fn state(&mut self, now: Time) -> Option<(RecordKey, Map<String, Value>)> {
        let told = told::state(&self.snapshot(now)?);
        Some((self.key(), told))
    }

    fn key(&mut self) -> RecordKey {
        self.sequence += 1;
        RecordKey { run: self.run, sequence: self.sequence }
    }

    fn put(&mut self, class: SpoolClass, told: Map<String, Value>) {
        let key = self.key();
        let record = SpoolRecord { key, utc: self.utc, text: payload::record(key.sequence, told) };
        if self.spool.is_none() {
            self.with_status(|own| own.losses.unwritten += 1);
        }
        // only what is put away shows that the disk takes it again
        if self.attempt(|spool| spool.append(class, &record)).is_some() {
            self.fail(None);
        }
    }

    /// The next records to send.
    pub(super) fn batch(&mut self, class: SpoolClass, plan: &FleetPlan) -> Option<SpoolBatch> {
        let expired = self
            .steady
            .utc()
            .zip(plan.expiry)
            .map(|(utc, span)| utc.plus(Span::from_nanos(-span.as_nanos())));
        let bytes = if plan.packs(class) { PACKED } else { PLAIN };
        self.attempt(|spool| spool.oldest(class, (MOST, bytes), expired)).flatten()
    }

    /// Records that wait in a class.
    pub(super) fn waiting(&self, class: SpoolClass) -> u64 {
        self.spool.as_ref().map_or(0, |spool| spool.waiting(class))
    }

    /// They are ashore.
    pub(super) fn acknowledge(&mut self, batch: &SpoolBatch) {
        self.attempt(|spool| spool.acknowledge(batch));
        self.account();
    }

    /// Makes everything safe.
    pub(super) fn close(&mut self) {
        self.attempt(Spool::sync);
    }

    fn open(&mut self, plan: &FleetPlan, now: Time) {
        if self.spool.is_some() || !self.opened.is_due(now) {
            return;
        }
        self.opened.done(now);
        match Spool::open(&plan.folder, plan.quota) {
            Ok(spool) => {
                let waiting: u64 = SpoolClass::ALL.iter().map(|own| spool.waiting(*own)).sum();
                let folder = plan.folder.display();
                tracing::info!(fleet = plan.name, %folder, waiting, "spool");
                self.spool = Some(spool);
                self.fail(None);
            }
            Err(fault) => self.fail(Some(&fault)),
        }
    }

    /// Does something with the spool; what goes wrong is told, and does no harm.
    fn attempt<R>(&mut self, work: impl FnOnce(&mut Spool) -> io::Result<R>) -> Option<R> {
        let outcome = work(self.spool.as_mut()?);
        outcome.inspect_err(|fault| self.fail(Some(fault))).ok()
    }

    fn fail(&self, fault: Option<&io::Error>) {
        let (told, fleet) = (fault.map(ToString::to_string), &self.name);
        self.with_status(|status| {
            match &told {
                Some(fault) if status.disk_fault.is_none() => {
                    tracing::error!(fleet, fault, "what waits for the fleet cannot be put away");
                }
                None if status.disk_fault.is_some() => {
                    tracing::info!(fleet, "the spool works again");
                }
                _ => {}
            }
            status.disk_fault = told;
        });
    }

    /// Tells how much waits, and what was lost.
    fn account(&self) {
        let Some(spool) = &self.spool else { return };
        let (losses, waiting) =
            (spool.losses(), SpoolClass::ALL.iter().map(|own| spool.waiting(*own)).sum());
        self.with_status(|status| (status.losses, status.waiting) = (losses, waiting));
    }

    fn with_status(&self, change: impl FnOnce(&mut FleetStatus)) {
        change(&mut self.status.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

fn utc_of(text: &str) -> Option<UtcTime> {
    let instant: jiff::Timestamp = text.parse().ok()?;
    i64::try_from(instant.as_nanosecond()).ok().map(UtcTime::from_nanos)
}
