//! Our node on an interface, made and spoken to as the daemon does it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use insd::clock::HostClock;
use insd_base::{BusEvent, Input, PortId};
use insd_config::{NodeMemory, NodeSection};
use insd_drivers::can::{SharedSpeaker, Socketcan, spawn};
use insd_drivers::ports::{
    PortConfig, PortHandle, Receiver, Surroundings, Transport, WAITING_LIMIT, queue,
};
use insd_n2k::Name;
use insd_n2k::node::{Node, NodeCounts, NodeEvent};
use insd_output::OutputEpoch;
use insd_output::n2k::PgnSchedule;
use tokio::runtime::Runtime;

use super::guest::SECOND;
use super::tap::Tap;

/// Time between two solutions.
const EPOCH: Duration = Duration::from_millis(100);
/// The address that it tries first.
pub(crate) const HOME: u8 = 35;

/// What the consumer of the port has got.
#[derive(Clone, Debug, Default)]
pub(crate) struct Got {
    pub(crate) frames: u64,
    pub(crate) states: Vec<String>,
    pub(crate) bus: Vec<BusEvent>,
}

/// A node at work.
pub(crate) struct Unit {
    pub(crate) node: SharedSpeaker<Node>,
    pub(crate) name: Name,
    got: Arc<Mutex<Got>>,
    stop: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
    port: Option<PortHandle>,
    runtime: Option<Runtime>,
}

impl Unit {
    /// A unit with this number of its own, not before the interface is there.
    pub(crate) fn on(interface: &str, unique: u32, seed: u64) -> Self {
        let text = format!("port = \"bus\"\nunique = {unique}\naddress = {HOME}");
        let section: NodeSection = toml::from_str(&text).unwrap();
        let config = section.node(0, &NodeMemory::default());
        let name = config.name;
        let node = SharedSpeaker::new(Node::new(config, seed));
        let (queue, receiver) = queue(WAITING_LIMIT);
        let clock = HostClock::start();
        let surroundings = Surroundings { clock: Arc::new(clock), queue, judge: None };
        let transport = Transport::Socketcan(Socketcan { interface: interface.to_owned() });
        let config = PortConfig::new(transport).as_can().unwrap();
        let mut builder = tokio::runtime::Builder::new_multi_thread();
        let runtime = builder.worker_threads(1).enable_all().build().unwrap();
        let port = runtime
            .block_on(async { spawn(PortId(0), config, surroundings, Some(node.for_port())) });
        let (got, stop) = (Arc::default(), Arc::new(AtomicBool::new(false)));
        let threads = vec![
            std::thread::spawn({
                let (got, stop) = (Arc::clone(&got), Arc::clone(&stop));
                move || consume(receiver, &got, &stop)
            }),
            std::thread::spawn({
                let (node, stop) = (node.clone(), Arc::clone(&stop));
                let voice = PgnSchedule::new(section.voice());
                move || speak(voice, &node, &clock, &stop)
            }),
        ];
        Unit { node, name, got, stop, threads, port: Some(port), runtime: Some(runtime) }
    }

    /// The same, and it has the address that it tries first.
    pub(crate) fn at_home(interface: &str, tap: &Tap) -> Self {
        let unit = Unit::on(interface, 1000, 1);
        unit.settles(tap, 0.0);
        assert_eq!(unit.address(), Some(HOME));
        unit
    }

    /// Waits until it has an address and has said something from there. Gives the time of that.
    pub(crate) fn settles(&self, tap: &Tap, since: f64) -> f64 {
        for _ in 0..200 {
            std::thread::sleep(SECOND / 20);
            if let Some(address) = self.address() {
                let heading =
                    |frame: &super::tap::Heard| frame.pgn() == HEADING && frame.source() == address;
                return tap.wait(since, SECOND, heading).expect("it speaks").at;
            }
        }
        panic!("no address after ten seconds: {:?}", self.node.with(|node| node.status()));
    }

    pub(crate) fn address(&self) -> Option<u8> {
        self.node.with(|node| node.address())
    }

    pub(crate) fn counts(&self) -> NodeCounts {
        self.node.with(|node| node.counts())
    }

    /// What has happened since it was last asked.
    pub(crate) fn events(&self) -> Vec<NodeEvent> {
        self.node.with(|node| std::iter::from_fn(|| node.poll_event()).collect())
    }

    pub(crate) fn got(&self) -> Got {
        self.got.lock().unwrap().clone()
    }
}

/// True heading, sent every 100 ms.
pub(crate) const HEADING: u32 = 127_250;

impl Drop for Unit {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        self.port.take();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_timeout(SECOND);
        }
    }
}

fn consume(mut receiver: Receiver, got: &Mutex<Got>, stop: &AtomicBool) {
    while !stop.load(Ordering::Relaxed) {
        match receiver.recv_timeout(EPOCH) {
            Ok(arrival) => {
                let mut got = got.lock().unwrap();
                match arrival.input {
                    Input::Can(_) => got.frames += 1,
                    Input::Bus(event) => got.bus.push(event),
                    Input::State(state) => got.states.push(state.to_string()),
                    _ => {}
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}

/// Hands in what is to be said at each epoch, of which nothing is known.
fn speak(mut voice: PgnSchedule, node: &SharedSpeaker<Node>, clock: &HostClock, stop: &AtomicBool) {
    let begun = clock.now().monotonic;
    for epoch in 1_u32.. {
        let due = begun + insd_base::Span::from_seconds(EPOCH.as_secs_f64() * f64::from(epoch));
        let now = clock.now().monotonic;
        std::thread::sleep(Duration::from_nanos((due - now).as_nanos().max(0).unsigned_abs()));
        if stop.load(Ordering::Relaxed) {
            return;
        }
        let now = clock.now().monotonic;
        node.with(|node| {
            for (pgn, data) in voice.messages(&OutputEpoch::unknown(now), node.transmit()) {
                node.send(pgn, &data, now);
            }
        });
    }
}
