//! Who is let in over the network, who may command, and how much of a port one host can take.

use std::net::SocketAddr;

use insd_base::{Closed, Input, PortState, Sent};
use insd_drivers::can::{GatewayFormat, GatewayUdp};
use insd_drivers::ports::{
    Destination, Hosts, OutputConfig, PortConfig, TcpServer, Transport, Udp,
};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpSocket, TcpStream, UdpSocket};
use tokio::time::timeout;

use crate::host::{Host, PATIENCE};
use crate::network::{free_address, free_udp};

fn hosts(text: &str) -> Hosts {
    text.split(' ').map(|host| host.parse::<insd_drivers::ports::Network>().unwrap()).collect()
}

/// A call from an address of this computer.
async fn call(from: &str, to: SocketAddr) -> TcpStream {
    let socket = TcpSocket::new_v4().unwrap();
    socket.bind(SocketAddr::new(from.parse().unwrap(), 0)).unwrap();
    timeout(PATIENCE, socket.connect(to)).await.unwrap().unwrap()
}

fn refused(host: &str, why: Closed) -> impl Fn(&PortState) -> bool {
    move |state| matches!(state, PortState::Refused { host: own, why: cause, count: 1 } if own == host && *cause == why)
}

#[tokio::test]
async fn datagrams_of_others_are_dropped_and_told_once() {
    let config = Udp { from: Some(hosts("127.0.0.2 10.0.0.0/24")), ..free_udp() };
    let mut host = Host::new();
    let _port = host.spawn(1, Transport::Udp(config.clone()));
    host.opened(1).await;
    let stranger = UdpSocket::bind("127.0.0.3:0").await.unwrap();
    let wanted = UdpSocket::bind("127.0.0.2:0").await.unwrap();
    for _ in 0..20 {
        stranger.send_to(b"false", config.bind).await.unwrap();
    }
    wanted.send_to(b"true", config.bind).await.unwrap();
    host.bytes(1, b"true").await;
    let told = host.states(Some(1));
    let told: Vec<&String> = told.iter().filter(|state| state.starts_with("refused")).collect();
    assert_eq!(told, ["refused: 127.0.0.3, which is not listed (count 1)"]);
}

#[tokio::test]
async fn a_server_lets_in_whom_it_lists() {
    let bind = free_address();
    let mut host = Host::new();
    let server = TcpServer { from: Some(hosts("127.0.0.2/31")), ..TcpServer::new(bind) };
    let _port = host.spawn(1, Transport::TcpServer(server));
    host.opened(1).await;
    let mut stranger = call("127.0.0.1", bind).await;
    let _ = stranger.write_all(b"false").await;
    assert_eq!(stranger.read(&mut [0]).await.unwrap_or(0), 0, "it is closed at once");
    host.state(1, refused("127.0.0.1", Closed::NotListed)).await;
    call("127.0.0.3", bind).await.write_all(b"true").await.unwrap();
    host.bytes(1, b"true").await;
}

#[tokio::test]
async fn a_gateway_that_is_not_listed_brings_no_frame() {
    let bind = free_udp().bind;
    let from = Some(hosts("127.0.0.2"));
    let gateway = GatewayUdp { bind, to: None, from, format: GatewayFormat::Ydwg };
    let mut host = Host::new();
    let _port = host.spawn(1, Transport::GatewayUdp(gateway));
    host.opened(1).await;
    let line = b"17:33:21.107 R 09F11223 01 02 03 04 05 06 07 08\r\n";
    let stranger = UdpSocket::bind("127.0.0.3:0").await.unwrap();
    stranger.send_to(line, bind).await.unwrap();
    host.state(1, refused("127.0.0.3", Closed::NotListed)).await;
    let wanted = UdpSocket::bind("127.0.0.2:0").await.unwrap();
    wanted.send_to(line, bind).await.unwrap();
    while !matches!(host.next().await.input, Input::Can(_)) {}
    let frames = host.seen.iter().filter(|arrival| matches!(arrival.input, Input::Can(_)));
    assert_eq!(frames.count(), 1);
}

#[tokio::test]
async fn silent_clients_of_one_host_leave_room_for_another() {
    let bind = free_address();
    let mut host = Host::new();
    // eight places in all, as they once were for whoever came first
    let server = TcpServer { max_clients: 8, ..TcpServer::new(bind) };
    let output = host.spawn_output(1, OutputConfig::new(Destination::TcpServer(server)));
    host.opened(1).await;
    let mut silent = Vec::new();
    for _ in 0..30 {
        silent.push(call("127.0.0.1", bind).await);
    }
    host.state(1, refused("127.0.0.1", Closed::HostFull)).await;
    let mut other = call("127.0.0.2", bind).await;
    host.state(1, |state| state.to_string().ends_with("8 clients")).await;
    output.send(host.message(1, b"$HEHDT,1.00,T*1C\r\n".to_vec()));
    let mut heard = [0; 18];
    timeout(PATIENCE, other.read_exact(&mut heard)).await.unwrap().unwrap();
    assert!(heard.starts_with(b"$HEHDT"));
}

#[tokio::test]
async fn where_commands_are_listened_to_all_bytes_say_who_sent_them_and_whether_he_may_command() {
    let bind = free_address();
    let datagrams = free_udp();
    let mut host = Host::new();
    let mut ports = Vec::new();
    let server = Transport::TcpServer(TcpServer::new(bind));
    for (port, transport) in [(1, server), (2, Transport::Udp(datagrams.clone()))] {
        let commands_from = Some(hosts("127.0.0.2"));
        ports.push(
            host.spawn_with(port, PortConfig { commands_from, ..PortConfig::new(transport) }),
        );
        host.opened(port).await;
    }
    for (from, may_command) in [("127.0.0.2", true), ("127.0.0.3", false)] {
        let sent = Input::Sent(Sent { host: from.to_owned(), may_command, bytes: b"acn".to_vec() });
        call(from, bind).await.write_all(b"acn").await.unwrap();
        while host.next().await.input != sent {}
        let socket = UdpSocket::bind((from, 0)).await.unwrap();
        socket.send_to(b"acn", datagrams.bind).await.unwrap();
        while host.next().await.input != sent {}
    }
}

#[test]
fn lists_that_make_no_sense_are_told() {
    let bind = free_address();
    let server = |from: Option<&str>| {
        let from = from.map(|list| if list.is_empty() { Hosts::default() } else { hosts(list) });
        Transport::TcpServer(TcpServer { from, ..TcpServer::new(bind) })
    };
    let file = Transport::File(insd_drivers::ports::File { path: "log".into() });
    for (transport, commanders, fault) in [
        (server(None), Some("10.0.0.7"), None),
        (server(Some("10.0.0.0/24")), Some("10.0.0.7 10.0.0.128/25"), None),
        (server(Some("10.0.0.0/24")), Some("10.0.1.7"), Some("commands_from: expected hosts that")),
        (server(Some("")), None, Some("from: expected at least one address")),
        (file, Some("10.0.0.7"), Some("commands_from: expected a UDP or TCP port")),
    ] {
        let commands_from = commanders.map(hosts);
        let faults = PortConfig { commands_from, ..PortConfig::new(transport) }.faults();
        match fault {
            None => assert_eq!(faults, Vec::<String>::new()),
            Some(fault) => assert!(faults.len() == 1 && faults[0].starts_with(fault), "{faults:?}"),
        }
    }
}
