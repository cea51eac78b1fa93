//! Tells what becomes of a port: bytes and frames with their stamp, and each change of state once.

use std::net::IpAddr;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use insd_base::input::{Arrival, Input, PortId, PortState, Pulse, Stamp};
use insd_base::{BusEvent, CanFrame, Closed, Sent, Span, Time};

use super::clock::Clock;
use super::doorman::Doorman;
use super::hosts::Hosts;
use super::queue::Queue;

/// Least time between two reports of an overrun.
const OVERRUN_PERIOD: Span = Span::from_nanos(1_000_000_000);

/// How long a port sleeps when nothing is due.
const REST: Duration = Duration::from_secs(60);

/// The last state of a port that was told.
pub(crate) type Shown = Arc<Mutex<Option<PortState>>>;

/// The voice of one port.
#[derive(Clone)]
pub(crate) struct Teller {
    port: PortId,
    clock: Arc<dyn Clock>,
    queue: Queue,
    /// The silence that is told; `None` for a port that is not expected to speak.
    patience: Option<Span>,
    /// The last of open, absent and lost that was told.
    told: Option<PortState>,
    /// The last state that was told, for others to look at.
    shown: Shown,
    /// When it was opened, if it was since the last [`Teller::begin`].
    opened: Option<Time>,
    /// When it was last heard, or opened; `None` while it is not open or silent.
    heard: Option<Time>,
    silent: bool,
    /// Bytes dropped and not told.
    untold: u64,
    overrun_told: Option<Time>,
    /// Hosts whose commands are obeyed, where commands are listened to.
    commands_from: Option<Hosts>,
    doorman: Doorman,
}

impl Teller {
    /// The voice of a port whose silence is told after the patience. Without patience it is one that
    /// is only written to: what it says is nobody's business.
    pub(crate) fn new(
        port: PortId,
        clock: Arc<dyn Clock>,
        queue: Queue,
        patience: Option<Span>,
    ) -> Self {
        Teller {
            port,
            clock,
            queue,
            patience,
            told: None,
            shown: Shown::default(),
            opened: None,
            heard: None,
            silent: false,
            untold: 0,
            overrun_told: None,
            commands_from: None,
            doorman: Doorman::default(),
        }
    }

    /// The same, telling of all bytes of hosts on the network who sent them and whether that is one of
    /// these.
    pub(crate) fn commanded_by(mut self, commands_from: Option<Hosts>) -> Self {
        self.commands_from = commands_from;
        self
    }

    /// Both clocks, now.
    pub(crate) fn now(&self) -> Stamp {
        self.clock.now()
    }

    /// The clock, for a task of its own.
    pub(crate) fn clock(&self) -> Arc<dyn Clock> {
        Arc::clone(&self.clock)
    }

    /// The last state that was told, for others to look at.
    pub(crate) fn shown(&self) -> Shown {
        Arc::clone(&self.shown)
    }

    /// An attempt to open begins.
    pub(crate) fn begin(&mut self) {
        self.opened = None;
    }

    /// It is open. Told once for the same words.
    pub(crate) fn open(&mut self, what: String) {
        let now = self.now();
        if self.opened.is_none() {
            self.opened = Some(now.monotonic);
            self.heard = self.patience.map(|_| now.monotonic);
            self.silent = false;
        }
        self.change(now, PortState::Open { what });
    }

    /// It could not be opened. Told once for the same reason.
    pub(crate) fn absent(&mut self, reason: String) {
        self.heard = None;
        self.change(self.now(), PortState::Absent { reason });
    }

    /// It was open and is gone.
    pub(crate) fn lost(&mut self, reason: String) {
        self.heard = None;
        self.change(self.now(), PortState::Lost { reason });
    }

    /// It has been read to its end.
    pub(crate) fn ended(&mut self) {
        self.heard = None;
        self.state(self.now(), PortState::Ended);
    }

    /// For how long it has been open since the last beginning.
    pub(crate) fn open_for(&self) -> Span {
        self.opened.map_or(Span::ZERO, |opened| self.now().monotonic - opened)
    }

    /// Whether its silence has been told.
    pub(crate) fn is_silent(&self) -> bool {
        self.silent
    }

    /// Bytes came.
    pub(crate) fn bytes(&mut self, stamp: Stamp, bytes: &[u8]) {
        if self.patience.is_some() && !bytes.is_empty() {
            self.speaks(stamp);
            self.push(stamp, Input::Bytes(bytes.to_vec()));
        }
        self.overrun(stamp);
    }

