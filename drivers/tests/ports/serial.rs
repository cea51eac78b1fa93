//! Serial lines.

use std::time::Duration;

use insd_base::{Input, PortState};
use insd_drivers::ports::{
    BaudJudge, BaudJudgement, FlowControl, Parity, PortConfig, Serial, Transport,
};
use tokio::time::sleep;

use crate::host::{Device, Host};

fn serial(path: &std::path::Path) -> Transport {
    Transport::Serial(Serial::new(path.to_owned(), 115_200))
}

#[tokio::test]
async fn an_unplugged_device_is_lost_once_and_heard_again_when_it_is_plugged_in() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("imu");
    let mut host = Host::new();
    let mut device = Device::at(&link);
    let port = host.spawn(1, serial(&link));
    host.opened(1).await;
    device.say(b"before\n");
    host.bytes(1, b"before\n").await;
    assert_eq!(device.heard(), b"", "a listener writes nothing");

    drop(device);
    std::fs::remove_file(&link).unwrap();
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    // some attempts more, of which nothing new is to be told
    while port.attempts() < 4 {
        sleep(Duration::from_millis(50)).await;
    }
    let mut device = Device::at(&link);
    host.opened(1).await;
    device.say(b"after\n");
    host.bytes(1, b"after\n").await;

    let states = host.states(Some(1));
    let kinds: Vec<&str> = states.iter().filter_map(|state| state.split(':').next()).collect();
    assert_eq!(kinds, ["open", "lost", "absent", "open"], "{states:?}");
    assert!(port.attempts() < 20, "{} attempts", port.attempts());
}

#[tokio::test]
async fn a_device_that_is_absent_at_the_start_is_found_when_it_comes() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("gyro");
    let mut host = Host::new();
    let _port = host.spawn(1, serial(&link));
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    let mut device = Device::at(&link);
    host.opened(1).await;
    device.say(b"here\n");
    host.bytes(1, b"here\n").await;
    assert!(host.states(Some(1))[0].contains("gyro"), "the reason names the device");
}

#[tokio::test]
async fn what_came_before_the_line_was_opened_is_not_told_as_if_it_came_now() {
    let mut device = Device::new();
    device.say(b"long ago\n");
    let mut host = Host::new();
    let _port = host.spawn(1, serial(device.path()));
    host.opened(1).await;
    device.say(b"now\n");
    host.bytes(1, b"now\n").await;
    assert_eq!(host.sums(1).0, 4, "nothing but that");
}

#[tokio::test]
async fn what_is_no_serial_line_is_told_once_and_not_tried_without_pause() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    std::fs::write(&path, "text").unwrap();
    let mut host = Host::new();
    let port = host.spawn(1, serial(&path));
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    sleep(Duration::from_secs(1)).await;
    host.drain();
    assert_eq!(host.states(Some(1)).len(), 1, "{:?}", host.states(None));
    // after 0, 0.2, 0.6 and 1.4 s
    assert!(port.attempts() <= 4, "{} attempts in a second", port.attempts());
}

#[tokio::test]
async fn silence_is_told_once_and_speaking_again_too() {
    let mut device = Device::new();
    let mut host = Host::new();
    let config = PortConfig { patience_s: 0.2, ..PortConfig::new(serial(device.path())) };
    let _port = host.spawn_with(1, config);
    host.state(1, |state| matches!(state, PortState::Silent { .. })).await;
    sleep(Duration::from_millis(700)).await;
    device.say(b"x");
    host.bytes(1, b"x").await;
    let states = host.states(Some(1));
    let kinds: Vec<&str> =
        states.iter().filter_map(|state| state.split([':', ' ']).next()).collect();
    assert_eq!(kinds, ["open", "silent", "speaking"]);
    let speaking = host.seen.len() - 2;
    assert_eq!(host.seen[speaking].input, Input::State(PortState::Speaking));
    assert_eq!(host.seen[speaking].stamp, host.seen[speaking + 1].stamp);
}

#[tokio::test]
async fn a_terminal_takes_every_setting() {
    let device = Device::new();
    for (data_bits, stop_bits) in [(8, 1), (7, 2)] {
        for flow_control in [FlowControl::None, FlowControl::Software, FlowControl::Hardware] {
            for parity in [Parity::None, Parity::Odd, Parity::Even] {
                let mut host = Host::new();
                let plain = Serial::new(device.path().to_owned(), 921_600);
                let settings = Serial {
                    data_bits,
                    stop_bits,
                    flow_control,
                    parity,
                    low_latency: true,
                    ..plain
                };
                let _port = host.spawn(1, Transport::Serial(settings));
                host.opened(1).await;
            }
        }
    }
}

#[tokio::test]
async fn one_port_listens_and_talks_where_that_is_allowed() {
    let mut device = Device::new();
    let mut host = Host::new();
    let config = PortConfig { write: true, ..PortConfig::new(serial(device.path())) };
    let both = host.spawn_with(1, config);
    host.opened(1).await;
    assert!(both.send(b"ask\n".to_vec()));
    let mut heard = Vec::new();
    while heard != b"ask\n" {
        sleep(Duration::from_millis(5)).await;
        heard.extend(device.heard());
    }
    device.say(b"answer\n");
    host.bytes(1, b"answer\n").await;
}

#[tokio::test]
async fn a_baud_rate_is_found_by_listening_alone() {
    let mut device = Device::new();
    let mut host = Host::new();
    let judge = |bytes: &[u8]| {
        if bytes.windows(2).any(|pair| pair == b"*\n") {
            BaudJudgement::Fits
        } else {
            BaudJudgement::Unsure
        }
    };
    host.surroundings.judge = Some(BaudJudge::new(judge));
    let plain = Serial::new(device.path().to_owned(), 4800);
    let probing = Serial { probe_bauds: vec![4800, 38_400], probe_s: 0.1, ..plain };
    let _port = host.spawn(1, Transport::Serial(probing));
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    assert!(host.states(None)[0].ends_with("nothing readable at 4800, 38400 baud"));
    loop {
        device.say(b"$A*\n");
        sleep(Duration::from_millis(20)).await;
        host.drain();
        if let [absent, open, ..] = host.states(None).as_slice() {
            assert!(absent.starts_with("absent") && open.starts_with("open"), "{absent} {open}");
            assert!(open.ends_with("4800 baud") || open.ends_with("38400 baud"), "{open}");
            break;
        }
    }
    device.say(b"more\n");
    host.bytes(1, b"more\n").await;
    assert_eq!(device.heard(), b"");
}
