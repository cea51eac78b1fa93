//! Ports that are written to.

use std::io::Read;
use std::os::unix::net::UnixDatagram;
use std::path::Path;
use std::time::Duration;

use insd_base::{PortId, PortState, Span, UtcTime};
use insd_drivers::ports::{
    ChronySock, Destination, File, Leap, OutputConfig, Sample, Serial, TcpServer,
};
use tokio::io::AsyncReadExt;
use tokio::net::TcpStream;
use tokio::time::{sleep, timeout};

use crate::host::{Device, Host, PATIENCE};
use crate::network::free_address;

const LENGTH: usize = 100;

/// A message of 100 bytes that ends in a line break.
fn message(number: u32) -> Vec<u8> {
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

#[tokio::test]
async fn the_oldest_whole_messages_are_dropped_when_nobody_reads() {
    let mut device = Device::new();
    let mut host = Host::new();
    let config =
        OutputConfig { waiting_bytes: Some(1000), ..OutputConfig::new(serial(device.path())) };
    let output = host.spawn_output(1, config);
    host.opened(1).await;
    const SENT: u32 = 2000;
    for number in 0..SENT {
        output.send(message(number));
        if number % 10 == 0 {
            sleep(Duration::from_millis(1)).await;
        }
    }
    assert!(output.dropped() > 0, "the terminal holds more than thought");
    let mut heard = Vec::new();
    while !heard.ends_with(&message(SENT - 1)) {
        heard.extend(device.heard());
        sleep(Duration::from_millis(2)).await;
    }
    let numbers = numbers(&heard);
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "in their order");
    assert_eq!(numbers.len() as u64 + output.dropped(), u64::from(SENT));
}

#[tokio::test]
async fn an_output_comes_back_with_its_device_and_leaves_out_what_is_old() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("pilot");
    let mut host = Host::new();
    let output = host.spawn_output(1, OutputConfig::new(serial(&link)));
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    output.send(message(1));
    let mut device = Device::at(&link);
    host.opened(1).await;
    output.send(message(2));
    let mut heard = Vec::new();
    while heard.len() < LENGTH {
        heard.extend(device.heard());
        sleep(Duration::from_millis(2)).await;
    }
    assert_eq!((numbers(&heard), output.dropped()), (vec![2], 1));
    drop(device);
    host.state(1, |state| matches!(state, PortState::Lost { .. })).await;
}

#[tokio::test]
async fn a_server_writes_to_all_clients_and_one_that_stalls_costs_the_others_nothing() {
    let bind = free_address();
    let mut host = Host::new();
    let destination = Destination::TcpServer(TcpServer { bind, max_clients: 4 });
    let output = host.spawn_output(1, OutputConfig::new(destination));
    host.opened(1).await;
    let _stalled = TcpStream::connect(bind).await.unwrap();
    let mut reading = TcpStream::connect(bind).await.unwrap();
    host.state(1, |state| state.to_string().ends_with("2 clients")).await;
    let mut line = [0; LENGTH];
    let mut sent = 0;
    // until the stalled one has cost messages
    while output.dropped() == 0 {
        for _ in 0..200 {
            output.send(message(sent));
            sent += 1;
        }
        for expected in sent - 200..sent {
            timeout(PATIENCE, reading.read_exact(&mut line)).await.unwrap().unwrap();
            assert_eq!(numbers(&line), [expected]);
        }
    }
}

#[tokio::test]
async fn a_file_gets_every_message() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.nmea");
    let mut host = Host::new();
    let destination = Destination::File(File { path: path.clone() });
    let output = host.spawn_output(1, OutputConfig::new(destination));
    (0..100).for_each(|number| output.send(message(number)));
    host.opened(1).await;
    settle(|| std::fs::metadata(&path).is_ok_and(|file| file.len() == 100 * LENGTH as u64)).await;
    assert_eq!(numbers(&std::fs::read(&path).unwrap()), (0..100).collect::<Vec<u32>>());
}

#[tokio::test]
async fn a_made_terminal_gives_what_is_new_to_whoever_comes() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("nmea");
    let mut host = Host::new();
    let destination = Destination::Pty(File { path: link.clone() });
    let config = OutputConfig { waiting_bytes: Some(1000), ..OutputConfig::new(destination) };
    let output = host.spawn_output(1, config);
    host.opened(1).await;
    for number in 0..100 {
        output.send(message(number));
        sleep(Duration::from_millis(1)).await;
    }
    // more than a second without a reader: what the kernel held is forgotten
    settle(|| output.dropped() >= 90).await;
    let mut reader = std::fs::File::open(&link).unwrap();
    let mut lines = vec![0; LENGTH];
    output.send(message(100));
    let mut last = Vec::new();
    while last != [100] {
        let read;
        (read, reader, lines) = tokio::task::spawn_blocking(move || {
            let read = reader.read_exact(&mut lines);
            (read, reader, lines)
        })
        .await
        .unwrap();
        read.unwrap();
        last = numbers(&lines);
        assert!(last[0] >= 90, "{last:?}");
    }
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
