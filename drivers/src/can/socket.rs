//! Interfaces of the kernel (`linux/can/raw.h`, kernel documentation `networking/can.rst`).
//!
//! An interface that goes down makes the socket fail once; one that is deleted does so once and then says
//! nothing for ever, even when another of that name has come. So the socket is closed at the first
//! failure, and while nothing is heard it is looked whether the name still means the same interface.
//!
//! The socket's share of the kernel's memory for sending is kept at the least: what waits in the kernel
//! can neither be overtaken by something more urgent nor be replaced by something newer.

use std::fs;
use std::io::{self, IoSliceMut};
use std::os::fd::AsRawFd;
use std::sync::Arc;
use std::time::Duration;

use insd_base::{BusEvent, CanFrame, CanId, Span, Stamp, Time, UtcTime};
use nix::sys::socket::{ControlMessageOwned, MsgFlags, recvmsg, setsockopt, sockopt};
use nix::sys::time::TimeSpec;
use rustix::io::Errno;
use socket2::SockRef;
use socketcan::timestamp::{
    SOF_TIMESTAMPING_RAW_HARDWARE, SOF_TIMESTAMPING_RX_HARDWARE, SOF_TIMESTAMPING_RX_SOFTWARE,
    SOF_TIMESTAMPING_SOFTWARE,
};
use socketcan::{CanFilter as KernelFilter, CanSocket, Socket, SocketOptions};
use tokio::io::Interest;
use tokio::io::unix::AsyncFd;
use tokio::time::{sleep, timeout};

use super::config::{CanFilter, Socketcan};
use super::{CanBus, Heard, Opener, Sending, error_frame};
use crate::ports::{Clock, FIRST_PAUSE, FRAME, both_clocks, monotonic_at};

/// Bits of the kernel's identifier beside those of the frame.
const EXTENDED: u32 = 0x8000_0000;
const REMOTE: u32 = 0x4000_0000;
const ERROR: u32 = 0x2000_0000;

/// What comes: frames, and that the interface is down, which does not make the socket readable.
const WORD: Interest = Interest::READABLE.add(Interest::ERROR);

/// How often it is looked whether the name still means the same interface, while nothing is heard.
const LOOKING: Span = Span::from_nanos(250_000_000);

/// How long a full device is left alone: less than four frames take at 250 kbit/s.
const DRAINING: Span = Span::from_nanos(2_000_000);

/// Longest time from a frame to its reading. Beyond, the clock has stepped in between.
const READING: Span = Span::from_nanos(1_500_000_000);

/// How far before the kernel's time that of the hardware may be, if it is on the same clock.
const HARDWARE: Span = Span::from_nanos(10_000_000);

/// Bytes of frames that the kernel may hold for us, as far as it allows.
const SYSTEM_BUFFER: usize = 1024 * 1024;

/// Room for the kernel's remarks on a frame: three times, another, and a count.
const REMARKS: usize = 256;

/// An interface by its name.
pub(super) struct Interface {
    name: String,
    filters: Vec<CanFilter>,
    clock: Arc<dyn Clock>,
}

impl Interface {
    pub(super) fn new(config: Socketcan, filters: Vec<CanFilter>, clock: Arc<dyn Clock>) -> Self {
        Interface { name: config.interface, filters, clock }
    }

    fn bind(&self, index: u32) -> io::Result<AsyncFd<CanSocket>> {
        let socket = CanSocket::open_iface(index)?;
        socket.set_nonblocking(true)?;
        socket.set_recv_own_msgs(false)?;
        socket.set_filters(&kernel_filters(&self.filters))?;
        socket.set_error_filter(error_frame::WANTED)?;
        set_stamps(&socket)?;
        socket.set_socket_option_int(nix::libc::SOL_SOCKET, nix::libc::SO_RXQ_OVFL, 1)?;
        // the first is for root only; what the kernel does not grant is no reason to go without
        let _ = setsockopt(&socket.as_raw_socket(), sockopt::RcvBufForce, &SYSTEM_BUFFER)
            .map_err(io::Error::from)
            .or_else(|_| SockRef::from(socket.as_raw_socket()).set_recv_buffer_size(SYSTEM_BUFFER));
        let _ = SockRef::from(socket.as_raw_socket()).set_send_buffer_size(1);
        // an interface that is down can be bound to, and says so here
        match socket.as_raw_socket().take_error()? {
            Some(error) => Err(error),
            None => watch(socket),
        }
    }
}

