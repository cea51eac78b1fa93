//! Gateways on the network, which speak text.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;

use insd_base::{CanFrame, Stamp};
use tokio::net::{TcpStream, UdpSocket};
use tokio::time::timeout;

use super::config::{GatewayTcp, GatewayUdp};
use super::stream::TextBus;
use super::words::{Tongue, Words};
use super::{CanBus, Heard, Opener, Sending};
use crate::ports::{CALLING, Clock, Hosts, keep_alive};

/// Longest datagram there can be.
const DATAGRAM: usize = 65_536;

/// A gateway that is called.
pub(super) struct Calls {
    config: GatewayTcp,
    clock: Arc<dyn Clock>,
}

impl Calls {
    pub(super) fn new(config: GatewayTcp, clock: Arc<dyn Clock>) -> Self {
        Calls { config, clock }
    }
}

impl Opener for Calls {
    type Bus = TextBus<TcpStream>;

    async fn open(&mut self) -> Result<(Self::Bus, String), String> {
        let what = format!("gateway tcp {}", self.config.address);
        let stream = match timeout(CALLING, TcpStream::connect(&self.config.address)).await {
            Ok(Ok(stream)) => stream,
            Ok(Err(error)) => return Err(format!("{what}: {error}")),
            Err(_) => return Err(format!("{what}: no answer")),
        };
        keep_alive(&stream);
        let tongue = Tongue::Gateway(self.config.format);
        Ok((TextBus::new(stream, tongue, Arc::clone(&self.clock)), what))
    }
}

/// A gateway that sends datagrams, each of them one line or several.
pub(super) struct Datagrams {
    config: GatewayUdp,
    clock: Arc<dyn Clock>,
}

impl Datagrams {
    pub(super) fn new(config: GatewayUdp, clock: Arc<dyn Clock>) -> Self {
        Datagrams { config, clock }
    }
}

impl Opener for Datagrams {
    type Bus = DatagramBus;

    async fn open(&mut self) -> Result<(Self::Bus, String), String> {
        let GatewayUdp { bind, to, format, .. } = self.config;
        let what = format!("gateway udp {bind}");
        let socket = open(bind).await.map_err(|error| format!("{what}: {error}"))?;
        let bus = DatagramBus {
            socket,
            to,
            from: self.config.from.clone(),
            words: Words::new(Tongue::Gateway(format)),
            unsent: None,
            read_at: self.clock.now(),
            clock: Arc::clone(&self.clock),
            datagram: vec![0; DATAGRAM],
        };
        Ok((bus, what))
    }
}

async fn open(bind: SocketAddr) -> io::Result<UdpSocket> {
    let socket = UdpSocket::bind(bind).await?;
    socket.set_broadcast(true)?;
    // a frame that is to be sent at once is not refused for want of knowing that the socket can
    socket.writable().await?;
    Ok(socket)
}

/// A socket on which datagrams of text come.
pub(super) struct DatagramBus {
    socket: UdpSocket,
    to: Option<SocketAddr>,
    from: Option<Hosts>,
    words: Words,
    /// A line for which there was no room.
    unsent: Option<String>,
    clock: Arc<dyn Clock>,
    /// When the last read returned.
    read_at: Stamp,
    datagram: Vec<u8>,
}

impl CanBus for DatagramBus {
    async fn next(&mut self, refused: bool) -> Result<Heard, String> {
        loop {
            if let Some(frame) = self.words.next() {
                return Ok(Heard::Frame(self.read_at, frame));
            }
            let read = tokio::select! {
                read = self.socket.recv_from(&mut self.datagram) => read,
                ready = self.socket.writable(), if refused || self.unsent.is_some() => {
                    ready.map_err(|error| error.to_string())?;
                    if self.flush()? && refused {
                        return Ok(Heard::Room);
                    }
                    continue;
                }
            };
            self.read_at = self.clock.now();
            let (length, peer) = read.map_err(|error| error.to_string())?;
            if self.from.as_ref().is_some_and(|from| !from.contains(peer.ip())) {
                return Ok(Heard::Stranger(peer.ip()));
            }
            self.words.take(self.datagram.get(..length).unwrap_or_default());
            self.words.end();
        }
    }

    fn try_send(&mut self, frame: &CanFrame) -> Result<Sending, String> {
        if !self.flush()? {
            return Ok(Sending::Full);
        }
        self.unsent = self.words.write(frame, self.clock.now()).filter(|_| self.to.is_some());
        self.flush()?;
        Ok(Sending::Sent)
    }
}

impl DatagramBus {
    /// Sends the line that waits. Gives whether none waits any more.
    fn flush(&mut self) -> Result<bool, String> {
        let Some((line, to)) = self.unsent.as_ref().zip(self.to) else { return Ok(true) };
        match self.socket.try_send_to(line.as_bytes(), to) {
            Ok(_) => self.unsent = None,
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
            Err(error) => return Err(error.to_string()),
        }
        Ok(self.unsent.is_none())
    }
}
