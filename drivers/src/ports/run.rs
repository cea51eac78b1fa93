//! The task of a port: open, listen, lose, wait, open again, for ever.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use insd_base::{PortId, Span, Stamp};
use tokio::time::sleep;

use super::attempt::{Outcome, Pause, tell};
use super::config::{Destination, OutputConfig, PortConfig, Serial, Transport};
use super::handle::{OutputPort, PortHandle, Work};
use super::judge::BaudJudge;
use super::ntrip::Ntrip;
use super::outbox::{Keeping, Outbox, Outlet};
use super::surroundings::Surroundings;
use super::teller::Teller;
use super::{file, ntrip, pps, pty, serial, tcp, udp};
use crate::can;

/// Longest pause before a caster is called again.
const CASTER_PAUSE: Duration = Duration::from_secs(60);

/// Bytes that may wait to be written where nothing else is said.
const OUTBOX_LIMIT: usize = 64 * 1024;

/// Bytes that may wait to be written to a file: some seconds in which a disk is busy.
const FILE_LIMIT: usize = 1024 * 1024;

/// Seconds' worth of bytes that may wait for a serial line where all is kept in order.
const SERIAL_SECONDS: u32 = 2;

/// What is to be written, for those that write.
struct Written {
    /// For a port that has one peer.
    outbox: Option<Outbox>,
    /// For a port that has many.
    outlet: Option<Outlet>,
}

enum Link {
    Input(Transport, Option<BaudJudge>),
    Output(Destination),
}

/// Starts the port. To be called inside a tokio runtime that can do I/O and timers.
///
/// Whatever happens to the device, the port goes on by itself: it tells each change of state once with
/// its reason, and opens the device again by its configured name after a pause of 0.2 s, which doubles
/// up to 5 s. Only a file ends. A CAN port is listened to, see [`can::spawn`].
pub fn spawn(port: PortId, config: PortConfig, surroundings: Surroundings) -> PortHandle {
    if let Some(config) = config.as_can() {
        return can::spawn(port, config, surroundings, None);
    }
    let Surroundings { clock, queue, judge } = surroundings;
    let patience = Some(Span::from_seconds(config.patience_s));
    let outlet = config
        .keeping()
        .map(|keeping| Outlet::new(keeping, limit_of_input(&config.transport), Arc::clone(&clock)));
    let teller =
        Teller::new(port, clock, queue, patience).commanded_by(config.commands_from.clone());
    let attempts = Arc::<AtomicU64>::default();
    let work = match config.transport {
        Transport::Pps(pps) => Work::Thread(pps::spawn(pps, teller, Arc::clone(&attempts))),
        transport => {
            start(Link::Input(transport, judge), teller, outlet.clone(), Arc::clone(&attempts))
        }
    };
    PortHandle::new(work, outlet, attempts)
}

/// Starts an output. To be called inside a tokio runtime that can do I/O and timers. Its states are
/// told in the same way; what the far end says is read and forgotten.
///
/// Of each slot one message waits at most, the newest, and none is started when it is older than its
/// period; what waited while a device was away is dropped when it is there again. A line that is behind
/// does each slot justice: what is due first leaves first, and what was passed over comes nearer to its
/// turn. In a file all is kept, in order.
///
/// A message that is handed over when it is already as old as its period, or nearly so, may still wait
/// for half a period and at most 10 ms.
pub fn spawn_output(port: PortId, config: OutputConfig, surroundings: Surroundings) -> OutputPort {
    let (keeping, usual) = match &config.destination {
        Destination::File(_) => (Keeping::All, FILE_LIMIT),
        _ => (Keeping::Newest, OUTBOX_LIMIT),
    };
    let limit = config.waiting_bytes.unwrap_or(usual);
    let outlet = Outlet::new(keeping, limit, Arc::clone(&surroundings.clock));
    let teller = Teller::new(port, surroundings.clock, surroundings.queue, None);
    let shown = teller.shown();
    let attempts = Arc::<AtomicU64>::default();
    let link = Link::Output(config.destination);
    let work = start(link, teller, Some(outlet.clone()), Arc::clone(&attempts));
    OutputPort::new(PortHandle::new(work, None, attempts), outlet, shown)
}

fn start(link: Link, teller: Teller, outlet: Option<Outlet>, attempts: Arc<AtomicU64>) -> Work {
    // made before the task starts, so that nothing that is handed over meanwhile is missed
    let outbox = outlet.as_ref().filter(|_| !link.has_clients()).map(Outlet::outbox);
    let written = Written { outbox, outlet };
    Work::Task(tokio::spawn(run(link, teller, written, attempts)).abort_handle())
}

impl Link {
    /// Whether others call the same server, and in vain at the same time.
    fn is_shared(&self) -> bool {
        matches!(self, Link::Input(Transport::Ntrip(_), _))
    }

    fn pause(&self) -> Pause {
        if self.is_shared() { Pause::up_to(CASTER_PAUSE) } else { Pause::default() }
    }

    fn has_clients(&self) -> bool {
        matches!(
            self,
            Link::Input(Transport::TcpServer(_), _) | Link::Output(Destination::TcpServer(_))
        )
    }
}

