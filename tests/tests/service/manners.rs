//! What the daemon says to the service manager, and what it does when it is told to read its configuration
//! again.

use std::sync::Arc;

use rustix::process::Signal;

use super::daemon::{Daemon, status, wait_until};
use super::heard::{attitudes, forget};
use super::ship::Ship;

const ALIGNED: f64 = 240.0;

#[test]
fn it_says_when_it_is_ready_how_it_is_and_that_it_lives() {
    let ship = Arc::new(Ship::under_way(30.0, 3));
    let _sailing = ship.sail(0.0);
    let daemon = Daemon::start(&ship);
    daemon.wait_for("READY=1");
    daemon.wait_for("STATUS=");
    for _ in 0..3 {
        daemon.wait_for("WATCHDOG=1");
    }
    daemon.signal(Signal::STOP);
    let _ = daemon.said();
    std::thread::sleep(std::time::Duration::from_secs(3));
    assert_eq!(daemon.said(), Vec::<String>::new(), "a watchdog of 2 s would have bitten");
    daemon.signal(Signal::CONT);
    daemon.wait_for("WATCHDOG=1");
    daemon.stop();
}

#[test]
fn a_broken_configuration_is_not_taken_and_a_good_one_is_without_losing_the_alignment() {
    let ship = Arc::new(Ship::under_way(ALIGNED + 60.0, 3));
    ship.leave_state(ALIGNED);
    let _sailing = ship.sail(ALIGNED);
    let mut daemon = Daemon::start(&ship);
    wait_until("navigating", || {
        status(ship.page).is_some_and(|own| own["mode"]["name"] == "aided")
    });
    let _ = daemon.said();

    std::fs::write(ship.config(), ship.text("[ship\n")).unwrap();
    daemon.signal(Signal::HUP);
    let said = daemon.wait_for("has faults: the old one holds");
    assert!(said.iter().any(|line| line == "RELOADING=1"), "{said:?}");
    assert!(said.iter().any(|line| line.starts_with("MONOTONIC_USEC=")), "{said:?}");
    assert!(daemon.is_running());

    // another rate, another output, and something that has to wait
    let text = ship.text("").replace("novatel\" = 10", "novatel\" = 5");
    let text = text.replace("gyro_bias_std_deg_h = 0.01", "gyro_bias_std_deg_h = 0.02");
    std::fs::write(ship.config(), text).unwrap();
    daemon.signal(Signal::HUP);
    daemon.wait_for("for the next start: imu");
    forget(&ship.output);
    let all = attitudes(&ship, 3.0);
    assert!((10..=20).contains(&all.len()), "{} attitudes in three seconds", all.len());
    assert!(all.iter().all(|own| own.error.abs() < 4.0 * own.sigma), "{all:?}");
    let modes = status(ship.page).unwrap()["modes"].clone();
    assert!(!modes.to_string().contains("coarse_alignment\",\"reason"), "{modes}");
    daemon.stop();
}

#[test]
fn a_port_that_is_not_there_at_the_start_is_opened_when_it_comes() {
    let ship = Arc::new(Ship::under_way(30.0, 3));
    let device = ship.path().join("tty-late");
    let late = format!(
        "[[port]]\nname = \"late\"\ntransport = {{ kind = \"serial\", device = {device:?}, \
         baud = 38400 }}\n"
    );
    std::fs::write(ship.config(), ship.text(&late)).unwrap();
    let _sailing = ship.sail(0.0);
    let daemon = Daemon::start(&ship);
    let state = |wanted: &str| {
        wait_until(wanted, || {
            status(ship.page).is_some_and(|own| own["inputs"][3]["state"] == wanted)
        });
    };
    state("absent");
    let _wire = insd_tests::wire::Wire::new(&device).unwrap();
    state("open");
    let own = status(ship.page).unwrap();
    assert_eq!(own["inputs"][0]["state"], "open");
    assert!(own["samples"]["used"].as_u64().unwrap() > 0);
    daemon.stop();
}