impl Opener for Interface {
    type Bus = SocketBus;

    /// An interface that is there again is to be heard at once.
    const LONGEST_PAUSE: Duration = FIRST_PAUSE;

    async fn open(&mut self) -> Result<(Self::Bus, String), String> {
        let fault = |error: io::Error| format!("{}: {error}", self.name);
        let index = index_of(&self.name).map_err(fault)?;
        let socket = self.bind(index).map_err(fault)?;
        // a frame that is to be sent at once is not refused for want of knowing that the socket can
        let ready = timeout(FIRST_PAUSE, socket.writable()).await;
        drop(ready);
        let bus = SocketBus {
            looked: self.clock.now().monotonic,
            clock: Arc::clone(&self.clock),
            name: self.name.clone(),
            index,
            socket,
            dropped: 0,
            waiting: None,
            full: None,
        };
        Ok((bus, self.name.clone()))
    }
}

/// The number of the interface with this name. To ask the kernel by a call would let it look for a driver
/// of that name each time.
fn index_of(name: &str) -> io::Result<u32> {
    let text = fs::read_to_string(format!("/sys/class/net/{name}/ifindex"));
    let text = text.map_err(|_| io::Error::from(Errno::NODEV))?;
    text.trim().parse().map_err(|_| io::Error::from(Errno::NODEV))
}

/// Lets the runtime watch the socket.
#[expect(unsafe_code, reason = "the safe way is deprecated for other types than this one")]
fn watch(socket: CanSocket) -> io::Result<AsyncFd<CanSocket>> {
    // Sound: a `CanSocket` owns its descriptor, always gives the same one, and closes it when dropped.
    unsafe { Ok(AsyncFd::register_with_interest(socket, WORD.add(Interest::WRITABLE))?) }
}

/// Remote frames are never wanted; a filter sees the frames of one length of identifiers only.
fn kernel_filters(filters: &[CanFilter]) -> Vec<KernelFilter> {
    if filters.is_empty() {
        return vec![KernelFilter::new(0, REMOTE)];
    }
    let filter = |filter: &CanFilter| {
        let kind = if filter.standard { 0 } else { EXTENDED };
        KernelFilter::new(filter.id | kind, filter.mask | EXTENDED | REMOTE)
    };
    filters.iter().map(filter).collect()
}

/// Asks for the times of receipt, in the finest way that the kernel knows.
fn set_stamps(socket: &CanSocket) -> io::Result<()> {
    let software = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;
    let hardware = SOF_TIMESTAMPING_RX_HARDWARE | SOF_TIMESTAMPING_RAW_HARDWARE;
    socket.set_timestamping(software | hardware).or_else(|_| socket.set_recv_timestamp(true))
}

/// A socket of an interface.
pub(super) struct SocketBus {
    socket: AsyncFd<CanSocket>,
    clock: Arc<dyn Clock>,
    name: String,
    /// The interface's number when it was opened.
    index: u32,
    /// When it was last heard, or looked for.
    looked: Time,
    /// Frames that the kernel had dropped by the last report.
    dropped: u32,
    /// What came with a report of dropped frames.
    waiting: Option<Heard>,
    /// Since when the device has no room for frames.
    full: Option<Time>,
}

impl CanBus for SocketBus {
    async fn next(&mut self, refused: bool) -> Result<Heard, String> {
        loop {
            if let Some(heard) = self.waiting.take() {
                return Ok(heard);
            }
            let rest = until(self.looked + LOOKING, self.clock.now().monotonic);
            tokio::select! {
                received = self.socket.async_io(WORD, receive) => {
                    let received = received.map_err(|error| error.to_string())?;
                    if let Some(heard) = self.hear(&received) {
                        return Ok(heard);
                    }
                }
                () = room(&self.socket, self.full, &*self.clock), if refused => {
                    self.full = None;
                    return Ok(Heard::Room);
                }
                () = sleep(rest) => self.look()?,
            }
        }
    }

