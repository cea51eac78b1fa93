//! How long an IMU frame takes to become a heading: from its last byte written to one pseudo terminal to
//! the first byte of the HDT it causes read from another, with ten outputs open, beside a bare echo from
//! one pseudo terminal to another through tokio at the same times.
//!
//! `cargo run --release -p insd-tests --example latency -- target/release/insd [SECONDS]`

#![allow(clippy::unwrap_used)] // a tool of the tests

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use insd::clock::Clock;
use insd_drivers::recording::{Compression, write_voyage};
use insd_simulator::{Scenario, shipped, simulate};
use insd_tests::feed::{Encoding, FeedConfig, feed};
use insd_tests::wire::Wire;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio_serial::SerialPortBuilderExt;

/// Ports that the daemon writes to.
const OUTPUTS: usize = 10;
/// Time until the ship is aligned and sends headings, s.
const SETTLE: f64 = 60.0;
/// IMU samples per second.
const RATE: f64 = 200.0;

/// When bytes came, s.
type Times = Arc<Mutex<Vec<f64>>>;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let insd = arguments.next().unwrap_or_else(|| "target/release/insd".to_owned());
    let seconds: f64 = arguments.next().map_or(60.0, |text| text.parse().unwrap());
    let dir = std::env::temp_dir().join(format!("insd-latency-{}", std::process::id()));
    fs::create_dir_all(&dir).unwrap();

    let rate = "imu.rate_hz=200".parse().unwrap();
    let scenario = Scenario::with_overrides(shipped()[0].1, &[rate]).unwrap();
    let voyage = simulate(&scenario, 1);
    write_voyage(&dir.join("voyage"), &voyage, Compression::None).unwrap();
    let mut feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx, Encoding::Ths]);
    for sensor in &mut feeds.sensors {
        sensor.latency = 0.0;
        sensor.byte_time = 0.0;
    }
    let mut wires: Vec<Wire> =
        (0..3).map(|port| Wire::new(&dir.join(format!("tty{port}"))).unwrap()).collect();
    fs::write(dir.join("insd.toml"), configuration(&dir, &feeds, &voyage)).unwrap();
    let clock = Clock::start();
    let outputs: Vec<Wire> =
        (0..OUTPUTS).map(|port| Wire::new(&dir.join(format!("out{port}"))).unwrap()).collect();
    let mut heard: Vec<Times> =
        outputs.iter().map(|wire| listen(wire.file().unwrap(), clock)).collect();
    let mut daemon =
        Command::new(insd).args(["run", "--config"]).arg(dir.join("insd.toml")).spawn().unwrap();
    std::thread::sleep(Duration::from_secs(1));

    let headings = heard.swap_remove(0);
    let mut echo_in = Wire::new(&dir.join("echo-in")).unwrap();
    let (echoes, _out, _runtime) = echo(&dir, clock);
    let (mut frames, mut calls) = (Vec::new(), Vec::new());
    let begun = clock.elapsed().as_secs_f64();
    for sending in feed(&voyage, &feeds) {
        let due = sending.at.as_seconds();
        if due > SETTLE + seconds {
            break;
        }
        wait_until(&clock, begun + due);
        let is_imu = sending.port == 0;
        wires[sending.port].send(sending.bytes()).unwrap();
        if is_imu && due > SETTLE {
            frames.push(clock.elapsed().as_secs_f64());
            wait_until(&clock, begun + due + 0.4 / RATE);
            echo_in.send(b"$HEHDT,000.00,T*00\r\n").unwrap();
            calls.push(clock.elapsed().as_secs_f64());
        }
    }
    std::thread::sleep(Duration::from_millis(200));
    report("IMU frame to HDT", &frames, &headings.lock().unwrap());
    report("bare echo", &calls, &echoes.lock().unwrap());
    stop(&mut daemon);
    fs::remove_dir_all(&dir).unwrap();
}

