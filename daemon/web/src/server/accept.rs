//! Takes connections, so many at a time, so many of one address, and none for ever.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::Router;
use axum::extract::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use socket2::SockRef;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::door::Door;
use super::hall::Hall;
use super::room::{Place, Room};
use super::stall::Stall;
use crate::SECURITY;

/// How long a client may take for the head of a request, and say nothing between two.
const HEAD: Duration = Duration::from_secs(5);
/// Bytes of a request's head, and those that wait for a slow client.
const BUFFER: usize = 16 * 1024;
/// Lines of a request's head.
const MAX_HEADERS: usize = 64;
/// What the kernel may hold for a client that does not read, bytes.
const SEND_BUFFER: usize = 32 * 1024;
/// Clients that are told at a time that there are too many.
const TURNED_AWAY: usize = 32;
/// Pause after the system grants no further connection.
const PAUSE: Duration = Duration::from_millis(100);

const FULL: &[u8] = b"HTTP/1.1 503 Service Unavailable\r\nretry-after: 5\r\n\
    content-type: text/plain\r\ncontent-length: 17\r\nconnection: close\r\n\r\ntoo many clients\n";

/// Who is at the other end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peer(pub(super) SocketAddr);

/// Takes connections for ever.
pub(super) async fn accept(
    door: Door,
    router: Router,
    hall: &Arc<Hall>,
    room: &Room,
) -> io::Result<()> {
    let listener = door.opened().await?;
    let porch = Arc::new(Semaphore::new(TURNED_AWAY));
    loop {
        let Ok((stream, peer)) = listener.accept().await else {
            tokio::time::sleep(PAUSE).await;
            continue;
        };
        let why = match room.enter(peer.ip()) {
            Ok(place) => {
                tokio::spawn(serve(stream, Peer(peer), router.clone(), Arc::clone(hall), place));
                continue;
            }
            Err(why) => why,
        };
        tracing::warn!(target: SECURITY, host = %peer.ip().to_canonical(), why, "a connection to the page is refused");
        if let Ok(permit) = Arc::clone(&porch).try_acquire_owned() {
            tokio::spawn(turn_away(stream, permit));
        }
    }
}

async fn serve(stream: TcpStream, peer: Peer, router: Router, hall: Arc<Hall>, _place: Place) {
    // a client that is slower for the lack of either is served all the same
    let _ = stream.set_nodelay(true);
    let _ = SockRef::from(&stream).set_send_buffer_size(SEND_BUFFER);
    let router = TowerToHyperService::new(router);
    let service = service_fn(move |mut request: Request<Incoming>| {
        request.extensions_mut().insert(peer);
        router.call(request)
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD)
        .max_buf_size(BUFFER)
        .max_headers(MAX_HEADERS)
        .serve_connection(TokioIo::new(Stall::new(stream)), service);
    hall.clients.fetch_add(1, Ordering::Relaxed);
    if let Err(fault) = connection.await {
        tracing::trace!(%fault, peer = %peer.0, "connection ended");
    }
    hall.clients.fetch_sub(1, Ordering::Relaxed);
}

/// Reads a little before it closes, or the answer would be lost with what was not read.
async fn turn_away(mut stream: TcpStream, _permit: OwnedSemaphorePermit) {
    let answer = async {
        stream.write_all(FULL).await?;
        stream.shutdown().await?;
        stream.read(&mut [0; 1024]).await
    };
    let _ = tokio::time::timeout(Duration::from_secs(1), answer).await;
}