    /// Bytes came from a host on the network.
    pub(crate) fn bytes_of(&mut self, host: IpAddr, stamp: Stamp, bytes: &[u8]) {
        let Some(list) = &self.commands_from else { return self.bytes(stamp, bytes) };
        if self.patience.is_some() && !bytes.is_empty() {
            let (host, may_command) = (host.to_canonical().to_string(), list.contains(host));
            self.speaks(stamp);
            self.push(stamp, Input::Sent(Sent { host, may_command, bytes: bytes.to_vec() }));
        }
        self.overrun(stamp);
    }

    /// A host on the network was not let in.
    pub(crate) fn refuse(&mut self, host: IpAddr, why: Closed) {
        let now = self.now();
        if let Some(state) = self.doorman.refuse(host, why, now.monotonic) {
            self.push(now, Input::State(state));
        }
    }

    /// A frame came.
    pub(crate) fn frame(&mut self, stamp: Stamp, frame: CanFrame) {
        self.speaks(stamp);
        self.push(stamp, Input::Can(frame));
        self.overrun(stamp);
    }

    /// The controller of a CAN bus says something. That is no speaking: nobody may be on the bus.
    pub(crate) fn bus_event(&mut self, stamp: Stamp, event: BusEvent) {
        self.push(stamp, Input::Bus(event));
        self.overrun(stamp);
    }

    /// An edge came.
    pub(crate) fn pulse(&mut self, stamp: Stamp, pulse: Pulse) {
        self.speaks(stamp);
        self.push(stamp, Input::Pulse(pulse));
    }

    /// Waits until the consumer has room for more of this port.
    pub(crate) async fn room(&self) {
        self.queue.room(self.port).await;
    }

    /// How long nothing can be due. To be followed by a [`Teller::tick`].
    pub(crate) fn rest(&self) -> Duration {
        let now = self.now().monotonic;
        let until = |due: Time| Duration::from_nanos((due - now).as_nanos().max(0).unsigned_abs());
        let silence = self.heard.zip(self.patience).map(|(heard, patience)| heard + patience);
        let overrun = self.overrun_told.filter(|_| self.untold > 0);
        let overrun = overrun.map(|told| told + OVERRUN_PERIOD);
        let all = silence.into_iter().chain(overrun).chain(self.doorman.due_at());
        let next = all.map(until).min();
        // a millisecond more, so that it is due when the sleeper wakes
        next.map_or(REST, |wait| wait.min(REST) + Duration::from_millis(1))
    }

    /// Tells the silence, the overrun and the strangers that are due.
    pub(crate) fn tick(&mut self) {
        let now = self.now();
        self.overrun(now);
        while let Some(state) = self.doorman.next(now.monotonic) {
            self.push(now, Input::State(state));
        }
        let span = self.heard.map_or(Span::ZERO, |heard| now.monotonic - heard);
        if self.patience.is_some_and(|patience| span >= patience) {
            self.heard = None;
            self.silent = true;
            self.state(now, PortState::Silent { span });
        }
    }

    fn speaks(&mut self, stamp: Stamp) {
        if std::mem::take(&mut self.silent) {
            self.state(stamp, PortState::Speaking);
        }
        self.heard = Some(stamp.monotonic);
    }

    fn change(&mut self, stamp: Stamp, state: PortState) {
        if self.told.as_ref() != Some(&state) {
            self.told = Some(state.clone());
            self.state(stamp, state);
        }
    }

    fn overrun(&mut self, stamp: Stamp) {
        let due = |told: Time| stamp.monotonic - told >= OVERRUN_PERIOD;
        if self.untold > 0 && self.overrun_told.is_none_or(due) {
            self.overrun_told = Some(stamp.monotonic);
            let bytes = std::mem::take(&mut self.untold);
            self.state(stamp, PortState::Overrun { bytes });
        }
    }

    fn state(&mut self, stamp: Stamp, state: PortState) {
        *self.shown.lock().unwrap_or_else(PoisonError::into_inner) = Some(state.clone());
        self.push(stamp, Input::State(state));
    }

    fn push(&mut self, stamp: Stamp, input: Input) {
        self.untold += self.queue.push(Arrival { stamp, port: self.port, input });
    }
}

/// What was dropped last is told even if the port is stopped.
impl Drop for Teller {
    fn drop(&mut self) {
        self.overrun_told = None;
        self.overrun(self.now());
    }
}