async fn run(link: Link, mut teller: Teller, written: Written, attempts: Arc<AtomicU64>) {
    let mut pause = link.pause();
    let mut last_baud = None;
    loop {
        attempts.fetch_add(1, Ordering::Relaxed);
        teller.begin();
        let outcome = attempt(&link, &mut last_baud, &mut teller, &written).await;
        if !tell(outcome, &mut teller) {
            return;
        }
        let wait = pause.after(teller.open_for());
        // whoever serves many is not called by all of them at once
        sleep(if link.is_shared() { spread(wait, teller.now()) } else { wait }).await;
    }
}

async fn attempt(
    link: &Link,
    last_baud: &mut Option<u32>,
    teller: &mut Teller,
    written: &Written,
) -> Outcome {
    let (outbox, outlet) = (written.outbox.as_ref(), written.outlet.as_ref());
    match (link, outbox) {
        (Link::Input(Transport::Serial(config), judge), _) => {
            serial::attempt(config, judge.as_ref(), last_baud, teller, outbox).await
        }
        (Link::Input(Transport::Udp(config), _), _) => udp::listen(config, teller).await,
        (Link::Input(Transport::TcpClient(config), _), _) => {
            tcp::call(config, teller, outbox).await
        }
        (Link::Input(Transport::Ntrip(config), _), _) => call_caster(config, teller, outbox).await,
        (Link::Input(Transport::TcpServer(config), _), _) => {
            tcp::serve(config, teller, outlet).await
        }
        (Link::Input(Transport::File(config), _), _) => file::read_whole(config, teller).await,
        (Link::Input(Transport::Pipe(config), _), _) => file::listen(config, teller).await,
        (Link::Output(Destination::Serial(config)), _) => {
            serial::attempt(config, None, last_baud, teller, outbox).await
        }
        (Link::Output(Destination::TcpServer(config)), _) => {
            tcp::serve(config, teller, outlet).await
        }
        (Link::Output(Destination::Udp(config)), Some(outbox)) => {
            udp::talk(config, teller, outbox).await
        }
        (Link::Output(Destination::File(config)), Some(outbox)) => {
            file::append(config, teller, outbox).await
        }
        (Link::Output(Destination::Pty(config)), Some(outbox)) => {
            pty::talk(config, teller, outbox).await
        }
        // pulses have a thread of their own, CAN a task of another kind, and an output an outbox
        (Link::Input(..) | Link::Output(_), _) => Outcome::Ended,
    }
}

/// A pause that is longer or shorter by up to a quarter: by the nanoseconds of the clock, which are of no other use.
fn spread(pause: Duration, now: Stamp) -> Duration {
    let part = now.system.as_nanos().rem_euclid(1_000_003) as f64 / 1_000_003.0;
    pause.mul_f64(0.75 + 0.5 * part)
}

impl PortConfig {
    /// What may wait to be written to it; `None` if it is never written to.
    fn keeping(&self) -> Option<Keeping> {
        match &self.transport {
            Transport::Ntrip(ntrip) => (ntrip.gga_s > 0.0).then_some(Keeping::Newest),
            _ => self.write.then_some(Keeping::All),
        }
    }
}

async fn call_caster(config: &Ntrip, teller: &mut Teller, outbox: Option<&Outbox>) -> Outcome {
    let stream = match ntrip::password(config) {
        Ok(password) => tcp::dial(&config.address).await.map(|stream| (stream, password)),
        Err(why) => Err(why),
    };
    let ended = match stream {
        Ok((stream, password)) if config.tls => {
            match ntrip::secure(stream, config, teller.now().system).await {
                Ok(stream) => ntrip::converse(stream, config, &password, teller, outbox).await,
                Err(why) => Err(why),
            }
        }
        Ok((stream, password)) => ntrip::converse(stream, config, &password, teller, outbox).await,
        Err(why) => Err(why),
    };
    match ended {
        Ok(reason) => Outcome::Lost(reason),
        Err(why) => Outcome::Absent(format!("ntrip {}/{}: {why}", config.address, config.mount)),
    }
}

fn limit_of_input(transport: &Transport) -> usize {
    match transport {
        Transport::Serial(serial) => serial_limit(serial),
        _ => OUTBOX_LIMIT,
    }
}

/// So many bytes that the oldest is not older than a few seconds when it leaves, and a long sentence
/// in any case.
fn serial_limit(serial: &Serial) -> usize {
    let a_second = serial.baud / serial.symbols();
    usize::try_from(a_second.saturating_mul(SERIAL_SECONDS)).unwrap_or(OUTBOX_LIMIT).max(1024)
}

#[cfg(test)]
mod tests {
    use insd_base::{Time, UtcTime};

    use super::*;

    #[test]
    fn pauses_of_those_who_call_one_caster_differ() {
        let at = |nanos| Stamp { monotonic: Time::START, system: UtcTime::from_nanos(nanos) };
        let waits = (0..1000).map(|own| spread(CASTER_PAUSE, at(own * 7_919_333)).as_secs_f64());
        let waits: Vec<f64> = waits.collect();
        assert!(waits.iter().all(|wait| (45.0..=75.0).contains(wait)));
        let mean = waits.iter().sum::<f64>() / 1000.0;
        assert!((58.0..62.0).contains(&mean), "{mean}");
    }
}
