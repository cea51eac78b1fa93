//! The daemon itself, over pseudo terminals: what it recorded replays to the same bytes, and a sensor
//! that is unplugged and plugged in again is read again. So do the raw messages of a receiver of satellites, and with them what a caster sends.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod base;

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::thread::JoinHandle;
use std::time::Duration;

use insd::clock::Clock;
use insd::logging::Log;
use insd::run::{RunOptions, run};
use insd_base::{Event, Solution, UtcTime};
use insd_config::Config;
use insd_drivers::raw::RawReader;
use insd_drivers::recording::NavWriter;
use insd_engine::Output;
use insd_simulator::{raw_gnss, simulate};
use insd_tests::feed::{Encoding, FeedConfig, LineSending, feed};
use insd_tests::wire::Wire;
use insd_tests::{raw_feed, scenario, variant};
use insd_vessel::{Product, Spoken};

/// Seconds of the voyage that are sailed, and when the receiver is unplugged and plugged in again.
const SAILED: f64 = 25.0;
const UNPLUGGED: Range<f64> = 14.0..17.0;
/// Ports from here on are no serial lines.
const ELSEWHERE: usize = 100;
/// Seconds that are sailed with raw satellites: until the heading is known and ranges are used.
const WITH_RAW: f64 = 60.0;

#[test]
fn a_run_over_real_lines_replays_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    let voyage = simulate(&scenario(2), 1);
    let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx, Encoding::Vbw]);
    let text = configuration(dir, &feeds, &voyage);
    let config = Config::of_text(&text).unwrap();
    let nav = dir.join("nav.csv");
    let options =
        RunOptions { nav: Some(nav.clone()), seconds: Some(SAILED + 3.0), ..RunOptions::default() };
    let daemon = start(&config, &text, options);
    send(dir, &feed(&voyage, &feeds), SAILED, UNPLUGGED, |_| ());
    daemon.join().unwrap();

    let Replayed { nav: replayed, sent, states, .. } = replay(dir, &config);
    let live = fs::read(&nav).unwrap();
    assert!(live.len() > 10_000, "{} bytes of solutions", live.len());
    assert!(live == replayed, "the recording does not replay to the same bytes");
    let written = fs::read(dir.join("sent")).unwrap();
    assert!(written.len() > 20_000, "{} bytes sent", written.len());
    // the last of them may not have left before the end
    assert!(sent.starts_with(&written), "the recording does not replay to what was sent");
    assert!(sent.len() - written.len() < 2_000, "{} bytes never left", sent.len() - written.len());
    let seen = |word: &str| states.iter().any(|state| state.contains(word));
    assert!(seen("lost") && seen("absent") && seen("open"), "{states:?}");
}

#[test]
fn a_run_with_raw_satellites_over_real_lines_replays_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    let scenario = variant(26, &[("grade = \"mems\"", "grade = \"navigation\"")]);
    let scenario = scenario.with_duration(WITH_RAW + 5.0);
    let (voyage, raw) = (simulate(&scenario, 1), raw_gnss(&scenario, 1).unwrap());
    let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx]);
    let text = configuration(dir, &feeds, &voyage);
    let config = Config::of_text(&text).unwrap();
    let nav = dir.join("nav.csv");
    let seconds = Some(WITH_RAW + 3.0);
    let options = RunOptions { nav: Some(nav.clone()), seconds, ..RunOptions::default() };
    let start_gps = feeds.sensors[1].calendar.start.to_gps();
    let mut sendings = feed(&voyage, &feeds);
    sendings.extend(raw_feed::ubx(&raw, start_gps, 1));
    sendings.sort_by_key(|sending| sending.at);
    let daemon = start(&config, &text, options);
    send(dir, &sendings, WITH_RAW, 0.0..0.0, |_| ());
    daemon.join().unwrap();

    let replayed = replay(dir, &config);
    let live = fs::read(&nav).unwrap();
    assert!(live.len() > 10_000, "{} bytes of solutions", live.len());
    assert!(live == replayed.nav, "the recording does not replay to the same bytes");
    let rows = String::from_utf8(live).unwrap();
    let counts = rows.lines().skip(1).filter_map(|row| row.rsplit(',').nth(1)?.parse().ok());
    let counts: Vec<u32> = counts.collect();
    assert!(counts.len() > 10 && counts.iter().all(|count| *count > 4), "{counts:?}");
    let codes = replayed.accepted.get("satellite_code").copied().unwrap_or(0);
    assert!(codes > 3, "{codes} epochs of ranges used: {:?}", replayed.accepted);
}

fn start(config: &Config, text: &str, options: RunOptions) -> JoinHandle<()> {
    let (config, text) = (config.clone(), text.to_owned());
    std::thread::spawn(move || run(&config, &text, &options, &Log::silent()).unwrap())
}

