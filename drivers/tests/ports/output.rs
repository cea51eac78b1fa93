//! Ports that are written to.

use std::io::Read;
use std::os::unix::net::UnixDatagram;
use std::path::Path;
use std::time::Duration;

use insd_base::{PortId, PortState, Span, UtcTime};
use insd_drivers::ports::{
    ChronySock, Destination, File, Leap, Outgoing, OutputConfig, OutputPort, Pty, Sample, Serial,
    TcpServer,
};
use tokio::io::AsyncReadExt;
use tokio::net::TcpStream;
use tokio::time::{sleep, timeout};

use crate::host::{Device, Host, PATIENCE};
use crate::network::free_address;

const LENGTH: usize = 100;

/// The bytes of a message, 100 of them, that end in a line break.
fn line(number: u32) -> Vec<u8> {
    format!("{number:0width$}\n", width = LENGTH - 1).into_bytes()
}

fn numbers(bytes: &[u8]) -> Vec<u32> {
    assert_eq!(bytes.len() % LENGTH, 0, "only whole messages");
    bytes
        .chunks(LENGTH)
        .map(|line| std::str::from_utf8(line).unwrap().trim().parse().unwrap())
        .collect()
}

fn serial(path: &Path) -> Destination {
    Destination::Serial(Serial::new(path.to_owned(), 4_000_000))
}

async fn settle(condition: impl Fn() -> bool) {
    let wait = async {
        while !condition() {
            sleep(Duration::from_millis(10)).await;
        }
    };
    timeout(PATIENCE, wait).await.unwrap();
}

/// All that was handed over is sent, dropped or waiting.
fn assert_sum(output: &OutputPort, handed: u64) {
    let status = output.status();
    assert_eq!(status.sent + status.dropped + status.waiting, handed, "{status:?}");
}

#[tokio::test]
async fn a_device_that_stalls_gets_what_is_new_when_it_reads_again() {
    const SENT: u32 = 3000;
    let mut device = Device::new();
    let mut host = Host::new();
    let output = host.spawn_output(1, OutputConfig::new(serial(device.path())));
    host.opened(1).await;
    for number in 0..SENT {
        output.send(host.message(number as u16 % 3, line(number)));
        if number % 10 == 0 {
            sleep(Duration::from_millis(1)).await;
        }
    }
    assert!(output.dropped() > 0, "the terminal holds more than thought");
    let mut heard = Vec::new();
    while output.status().waiting > 0 || !heard.ends_with(b"\n") {
        heard.extend(device.heard());
        sleep(Duration::from_millis(2)).await;
    }
    heard.extend(device.heard());
    let mut numbers = numbers(&heard);
    for slot in 0..3 {
        let of_slot = numbers.iter().filter(|number| **number % 3 == slot);
        assert!(of_slot.is_sorted(), "the messages of a slot in their order");
    }
    let last = numbers.split_off(numbers.len() - 3);
    assert!((SENT - 3..SENT).all(|newest| last.contains(&newest)), "{last:?}");
    numbers.extend(last);
    assert_eq!(numbers.len() as u64 + output.dropped(), u64::from(SENT));
    let status = output.status();
    assert_eq!((status.waiting, status.bytes), (0, heard.len() as u64));
    assert!(matches!(status.state, Some(PortState::Open { .. })));
    assert_sum(&output, SENT.into());
}

#[tokio::test]
async fn an_output_comes_back_with_its_device_and_leaves_out_what_is_old() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("pilot");
    let mut host = Host::new();
    let output = host.spawn_output(1, OutputConfig::new(serial(&link)));
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    output.send(host.message(1, line(1)));
    assert_eq!(output.status().waiting, 1);
    let mut device = Device::at(&link);
    host.opened(1).await;
    output.send(host.message(2, line(2)));
    let mut heard = Vec::new();
    while heard.len() < LENGTH {
        heard.extend(device.heard());
        sleep(Duration::from_millis(2)).await;
    }
    assert_eq!((numbers(&heard), output.dropped()), (vec![2], 1));
    drop(device);
    host.state(1, |state| matches!(state, PortState::Lost { .. })).await;
    assert!(matches!(output.status().state, Some(PortState::Lost { .. })));
}

