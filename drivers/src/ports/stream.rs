//! Listening and talking on anything that is a stream of bytes.

use std::io;
use std::net::IpAddr;
use std::pin::Pin;

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::time::timeout;

use super::judge::Doubt;
use super::outbox::Outbox;
use super::pace::Pace;
use super::teller::Teller;

/// Most bytes of one read.
pub(super) const READ: usize = 16 * 1024;

/// Listens to one half of a stream, and writes to the other what waits if there is an outbox. Returns
/// with the reason for which it is lost: a read of nothing or an error ends it at once, as an unplugged
/// device goes on saying the same for ever.
pub(super) async fn converse<R: AsyncRead + Unpin, W: AsyncWrite + Unpin>(
    (reader, writer): (R, W),
    teller: &mut Teller,
    outbox: Option<&Outbox>,
    pace: Option<Pace<'_>>,
    doubt: Option<Doubt>,
) -> String {
    tokio::select! {
        reason = listen(reader, teller, None, doubt) => reason,
        reason = talk(writer, outbox, pace) => reason,
    }
}

/// Tells what a stream says, and which host says it if it comes from one, until it is lost.
pub(super) async fn listen<R: AsyncRead + Unpin>(
    mut reader: R,
    teller: &mut Teller,
    host: Option<IpAddr>,
    mut doubt: Option<Doubt>,
) -> String {
    let mut bytes = Vec::with_capacity(READ);
    loop {
        match timeout(teller.rest(), read(&mut reader, &mut bytes)).await {
            Err(_) => teller.tick(),
            Ok(Err(reason)) => return reason,
            Ok(Ok(())) => {
                let stamp = teller.now();
                match host {
                    Some(host) => teller.bytes_of(host, stamp, &bytes),
                    None => teller.bytes(stamp, &bytes),
                }
                let given_up = doubt.as_mut().and_then(|doubt| doubt.hear(stamp.monotonic, &bytes));
                if let Some(reason) = given_up {
                    return reason;
                }
            }
        }
    }
}

/// One read of at least a byte in place of what `bytes` held.
pub(super) async fn read<R: AsyncRead + Unpin>(
    reader: &mut R,
    bytes: &mut Vec<u8>,
) -> Result<(), String> {
    bytes.clear();
    bytes.reserve(READ);
    match reader.read_buf(bytes).await {
        Ok(0) => Err("closed by the other end".to_owned()),
        Ok(_) => Ok(()),
        Err(error) => Err(error.to_string()),
    }
}

/// Writes what waits, message by message, until the stream is lost. Never flushes: on a serial line
/// that waits for the wire and would hold up the other tasks.
pub(super) async fn talk<W: AsyncWrite + Unpin>(
    mut writer: W,
    outbox: Option<&Outbox>,
    mut pace: Option<Pace<'_>>,
) -> String {
    let Some(outbox) = outbox else { return std::future::pending().await };
    loop {
        if let Err(error) = write_next(&mut writer, outbox, pace.as_mut()).await {
            return error.to_string();
        }
    }
}

async fn write_next<W: AsyncWrite + Unpin>(
    writer: &mut W,
    outbox: &Outbox,
    mut pace: Option<&mut Pace<'_>>,
) -> io::Result<()> {
    if let Some(pace) = &mut pace {
        pace.room().await;
    }
    let offered =
        outbox.offer(pace.as_deref(), |cx, bytes| Pin::new(&mut *writer).poll_write(cx, bytes));
    let (message, taken) = offered.await;
    let rest = message.bytes().get(taken?..).unwrap_or_default();
    writer.write_all(rest).await?;
    let (now, length) = (outbox.now(), message.bytes().len());
    message.written(pace.map_or(now, |pace| pace.carry(now, length)));
    Ok(())
}
