//! UDP and TCP.

use std::net::{Ipv4Addr, SocketAddr};
use std::time::Duration;

use insd_base::{Input, PortState};
use insd_drivers::ports::{
    Destination, OutputConfig, PortConfig, TcpClient, TcpServer, Transport, Udp, UdpOutput,
};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream, UdpSocket};
use tokio::time::{sleep, timeout};

use crate::host::{Host, PATIENCE};

const ANY_PORT: &str = "127.0.0.1:0";

/// A local address that nobody has at the moment.
pub(crate) fn free_address() -> SocketAddr {
    std::net::TcpListener::bind(ANY_PORT).unwrap().local_addr().unwrap()
}

fn free_udp_port() -> u16 {
    std::net::UdpSocket::bind(ANY_PORT).unwrap().local_addr().unwrap().port()
}

fn udp(port: u16) -> Udp {
    let bind = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    Udp { bind, multicast: None, interface: None, from: None }
}

/// Datagrams to a free port of this computer.
pub(crate) fn free_udp() -> Udp {
    udp(free_udp_port())
}

#[tokio::test]
async fn each_datagram_is_one_arrival() {
    let config = udp(free_udp_port());
    let mut host = Host::new();
    let _port = host.spawn(1, Transport::Udp(config.clone()));
    host.opened(1).await;
    let sender = UdpSocket::bind(ANY_PORT).await.unwrap();
    for datagram in [&b"one"[..], b"", b"two"] {
        sender.send_to(datagram, config.bind).await.unwrap();
    }
    assert_eq!(host.next().await.input, Input::Bytes(b"one".to_vec()));
    assert_eq!(host.next().await.input, Input::Bytes(b"two".to_vec()));
}

#[tokio::test]
async fn a_multicast_group_is_joined_and_written_to() {
    let (group, port) = (Ipv4Addr::new(239, 192, 0, 77), free_udp_port());
    let interface = Some(Ipv4Addr::LOCALHOST);
    let bind = SocketAddr::from((Ipv4Addr::UNSPECIFIED, port));
    let input = Udp { bind, multicast: Some(group), interface, from: None };
    let mut host = Host::new();
    let _port = host.spawn(1, Transport::Udp(input));
    let to = SocketAddr::from((group, port));
    let destination = Destination::Udp(UdpOutput { interface, ..UdpOutput::new(to) });
    let output = host.spawn_output(2, OutputConfig::new(destination));
    for _ in 0..2 {
        if let Input::State(PortState::Absent { reason }) = host.next().await.input {
            eprintln!("skipped: no multicast here: {reason}");
            return;
        }
    }
    for (slot, message) in [b"to all", b"again "].into_iter().enumerate() {
        output.send(host.message(slot as u16, message.to_vec()));
        match host.next().await.input {
            Input::Bytes(bytes) => assert_eq!(bytes, message, "one message, one datagram"),
            other => eprintln!("skipped: no multicast here: {other:?}"),
        }
    }
}

#[tokio::test]
async fn another_program_on_this_computer_hears_a_group_each_message_one_datagram() {
    let group = Ipv4Addr::new(239, 192, 0, 4);
    let other = UdpSocket::bind("0.0.0.0:0").await.unwrap();
    let to = SocketAddr::from((group, other.local_addr().unwrap().port()));
    if let Err(error) = other.join_multicast_v4(group, Ipv4Addr::LOCALHOST) {
        eprintln!("skipped: no multicast here: {error}");
        return;
    }
    let mut host = Host::new();
    let interface = Some(Ipv4Addr::LOCALHOST);
    let destination = Destination::Udp(UdpOutput { interface, ttl: 3, ..UdpOutput::new(to) });
    let output = host.spawn_output(1, OutputConfig::new(destination));
    host.opened(1).await;
    let messages = ["$HEHDT,274.07,T*03\r\n", "$HEROT,0.0,A*2B\r\n", "$HEHDT,274.08,T*0C\r\n"];
    for (slot, message) in messages.into_iter().enumerate() {
        output.send(host.message(slot as u16, message.into()));
    }
    let mut datagram = [0; 2000];
    for message in messages {
        let (length, from) =
            timeout(PATIENCE, other.recv_from(&mut datagram)).await.unwrap().unwrap();
        assert_eq!(&datagram[..length], message.as_bytes());
        assert_eq!(from.ip(), Ipv4Addr::LOCALHOST, "by the interface that was asked for");
    }
    let status = output.status();
    assert_eq!((status.sent, status.dropped), (3, 0));
}