fn configuration(dir: &Path, feeds: &FeedConfig, voyage: &insd_base::Voyage) -> String {
    let mut text = format!("[ship]\nstart = \"moored\"\nrate_hz = {RATE}\n");
    let header = fs::read_to_string(dir.join("voyage/voyage.toml")).unwrap();
    let mut header: toml::Table = header.parse().unwrap();
    if let Some(imu) = header.get_mut("imu").and_then(toml::Value::as_table_mut) {
        imu.remove("rate_hz");
        let wrapped = toml::Table::from_iter([("imu".to_owned(), imu.clone().into())]);
        text.push_str(&wrapped.to_string());
    }
    for (port, sensor) in feeds.intake(voyage).sensors.iter().enumerate() {
        let device = dir.join(format!("tty{port}"));
        text.push_str(&format!(
            "[[port]]\nname = {:?}\n[port.transport]\nkind = \"serial\"\ndevice = {device:?}\nbaud = 921600\n",
            sensor.port
        ));
        let table = toml::Table::try_from(sensor).unwrap();
        let wrapped = toml::Table::from_iter([("sensor".to_owned(), vec![table].into())]);
        text.push_str(&wrapped.to_string());
    }
    for output in 0..OUTPUTS {
        let path = dir.join(format!("out{output}"));
        text.push_str(&format!(
            "[[output]]\nname = \"out {output}\"\ndestination = {{ kind = \"serial\", device = {path:?}, baud = 921600 }}\n\
             sentences = {{ HDT = {RATE} }}\n"
        ));
    }
    text
}

/// Notes when each line begins that comes over a pseudo terminal.
fn listen(mut file: File, clock: Clock) -> Times {
    let times = Times::default();
    let noted = Arc::clone(&times);
    std::thread::spawn(move || {
        let mut buffer = [0; 4096];
        let mut ended = true;
        while let Ok(count) = file.read(&mut buffer) {
            let now = clock.elapsed().as_secs_f64();
            for byte in &buffer[..count] {
                if ended {
                    noted.lock().unwrap().push(now);
                }
                ended = *byte == b'\n';
            }
            if count == 0 {
                break;
            }
        }
    });
    times
}

/// A bare echo: from one pseudo terminal to another, through tokio.
fn echo(dir: &Path, clock: Clock) -> (Times, Wire, tokio::runtime::Runtime) {
    let out = Wire::new(&dir.join("echo-out")).unwrap();
    let times = listen(out.file().unwrap(), clock);
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().unwrap();
    let [from, to] = ["echo-in", "echo-out"].map(|name| dir.join(name).display().to_string());
    runtime.spawn(async move {
        let open = |path| tokio_serial::new(path, 921_600).open_native_async().unwrap();
        let (mut from, mut to) = (open(from), open(to));
        let mut buffer = [0; 4096];
        while let Ok(count) = AsyncReadExt::read(&mut from, &mut buffer).await {
            let answer = &buffer[..count];
            if count == 0 || AsyncWriteExt::write_all(&mut to, answer).await.is_err() {
                break;
            }
        }
    });
    (times, out, runtime)
}

fn wait_until(clock: &Clock, due: f64) {
    let wait = due - clock.elapsed().as_secs_f64();
    if wait > 0.0 {
        std::thread::sleep(Duration::from_secs_f64(wait));
    }
}

/// From each cause to the first effect after it and before the next cause.
fn report(what: &str, causes: &[f64], effects: &[f64]) {
    let mut delays = Vec::new();
    let mut missing = 0;
    for pair in causes.windows(2) {
        let after = effects.partition_point(|effect| effect < &pair[0]);
        match effects.get(after).filter(|effect| **effect < pair[1]) {
            Some(effect) => delays.push(effect - pair[0]),
            None => missing += 1,
        }
    }
    delays.sort_by(f64::total_cmp);
    let quantile = |share: f64| {
        let index = (delays.len() as f64 * share) as usize;
        delays.get(index.min(delays.len().saturating_sub(1))).copied().unwrap_or(f64::NAN) * 1e6
    };
    println!(
        "{what:18} median {:6.0} us  p99 {:6.0} us  greatest {:6.0} us  of {}, {missing} without an answer in time",
        quantile(0.5),
        quantile(0.99),
        quantile(1.0),
        delays.len()
    );
}

fn stop(daemon: &mut Child) {
    let pid = rustix::process::Pid::from_child(daemon);
    rustix::process::kill_process(pid, rustix::process::Signal::TERM).unwrap();
    daemon.wait().unwrap();
}