    fn try_send(&mut self, frame: &CanFrame) -> Result<Sending, String> {
        let bytes = encode(frame);
        let write = |socket: &CanSocket| Ok(rustix::io::write(socket.as_raw_socket(), &bytes)?);
        match self.socket.try_io(Interest::WRITABLE, write) {
            Ok(_) => Ok(Sending::Sent),
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => Ok(Sending::Full),
            Err(error) if error.raw_os_error() == Some(Errno::NOBUFS.raw_os_error()) => {
                self.full = Some(self.clock.now().monotonic);
                Ok(Sending::Full)
            }
            Err(error) => Err(error.to_string()),
        }
    }
}

impl SocketBus {
    /// What was received, dated; if the kernel dropped frames before it, first that.
    fn hear(&mut self, received: &Received) -> Option<Heard> {
        let stamp = self.date(received);
        self.looked = self.clock.now().monotonic;
        let heard = match decode(&received.bytes) {
            Some(Decoded::Frame(frame)) => Some(Heard::Frame(stamp, frame)),
            Some(Decoded::Error(event)) => Some(Heard::Event(stamp, event)),
            None => None,
        };
        let frames = received.dropped.map_or(0, |all| all.wrapping_sub(self.dropped));
        if frames == 0 {
            return heard;
        }
        self.dropped = self.dropped.wrapping_add(frames);
        self.waiting = heard;
        Some(Heard::Event(stamp, BusEvent::Dropped { frames }))
    }

    /// When the kernel had the frame, on both clocks; if it does not say, now.
    fn date(&self, received: &Received) -> Stamp {
        let now = both_clocks(&*self.clock);
        let kernel = received.kernel.and_then(|kernel| {
            let monotonic = monotonic_at(now, kernel, READING)?;
            Some(Stamp { monotonic, system: kernel })
        });
        kernel.unwrap_or(now)
    }

    /// Looks whether the name still means the interface that is open.
    fn look(&mut self) -> Result<(), String> {
        self.looked = self.clock.now().monotonic;
        match index_of(&self.name) {
            Ok(index) if index == self.index => Ok(()),
            Ok(_) => Err("it is another interface now".to_owned()),
            Err(error) => Err(error.to_string()),
        }
    }
}

/// Waits until the socket has room, and until the device that was full is no longer left alone.
async fn room(socket: &AsyncFd<CanSocket>, full: Option<Time>, clock: &dyn Clock) {
    if let Some(since) = full {
        sleep(until(since + DRAINING, clock.now().monotonic)).await;
    }
    // an error comes out when the socket is read
    let _ = socket.writable().await;
}

fn until(at: Time, now: Time) -> Duration {
    Duration::from_nanos((at - now).as_nanos().max(0).unsigned_abs())
}

/// A frame as the kernel gives it.
#[derive(Debug, Default)]
struct Received {
    bytes: [u8; FRAME],
    /// When it was received, on the system's clock.
    kernel: Option<UtcTime>,
    /// Frames that were dropped since the socket was opened.
    dropped: Option<u32>,
}

fn receive(socket: &CanSocket) -> io::Result<Received> {
    let mut received = Received::default();
    let mut remarks = [0; REMARKS];
    let mut parts = [IoSliceMut::new(&mut received.bytes)];
    let message =
        recvmsg::<()>(socket.as_raw_fd(), &mut parts, Some(&mut remarks), MsgFlags::empty())?;
    let (mut kernel, mut dropped) = (None, None);
    for remark in message.cmsgs()? {
        match remark {
            ControlMessageOwned::ScmTimestampsns(times) => {
                kernel = finest(times.system, times.hw_raw);
            }
            ControlMessageOwned::ScmTimestampns(time) => kernel = utc(time),
            ControlMessageOwned::RxqOvfl(count) => dropped = Some(count),
            _ => {}
        }
    }
    Ok(Received { kernel, dropped, ..received })
}

/// The hardware's time of a frame if its clock is set as the system's is, else the kernel's.
fn finest(software: TimeSpec, hardware: TimeSpec) -> Option<UtcTime> {
    let software = utc(software);
    let same = |hardware: &UtcTime| {
        let earlier = software.map(|software| software.since(*hardware));
        earlier.is_some_and(|earlier| earlier >= Span::ZERO && earlier < HARDWARE)
    };
    utc(hardware).filter(same).or(software)
}

