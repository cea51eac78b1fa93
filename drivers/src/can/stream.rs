//! Buses that are streams of text: adapters at a serial line, and logs.

use std::io::Cursor;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

use insd_base::{CanFrame, Stamp};
use insd_n2k::text::slcan;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};

use super::config::{Candump, Slcan};
use super::words::{Tongue, Words};
use super::{CanBus, Heard, Opener, Sending};
use crate::ports::{Clock, Line, Serial, open_line};

/// Bytes of one read.
const READ: usize = 4096;

/// Bytes that may wait to be written when a line is added: some frames only, as what waits with the speaker
/// can still be replaced by what is newer.
const WAITING: usize = 128;

/// A stream that speaks of frames.
pub(super) struct TextBus<S> {
    stream: S,
    words: Words,
    clock: Arc<dyn Clock>,
    /// When the last read returned.
    read_at: Stamp,
    /// What is being written.
    written: Cursor<Vec<u8>>,
    /// Whether the end of the stream is that of a log, and not a loss.
    ends: bool,
}

impl<S: AsyncRead + AsyncWrite + Unpin + Send> TextBus<S> {
    pub(super) fn new(stream: S, tongue: Tongue, clock: Arc<dyn Clock>) -> Self {
        let read_at = clock.now();
        let written = Cursor::new(Vec::new());
        TextBus { stream, words: Words::new(tongue), clock, read_at, written, ends: false }
    }

    /// Writes this first.
    fn begin_with(&mut self, text: String) {
        self.written = Cursor::new(text.into_bytes());
    }

    /// Bytes that wait to be written.
    fn left(&self) -> &[u8] {
        self.written.get_ref().get(self.written.position() as usize..).unwrap_or_default()
    }

    /// One step of reading and of writing.
    fn poll(&mut self, cx: &mut Context<'_>, refused: bool) -> Poll<Result<Heard, String>> {
        loop {
            if let Some(frame) = self.words.next() {
                return Poll::Ready(Ok(Heard::Frame(self.read_at, frame)));
            }
            if let Poll::Ready(Err(reason)) = self.poll_write(cx) {
                return Poll::Ready(Err(reason));
            }
            if refused && self.left().is_empty() {
                return Poll::Ready(Ok(Heard::Room));
            }
            match std::task::ready!(self.poll_read(cx)) {
                Ok(true) => {}
                Ok(false) => return Poll::Ready(Ok(Heard::End)),
                Err(reason) => return Poll::Ready(Err(reason)),
            }
        }
    }

    /// Reads once. Gives whether there may be more.
    fn poll_read(&mut self, cx: &mut Context<'_>) -> Poll<Result<bool, String>> {
        let mut space = [0; READ];
        let mut bytes = ReadBuf::new(&mut space);
        let read = std::task::ready!(Pin::new(&mut self.stream).poll_read(cx, &mut bytes));
        self.read_at = self.clock.now();
        Poll::Ready(match read {
            Err(error) => Err(error.to_string()),
            Ok(()) if !bytes.filled().is_empty() => {
                self.words.take(bytes.filled());
                Ok(true)
            }
            Ok(()) if self.ends => {
                // the last line may lack its end, and may be all that there is
                self.words.end();
                Ok(self.words.has_more())
            }
            Ok(()) => Err("closed by the other end".to_owned()),
        })
    }

    /// Writes as much as can be written. Ready when nothing is left.
    fn poll_write(&mut self, cx: &mut Context<'_>) -> Poll<Result<(), String>> {
        while !self.left().is_empty() {
            let from = self.written.position() as usize;
            let left = self.written.get_ref().get(from..).unwrap_or_default();
            match std::task::ready!(Pin::new(&mut self.stream).poll_write(cx, left)) {
                Ok(0) => return Poll::Ready(Err("nothing can be written".to_owned())),
                Ok(count) => self.written.set_position((from + count) as u64),
                Err(error) => return Poll::Ready(Err(error.to_string())),
            }
        }
        self.written = Cursor::new(Vec::new());
        Poll::Ready(Ok(()))
    }
}

impl<S: AsyncRead + AsyncWrite + Unpin + Send> CanBus for TextBus<S> {
    async fn next(&mut self, refused: bool) -> Result<Heard, String> {
        std::future::poll_fn(|cx| self.poll(cx, refused)).await
    }

    fn try_send(&mut self, frame: &CanFrame) -> Result<Sending, String> {
        if self.left().len() > WAITING {
            return Ok(Sending::Full);
        }
        // a frame that the other end cannot send is as good as lost on the wire
        let line = self.words.write(frame, self.clock.now()).unwrap_or_default();
        self.written.get_mut().extend_from_slice(line.as_bytes());
        Ok(Sending::Sent)
    }
}

/// An adapter at a serial line.
pub(super) struct Adapter {
    config: Slcan,
    /// Whether it may be told to open its channel, and to send.
    commands: bool,
    clock: Arc<dyn Clock>,
}

impl Adapter {
    pub(super) fn new(config: Slcan, commands: bool, clock: Arc<dyn Clock>) -> Self {
        Adapter { config, commands, clock }
    }
}

impl Opener for Adapter {
    type Bus = TextBus<Line>;

    async fn open(&mut self) -> Result<(Self::Bus, String), String> {
        let Slcan { device, baud, bitrate } = &self.config;
        let path = device.display();
        let line = Serial { low_latency: true, ..Serial::new(device.clone(), *baud) };
        let line = open_line(&line, self.commands).map_err(|reason| format!("{path}: {reason}"))?;
        let mut bus = TextBus::new(line, Tongue::Slcan, Arc::clone(&self.clock));
        if self.commands {
            bus.begin_with(slcan::open(*bitrate).ok_or("there is no command for the bit rate")?);
        }
        Ok((bus, format!("slcan {path}")))
    }
}

/// A log of candump.
pub(super) struct Log {
    config: Candump,
    clock: Arc<dyn Clock>,
}

impl Log {
    pub(super) fn new(config: Candump, clock: Arc<dyn Clock>) -> Self {
        Log { config, clock }
    }
}

impl Opener for Log {
    type Bus = TextBus<tokio::fs::File>;

    const WAITS: bool = true;

    async fn open(&mut self) -> Result<(Self::Bus, String), String> {
        let path = self.config.path.display();
        let file = tokio::fs::File::open(&self.config.path).await;
        let file = file.map_err(|error| format!("{path}: {error}"))?;
        let bus = TextBus::new(file, Tongue::Log, Arc::clone(&self.clock));
        Ok((TextBus { ends: true, ..bus }, path.to_string()))
    }
}
