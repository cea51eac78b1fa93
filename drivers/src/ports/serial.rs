//! Serial lines. Opening one raises DTR and RTS, as the system does for every program; beyond that
//! a line that is only listened to is left alone.

use std::io;
use std::path::Path;
use std::pin::Pin;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll};
use std::time::Duration;

use rustix::fs::{Mode, OFlags};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio_serial::{ClearBuffer, SerialPort, SerialPortBuilder, SerialStream};

use super::attempt::Outcome;
use super::config::{FlowControl, Parity, Serial};
use super::judge::{BaudJudge, Doubt};
use super::low_latency;
use super::outbox::Outbox;
use super::pace::Pace;
use super::probe::probe;
use super::stream::converse;
use super::teller::Teller;

/// An open line.
pub(crate) struct Line {
    pub(crate) stream: SerialStream,
    /// Whether something was written to it.
    pub(crate) written: bool,
}

impl AsyncRead for Line {
    fn poll_read(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bytes: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(cx, bytes)
    }
}

impl AsyncWrite for Line {
    fn poll_write(
        mut self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.stream).poll_write(cx, bytes)
    }

    /// Never waits for the wire: that would hold up all other tasks.
    fn poll_flush(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }
}

impl Drop for Line {
    /// The system would hold up the last close, and with it all tasks, until a device that stalls has
    /// taken the last bytes.
    fn drop(&mut self) {
        if self.written {
            let _ = self.stream.clear(ClearBuffer::Output);
        }
    }
}

/// Opens the line, listens and talks until it is lost. `last` is the rate that fitted last time.
pub(super) async fn attempt(
    config: &Serial,
    judge: Option<&BaudJudge>,
    last: &mut Option<u32>,
    teller: &mut Teller,
    outbox: Option<&Outbox>,
) -> Outcome {
    let device = config.device.display();
    let mut line = match open_line(config, outbox.is_some()) {
        Ok(line) => line,
        Err(reason) => return Outcome::Absent(format!("{device}: {reason}")),
    };
    let judge = judge.filter(|_| !config.probe_bauds.is_empty());
    let mut baud = config.baud;
    if let Some(judge) = judge {
        match find(&mut line.stream, config, judge, *last).await {
            Ok(found) => baud = found,
            Err(reason) => return Outcome::Absent(format!("{device}: {reason}")),
        }
        *last = Some(baud);
    }
    if let Some(outbox) = outbox {
        outbox.clear();
    }
    teller.open(format!("{device} at {baud} baud"));
    let doubt = judge.map(|judge| Doubt::new(judge.clone(), teller.now().monotonic));
    let clock = teller.clock();
    let shared = Mutex::new(&mut line.stream);
    let pace = Pace::new(clock, config.symbols(), baud);
    let pace = pace.asking(|| Half(&shared).lock().bytes_to_write().ok());
    let halves = (Half(&shared), Half(&shared));
    Outcome::Lost(converse(halves, teller, outbox, Some(pace), doubt).await)
}

/// One half of a line that is read and written by one task, and asked what the driver still holds.
struct Half<'a>(&'a Mutex<&'a mut SerialStream>);

impl<'a> Half<'a> {
    fn lock(&self) -> MutexGuard<'a, &'a mut SerialStream> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl AsyncRead for Half<'_> {
    fn poll_read(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bytes: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut **self.lock()).poll_read(cx, bytes)
    }
}

impl AsyncWrite for Half<'_> {
    fn poll_write(
        self: Pin<&mut Self>,
        cx: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut **self.lock()).poll_write(cx, bytes)
    }

    fn poll_flush(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }
}

/// Listens at each rate, first at the one that fitted last time, until one fits.
async fn find(
    stream: &mut SerialStream,
    config: &Serial,
    judge: &BaudJudge,
    last: Option<u32>,
) -> Result<u32, String> {
    let span = Duration::try_from_secs_f64(config.probe_s).unwrap_or(Duration::from_secs(3));
    let others = config.probe_bauds.iter().copied().filter(|baud| last != Some(*baud));
    let rates = last.into_iter().chain(others);
    for baud in rates {
        // a rate that the device cannot do is not its rate
        if stream.set_baud_rate(baud).is_err() {
            continue;
        }
        // what came at another rate says nothing; a terminal that cannot forget is listened to anyway
        let _ = stream.clear(ClearBuffer::Input);
        if probe(stream, judge, span).await? {
            return Ok(baud);
        }
    }
    let list: Vec<String> = config.probe_bauds.iter().map(u32::to_string).collect();
    Err(format!("nothing readable at {} baud", list.join(", ")))
}

/// Opens a line, which may be written to or not. What has come before is forgotten: nobody knows when it came.
pub(crate) fn open_line(config: &Serial, written: bool) -> Result<Line, String> {
    let builder = builder(config)?;
    // held until the line is open, as some drivers forget the setting at the last close
    let _held = config.low_latency.then(|| ask_low_latency(&config.device));
    let stream = SerialStream::open(&builder).map_err(|error| error.to_string())?;
    // a terminal that cannot forget is listened to anyway
    let _ = stream.clear(ClearBuffer::Input);
    Ok(Line { stream, written })
}

fn builder(config: &Serial) -> Result<SerialPortBuilder, String> {
    let path = config.device.to_str().ok_or("the path is not text")?;
    let data_bits = match config.data_bits {
        5 => tokio_serial::DataBits::Five,
        6 => tokio_serial::DataBits::Six,
        7 => tokio_serial::DataBits::Seven,
        _ => tokio_serial::DataBits::Eight,
    };
    let parity = match config.parity {
        Parity::None => tokio_serial::Parity::None,
        Parity::Odd => tokio_serial::Parity::Odd,
        Parity::Even => tokio_serial::Parity::Even,
    };
    let stop_bits = match config.stop_bits {
        2 => tokio_serial::StopBits::Two,
        _ => tokio_serial::StopBits::One,
    };
    let flow_control = match config.flow_control {
        FlowControl::None => tokio_serial::FlowControl::None,
        FlowControl::Software => tokio_serial::FlowControl::Software,
        FlowControl::Hardware => tokio_serial::FlowControl::Hardware,
    };
    let builder = tokio_serial::new(path, config.baud).data_bits(data_bits).parity(parity);
    Ok(builder.stop_bits(stop_bits).flow_control(flow_control))
}

/// Asks for low latency by both ways. A driver that refuses is used as it is: a latency of some
/// milliseconds is no reason to go without the sensor.
fn ask_low_latency(device: &Path) -> Option<std::os::fd::OwnedFd> {
    let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let port = rustix::fs::open(device, flags, Mode::empty()).ok()?;
    let _ = low_latency::set(&port);
    low_latency::set_ftdi_timer(Path::new("/"), device);
    Some(port)
}
