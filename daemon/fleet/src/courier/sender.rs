//! Sends: first the state as it is now, then alerts, then history from its oldest record on, with one message in
//! flight. On a link of 2 kB/s anything more would only queue up before it.

use std::sync::PoisonError;

use insd_base::{Span, Time};

use super::clerk::Clerk;
use super::status::{FleetStatus, Shared};
use crate::budget::{ByteBudget, Purse};
use crate::link::{Link, LinkEvent};
use crate::payload::{self, FleetMessage};
use crate::plan::FleetPlan;
use crate::spool::{SpoolBatch, SpoolClass};
use crate::watch::Interval;

/// First and longest time between two calls.
const AGAIN: (Span, Span) = (Span::from_nanos(1_000_000_000), Span::from_nanos(60_000_000_000));
/// Time after which a message that nobody acknowledges is given up, with its connection.
const PATIENCE: Span = Span::from_nanos(120_000_000_000);
/// Time after which something is tried again that the broker did not take, or for which it has nobody.
const HOLD: Span = Span::from_nanos(60_000_000_000);

/// Heads and properties of a message, bytes.
const PROPERTIES: usize = 90;

/// What is in flight.
#[derive(Debug)]
struct Flight {
    since: Time,
    bytes: usize,
    /// `None` for the state, which is not sent again.
    batch: Option<SpoolBatch>,
}

/// The sender.
pub(super) struct Sender {
    /// Name of the fleet, for the journal.
    name: String,
    status: Shared,
    budget: ByteBudget,
    link: Option<Link>,
    is_up: bool,
    flight: Option<Flight>,
    state: Interval,
    gathered: Interval,
    /// Not called again before this.
    call_after: Time,
    wait: Span,
    /// Nothing of the spool is sent before this.
    hold_until: Time,
}

impl Sender {
    pub(super) fn new(plan: &FleetPlan, status: Shared) -> Self {
        Sender {
            name: plan.name.clone(),
            status,
            budget: ByteBudget::new(plan.budget),
            link: None,
            is_up: false,
            flight: None,
            state: Interval::new(plan.state),
            gathered: Interval::new(Some(plan.gather)),
            call_after: Time::START,
            wait: AGAIN.0,
            hold_until: Time::START,
        }
    }

    /// What the broker says next; never anything without a connection.
    pub(super) async fn event(&mut self) -> LinkEvent {
        match &mut self.link {
            Some(link) => link.event().await,
            None => std::future::pending().await,
        }
    }

    /// Calls the broker when it is time, and gives up what is in flight for too long.
    pub(super) fn look(&mut self, plan: &FleetPlan, now: Time) {
        if self.flight.as_ref().is_some_and(|own| now - own.since > PATIENCE) {
            self.down(now, "the broker acknowledges nothing");
        }
        if self.link.is_none() && now >= self.call_after {
            match Link::open(&plan.broker) {
                Ok(link) => self.link = Some(link),
                Err(fault) => self.down(now, &fault),
            }
        }
    }

    pub(super) fn hear(&mut self, event: LinkEvent, clerk: &mut Clerk, now: Time) {
        match event {
            LinkEvent::Up => {
                self.is_up = true;
                self.wait = AGAIN.0;
                tracing::info!(fleet = self.name, "the broker answers");
                self.with_status(|status| (status.is_connected, status.link_fault) = (true, None));
            }
            LinkEvent::Taken { is_wanted } => self.taken(is_wanted, clerk, now),
            LinkEvent::Refused(why) => {
                self.flight = None;
                self.hold(now, &format!("the broker does not take it: {why}"));
            }
            LinkEvent::Down(why) => self.down(now, &why),
        }
    }

    fn taken(&mut self, is_wanted: bool, clerk: &mut Clerk, now: Time) {
        let Some(flight) = self.flight.take() else { return };
        match flight.batch {
            // the broker would keep nothing of it
            Some(_) if !is_wanted => {
                return self.hold(now, "nobody ashore has asked the broker for it yet");
            }
            Some(batch) => clerk.acknowledge(&batch),
            // the broker keeps it for whoever comes
            None => {}
        }
        self.with_status(|status| {
            status.messages += 1;
            status.bytes += flight.bytes as u64;
            status.link_fault = None;
        });
    }

    /// Sends nothing of the spool for a while.
    fn hold(&mut self, now: Time, why: &str) {
        self.hold_until = now + HOLD;
        self.with_status(|status| {
            if status.link_fault.as_deref() != Some(why) {
                tracing::warn!(fleet = self.name, why, "the fleet is told nothing for now");
            }
            status.link_fault = Some(why.to_owned());
        });
    }

    fn down(&mut self, now: Time, why: &str) {
        (self.link, self.flight, self.is_up) = (None, None, false);
        self.call_after = now + self.wait;
        self.wait = Span::from_nanos(self.wait.as_nanos() * 2).min(AGAIN.1);
        self.with_status(|status| {
            if status.is_connected || status.link_fault.is_none() {
                tracing::warn!(
                    fleet = self.name,
                    why,
                    "the broker cannot be reached: what is to be told waits"
                );
            }
            (status.is_connected, status.link_fault) = (false, Some(why.to_owned()));
        });
    }

    /// Sends the next message, if it may.
    pub(super) fn send(&mut self, plan: &FleetPlan, clerk: &mut Clerk, now: Time) {
        if !self.is_up || self.flight.is_some() {
            return;
        }
        if self.state.is_due(now)
            && self.budget.allows(Purse::State, now)
            && let Some((key, told)) = clerk.state(now)
        {
            self.state.done(now);
            return self.launch(payload::state(plan, key, told), None, now);
        }
        if now < self.hold_until || !self.budget.allows(Purse::Spool, now) {
            return;
        }
        let Some(class) = self.class(plan, clerk, now) else { return };
        if let Some(batch) = clerk.batch(class, plan) {
            if class == SpoolClass::History {
                self.gathered.done(now);
            }
            self.launch(payload::batch(plan, &batch), Some(batch), now);
        }
    }

    /// The class that is to be sent from: alerts at once, history when enough has come together.
    fn class(&self, plan: &FleetPlan, clerk: &Clerk, now: Time) -> Option<SpoolClass> {
        if clerk.waiting(SpoolClass::Alerts) > 0 {
            return Some(SpoolClass::Alerts);
        }
        let waiting = clerk.waiting(SpoolClass::History) as f64;
        let enough = plan.history.map_or(1.0, |own| plan.gather.as_seconds() / own.as_seconds());
        let is_due = self.gathered.is_due(now) || waiting > enough + 1.0;
        (waiting > 0.0 && is_due).then_some(SpoolClass::History)
    }

    fn launch(&mut self, message: FleetMessage, batch: Option<SpoolBatch>, now: Time) {
        let Some(link) = &self.link else { return };
        let bytes = message.payload.len();
        let purse = if batch.is_some() { Purse::Spool } else { Purse::State };
        // what the broker is told beside the payload: topic, properties, heads
        self.budget.spend(purse, bytes + message.topic.len() + PROPERTIES);
        match link.send(message) {
            Ok(()) => self.flight = Some(Flight { since: now, bytes, batch }),
            Err(why) => self.down(now, &why),
        }
    }

    /// Says farewell, if there is anybody to say it to.
    pub(super) fn close(&self) -> bool {
        self.link.as_ref().filter(|_| self.is_up).inspect(|link| link.close()).is_some()
    }

    fn with_status(&self, change: impl FnOnce(&mut FleetStatus)) {
        change(&mut self.status.lock().unwrap_or_else(PoisonError::into_inner));
    }
}
