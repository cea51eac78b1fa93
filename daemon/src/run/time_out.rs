//! Our own time for chronyd.

use insd_base::{PortId, Span, Stamp, UtcTime};
use insd_config::Config;
use insd_drivers::ports::{ChronySock, Leap, Sample, Surroundings};

/// Sends a sample each second while UTC is known.
pub(super) struct TimeOut {
    sock: Option<ChronySock>,
}

impl TimeOut {
    pub(super) fn open(config: &Config, port: u16, surroundings: &Surroundings) -> Self {
        let sock = config.chrony.as_ref().map(|chrony| {
            ChronySock::new(PortId(port), chrony.socket.clone(), surroundings.clone())
        });
        TimeOut { sock }
    }

    /// Tells chronyd how far the system clock is from UTC at the moment of the stamp.
    pub(super) fn send(&mut self, stamp: &Stamp, utc: Option<UtcTime>) {
        if let (Some(sock), Some(utc)) = (&mut self.sock, utc) {
            let offset: Span = utc.since(stamp.system);
            let sample = Sample { system: stamp.system, offset, pulse: false, leap: Leap::None };
            sock.send(&sample);
        }
    }
}
