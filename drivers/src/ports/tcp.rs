//! TCP, calling and being called.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use insd_base::Stamp;
use socket2::{SockRef, TcpKeepalive};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::mpsc;
use tokio::task::JoinSet;
use tokio::time::{sleep, timeout};

use super::clock::Clock;
use super::config::{TcpClient, TcpServer};
use super::outbox::{Outbox, next_of};
use super::run::Outcome;
use super::stream::{converse, read, talk};
use super::teller::Teller;

/// How long a call may take.
pub(crate) const CALLING: Duration = Duration::from_secs(5);

/// A peer that has vanished without a word is given up after about twice this.
const KEEPALIVE: Duration = Duration::from_secs(10);

/// Pause after a client could not be accepted, and between telling how many there are.
const ACCEPTING: Duration = Duration::from_millis(200);
const COUNTING: Duration = Duration::from_secs(1);

/// Reads of all clients that may wait for the port's own task.
const READS: usize = 16;

/// Calls, listens and talks until the connection is lost.
pub(super) async fn call(
    config: &TcpClient,
    teller: &mut Teller,
    outbox: Option<&Outbox>,
) -> Outcome {
    let address = &config.address;
    let stream = match timeout(CALLING, TcpStream::connect(address)).await {
        Ok(Ok(stream)) => stream,
        Ok(Err(error)) => return Outcome::Absent(format!("tcp {address}: {error}")),
        Err(_) => return Outcome::Absent(format!("tcp {address}: no answer")),
    };
    keep_alive(&stream);
    if let Some(outbox) = outbox {
        outbox.clear();
    }
    teller.open(format!("tcp {address}"));
    Outcome::Lost(converse(stream, teller, outbox, None, None).await)
}

/// Takes calls, listens and talks to all who call. It is lost only when the address cannot be had.
pub(super) async fn serve(
    config: &TcpServer,
    teller: &mut Teller,
    outbox: Option<&Outbox>,
) -> Outcome {
    let listener = match TcpListener::bind(config.bind).await {
        Ok(listener) => listener,
        Err(error) => return Outcome::Absent(format!("tcp {}: {error}", config.bind)),
    };
    let local = listener.local_addr().unwrap_or(config.bind);
    let (speaking, mut heard) = mpsc::channel(READS);
    let mut clients = Clients { limit: config.max_clients, ..Clients::default() };
    let mut counting = tokio::time::interval(COUNTING);
    loop {
        tokio::select! {
            accepted = listener.accept() => match accepted {
                Ok((stream, _)) => clients.add(stream, teller.clock(), &speaking, outbox),
                Err(_) => sleep(ACCEPTING).await,
            },
            Some((stamp, bytes)) = heard.recv() => {
                let bytes: Vec<u8> = bytes;
                teller.bytes(stamp, &bytes);
            }
            message = next_of(outbox) => {
                clients.send(&message.bytes);
                message.written();
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
    limit: usize,
    tasks: JoinSet<()>,
    open: Vec<(tokio::task::AbortHandle, Option<Outbox>)>,
}

type Heard = (Stamp, Vec<u8>);

impl Clients {
    /// Lets a client in, if there is room: otherwise the connection is closed at once.
    fn add(
        &mut self,
        stream: TcpStream,
        clock: Arc<dyn Clock>,
        speaking: &mpsc::Sender<Heard>,
        outbox: Option<&Outbox>,
    ) {
        self.forget_gone();
        if self.open.len() >= self.limit {
            return;
        }
        keep_alive(&stream);
        let outbox = outbox.map(Outbox::for_client);
        let client = converse_with_client(stream, clock, speaking.clone(), outbox.clone());
        self.open.push((self.tasks.spawn(client), outbox));
    }

    fn send(&self, message: &[u8]) {
        for outbox in self.open.iter().filter_map(|(_, outbox)| outbox.as_ref()) {
            outbox.send(message.to_vec());
        }
    }

    fn forget_gone(&mut self) {
        self.open.retain(|(task, _)| !task.is_finished());
    }
}

async fn converse_with_client(
    stream: TcpStream,
    clock: Arc<dyn Clock>,
    speaking: mpsc::Sender<Heard>,
    outbox: Option<Outbox>,
) {
    let (mut reader, writer) = tokio::io::split(stream);
    let listen = async {
        let mut bytes = Vec::new();
        while read(&mut reader, &mut bytes).await.is_ok() {
            if speaking.send((clock.now(), bytes.clone())).await.is_err() {
                return;
            }
        }
    };
    tokio::select! {
        () = listen => {}
        _ = talk(writer, outbox.as_ref(), None) => {}
    }
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
