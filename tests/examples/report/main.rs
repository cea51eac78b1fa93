//! The recording of a simulated day's work, to look at a report of it: she aligns at her berth, leaves,
//! loses GNSS for ten minutes, the receiver is unplugged, the IMU falls silent, and a line is damaged.
//!
//! `cargo run --release -p insd-tests --example report -- FOLDER`, then `insd report FOLDER`.

#![allow(clippy::unwrap_used)] // a tool of the tests

use std::path::PathBuf;

use insd_base::{Input, PortState};
use insd_simulator::{Scenario, simulate};
use insd_tests::feed::{Encoding, noise};
use insd_tests::recorded::{Recorded, alert};

const SCENARIO: &str = include_str!("voyage.toml");

const MORE: &str = r#"
[[point]]
name = "bow"
lever_m = [60.0, 0.0, -5.0]

[[output]]
name = "ecdis"
profile = "ecdis"
destination = { kind = "file", path = "/var/lib/insd/ecdis" }

[[output]]
name = "multibeam"
point = "bow"
messages = { "PSXN.23" = 20, HDT = 20 }
destination = { kind = "file", path = "/var/lib/insd/multibeam" }
"#;

fn main() {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "recording".to_owned()));
    let voyage = simulate(&Scenario::from_toml(SCENARIO).unwrap(), 1);
    let encodings = [Encoding::Sbg, Encoding::Ubx, Encoding::Vbw];
    let mut recorded = Recorded::new(&voyage, &encodings, MORE);
    // the receiver is unplugged and plugged in again
    recorded.silence(1, 2300.0, 2420.0);
    recorded.state(2300.0, 1, PortState::Lost { reason: "unplugged".to_owned() });
    recorded.state(2420.0, 1, PortState::Open { what: "line 1".to_owned() });
    // the IMU says nothing for a while; the bridge acknowledges the alert
    recorded.silence(0, 2700.0, 2712.0);
    recorded.acknowledge(2709.0, alert(3062));
    for burst in 0..40_u64 {
        let seconds = 2800.0 + 2.7 * burst as f64;
        recorded.insert(seconds, 2, Input::Bytes(noise(burst, 40)));
    }
    recorded.write(&folder);
}
