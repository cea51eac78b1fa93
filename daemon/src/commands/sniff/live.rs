//! Listening to ports for a while.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use anyhow::Context;
use insd_base::{PortId, Time};
use insd_drivers::can::{self, SharedSpeaker};
use insd_drivers::ports::{
    self, BaudJudge, BaudJudgement, PortConfig, PortHandle, Receiver, Surroundings, WAITING_LIMIT,
};
use insd_lab::sniff::{PortToHear, SniffReport, Sniffed, is_proof, text};
use insd_lab::terminal::Farewell;
use insd_wire::stream::{Cutter, Protocol};
use tokio::time::{MissedTickBehavior, interval};

use super::asker::Asker;
use super::{frames, screen};
use crate::clock::HostClock;

/// Time between two looks at the clock, and how many of them make a picture.
const TICK: Duration = Duration::from_millis(100);
const PICTURE: u32 = 10;

/// Time in which a port says whether it can be opened, beside the search for its baud rate, s.
const OPENING: f64 = 2.0;

/// So many bytes without a frame are of a wrong baud rate: more than the longest frame.
const WRONG: usize = 4096;

/// A port to listen to.
#[derive(Clone, Debug)]
pub(super) struct Opening {
    pub(super) plan: PortToHear,
    pub(super) config: PortConfig,
    /// How long the search for its baud rate may take, s.
    pub(super) search_s: f64,
}

/// How long, and what is shown meanwhile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// Time from when the ports are open, s; without end if zero.
    pub(super) seconds: f64,
    /// The report is redrawn once a second.
    pub(super) redraw: bool,
    /// In which form each frame is printed.
    pub(super) frames: frames::Form,
    /// Devices of CAN buses are asked who they are.
    pub(super) ask: bool,
}

/// Listens until the time is over, everything has been read or the user has seen enough.
pub(super) fn listen(
    ports: Vec<Opening>,
    protocols: &[Protocol],
    style: Style,
) -> anyhow::Result<SniffReport> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .context("cannot start the event loop")?;
    let report = runtime.block_on(async {
        let (mut bench, receiver) = Bench::new(ports, protocols, style);
        bench.announce();
        bench.run(receiver).await?;
        Ok(bench.report())
    });
    runtime.shutdown_timeout(TICK);
    report
}

/// The ports at work, and what they have said.
struct Bench {
    clock: HostClock,
    sniffed: Sniffed,
    style: Style,
    /// Ports whose baud rate is searched, with the bytes that were heard meanwhile.
    searched: Vec<(PortId, Arc<AtomicU64>)>,
    search_s: f64,
    /// Names of the ports that are listened to for a while.
    names: Vec<String>,
    _ports: Vec<PortHandle>,
}

impl Bench {
    fn new(ports: Vec<Opening>, protocols: &[Protocol], style: Style) -> (Self, Receiver) {
        let clock = HostClock::start();
        let (queue, receiver) = ports::queue(WAITING_LIMIT);
        let mut bench = Bench {
            clock,
            sniffed: Sniffed::new(protocols),
            style,
            searched: Vec::new(),
            search_s: 0.0,
            names: Vec::new(),
            _ports: Vec::new(),
        };
        for (id, port) in (0..).map(PortId).zip(ports) {
            let heard = Arc::<AtomicU64>::default();
            let judge = Some(judge(protocols, Arc::clone(&heard)));
            let queue = queue.clone();
            let surroundings = Surroundings { clock: Arc::new(clock), queue, judge };
            if port.plan.timed {
                bench.names.push(port.plan.name.clone());
            }
            bench.sniffed.announce(id, port.plan);
            if port.search_s > 0.0 {
                bench.searched.push((id, heard));
                bench.search_s = bench.search_s.max(port.search_s);
            }
            let handle = match port.config.as_can().filter(|_| style.ask) {
                Some(bus) => {
                    let asker = SharedSpeaker::new(Asker::default()).for_port();
                    can::spawn(id, bus, surroundings, Some(asker))
                }
                None => ports::spawn(id, port.config, surroundings),
            };
            bench._ports.push(handle);
        }
        (bench, receiver)
    }

    /// Says what is going on, as nothing may happen for a while.
    fn announce(&self) {
        if self.names.is_empty() {
            return;
        }
        let names = self.names.join(", ");
        let until = if self.style.seconds > 0.0 {
            format!("for {} s", self.style.seconds)
        } else {
            "until Ctrl-C".to_owned()
        };
        eprintln!("listening {until}: {names}");
        if self.search_s > 0.0 {
            eprintln!("before that, up to {:.0} s to find the baud rate", self.search_s);
        }
    }

    async fn run(&mut self, mut receiver: Receiver) -> anyhow::Result<()> {
        let mut farewell = Farewell::new(None)?;
        let mut ticks = interval(TICK);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let screen = self.style.redraw.then(screen::Screen::open).transpose()?;
        let mut printer = frames::Printer::new(self.style.frames);
        let mut settled = None;
        let mut count = 0;
        loop {
            tokio::select! {
                Some(arrival) = receiver.recv() => {
                    self.sniffed.take_and_show(&arrival, |seen| printer.show(seen));
                    if printer.outcome()? {
                        return Ok(());
                    }
                }
                _ = ticks.tick() => {
                    if let Some(screen) = screen.as_ref().filter(|_| count % PICTURE == 0) {
                        screen.draw(&self.picture())?;
                    }
                    count += 1;
                    if self.is_over(&mut settled) {
                        return Ok(());
                    }
                }
                () = farewell.wait() => return Ok(()),
            }
        }
    }

    /// Whether all was read, or the time is up that begins when all ports are open or known to be
    /// absent.
    fn is_over(&self, settled: &mut Option<Time>) -> bool {
        let now = self.clock.now().monotonic;
        let is_late = now.as_seconds() > self.search_s + OPENING;
        if settled.is_none() && (self.sniffed.is_settled() || is_late) {
            *settled = Some(now);
        }
        let span = settled.map_or(0.0, |settled| (now - settled).as_seconds());
        let is_up = self.style.seconds > 0.0 && settled.is_some() && span >= self.style.seconds;
        is_up || self.sniffed.is_ended()
    }

    fn picture(&mut self) -> String {
        let mut report = self.report();
        for port in &mut report.ports {
            port.suggestions.clear();
        }
        let heading =
            if self.style.seconds > 0.0 { "Ctrl-C: the report now" } else { "Ctrl-C ends" };
        format!("{heading}\n\n{}", text::report(&report))
    }

    fn report(&mut self) -> SniffReport {
        for (id, heard) in &self.searched {
            self.sniffed.unreadable(*id, heard.load(Ordering::Relaxed));
        }
        self.sniffed.report(self.clock.now().monotonic)
    }
}

/// A baud rate is right at the first good frame. Counts the bytes that were heard at any rate.
fn judge(protocols: &[Protocol], heard: Arc<AtomicU64>) -> BaudJudge {
    let protocols = protocols.to_vec();
    BaudJudge::new(move |bytes| {
        heard.fetch_max(bytes.len() as u64, Ordering::Relaxed);
        let mut cutter = Cutter::new(&protocols);
        cutter.push(bytes);
        while let Some(cut) = cutter.cut() {
            if is_proof(cut.protocol, cut.bytes) {
                return BaudJudgement::Fits;
            }
        }
        if bytes.len() >= WRONG { BaudJudgement::Wrong } else { BaudJudgement::Unsure }
    })
}