#[tokio::test]
async fn a_server_writes_to_all_clients_and_one_that_stalls_costs_the_others_nothing() {
    const BURST: u32 = 200;
    let bind = free_address();
    let mut host = Host::new();
    let destination = Destination::TcpServer(TcpServer {
        max_clients: 5,
        max_per_address: 4,
        ..TcpServer::new(bind)
    });
    let output = host.spawn_output(1, OutputConfig::new(destination));
    host.opened(1).await;
    output.send(host.message(0, line(999)));
    assert_eq!(output.status().slots, [], "nobody was there");
    let mut stalled = TcpStream::connect(bind).await.unwrap();
    let mut reading = TcpStream::connect(bind).await.unwrap();
    host.state(1, |state| state.to_string().ends_with("2 clients")).await;
    let mut bytes = [0; LENGTH];
    let mut sent = 0;
    // until the stalled one has cost messages
    while output.dropped() < u64::from(BURST) {
        for number in sent..sent + BURST {
            output.send(host.message((number - sent) as u16, line(number)));
        }
        for expected in sent..sent + BURST {
            timeout(PATIENCE, reading.read_exact(&mut bytes)).await.unwrap().unwrap();
            assert_eq!(numbers(&bytes), [expected]);
        }
        sent += BURST;
    }
    assert_sum(&output, 2 * u64::from(sent));
    let mut late = TcpStream::connect(bind).await.unwrap();
    host.state(1, |state| state.to_string().ends_with("3 clients")).await;
    output.send(host.message(0, line(sent)));
    timeout(PATIENCE, late.read_exact(&mut bytes)).await.unwrap().unwrap();
    assert_eq!(numbers(&bytes), [sent], "who comes late gets what is new");

    let mut old = 0;
    while numbers(&bytes) != [sent - 1] {
        timeout(PATIENCE, stalled.read_exact(&mut bytes)).await.unwrap().unwrap();
        old += LENGTH;
    }
    eprintln!("{sent} messages; the systems held {old} bytes for a client that did not read");
    drop((stalled, reading, late));
    host.state(1, |state| state.to_string().ends_with(" 0 clients")).await;
    settle(|| output.status().waiting == 0).await;
    assert_sum(&output, 2 * u64::from(sent) + 3);
}

#[tokio::test]
async fn a_file_gets_every_message_in_order_whatever_its_slot_and_age() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.nmea");
    let mut host = Host::new();
    let destination = Destination::File(File { path: path.clone() });
    let output = host.spawn_output(1, OutputConfig::new(destination));
    for number in 0..100 {
        let period = Span::from_nanos(1);
        output.send(Outgoing { period, ..host.message(number as u16 % 3, line(number)) });
    }
    host.opened(1).await;
    settle(|| std::fs::metadata(&path).is_ok_and(|file| file.len() == 100 * LENGTH as u64)).await;
    assert_eq!(numbers(&std::fs::read(&path).unwrap()), (0..100).collect::<Vec<u32>>());
    settle(|| output.status().sent == 100).await;
    assert_sum(&output, 100);
}

#[tokio::test]
async fn a_made_terminal_gives_what_is_new_to_whoever_comes() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("nmea");
    let mut host = Host::new();
    let output = host.spawn_output(1, OutputConfig::new(Destination::Pty(Pty::new(link.clone()))));
    host.opened(1).await;
    let mut unread = 0;
    let mut sent = 0;
    // more than a second without a reader: what the kernel held is forgotten
    while unread == 0 {
        output.send(host.message(1, line(sent)));
        sleep(Duration::from_millis(100)).await;
        sent += 1;
        unread = output.status().slots[0].unread;
    }
    assert_sum(&output, sent.into());
    let mut reader = std::fs::File::open(&link).unwrap();
    let mut bytes = vec![0; LENGTH];
    let read = tokio::task::spawn_blocking(move || reader.read_exact(&mut bytes).map(|()| bytes));
    let bytes = timeout(PATIENCE, read).await.unwrap().unwrap().unwrap();
    let first = numbers(&bytes)[0];
    assert!(u64::from(first) >= unread, "{first}, although {unread} were forgotten");
    drop(output);
    settle(|| !link.exists()).await;
}

#[tokio::test]
async fn chrony_gets_samples_whenever_its_socket_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("chrony.sock");
    let mut host = Host::new();
    let mut sender = ChronySock::new(PortId(1), path.clone(), host.surroundings.clone());
    let system = UtcTime::from_nanos(1_800_000_000_000_000_000);
    let offset = Span::from_seconds(0.001);
    let sample = Sample { system, offset, pulse: false, leap: Leap::None };
    for _ in 0..2 {
        assert!(!sender.send(&sample) && !sender.send(&sample));
        let chronyd = UnixDatagram::bind(&path).unwrap();
        assert!(sender.send(&sample));
        let mut datagram = [0; 64];
        assert_eq!(chronyd.recv(&mut datagram).unwrap(), 40);
        assert_eq!(datagram[..40], sample.encode());
        drop(chronyd);
        std::fs::remove_file(&path).unwrap();
    }
    host.drain();
    let states = host.states(Some(1));
    let kinds: Vec<&str> = states.iter().filter_map(|state| state.split(':').next()).collect();
    assert_eq!(kinds, ["absent", "open", "lost", "absent", "open"]);
}
