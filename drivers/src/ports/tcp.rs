//! TCP, calling and being called.

use std::io;
use std::net::IpAddr;
use std::sync::Arc;
use std::time::Duration;

use insd_base::{Closed, Stamp};
use socket2::{SockRef, TcpKeepalive};
use tokio::io::AsyncWriteExt;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::mpsc;
use tokio::task::{AbortHandle, JoinSet};
use tokio::time::{sleep, timeout};

use super::attempt::Outcome;
use super::clock::Clock;
use super::config::{TcpClient, TcpServer};
use super::outbox::{Outbox, Outlet};
use super::stream::{listen, read, talk};
use super::teller::Teller;

/// How long a call may take.
pub(crate) const CALLING: Duration = Duration::from_secs(5);

/// A peer that has vanished without a word is given up after about twice this.
const KEEPALIVE: Duration = Duration::from_secs(10);

/// Bytes that the system may hold for a client, sent and unsent; it doubles this for its own needs.
const HELD: usize = 16 * 1024;

/// Pause after a client could not be accepted, and between telling how many there are.
const ACCEPTING: Duration = Duration::from_millis(200);
const COUNTING: Duration = Duration::from_secs(1);

/// Reads of all clients that may wait for the port's own task.
const READS: usize = 16;

/// A connection that is looked after.
///
/// # Errors
/// Why there is none.
pub(super) async fn dial(address: &str) -> Result<TcpStream, String> {
    let stream = match timeout(CALLING, TcpStream::connect(address)).await {
        Ok(called) => called.map_err(|error| error.to_string())?,
        Err(_) => return Err("no answer".to_owned()),
    };
    keep_alive(&stream);
    Ok(stream)
}

/// Calls, listens and talks until the connection is lost.
pub(super) async fn call(
    config: &TcpClient,
    teller: &mut Teller,
    outbox: Option<&Outbox>,
) -> Outcome {
    let address = &config.address;
    let mut stream = match timeout(CALLING, TcpStream::connect(address)).await {
        Ok(Ok(stream)) => stream,
        Ok(Err(error)) => return Outcome::Absent(format!("tcp {address}: {error}")),
        Err(_) => return Outcome::Absent(format!("tcp {address}: no answer")),
    };
    keep_alive(&stream);
    if let Some(ask) = &config.ask
        && let Err(error) = stream.write_all(format!("{ask}\r\n").as_bytes()).await
    {
        return Outcome::Absent(format!("tcp {address}: {error}"));
    }
    if let Some(outbox) = outbox {
        outbox.clear();
    }
    teller.open(format!("tcp {address}"));
    let host = stream.peer_addr().ok().map(|peer| peer.ip());
    let (reader, writer) = tokio::io::split(stream);
    Outcome::Lost(tokio::select! {
        reason = listen(reader, teller, host, None) => reason,
        reason = talk(writer, outbox, None) => reason,
    })
}

/// Takes calls, listens and talks to all who call: each client has an outbox of its own, from the moment
/// at which it is let in. The server is lost only when the address cannot be had.
pub(super) async fn serve(
    config: &TcpServer,
    teller: &mut Teller,
    outlet: Option<&Outlet>,
) -> Outcome {
    let listener = match TcpListener::bind(config.bind).await {
        Ok(listener) => listener,
        Err(error) => return Outcome::Absent(format!("tcp {}: {error}", config.bind)),
    };
    let local = listener.local_addr().unwrap_or(config.bind);
    let (speaking, mut heard) = mpsc::channel(READS);
    let mut clients = Clients::default();
    let mut counting = tokio::time::interval(COUNTING);
    loop {
        tokio::select! {
            accepted = listener.accept() => match accepted {
                Ok((stream, peer)) => match clients.refusal(config, peer.ip()) {
                    Some(why) => teller.refuse(peer.ip(), why),
                    None => clients.add((stream, peer.ip()), teller.clock(), &speaking, outlet),
                },
                Err(_) => sleep(ACCEPTING).await,
            },
            Some(Heard { host, stamp, bytes }) = heard.recv() => {
                teller.bytes_of(host, stamp, &bytes);
            }
            _ = clients.tasks.join_next_with_id(), if !clients.tasks.is_empty() => {
                clients.forget_gone();
            }
            _ = counting.tick() => {
                teller.open(format!("tcp server {local}, {} clients", clients.open.len()));
                teller.tick();
            }
        }
    }
}

#[derive(Default)]
struct Clients {
    tasks: JoinSet<()>,
    open: Vec<(IpAddr, AbortHandle)>,
}

/// What a client said.
struct Heard {
    host: IpAddr,
    stamp: Stamp,
    bytes: Vec<u8>,
}

impl Clients {
    /// Why a host is not let in: then the connection is closed at once.
    fn refusal(&mut self, config: &TcpServer, host: IpAddr) -> Option<Closed> {
        self.forget_gone();
        let own = self.open.iter().filter(|(other, _)| *other == host).count();
        if config.from.as_ref().is_some_and(|from| !from.contains(host)) {
            Some(Closed::NotListed)
        } else if own >= config.share() {
            Some(Closed::HostFull)
        } else {
            (self.open.len() >= config.max_clients).then_some(Closed::Full)
        }
    }

    fn add(
        &mut self,
        (stream, host): (TcpStream, IpAddr),
        clock: Arc<dyn Clock>,
        speaking: &mpsc::Sender<Heard>,
        outlet: Option<&Outlet>,
    ) {
        keep_alive(&stream);
        hold_little(&stream);
        let outbox = outlet.map(Outlet::outbox);
        let client = converse_with_client((stream, host), clock, speaking.clone(), outbox);
        self.open.push((host, self.tasks.spawn(client)));
    }

    fn forget_gone(&mut self) {
        self.open.retain(|(_, task)| !task.is_finished());
    }
}

async fn converse_with_client(
    (stream, host): (TcpStream, IpAddr),
    clock: Arc<dyn Clock>,
    speaking: mpsc::Sender<Heard>,
    outbox: Option<Outbox>,
) {
    let (mut reader, writer) = tokio::io::split(stream);
    let listen = async {
        let mut bytes = Vec::new();
        while read(&mut reader, &mut bytes).await.is_ok() {
            let heard = Heard { host, stamp: clock.now(), bytes: bytes.clone() };
            if speaking.send(heard).await.is_err() {
                return;
            }
        }
    };
    tokio::select! {
        () = listen => {}
        _ = talk(writer, outbox.as_ref(), None) => {}
    }
}

/// Lets the system hold little for a client that does not read, and take nothing more from us while it
/// holds something that could not be sent yet: what waits with us can still be replaced by newer data.
fn hold_little(stream: &TcpStream) {
    let socket = SockRef::from(stream);
    let _ = socket.set_send_buffer_size(HELD);
    let _ = socket.set_tcp_notsent_lowat(1);
}

/// Finds out when the peer has vanished without closing, and sends small messages at once. What the
/// system refuses here is no reason to go without the peer.
pub(crate) fn keep_alive(stream: &TcpStream) {
    let keepalive = TcpKeepalive::new().with_time(KEEPALIVE).with_interval(KEEPALIVE / 4);
    let socket = SockRef::from(stream);
    let set = || -> io::Result<()> {
        socket.set_tcp_keepalive(&keepalive.with_retries(4))?;
        socket.set_tcp_user_timeout(Some(KEEPALIVE * 2))?;
        socket.set_tcp_nodelay(true)
    };
    let _ = set();
}
