//! Compasses of others at the daemon's ports, and what the page says of them.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use insd::clock::Clock;
use insd_base::Time;
use insd_base::units::DEG;
use insd_output::alerts::Condition;
use insd_wire::nmea::{Hdt, Talker};
use serde_json::Value;

use super::daemon::{Daemon, status, wait_until};
use super::ship::{Ship, free_ports};

const ALIGNED: f64 = 240.0;

fn comparison(own: &Value, sensor: &str, against: &Value) -> Option<Value> {
    let all = own["watched"].as_array()?;
    all.iter().find(|row| row["sensor"] == sensor && row["against"] == *against).cloned()
}

/// Sections of two compasses that are watched.
fn sections(ports: &[SocketAddr]) -> String {
    let own = |(number, port): (usize, &SocketAddr)| {
        let name = format!("gyro {number}");
        format!(
            "[[port]]\nname = \"{name}\"\ntransport = {{ kind = \"udp\", bind = \"{port}\" }}\n\
             [[sensor]]\nname = \"{name}\"\nport = \"{name}\"\nkind = \"compass\"\nheading_std_deg = 0.5\n\
             [[watch]]\nsensor = \"{name}\"\n"
        )
    };
    (1..).zip(ports).map(own).collect()
}

/// Sends the true heading to the first and two degrees more to the second, five times a second, until it is over.
fn send(ship: &Ship, clock: Clock, ports: &[SocketAddr], is_over: &AtomicBool) {
    let socket = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    while !is_over.load(Ordering::Relaxed) {
        let at = Time::from_seconds(ALIGNED + clock.elapsed().as_secs_f64());
        for (port, off) in ports.iter().zip([0.0, 2.0]) {
            let heading = Some(ship.heading(at) + off * DEG);
            let line = Hdt { heading }.write(Talker::HE);
            let _ = socket.send_to(line.as_bytes(), port);
        }
        std::thread::sleep(Duration::from_millis(200));
    }
}

/// Waits until the alert stands on the page and its text has been told the bridge.
fn wait_for_alert(ship: &Ship, text: &str) {
    let identifier = Condition::HeadingMonitor.alert().identifier;
    wait_until("the alert", || {
        let alerts = status(ship.page).map(|own| own["alerts"].clone()).unwrap_or_default();
        let mut all = alerts.as_array().into_iter().flatten();
        all.any(|own| own["id"] == identifier && own["description"] == text)
    });
    let mut datagram = [0; 2000];
    wait_until("its sentence", || {
        let mut heard = std::iter::from_fn(|| {
            let length = ship.output.recv(&mut datagram).ok()?;
            Some(String::from_utf8_lossy(&datagram[..length]).into_owned())
        });
        heard.any(|line| line.contains("ALF,2,2") && line.contains(text))
    });
}

#[test]
fn the_page_and_the_bridge_are_told_within_ten_seconds_which_of_two_old_compasses_is_off() {
    let ship = Arc::new(Ship::under_way(ALIGNED + 60.0, 3));
    let ports = free_ports::<2>();
    ship.leave_state(ALIGNED);
    let text = ship.text(&sections(&ports)).replace("HDT = 10 }", "HDT = 10, ALF = 1 }");
    std::fs::write(ship.config(), text).unwrap();
    let daemon = Daemon::start(&ship);
    let _sailing = ship.sail(ALIGNED);
    let (clock, is_over) = (Clock::start(), Arc::new(AtomicBool::new(false)));
    let sender = std::thread::spawn({
        let (ship, is_over) = (Arc::clone(&ship), Arc::clone(&is_over));
        move || send(&ship, clock, &ports, &is_over)
    });
    wait_until("navigating", || {
        status(ship.page).is_some_and(|own| own["mode"]["name"] == "aided")
    });
    let begun = clock.elapsed();
    let named = |own: &Value| {
        comparison(own, "gyro 2", &Value::Null).is_some_and(|row| row["wrong"] == "gyro 2")
    };
    wait_until("the wrong one is named", || status(ship.page).is_some_and(|own| named(&own)));
    let taken = (clock.elapsed() - begun).as_secs_f64();
    println!("named {taken:.1} s after she navigates");
    assert!(taken < 10.0, "{taken} s");
    let own = status(ship.page).unwrap();
    let right = comparison(&own, "gyro 1", &Value::Null).unwrap();
    assert_eq!((&right["differs"], &right["wrong"]), (&Value::Bool(false), &Value::Null));
    let both = comparison(&own, "gyro 1", &"gyro 2".into()).unwrap();
    assert_eq!(both["wrong"], "gyro 2");
    assert!((both["difference_deg"].as_f64().unwrap() + 2.0).abs() < 0.3, "{both}");
    wait_for_alert(&ship, "gyro 2 wrong. Do not use");
    is_over.store(true, Ordering::Relaxed);
    sender.join().unwrap();
    daemon.stop();
}