fn configuration(dir: &Path, feeds: &FeedConfig, voyage: &insd_base::Voyage) -> String {
    let mut text = format!("[recording]\nfolder = {:?}\n", dir.join("recording"));
    let shipped = include_str!("../../../systemd/examples/survey.toml");
    let imu = shipped.find("[imu]").unwrap()..shipped.find("[[port]]").unwrap();
    let arm = voyage.header.lever_arms.gnss.0;
    let lever_m = [arm.x, arm.y, arm.z];
    text.push_str(&format!("[ship]\nstart = \"underway\"\ngnss_lever_m = {lever_m:?}\n"));
    text.push_str(&shipped[imu]);
    for (port, sensor) in feeds.intake(voyage).sensors.iter().enumerate() {
        let (name, device) = (&sensor.port, dir.join(format!("tty{port}")));
        let transport = "kind = \"serial\"\nbaud = 921600";
        text.push_str(&format!(
            "[[port]]\nname = {name:?}\n[port.transport]\n{transport}\ndevice = {device:?}\n"
        ));
        let table = toml::Table::try_from(sensor).unwrap();
        let wrapped = toml::Table::from_iter([("sensor".to_owned(), vec![table].into())]);
        text.push_str(&wrapped.to_string());
    }
    text.push_str(&format!(
        "[[point]]\nname = \"bow\"\nlever_m = [60.0, 0.0, -5.0]\n\
         [[output]]\nname = \"bridge\"\npoint = \"bow\"\nprofile = \"bridge\"\n\
         messages = {{ HDT = 20, ROT = 20, RMC = 5, \"PSXN.23\" = 20 }}\n\
         destination = {{ kind = \"file\", path = {:?} }}\n",
        dir.join("sent")
    ));
    text
}

/// Sends in real time; the receiver's line is pulled and put back on the way. What is of a port from [`ELSEWHERE`] on goes another way.
fn send(
    dir: &Path,
    sendings: &[LineSending],
    sailed: f64,
    unplugged: Range<f64>,
    mut elsewhere: impl FnMut(&LineSending),
) {
    let open = |port: usize| Wire::new(&dir.join(format!("tty{port}"))).unwrap();
    let on_lines = sendings.iter().filter(|sending| sending.port < ELSEWHERE);
    let ports = on_lines.map(|sending| sending.port + 1).max().unwrap();
    let mut wires: Vec<Option<Wire>> = (0..ports).map(|port| Some(open(port))).collect();
    // absent lines are looked for again within a second
    std::thread::sleep(Duration::from_millis(1500));
    let clock = Clock::start();
    for sending in sendings {
        let due = sending.at.as_seconds();
        if due > sailed {
            break;
        }
        let wait = due - clock.elapsed().as_secs_f64();
        if wait > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(wait));
        }
        if sending.port >= ELSEWHERE {
            elsewhere(sending);
            continue;
        }
        if sending.port == 1 && unplugged.contains(&due) {
            wires[1] = None;
            continue;
        }
        let wire = wires[sending.port].get_or_insert_with(|| open(sending.port));
        wire.send(sending.bytes()).unwrap();
    }
}

/// What comes of a recording.
struct Replayed {
    /// The solutions as `nav.csv`.
    nav: Vec<u8>,
    /// What the port was sent.
    sent: Vec<u8>,
    /// The states of ports.
    states: Vec<String>,
    /// Measurements used, by aid.
    accepted: BTreeMap<&'static str, u64>,
    /// The solutions, with UTC as far as it was known.
    solutions: Vec<(Solution, Option<UtcTime>)>,
    /// Changes of the source of the solutions.
    sources: Vec<&'static str>,
}

fn replay(dir: &Path, config: &Config) -> Replayed {
    let mut pipeline = config.pipeline();
    let mut nav = NavWriter::new(Vec::new()).unwrap();
    let (mut sent, mut states) = (Vec::new(), Vec::new());
    let (mut solutions, mut sources) = (Vec::new(), Vec::new());
    for arrival in RawReader::open(&dir.join("recording")).unwrap() {
        let arrival = arrival.unwrap();
        if let insd_base::Input::State(state) = &arrival.input {
            states.push(state.to_string());
        }
        pipeline.handle(&arrival, |product| match product {
            Product::Engine(Output::Solution(solution)) => {
                nav.write(&solution).unwrap();
                solutions.push((solution, None));
            }
            Product::Engine(Output::Event(Event::SourceChanged { to, .. })) => {
                sources.push(to.as_str());
            }
            Product::Engine(Output::Satellite(told)) => nav.hear_satellite(&told),
            Product::Engine(Output::Event(Event::SatelliteJudged {
                satellite,
                is_excluded,
                ..
            })) => nav.leave_out(satellite, is_excluded),
            Product::Spoken(Spoken::Messages(_, messages)) => {
                sent.extend(messages.iter().flat_map(|message| message.content.to_bytes()));
            }
            _ => {}
        });
        for (solution, utc) in solutions.iter_mut().rev().take_while(|(_, utc)| utc.is_none()) {
            *utc = pipeline.utc_at(solution.time);
        }
    }
    let accepted = pipeline.counts().accepted.clone();
    let nav = nav.finish().unwrap();
    Replayed { nav, sent, states, accepted, solutions, sources }
}
