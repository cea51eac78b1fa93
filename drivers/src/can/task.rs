//! The task of a CAN port: open, listen and speak, lose, wait, open again, for ever.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use insd_base::{BusEvent, CanFrame, Closed, PortId, Span, Stamp, Time};
use tokio::time::sleep;

use super::config::{CanConfig, CanFilter, CanTransport};
use super::gateway::{Calls, Datagrams};
use super::socket::Interface;
use super::speaker::{SharedSpeaker, Speaker};
use super::stream::{Adapter, Log};
use super::{CanBus, Heard, Opener, Sending};
use crate::ports::{Outcome, Pause, PortHandle, Surroundings, Teller, tell};

/// Frames that are sent before the bus is looked at again.
const BURST: usize = 16;

/// How long nothing is sent after the controller has left the bus, if nothing tells that it is back.
const OFF: Span = Span::from_nanos(500_000_000);

/// Shortest sleep: whoever wants to be woken at once again and again does not keep others from running.
const NAP: Duration = Duration::from_millis(1);

/// Starts a CAN port. To be called inside a tokio runtime that can do I/O and timers.
///
/// Whatever happens to the bus, the port goes on by itself. The speaker, if there is one, is told when
/// the bus is there and when it is lost, hears every frame that the filters let pass, and sends.
pub fn spawn(
    port: PortId,
    config: CanConfig,
    surroundings: Surroundings,
    node: Option<SharedSpeaker>,
) -> PortHandle {
    let CanConfig { transport, patience_s, write, filters } = config;
    let clock = Arc::clone(&surroundings.clock);
    let commands = write || node.is_some();
    let patience = Span::from_seconds(patience_s);
    let port = Port::new(port, patience, filters.clone(), surroundings, node);
    let attempts = Arc::clone(&port.attempts);
    let task = match transport {
        CanTransport::Socketcan(config) => {
            tokio::spawn(port.run(Interface::new(config, filters, clock)))
        }
        CanTransport::Slcan(config) => {
            tokio::spawn(port.run(Adapter::new(config, commands, clock)))
        }
        CanTransport::GatewayTcp(config) => tokio::spawn(port.run(Calls::new(config, clock))),
        CanTransport::GatewayUdp(config) => tokio::spawn(port.run(Datagrams::new(config, clock))),
        CanTransport::Candump(config) => tokio::spawn(port.run(Log::new(config, clock))),
    };
    PortHandle::of_task(task.abort_handle(), attempts)
}

/// The same for a bus that is opened in another way, for example one in memory.
pub fn spawn_on<O: Opener>(
    port: PortId,
    opener: O,
    patience: Span,
    surroundings: Surroundings,
    node: Option<SharedSpeaker>,
) -> PortHandle {
    let port = Port::new(port, patience, Vec::new(), surroundings, node);
    let attempts = Arc::clone(&port.attempts);
    PortHandle::of_task(tokio::spawn(port.run(opener)).abort_handle(), attempts)
}

struct Port {
    teller: Teller,
    filters: Vec<CanFilter>,
    node: Option<SharedSpeaker>,
    attempts: Arc<AtomicU64>,
    /// The last frame was refused, and there was no sign of room since.
    refused: bool,
    /// The burst has ended before the speaker had said all.
    more: bool,
    /// Since when the controller is off the bus.
    off: Option<Time>,
}

impl Port {
    fn new(
        port: PortId,
        patience: Span,
        filters: Vec<CanFilter>,
        surroundings: Surroundings,
        node: Option<SharedSpeaker>,
    ) -> Self {
        let Surroundings { clock, queue, .. } = surroundings;
        let teller = Teller::new(port, clock, queue, Some(patience));
        let attempts = Arc::default();
        Port { teller, filters, node, attempts, refused: false, more: false, off: None }
    }

    async fn run<O: Opener>(mut self, mut opener: O) {
        let mut pause = Pause::up_to(O::LONGEST_PAUSE);
        loop {
            self.attempts.fetch_add(1, Ordering::Relaxed);
            self.teller.begin();
            let outcome = match opener.open().await {
                Ok((bus, what)) => self.attend::<O>(bus, what).await,
                Err(reason) => Outcome::Absent(reason),
            };
            if !tell(outcome, &mut self.teller) {
                return;
            }
            sleep(pause.after(self.teller.open_for())).await;
        }
    }

