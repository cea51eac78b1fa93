//! When outputs leave: at 50 Hz on ten ports, beside a load of busy threads, how long after its UTC boundary
//! an epoch can be read at the far end of a pseudo terminal, and what the daemon itself says of its ports.
//!
//! `cargo run --release -p insd-tests --example timing -- target/release/insd [SECONDS [BUSY THREADS]]`

#![allow(clippy::unwrap_used)] // a tool of the tests

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use insd::clock::Clock;
use insd_base::UtcTime;
use insd_drivers::recording::{Compression, write_voyage};
use insd_simulator::{Scenario, shipped, simulate};
use insd_tests::feed::{Encoding, FeedConfig, feed};
use insd_tests::wire::Wire;
use insd_wire::nmea::{Sentence, Zda};
use thread_priority::{
    RealtimeThreadSchedulePolicy, ThreadPriority, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};

/// Ports that the daemon writes to.
const OUTPUTS: usize = 10;
/// Time until the ship is aligned and sends headings, s.
const SETTLE: f64 = 60.0;
/// Epochs of each port per second.
const OUTPUT_RATE: f64 = 50.0;

/// Lines and when the last of their bytes came, s.
type Heard = Arc<Mutex<Vec<(f64, String)>>>;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let insd = arguments.next().unwrap_or_else(|| "target/release/insd".to_owned());
    let seconds: f64 = arguments.next().map_or(60.0, |text| text.parse().unwrap());
    let busy: usize = arguments.next().map_or(0, |text| text.parse().unwrap());
    let dir = std::env::temp_dir().join(format!("insd-timing-{}", std::process::id()));
    fs::create_dir_all(&dir).unwrap();

    let rate = "imu.rate_hz=200".parse().unwrap();
    let scenario = Scenario::with_overrides(shipped()[0].1, &[rate]).unwrap();
    let voyage = simulate(&scenario, 1);
    write_voyage(&dir.join("voyage"), &voyage, Compression::None).unwrap();
    let mut feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx, Encoding::Ths]);
    for sensor in &mut feeds.sensors {
        sensor.latency = 0.0;
        sensor.byte_time = 10.0 / 921_600.0;
    }
    let mut wires: Vec<Wire> =
        (0..3).map(|port| Wire::new(&dir.join(format!("tty{port}"))).unwrap()).collect();
    fs::write(dir.join("insd.toml"), configuration(&dir, &feeds, &voyage)).unwrap();
    let clock = Clock::start();
    let outputs: Vec<Wire> =
        (0..OUTPUTS).map(|port| Wire::new(&dir.join(format!("out{port}"))).unwrap()).collect();
    let heard: Vec<Heard> =
        outputs.iter().map(|wire| listen(wire.file().unwrap(), clock)).collect();
    for _ in 0..busy {
        std::thread::spawn(|| while std::hint::black_box(true) {});
    }
    let mut daemon =
        Command::new(insd).args(["run", "--config"]).arg(dir.join("insd.toml")).spawn().unwrap();
    // the sensors do not suffer from the load, and whoever listens does not; the daemon does
    ahead();
    std::thread::sleep(Duration::from_secs(1));

    let begun = clock.elapsed().as_secs_f64();
    let mut measured = None;
    for sending in feed(&voyage, &feeds) {
        let due = sending.at.as_seconds();
        if due > SETTLE + seconds {
            break;
        }
        wait_until(&clock, begun + due);
        wires[sending.port].send(sending.bytes()).unwrap();
        if due > SETTLE && measured.is_none() {
            measured = Some(heard[0].lock().unwrap().len());
        }
    }
    std::thread::sleep(Duration::from_millis(200));
    let lines = heard[0].lock().unwrap();
    report(&lines[measured.unwrap_or(0)..], begun, feeds.sensors[0].calendar.start);
    stop(&mut daemon);
    fs::remove_dir_all(&dir).unwrap();
}

fn configuration(dir: &Path, feeds: &FeedConfig, voyage: &insd_base::Voyage) -> String {
    let mut text = "[ship]\nstart = \"moored\"\nrate_hz = 10\n".to_owned();
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
             messages = {{ HDT = {OUTPUT_RATE}, ROT = {OUTPUT_RATE}, ZDA = {OUTPUT_RATE} }}\n"
        ));
    }
    text
}

/// Lets this thread go before all others, if that is allowed.
fn ahead() {
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    let value = ThreadPriority::Crossplatform(30.try_into().unwrap());
    if let Err(fault) = set_thread_priority_and_policy(thread_native_id(), value, policy) {
        println!("no real-time priority for the sensors: {fault:?}");
    }
}

/// Notes each line that comes over a pseudo terminal, and when it was whole.
fn listen(mut file: File, clock: Clock) -> Heard {
    let lines = Heard::default();
    let noted = Arc::clone(&lines);
    std::thread::spawn(move || {
        ahead();
        let (mut buffer, mut line) = ([0; 4096], Vec::new());
        while let Ok(count @ 1..) = file.read(&mut buffer) {
            let now = clock.elapsed().as_secs_f64();
            for byte in &buffer[..count] {
                line.push(*byte);
                if *byte == b'\n' {
                    let text = String::from_utf8_lossy(&std::mem::take(&mut line)).into_owned();
                    noted.lock().unwrap().push((now, text));
                }
            }
        }
    });
    lines
}

fn wait_until(clock: &Clock, due: f64) {
    let wait = due - clock.elapsed().as_secs_f64();
    if wait > 0.0 {
        std::thread::sleep(Duration::from_secs_f64(wait));
    }
}

/// How late each epoch's last byte could be read after the boundary that its ZDA names, by the feed's UTC.
fn report(heard: &[(f64, String)], begun: f64, start: UtcTime) {
    let mut late: Vec<f64> = heard
        .iter()
        .filter_map(|(at, line)| {
            let utc = zda(line)?;
            Some(at - begun - utc.since(start).as_seconds())
        })
        .collect();
    late.sort_by(f64::total_cmp);
    let quantile = |share: f64| {
        let index = (late.len() as f64 * share) as usize;
        late.get(index.min(late.len().saturating_sub(1))).copied().unwrap_or(f64::NAN) * 1e3
    };
    let within = late.iter().filter(|late| late.abs() <= 1e-3).count();
    println!(
        "{} epochs read at the far end, after their UTC boundary: median {:.3} ms, 1 % {:.3}, 99 % {:.3}, \
         greatest {:.3}; within 1 ms {:.2} %",
        late.len(),
        quantile(0.5),
        quantile(0.01),
        quantile(0.99),
        quantile(1.0),
        100.0 * within as f64 / late.len().max(1) as f64
    );
}

/// The instant of a ZDA.
fn zda(line: &str) -> Option<UtcTime> {
    match Sentence::read(line.as_bytes()).ok()?.1 {
        Sentence::Zda(Zda { utc: Some(utc), .. }) => utc.to_utc(),
        _ => None,
    }
}

fn stop(daemon: &mut Child) {
    let pid = rustix::process::Pid::from_child(daemon);
    rustix::process::kill_process(pid, rustix::process::Signal::TERM).unwrap();
    daemon.wait().unwrap();
}
