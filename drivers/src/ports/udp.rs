//! UDP datagrams.

use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::time::Duration;

use insd_base::Closed;
use socket2::{Domain, Protocol, Socket, Type};
use tokio::net::UdpSocket;
use tokio::time::timeout;

use super::attempt::Outcome;
use super::config::{Udp, UdpOutput};
use super::outbox::Outbox;
use super::teller::Teller;

/// Longest datagram there can be.
const DATAGRAM: usize = 65_536;

/// How often a silent group is joined again.
const REJOINING: Duration = Duration::from_secs(5);

/// Bytes that the system may hold for us, as far as it allows.
const SYSTEM_BUFFER: usize = 1024 * 1024;

/// Listens until the socket fails.
pub(super) async fn listen(config: &Udp, teller: &mut Teller) -> Outcome {
    let socket = match open(config) {
        Ok(socket) => socket,
        Err(error) => return Outcome::Absent(format!("udp {}: {error}", config.bind)),
    };
    teller.open(match config.multicast {
        Some(group) => format!("udp {} in group {group}", config.bind),
        None => format!("udp {}", config.bind),
    });
    let mut datagram = vec![0; DATAGRAM];
    loop {
        let rest = if teller.is_silent() { teller.rest().min(REJOINING) } else { teller.rest() };
        match timeout(rest, socket.recv_from(&mut datagram)).await {
            Ok(Ok((length, from))) => {
                let stamp = teller.now();
                if config.from.as_ref().is_none_or(|wanted| wanted.contains(from.ip())) {
                    let bytes = datagram.get(..length).unwrap_or_default();
                    teller.bytes_of(from.ip(), stamp, bytes);
                } else {
                    teller.refuse(from.ip(), Closed::NotListed);
                }
            }
            Ok(Err(error)) => return Outcome::Lost(error.to_string()),
            Err(_) if teller.is_silent() => join_again(config, &socket),
            Err(_) => {}
        }
        teller.tick();
    }
}

fn open(config: &Udp) -> io::Result<UdpSocket> {
    let socket = new_socket(config.bind)?;
    // several programs of one computer may listen to one group
    socket.set_reuse_address(config.multicast.is_some())?;
    let _ = socket.set_recv_buffer_size(SYSTEM_BUFFER);
    socket.bind(&config.bind.into())?;
    if let Some(group) = config.multicast {
        // only what is sent to groups that this very socket has joined
        socket.set_multicast_all_v4(false)?;
        socket.join_multicast_v4(&group, &interface(config.interface))?;
    }
    UdpSocket::from_std(socket.into())
}

/// A network that went and came back, and a switch that forgot, have lost the membership without a
/// word.
fn join_again(config: &Udp, socket: &UdpSocket) {
    if let Some(group) = config.multicast {
        let interface = interface(config.interface);
        let _ = socket.leave_multicast_v4(group, interface);
        let _ = socket.join_multicast_v4(group, interface);
    }
}

/// Writes each message as one datagram until the socket fails.
pub(super) async fn talk(config: &UdpOutput, teller: &mut Teller, outbox: &Outbox) -> Outcome {
    let socket = match open_output(config) {
        Ok(socket) => socket,
        Err(error) => return Outcome::Absent(format!("udp to {}: {error}", config.to)),
    };
    outbox.clear();
    teller.open(format!("udp to {}", config.to));
    loop {
        let (message, taken) =
            outbox.offer(None, |cx, bytes| socket.poll_send_to(cx, bytes, config.to)).await;
        match taken {
            Ok(_) => message.written(outbox.now()),
            Err(error) if error.raw_os_error().is_some_and(|error| ALONE.contains(&error)) => {}
            Err(error) => return Outcome::Lost(error.to_string()),
        }
    }
}

/// Errors that cost one message alone: it is longer than a datagram can be, or the interface is full.
const ALONE: [i32; 2] =
    [rustix::io::Errno::MSGSIZE.raw_os_error(), rustix::io::Errno::NOBUFS.raw_os_error()];

fn open_output(config: &UdpOutput) -> io::Result<UdpSocket> {
    let any: IpAddr = match config.to {
        SocketAddr::V4(_) => Ipv4Addr::UNSPECIFIED.into(),
        SocketAddr::V6(_) => std::net::Ipv6Addr::UNSPECIFIED.into(),
    };
    let any = SocketAddr::new(any, 0);
    let socket = new_socket(any)?;
    if config.to.is_ipv4() {
        socket.set_broadcast(true)?;
        socket.set_multicast_ttl_v4(config.ttl)?;
        socket.set_multicast_if_v4(&interface(config.interface))?;
        socket.set_multicast_loop_v4(config.loopback)?;
    } else {
        socket.set_multicast_hops_v6(config.ttl)?;
        socket.set_multicast_loop_v6(config.loopback)?;
    }
    socket.bind(&any.into())?;
    UdpSocket::from_std(socket.into())
}

fn new_socket(address: SocketAddr) -> io::Result<Socket> {
    let socket = Socket::new(Domain::for_address(address), Type::DGRAM, Some(Protocol::UDP))?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

fn interface(configured: Option<Ipv4Addr>) -> Ipv4Addr {
    configured.unwrap_or(Ipv4Addr::UNSPECIFIED)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn a_socket_for_a_group_has_the_options_asked_for() {
        for (ttl, loopback) in [(1, true), (7, false)] {
            let to = SocketAddr::from((Ipv4Addr::new(239, 192, 0, 4), 60_004));
            let interface = Some(Ipv4Addr::LOCALHOST);
            let config = UdpOutput { ttl, interface, loopback, ..UdpOutput::new(to) };
            let socket = open_output(&config).unwrap();
            let socket = socket2::SockRef::from(&socket);
            assert_eq!(socket.multicast_ttl_v4().unwrap(), ttl);
            assert_eq!(socket.multicast_loop_v4().unwrap(), loopback);
            assert_eq!(socket.multicast_if_v4().unwrap(), Ipv4Addr::LOCALHOST);
        }
    }
}
