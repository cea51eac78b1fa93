//! Strangers on the network, a log that is switched off, and a disk that takes nothing.

use std::fs;
use std::net::UdpSocket;
use std::sync::Arc;

use insd_output::Talker;
use insd_output::alerts::Condition;
use insd_wire::nmea::{Acn, AlertCommand};

use super::daemon::{Daemon, status, wait_until};
use super::ship::{Ship, free_ports};

const ALIGNED: f64 = 240.0;

/// How an alert stands on the page; empty if it is normal.
fn alert(ship: &Ship, condition: Condition) -> String {
    let identifier = condition.alert().identifier;
    let alerts = status(ship.page).map(|own| own["alerts"].clone()).unwrap_or_default();
    let own = alerts.as_array().and_then(|all| all.iter().find(|own| own["id"] == identifier));
    own.and_then(|own| own["state"].as_str()).unwrap_or_default().to_owned()
}

fn log(ship: &Ship) -> String {
    fs::read_to_string(ship.path().join("log")).unwrap()
}

#[test]
fn a_command_of_a_stranger_is_refused_and_logged_although_the_log_is_off_and_that_of_the_bridge_obeyed()
 {
    let ship = Arc::new(Ship::under_way(10.0, 3));
    let [port] = free_ports();
    let more = format!(
        "[[port]]\nname = \"bridge-in\"\nalerts = true\ncommands_from = [\"127.0.0.2\"]\n\
         transport = {{ kind = \"udp\", bind = \"{port}\", from = [\"127.0.0.2/31\"] }}\n\
         [log]\nlevel = \"off\"\n"
    );
    let text = ship.text(&more).replace("HDT = 10 }", "HDT = 10, ALF = 1 }");
    fs::write(ship.config(), text).unwrap();
    let daemon = Daemon::start(&ship);
    // no sensor speaks
    let fault = Condition::SystemFault;
    wait_until("the system fault", || alert(&ship, fault) == "unacknowledged");
    let command = Acn { time: None, alert: fault.alert(), command: AlertCommand::Acknowledge };
    let send = |host: &str| {
        let socket = UdpSocket::bind((host, 0)).unwrap();
        socket.send_to(command.write(Talker::IN).as_bytes(), port).unwrap();
    };
    send("127.0.0.4");
    wait_until("a stranger", || {
        status(ship.page).is_some_and(|own| own["inputs"][3]["refused"] == 1)
    });
    send("127.0.0.3");
    let mut datagram = [0; 2000];
    wait_until("the refusal", || {
        let mut heard = std::iter::from_fn(|| {
            let length = ship.output.recv(&mut datagram).ok()?;
            Some(String::from_utf8_lossy(&datagram[..length]).into_owned())
        });
        heard.any(|text| text.contains("ARC,"))
    });
    assert_eq!(alert(&ship, fault), "unacknowledged");
    send("127.0.0.2");
    wait_until("the acknowledgement", || alert(&ship, fault) == "acknowledged");
    daemon.stop();
    let log = log(&ship);
    for line in [
        "insd starts",
        "refused: 127.0.0.4, which is not listed",
        "a command is refused: its sender is not listed port=\"bridge-in\" host=\"127.0.0.3\"",
        "a command of the bridge port=\"bridge-in\" host=\"127.0.0.2\"",
        "insd stops why=\"told to stop\"",
    ] {
        assert!(log.contains(line), "{line}: {log}");
    }
    assert!(log.lines().all(|line| line.contains(" security: ")), "{log}");
}

#[test]
fn what_cannot_be_written_raises_an_alert_until_it_can() {
    let ship = Arc::new(Ship::under_way(ALIGNED + 120.0, 3));
    ship.leave_state(ALIGNED);
    let recordings = ship.path().join("recordings");
    let more = format!("[recording]\nfolder = {recordings:?}\nquota_mb = 100\n");
    fs::write(ship.config(), ship.text(&more)).unwrap();
    let _sailing = ship.sail(ALIGNED);
    let daemon = Daemon::start(&ship);
    let [_, state] = ship.folders();
    wait_until("a recording", || recordings.exists());
    let written = |own: &serde_json::Value| own["saving"]["saved"].as_u64() > Some(0);
    wait_until("a state", || status(ship.page).as_ref().is_some_and(written));
    for (folder, condition) in
        [(&recordings, Condition::NotRecording), (&state, Condition::NotSaving)]
    {
        assert_eq!(alert(&ship, condition), "");
        fs::remove_dir_all(folder).unwrap();
        wait_until(condition.title(), || alert(&ship, condition) == "acknowledged");
        assert!(!folder.exists(), "it is not made anew");
        fs::create_dir(folder).unwrap();
        wait_until("all is well", || alert(&ship, condition).is_empty());
    }
    daemon.stop();
}
