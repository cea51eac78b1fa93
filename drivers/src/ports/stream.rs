//! Listening and talking on anything that is a stream of bytes.

use std::sync::Arc;
use std::time::Duration;

use insd_base::{Span, Time};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::time::{sleep, timeout};

use super::clock::Clock;
use super::outbox::{Outbox, next_of};
use super::probe::Doubt;
use super::teller::Teller;

/// How long what was written may take on a line before more is written: as much as a sleep may be
/// longer than it was meant to be, so that the line never waits for us.
const LEAD: Span = Span::from_nanos(20_000_000);

/// Most bytes of one read.
pub(super) const READ: usize = 16 * 1024;

/// The pace of a line. Writing no faster keeps the system's own buffer nearly empty, where messages
/// would grow old unseen.
pub(super) struct Pace {
    clock: Arc<dyn Clock>,
    per_byte: Span,
    /// When the line has carried all that was written.
    idle: Time,
}

impl Pace {
    /// The pace of a line on which a byte takes so long.
    pub(super) fn new(clock: Arc<dyn Clock>, per_byte: Span) -> Self {
        Pace { clock, per_byte, idle: Time::START }
    }

    /// Waits until the line has nearly carried what was written before and these bytes.
    async fn carry(&mut self, bytes: usize) {
        let now = self.clock.now().monotonic;
        let bytes = i64::try_from(bytes).unwrap_or(i64::MAX);
        let span = Span::from_nanos(self.per_byte.as_nanos().saturating_mul(bytes));
        self.idle = self.idle.max(now) + span;
        let ahead = self.idle - now;
        if ahead > LEAD {
            let nanos = ahead.as_nanos() - LEAD.as_nanos();
            sleep(Duration::from_nanos(nanos.unsigned_abs())).await;
        }
    }
}

/// Listens to a stream, and writes to it what waits if there is an outbox. Returns with the reason
/// for which it is lost: a read of nothing or an error ends it at once, as an unplugged device goes
/// on saying the same for ever.
pub(super) async fn converse<S: AsyncRead + AsyncWrite>(
    stream: S,
    teller: &mut Teller,
    outbox: Option<&Outbox>,
    pace: Option<Pace>,
    doubt: Option<Doubt>,
) -> String {
    let (reader, writer) = tokio::io::split(stream);
    tokio::select! {
        reason = listen(reader, teller, doubt) => reason,
        reason = talk(writer, outbox, pace) => reason,
    }
}

/// Tells what a stream says, until it is lost.
pub(super) async fn listen<R: AsyncRead + Unpin>(
    mut reader: R,
    teller: &mut Teller,
    mut doubt: Option<Doubt>,
) -> String {
    let mut bytes = Vec::with_capacity(READ);
    loop {
        match timeout(teller.rest(), read(&mut reader, &mut bytes)).await {
            Err(_) => teller.tick(),
            Ok(Err(reason)) => return reason,
            Ok(Ok(())) => {
                let stamp = teller.now();
                teller.bytes(stamp, &bytes);
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
    mut pace: Option<Pace>,
) -> String {
    loop {
        let message = next_of(outbox).await;
        if let Err(error) = writer.write_all(&message.bytes).await {
            return error.to_string();
        }
        let length = message.bytes.len();
        message.written();
        if let Some(pace) = &mut pace {
            pace.carry(length).await;
        }
    }
}