#[tokio::test]
async fn a_message_too_long_for_a_datagram_is_lost_alone() {
    let other = UdpSocket::bind(ANY_PORT).await.unwrap();
    let to = other.local_addr().unwrap();
    let mut host = Host::new();
    let limit = Some(1 << 20);
    let config = OutputConfig::new(Destination::Udp(UdpOutput::new(to)));
    let output = host.spawn_output(1, OutputConfig { waiting_bytes: limit, ..config });
    host.opened(1).await;
    output.send(host.message(1, vec![0; 70_000]));
    output.send(host.message(2, b"short".to_vec()));
    let mut datagram = [0; 100];
    let length = timeout(PATIENCE, other.recv(&mut datagram)).await.unwrap().unwrap();
    assert_eq!(&datagram[..length], b"short");
    assert_eq!((output.dropped(), output.attempts()), (1, 1));
}

#[tokio::test]
async fn a_server_that_went_is_called_again() {
    let server = TcpListener::bind(ANY_PORT).await.unwrap();
    let address = server.local_addr().unwrap();
    let mut host = Host::new();
    let ask = Some("{\"subscribe\":[]}".to_owned());
    let client = TcpClient { address: address.to_string(), ask };
    let port = host.spawn(1, Transport::TcpClient(client));
    let (mut connection, _) = server.accept().await.unwrap();
    let mut asked = [0; 18];
    timeout(PATIENCE, connection.read_exact(&mut asked)).await.unwrap().unwrap();
    assert_eq!(&asked, b"{\"subscribe\":[]}\r\n");
    connection.write_all(b"first").await.unwrap();
    host.bytes(1, b"first").await;

    drop((connection, server));
    host.state(1, |state| matches!(state, PortState::Absent { .. })).await;
    let server = TcpListener::bind(address).await.unwrap();
    let (mut connection, _) = server.accept().await.unwrap();
    connection.write_all(b"second").await.unwrap();
    host.bytes(1, b"second").await;
    let states = host.states(Some(1));
    let kinds: Vec<&str> = states.iter().filter_map(|state| state.split(':').next()).collect();
    assert_eq!(kinds, ["open", "lost", "absent", "open"]);
    assert!(port.attempts() < 20);
}

#[tokio::test]
async fn a_server_hears_its_clients_and_turns_away_those_too_many() {
    let bind = free_address();
    let mut host = Host::new();
    let config = TcpServer { max_per_address: 2, ..TcpServer::new(bind) };
    let _port = host.spawn(1, Transport::TcpServer(config));
    host.opened(1).await;
    let mut one = TcpStream::connect(bind).await.unwrap();
    let mut two = TcpStream::connect(bind).await.unwrap();
    one.write_all(b"one").await.unwrap();
    host.bytes(1, b"one").await;
    two.write_all(b"two").await.unwrap();
    host.bytes(1, b"two").await;
    let mut three = TcpStream::connect(bind).await.unwrap();
    assert_eq!(three.read(&mut [0]).await.unwrap_or(0), 0, "it is closed at once");
    host.state(1, |state| state.to_string().ends_with("2 clients")).await;

    drop(one);
    loop {
        let mut again = TcpStream::connect(bind).await.unwrap();
        let _ = again.write_all(b"again").await;
        sleep(Duration::from_millis(20)).await;
        host.drain();
        if host.seen.iter().any(|arrival| arrival.input == Input::Bytes(b"again".to_vec())) {
            break;
        }
    }
    two.write_all(b"still").await.unwrap();
    host.bytes(1, b"still").await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_flood_on_one_port_is_counted_to_the_byte_and_costs_another_nothing() {
    const FLOOD: usize = 10 * 1024 * 1024;
    let (flooded, quiet) = (free_address(), udp(free_udp_port()));
    let mut host = Host::new();
    let server = TcpServer { max_clients: 1, ..TcpServer::new(flooded) };
    let _port = host.spawn_with(1, PortConfig::new(Transport::TcpServer(server)));
    host.opened(1).await;
    let _quiet = host.spawn(2, Transport::Udp(quiet.clone()));
    let sender = UdpSocket::bind(ANY_PORT).await.unwrap();
    host.opened(2).await;

    let mut flood = TcpStream::connect(flooded).await.unwrap();
    let piece = vec![b'f'; 64 * 1024];
    let mut quiet_bytes = 0;
    for _ in 0..FLOOD / piece.len() {
        flood.write_all(&piece).await.unwrap();
        quiet_bytes += sender.send_to(b"quiet", quiet.bind).await.unwrap() as u64;
    }
    flood.shutdown().await.unwrap();
    // the server closes once it has read all; nobody has taken anything meanwhile
    assert_eq!(flood.read(&mut [0]).await.unwrap(), 0);
    while host.sums(1).0 + host.sums(1).1 < FLOOD as u64 || host.sums(2).0 < quiet_bytes {
        host.next().await;
    }
    let (received, dropped) = host.sums(1);
    assert_eq!(received + dropped, FLOOD as u64);
    assert!(dropped > FLOOD as u64 / 2, "{dropped} bytes dropped");
    let overruns = host.states(Some(1)).iter().filter(|s| s.starts_with("overrun")).count();
    eprintln!("{received} received, {dropped} dropped, told {overruns} times");
    assert_eq!(host.sums(2), (quiet_bytes, 0));
}
