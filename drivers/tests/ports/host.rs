//! A consumer with its ports, and pseudo terminals to plug and unplug.

use std::ffi::OsStr;
use std::fs::File;
use std::io::{Read, Write};
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use insd_base::{Arrival, Input, PortId, PortState, Span, Time};
use insd_drivers::ports::{
    Outgoing, OutputConfig, OutputPort, PortConfig, PortHandle, Receiver, Surroundings, Transport,
    WAITING_LIMIT, queue, spawn, spawn_output,
};
use rustix::fs::{Mode, OFlags, fcntl_getfl, fcntl_setfl, open};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use tokio::time::timeout;

use crate::clocks::Clocks;

/// Long enough for a busy machine; nothing waits for it unless it fails.
pub(crate) const PATIENCE: Duration = Duration::from_secs(60);

/// The computer: ports are started on it, and what arrives is looked at.
pub(crate) struct Host {
    pub(crate) surroundings: Surroundings,
    pub(crate) receiver: Receiver,
    /// All that has arrived and was looked at.
    pub(crate) seen: Vec<Arrival>,
}

impl Host {
    pub(crate) fn new() -> Self {
        let (queue, receiver) = queue(WAITING_LIMIT);
        let clock = Arc::new(Clocks::start());
        let surroundings = Surroundings { clock, queue, judge: None };
        Host { surroundings, receiver, seen: Vec::new() }
    }

    pub(crate) fn spawn(&self, port: u16, transport: Transport) -> PortHandle {
        self.spawn_with(port, PortConfig::new(transport))
    }

    pub(crate) fn spawn_with(&self, port: u16, config: PortConfig) -> PortHandle {
        assert_eq!(config.faults(), Vec::<String>::new());
        spawn(PortId(port), config, self.surroundings.clone())
    }

    pub(crate) fn spawn_output(&self, port: u16, config: OutputConfig) -> OutputPort {
        assert_eq!(config.faults(), Vec::<String>::new());
        spawn_output(PortId(port), config, self.surroundings.clone())
    }

    /// The monotonic clock, now.
    pub(crate) fn time(&self) -> Time {
        self.surroundings.clock.now().monotonic
    }

    /// A message that is valid now, and for a minute.
    pub(crate) fn message(&self, slot: u16, bytes: Vec<u8>) -> Outgoing {
        Outgoing { slot, bytes, valid: self.time(), period: Span::from_seconds(60.0) }
    }

    /// Takes the next arrival.
    pub(crate) async fn next(&mut self) -> Arrival {
        let next = timeout(PATIENCE, self.receiver.recv()).await;
        let arrival = next.unwrap_or_else(|_| panic!("nothing after {:?}", self.states(None)));
        let arrival = arrival.expect("the queue is open");
        self.seen.push(arrival.clone());
        arrival
    }

    /// Waits for a state of a port that is as wanted.
    pub(crate) async fn state(&mut self, port: u16, wanted: impl Fn(&PortState) -> bool) {
        loop {
            let arrival = self.next().await;
            if let Input::State(state) = &arrival.input
                && arrival.port.0 == port
                && wanted(state)
            {
                return;
            }
        }
    }

    pub(crate) async fn opened(&mut self, port: u16) {
        self.state(port, |state| matches!(state, PortState::Open { .. })).await;
    }

    /// Waits until these bytes have come from a port since this was last called.
    pub(crate) async fn bytes(&mut self, port: u16, wanted: &[u8]) {
        let mut heard = Vec::new();
        while !heard.ends_with(wanted) {
            let arrival = self.next().await;
            if let Input::Bytes(bytes) = arrival.input
                && arrival.port.0 == port
            {
                heard.extend(bytes);
            }
        }
    }

    /// Takes what waits.
    pub(crate) fn drain(&mut self) {
        while let Ok(arrival) = self.receiver.try_recv() {
            self.seen.push(arrival);
        }
    }

    /// All states seen of a port, or of all, as people read them.
    pub(crate) fn states(&self, port: Option<u16>) -> Vec<String> {
        let of_port = self.seen.iter().filter(|arrival| port.is_none_or(|p| p == arrival.port.0));
        let state = |arrival: &Arrival| match &arrival.input {
            Input::State(state) => Some(state.to_string()),
            _ => None,
        };
        of_port.filter_map(state).collect()
    }

    /// Bytes seen of a port, and bytes told as dropped.
    pub(crate) fn sums(&self, port: u16) -> (u64, u64) {
        let mut sums = (0, 0);
        for arrival in self.seen.iter().filter(|arrival| arrival.port.0 == port) {
            match &arrival.input {
                Input::Bytes(bytes) => sums.0 += bytes.len() as u64,
                Input::State(PortState::Overrun { bytes }) => sums.1 += bytes,
                _ => {}
            }
        }
        sums
    }
}

/// A device on a cable: closing it unplugs it.
pub(crate) struct Device {
    near: File,
    far: PathBuf,
}

impl Device {
    pub(crate) fn new() -> Self {
        let near = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC).unwrap();
        grantpt(&near).unwrap();
        unlockpt(&near).unwrap();
        let name = ptsname(&near, Vec::new()).unwrap();
        let far = PathBuf::from(OsStr::from_bytes(name.as_bytes()));
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::CLOEXEC;
        let end = open(&far, flags, Mode::empty()).unwrap();
        let mut settings = tcgetattr(&end).unwrap();
        settings.make_raw();
        tcsetattr(&end, OptionalActions::Now, &settings).unwrap();
        fcntl_setfl(&near, fcntl_getfl(&near).unwrap() | OFlags::NONBLOCK).unwrap();
        Device { near: near.into(), far }
    }

    /// A device that is found at this path.
    pub(crate) fn at(link: &Path) -> Self {
        let device = Device::new();
        let _ = std::fs::remove_file(link);
        std::os::unix::fs::symlink(&device.far, link).unwrap();
        device
    }

    pub(crate) fn path(&self) -> &Path {
        &self.far
    }

    pub(crate) fn say(&mut self, bytes: &[u8]) {
        self.near.write_all(bytes).unwrap();
    }

    /// What has been written to it and was not read yet.
    pub(crate) fn heard(&mut self) -> Vec<u8> {
        let mut heard = Vec::new();
        let mut bytes = [0; 4096];
        while let Ok(count @ 1..) = self.near.read(&mut bytes) {
            heard.extend_from_slice(&bytes[..count]);
        }
        heard
    }
}