    /// Listens and speaks until the bus is lost.
    async fn attend<O: Opener>(&mut self, mut bus: O::Bus, what: String) -> Outcome {
        self.teller.open(what);
        (self.refused, self.off) = (false, None);
        let now = self.now();
        self.tell_node(|node| node.up(now));
        let outcome = self.converse::<O>(&mut bus).await;
        let now = self.now();
        self.tell_node(|node| node.down(now));
        outcome
    }

    async fn converse<O: Opener>(&mut self, bus: &mut O::Bus) -> Outcome {
        loop {
            if O::WAITS {
                self.teller.room().await;
            }
            let now = self.now();
            self.wake(now);
            if let Err(reason) = self.send(bus, now) {
                return Outcome::Lost(reason);
            }
            let heard = tokio::select! {
                heard = bus.next(self.refused) => heard,
                () = handed_in(self.node.as_ref()) => continue,
                () = sleep(self.rest(now)) => {
                    self.teller.tick();
                    continue;
                }
            };
            match heard {
                Ok(Heard::Frame(stamp, frame)) => self.hear(stamp, frame),
                Ok(Heard::Event(stamp, event)) => self.bus_event(stamp, event),
                Ok(Heard::Stranger(host)) => self.teller.refuse(host, Closed::NotListed),
                Ok(Heard::Room) => self.refused = false,
                Ok(Heard::End) => return Outcome::Ended,
                Err(reason) => return Outcome::Lost(reason),
            }
            self.teller.tick();
        }
    }

    fn hear(&mut self, stamp: Stamp, frame: CanFrame) {
        let id = frame.id();
        let passes = |filter: &CanFilter| filter.accepts(id);
        if !self.filters.is_empty() && !self.filters.iter().any(passes) {
            return;
        }
        self.teller.frame(stamp, frame);
        let now = self.now();
        self.back_on(now);
        self.tell_node(|node| node.hear(&frame, now));
    }

    fn bus_event(&mut self, stamp: Stamp, event: BusEvent) {
        self.teller.bus_event(stamp, event);
        let now = self.now();
        self.off = match event {
            BusEvent::BusOff => Some(now),
            BusEvent::Restarted => None,
            _ => self.off,
        };
        self.tell_node(|node| node.bus_event(event, now));
    }

    /// If the controller was off, it is taken to be back.
    fn back_on(&mut self, now: Time) {
        if self.off.take().is_some() {
            self.tell_node(|node| node.bus_event(BusEvent::Restarted, now));
        }
    }

    fn wake(&mut self, now: Time) {
        if self.off.is_some_and(|since| now - since >= OFF) {
            self.back_on(now);
        }
        let woken = self.tell_node(|node| {
            let due = node.wake_at().is_some_and(|at| at <= now);
            if due {
                node.wake(now);
            }
            due
        });
        self.refused &= woken != Some(true);
    }

    /// Sends what the node has to say, a burst at most, unless there is no room or the controller is off.
    fn send(&mut self, bus: &mut impl CanBus, now: Time) -> Result<(), String> {
        self.more = false;
        let Some(node) = self.node.clone().filter(|_| self.off.is_none()) else { return Ok(()) };
        for _ in 0..BURST {
            if self.refused {
                return Ok(());
            }
            let Some(frame) = node.quietly(|node| node.next_frame(now)) else { return Ok(()) };
            match bus.try_send(&frame)? {
                Sending::Sent => node.quietly(|node| node.sent(now)),
                Sending::Full => {
                    self.refused = true;
                    node.quietly(|node| node.refused(now));
                }
            }
        }
        self.more = true;
        Ok(())
    }

    /// How long nothing is due.
    fn rest(&self, now: Time) -> Duration {
        if self.more {
            return NAP;
        }
        let due = self.off.map(|since| since + OFF);
        let wake = self.node.as_ref().and_then(|node| node.quietly(|node| node.wake_at()));
        let until = |at: Time| Duration::from_nanos((at - now).as_nanos().max(0).unsigned_abs());
        let next = due.into_iter().chain(wake).map(until).min();
        next.map_or(self.teller.rest(), |next| next.min(self.teller.rest())).max(NAP)
    }

    fn tell_node<T>(&self, act: impl FnOnce(&mut (dyn Speaker + 'static)) -> T) -> Option<T> {
        self.node.as_ref().map(|node| node.quietly(act))
    }

    fn now(&self) -> Time {
        self.teller.now().monotonic
    }
}

/// Waits until somebody has handed in something; for ever if there is no node.
async fn handed_in(node: Option<&SharedSpeaker>) {
    match node {
        Some(node) => node.ready().await,
        None => std::future::pending().await,
    }
}
