//! The other process: pipeline, recorder and what is saved, as in the daemon; and what is counted.

use std::io::{BufReader, stdin};
use std::process::ExitCode;

use insd::clock::{Clock, HostClock, boot_now};
use insd::state::{Folders, Kept, Saver};
use insd_base::{Arrival, Event, Input, PortId, Span, Time};
use insd_config::Config;
use insd_drivers::raw::{RawHeader, RawWriter, Recorder, RecordingConfig};
use insd_engine::Output;
use insd_vessel::{Pipeline, Product, Spoken};

use super::pipe;

/// Simulated time between two lines of the table, s.
const LINE: f64 = 3600.0;
/// Simulated time between two states that are saved, s.
const SAVED: f64 = 1.0;
/// Growth of memory after the first hour that counts as flat.
const FLAT: f64 = 1.01;
/// All recorded files together, bytes.
const QUOTA: u64 = 64 << 20;

/// What is counted.
#[derive(Default)]
struct Account {
    arrivals: u64,
    bytes: u64,
    samples: u64,
    rejected: u64,
    ticks: u64,
    messages: Vec<u64>,
    /// Greatest time between two headings of each output, s, and when the last was.
    gaps: Vec<(f64, Option<Time>)>,
}

/// Runs to the end of what is sent.
pub(crate) fn run(text: &str) -> ExitCode {
    let config = Config::of_text(text).unwrap();
    let mut pipeline = config.pipeline();
    let folder = std::env::temp_dir().join(format!("insd-soak-{}", std::process::id()));
    let mut recorder = Recorder::start(recording(&folder, text)).unwrap();
    let folders =
        Folders { memory: Some(folder.clone()), disk: None, interval: Span::from_seconds(5.0) };
    let saver = Saver::start(&folders).unwrap();
    let (mut account, mut from) = (Account::new(config.outputs.len()), BufReader::new(stdin()));
    let (clock, host) = (Clock::start(), HostClock::start());
    let (mut line, mut saved, mut memory) = (None, Time::START, Vec::new());
    println!("  hours  wall s    memory  samples  rejected  headings  greatest gap s");
    while let Some(arrival) = pipe::read(&mut from) {
        let now = arrival.stamp.monotonic;
        // as the daemon does when it is awake: what is due by now is due
        if pipeline.wake_up(now).is_some_and(|due| due.at <= now) {
            let tick = Arrival { stamp: arrival.stamp, port: PortId(u16::MAX), input: Input::Tick };
            account.take(&mut pipeline, &mut recorder, &tick);
        }
        account.take(&mut pipeline, &mut recorder, &arrival);
        if (now - saved).as_seconds() >= SAVED {
            saved = now;
            if let Some(state) = pipeline.checkpoint() {
                saver.navigation(Kept { made: boot_now(&host.now()), state });
            }
        }
        let start = *line.get_or_insert(now);
        if (now - start).as_seconds() >= LINE {
            line = Some(now);
            memory.push(resident());
            account.tell(memory.len(), clock.elapsed().as_secs_f64(), resident());
        }
    }
    saver.finish();
    let state = recorder.finish();
    let recorded = state.written.arrivals;
    let _ = std::fs::remove_dir_all(&folder);
    let counts = pipeline.counts();
    let counted = pipeline.status().ports.iter().map(|port| port.counts.bytes).sum::<u64>();
    println!("{counts:?}");
    let checks = [
        ("every byte is counted", counted == account.bytes),
        ("every frame of a sensor is whole", whole(&pipeline)),
        ("every arrival is recorded", recorded + state.written.dropped == account.arrivals),
        ("the outputs have no gap", account.gaps.iter().all(|(gap, _)| *gap < 0.11)),
        ("all outputs sent the same", account.messages.windows(2).all(|two| two[0] == two[1])),
        ("memory is flat", is_flat(&memory)),
    ];
    for (what, holds) in checks {
        println!("{} {what}", if holds { "yes" } else { "NO " });
    }
    let good = checks.iter().all(|(_, holds)| *holds);
    if good { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn recording(folder: &std::path::Path, text: &str) -> RawWriter {
    let config = RecordingConfig {
        name: "soak".to_owned(),
        rotate_bytes: QUOTA / 8,
        rotate_span: Span::from_seconds(3600.0),
        quota_bytes: Some(QUOTA),
    };
    let header = RawHeader { program: "insd soak".to_owned(), config: text.to_owned() };
    RawWriter::create(folder, config, header).unwrap()
}

fn whole(pipeline: &Pipeline<Config>) -> bool {
    let ports = pipeline.status().ports;
    ports.iter().all(|port| port.counts.damaged == 0 && port.counts.skipped == 0)
}

/// Whether the memory of no later hour is more than a hundredth above that of the first.
fn is_flat(memory: &[u64]) -> bool {
    let Some((first, rest)) = memory.split_first() else { return true };
    rest.iter().all(|later| *later as f64 <= *first as f64 * FLAT)
}

/// Memory of this process, bytes.
fn resident() -> u64 {
    let statm = std::fs::read_to_string("/proc/self/statm").unwrap();
    let pages: u64 = statm.split_whitespace().nth(1).unwrap().parse().unwrap();
    pages * rustix::param::page_size() as u64
}

impl Account {
    fn new(outputs: usize) -> Self {
        Account { messages: vec![0; outputs], gaps: vec![(0.0, None); outputs], ..Self::default() }
    }

    fn take(
        &mut self,
        pipeline: &mut Pipeline<Config>,
        recorder: &mut Recorder,
        arrival: &Arrival,
    ) {
        self.arrivals += 1;
        match &arrival.input {
            Input::Bytes(bytes) => self.bytes += bytes.len() as u64,
            _ => self.ticks += 1,
        }
        recorder.record(arrival);
        pipeline.handle(arrival, |product| match product {
            Product::Spoken(Spoken::Messages(port, messages)) => {
                self.messages[port] += messages.len() as u64;
                let heading =
                    messages.iter().find(|own| own.content.to_bytes().starts_with(b"$HEHDT"));
                if let Some(heading) = heading {
                    let (gap, last) = &mut self.gaps[port];
                    let passed = last.map_or(0.0, |last| (heading.valid - last).as_seconds());
                    (*gap, *last) = (gap.max(passed), Some(heading.valid));
                }
            }
            Product::Engine(Output::Event(Event::Rejected { .. })) => self.rejected += 1,
            Product::Engine(Output::Solution(_)) => self.samples += 1,
            _ => {}
        });
    }

    fn tell(&self, hours: usize, wall: f64, memory: u64) {
        let megabytes = memory as f64 / f64::from(1 << 20);
        let gap = self.gaps.iter().map(|(gap, _)| *gap).fold(0.0, f64::max);
        let Account { samples, rejected, messages, .. } = self;
        let sent = messages.first().copied().unwrap_or_default();
        println!(
            "{hours:7} {wall:7.0} {megabytes:6.2} MB {samples:8} {rejected:9} {sent:9} {gap:8.3}"
        );
    }
}
