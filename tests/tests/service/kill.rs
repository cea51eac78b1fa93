//! The daemon is killed without a warning, in every mode, and started again.

use std::sync::Arc;
use std::time::Duration;

use super::daemon::{Daemon, status, wait_until};
use super::heard::{attitudes, first_heading, forget};
use super::ship::{GNSS, LOG, Ship};

/// The voyage has come so far when the daemon is started with a state: aligned, s.
const ALIGNED: f64 = 240.0;
/// After this time at most heading is sent again.
const AGAIN: Duration = Duration::from_secs(2);
/// What systemd waits before it starts the daemon again.
const RESTART: Duration = Duration::from_millis(100);

fn mode(ship: &Ship) -> String {
    let status = status(ship.page);
    status
        .map(|own| own["mode"]["name"].as_str().unwrap_or_default().to_owned())
        .unwrap_or_default()
}

/// Kills it and starts it again; how long it took until heading was sent again, and by how many claimed
/// sigmas attitudes were wrong at most in the first seconds.
fn kill_and_restart(ship: &Ship, daemon: Daemon) -> (Daemon, Option<Duration>, f64) {
    daemon.kill();
    forget(&ship.output);
    std::thread::sleep(RESTART);
    let daemon = Daemon::start(ship);
    let again = first_heading(ship, AGAIN * 5);
    // attitudes that are held against the truth need UTC, which the sensors tell once a second
    let all = attitudes(ship, 2.5);
    assert!(!all.is_empty(), "no attitude with its time");
    let worst = all.iter().map(|own| own.error.abs() / own.sigma).fold(0.0, f64::max);
    (daemon, again.map(|took| took + RESTART), worst)
}

#[test]
fn killed_under_way_she_has_a_good_heading_again_within_two_seconds() {
    let ship = Arc::new(Ship::under_way(ALIGNED + 40.0, 3));
    ship.leave_state(ALIGNED);
    let _sailing = ship.sail(ALIGNED);
    let mut daemon = Daemon::start(&ship);
    wait_until("aided", || mode(&ship) == "aided");
    for round in 0..4 {
        let (next, took, worst) = kill_and_restart(&ship, daemon);
        daemon = next;
        let took = took.expect("a heading");
        println!("round {round}: heading after {took:?}, at most {worst:.2} sigmas wrong");
        assert!(took < AGAIN, "{took:?}");
        assert!(worst < 3.0, "{worst}");
        std::thread::sleep(Duration::from_millis(700));
    }
    daemon.stop();
}

#[test]
fn killed_without_gnss_she_goes_on_by_log_and_without_that_by_the_imu_alone() {
    let ship = Arc::new(Ship::under_way(ALIGNED + 150.0, 4));
    ship.leave_state(ALIGNED);
    let sailing = ship.sail(ALIGNED);
    let mut daemon = Daemon::start(&ship);
    wait_until("aided", || mode(&ship) == "aided");
    for (mute, wanted) in [(&[GNSS][..], "dead_reckoning"), (&[GNSS, LOG][..], "inertial")] {
        sailing.mute(mute);
        wait_until(wanted, || mode(&ship) == wanted);
        let (next, took, worst) = kill_and_restart(&ship, daemon);
        daemon = next;
        println!("{wanted}: heading after {took:?}, at most {worst:.2} sigmas wrong");
        assert!(took.expect("a heading") < AGAIN && worst < 3.0);
        wait_until(wanted, || mode(&ship) == wanted);
    }
}

#[test]
fn killed_while_it_waits_or_aligns_it_begins_anew() {
    // neither a course nor waves tell a drifter on a calm sea where she points: it takes her gyros minutes
    let slow = ("speed_kn = 10.0\nduration_s = 270.0", "speed_kn = 0.5\nduration_s = 270.0");
    let calm = ("state = 4", "state = 0");
    let ship = Arc::new(Ship::on(&[slow, calm, ("[gnss]", "[gnss]\nrate_hz = 5.0")], 90.0, 5));
    let mut daemon = Daemon::start(&ship);
    wait_until("standby", || mode(&ship) == "standby");
    daemon.kill();
    let sailing = ship.sail(0.0);
    daemon = Daemon::start(&ship);
    wait_until("coarse", || mode(&ship) == "coarse_alignment");
    daemon.kill();
    daemon = Daemon::start(&ship);
    wait_until("in motion", || mode(&ship) == "in_motion_alignment");
    daemon.kill();
    daemon = Daemon::start(&ship);
    // a heading that was found is gone on from, even before it is good enough to steer by
    wait_until("in motion again", || {
        ["in_motion_alignment", "aided"].contains(&mode(&ship).as_str())
    });
    assert!(daemon.is_running());
    drop(sailing);
}