/// A time of the kernel's; zero is none.
fn utc(time: TimeSpec) -> Option<UtcTime> {
    let nanos = time.tv_sec().checked_mul(1_000_000_000)?.checked_add(time.tv_nsec())?;
    (nanos != 0).then_some(UtcTime::from_nanos(nanos))
}

enum Decoded {
    Frame(CanFrame),
    Error(BusEvent),
}

/// Reads the kernel's `can_frame`: identifier with flags, length, three bytes, data.
fn decode(bytes: &[u8; FRAME]) -> Option<Decoded> {
    let [a, b, c, d, length, _, _, _, data @ ..] = bytes;
    let flags = u32::from_ne_bytes([*a, *b, *c, *d]);
    let data = data.get(..usize::from(*length))?;
    let number = flags & CanId::MAX_EXTENDED;
    if flags & ERROR != 0 {
        return Some(Decoded::Error(error_frame::event(number, data)));
    }
    let id = match flags & (EXTENDED | REMOTE) {
        EXTENDED => CanId::Extended(number),
        0 => CanId::Standard(u16::try_from(number).ok()?),
        _ => return None,
    };
    CanFrame::new(id, data).map(Decoded::Frame)
}

/// Writes the kernel's `can_frame`.
fn encode(frame: &CanFrame) -> [u8; FRAME] {
    let id = match frame.id() {
        CanId::Standard(id) => u32::from(id),
        CanId::Extended(id) => id | EXTENDED,
    };
    let [a, b, c, d] = id.to_ne_bytes();
    let mut data = [0; 8];
    for (to, from) in data.iter_mut().zip(frame.data()) {
        *to = *from;
    }
    let [e, f, g, h, i, j, k, l] = data;
    [a, b, c, d, frame.data().len() as u8, 0, 0, 0, e, f, g, h, i, j, k, l]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_written_as_they_are_read() {
        let ids = [CanId::Standard(0x7FF), CanId::Extended(0x7FF), CanId::Extended(0x1FFF_FFFF)];
        for (id, data) in ids.into_iter().zip([&[][..], &[1, 2, 3], &[9; 8]]) {
            let frame = CanFrame::new(id, data).unwrap();
            let Some(Decoded::Frame(read)) = decode(&encode(&frame)) else { panic!("{frame:?}") };
            assert_eq!(read, frame);
        }
    }

    #[test]
    fn remote_frames_and_false_lengths_are_refused() {
        let frame = CanFrame::new(CanId::Extended(0x7FF), &[1]).unwrap();
        let mut bytes = encode(&frame);
        bytes[4] = 9;
        assert!(decode(&bytes).is_none());
        let mut bytes = encode(&frame);
        bytes[..4].copy_from_slice(&(EXTENDED | REMOTE | 0x7FF).to_ne_bytes());
        assert!(decode(&bytes).is_none());
    }

    #[test]
    fn the_hardwares_time_counts_where_its_clock_is_the_systems() {
        let software = TimeSpec::new(1_800_000_000, 500);
        let [near, strange] =
            [(1_799_999_999, 999_000_000), (7, 5)].map(|(s, n)| TimeSpec::new(s, n));
        assert_eq!(finest(software, near), utc(near));
        assert_eq!(finest(software, strange), utc(software));
        assert_eq!(finest(software, TimeSpec::new(0, 0)), utc(software));
        assert_eq!(finest(TimeSpec::new(0, 0), strange), None);
    }

    #[test]
    fn an_interface_that_is_not_there_is_named() {
        let clock: Arc<dyn Clock> = Arc::new(NoClock);
        let config = Socketcan { interface: "can97".to_owned() };
        let mut interface = Interface::new(config, Vec::new(), clock);
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        let reason = runtime.block_on(interface.open()).map(|(_, what)| what).unwrap_err();
        assert!(reason.starts_with("can97: "), "{reason}");
    }

    struct NoClock;

    impl Clock for NoClock {
        fn now(&self) -> Stamp {
            Stamp { monotonic: Time::START, system: UtcTime::from_nanos(0) }
        }
    }
}
