//! What the daemon costs at 200 samples a second with ten outputs: processor, memory, and the time from its
//! start to the first message. `INSD_PROGRAM=target/release/insd cargo run --release -p
//! insd-tests --example footprint [SECONDS]`

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // a tool of the tests

#[path = "../../tests/service/daemon.rs"]
mod daemon;
#[path = "../../tests/service/heard.rs"]
mod heard;
#[path = "../../tests/service/ship.rs"]
mod ship;

use std::sync::Arc;
use std::time::Duration;

use insd::clock::Clock;

use daemon::{Daemon, status, wait_until};
use ship::Ship;

/// The voyage has come so far when the daemon is started with a state, s.
const ALIGNED: f64 = 240.0;

fn main() {
    let seconds: f64 = std::env::args().nth(1).map_or(60.0, |text| text.parse().unwrap());
    let changes =
        [("[gnss]", "[log]\n\n[gnss]\nrate_hz = 10.0"), ("[imu]", "[imu]\nrate_hz = 200.0")];
    let ship = Arc::new(Ship::on(&changes, ALIGNED + seconds + 30.0, 3));
    std::fs::write(ship.config(), ship.text(&nine_more())).unwrap();
    ship.leave_state(ALIGNED);
    let _sailing = ship.sail(ALIGNED);
    // sensors are at work before the daemon is
    std::thread::sleep(Duration::from_millis(500));
    let clock = Clock::start();
    let daemon = Daemon::start(&ship);
    let mut buffer = [0; 2048];
    while ship.output.recv(&mut buffer).is_err() {}
    let first = clock.elapsed();
    let heading = heard::first_heading(&ship, Duration::from_secs(20)).unwrap();
    println!("from the start to the first message {first:?}, to a heading {:?}", first + heading);
    wait_until("aided", || status(ship.page).is_some_and(|own| own["mode"]["name"] == "aided"));
    let before = status(ship.page).unwrap();
    std::thread::sleep(Duration::from_secs_f64(seconds));
    let after = status(ship.page).unwrap();
    let number = |own: &serde_json::Value, key: &str| own["program"][key].as_f64().unwrap();
    let grown = |key: &str| number(&after, key) - number(&before, key);
    let share = 100.0 * grown("processor_s") / grown("uptime_s");
    let memory = number(&after, "memory_bytes") / f64::from(1 << 20);
    println!("processor {share:.2} % of a core, memory {memory:.1} MiB");
    println!("schedule {}", after["schedule"]);
    daemon.stop();
}

/// Nine outputs beside the first, each with what an ECDIS wants.
fn nine_more() -> String {
    let one = |number: usize| {
        format!(
            "[[output]]\nname = \"out{number}\"\nprofile = \"ecdis\"\n\
             destination = {{ kind = \"udp\", to = \"127.0.0.1:9\" }}\n"
        )
    };
    (0..9).map(one).collect()
}
