//! The daemon itself, over pseudo terminals: what it recorded replays to the same bytes, and a sensor
//! that is unplugged and plugged in again is read again.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::fs;
use std::path::Path;
use std::time::Duration;

use insd::clock::Clock;
use insd::logging::Log;
use insd::run::{RunOptions, run};
use insd_config::Config;
use insd_drivers::raw::RawReader;
use insd_drivers::recording::NavWriter;
use insd_engine::Output;
use insd_simulator::simulate;
use insd_tests::feed::{Encoding, FeedConfig, Sending, feed};
use insd_tests::scenario;
use insd_tests::wire::Wire;
use insd_vessel::{Product, Spoken};

/// Seconds of the voyage that are sailed, and when the receiver is unplugged and plugged in again.
const SAILED: f64 = 25.0;
const UNPLUGGED: std::ops::Range<f64> = 14.0..17.0;

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
    let sendings = feed(&voyage, &feeds);
    let daemon = std::thread::spawn({
        let (config, text) = (config.clone(), text.clone());
        move || run(&config, &text, &options, &Log::silent())
    });
    send(dir, &sendings);
    daemon.join().unwrap().unwrap();

    let (replayed, sent, states) = replay(dir, &config);
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

fn configuration(dir: &Path, feeds: &FeedConfig, voyage: &insd_base::Voyage) -> String {
    let mut text = format!("[recording]\nfolder = {:?}\n", dir.join("recording"));
    let shipped = include_str!("../../systemd/examples/survey.toml");
    let imu = shipped.find("[imu]").unwrap()..shipped.find("[[port]]").unwrap();
    text.push_str("[ship]\nstart = \"underway\"\ngnss_lever_m = [0.0, 0.0, -10.0]\n");
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

/// Sends in real time; the receiver's line is pulled and put back on the way.
fn send(dir: &Path, sendings: &[Sending]) {
    let open = |port: usize| Wire::new(&dir.join(format!("tty{port}"))).unwrap();
    let mut wires: Vec<Option<Wire>> = (0..3).map(|port| Some(open(port))).collect();
    // absent lines are looked for again within a second
    std::thread::sleep(Duration::from_millis(1500));
    let clock = Clock::start();
    for sending in sendings {
        let due = sending.at.as_seconds();
        if due > SAILED {
            break;
        }
        let wait = due - clock.elapsed().as_secs_f64();
        if wait > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(wait));
        }
        if sending.port == 1 && UNPLUGGED.contains(&due) {
            wires[1] = None;
            continue;
        }
        let wire = wires[sending.port].get_or_insert_with(|| open(sending.port));
        wire.send(sending.bytes()).unwrap();
    }
}

/// The solutions of the recording as `nav.csv`, what the port was sent, and the states of ports in it.
fn replay(dir: &Path, config: &Config) -> (Vec<u8>, Vec<u8>, Vec<String>) {
    let mut pipeline = config.pipeline();
    let mut nav = NavWriter::new(Vec::new()).unwrap();
    let (mut sent, mut states) = (Vec::new(), Vec::new());
    for arrival in RawReader::open(&dir.join("recording")).unwrap() {
        let arrival = arrival.unwrap();
        if let insd_base::Input::State(state) = &arrival.input {
            states.push(state.to_string());
        }
        pipeline.handle(&arrival, |product| match product {
            Product::Engine(Output::Solution(solution)) => nav.write(&solution).unwrap(),
            Product::Spoken(Spoken::Messages(_, messages)) => {
                sent.extend(messages.iter().flat_map(|message| message.content.to_bytes()));
            }
            _ => {}
        });
    }
    (nav.finish().unwrap(), sent, states)
}
