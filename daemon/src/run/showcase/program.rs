//! The program, its time and its recording.

use std::path::PathBuf;

use crc::{CRC_32_ISO_HDLC, Crc};
use insd_base::Stamp;
use insd_config::{Config, calendar};
use insd_fleet::FleetStatus;
use insd_fleet::spool::SpoolLosses;
use insd_intake::clock::TimeQuality;
use insd_intake::status::TimeStatus;
use insd_web::snapshot::{Program, RecordingState, Saving, ShownFleet, ShownRecording};
use rustix::time::{ClockId, clock_gettime};

use super::super::report::Slow;
use crate::clock::HostClock;
use crate::state::SaverState;

/// Bytes of a page of memory where the system says nothing else.
const PAGE: u64 = 4096;

/// Where the program came from.
#[derive(Clone, Debug)]
pub(in crate::run) struct Origin {
    /// The clocks of the ship's time line.
    pub(in crate::run) clock: HostClock,
    pub(in crate::run) started: Stamp,
    pub(in crate::run) configuration: Option<PathBuf>,
    pub(in crate::run) hash: String,
}

impl Origin {
    pub(super) fn program(&self) -> Program {
        Program {
            name: "insd".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            started_utc: Some(calendar::rfc3339_millis(self.started.system)),
            configuration_path: self.configuration.as_ref().map(|path| path.display().to_string()),
            configuration_hash: Some(self.hash.clone()),
            configuration_read_at_s: Some(0.0),
            ..Program::default()
        }
    }

    /// What the process uses.
    pub(super) fn measure(&self, program: &mut Program) {
        let statm = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
        let pages = statm.split_whitespace().nth(1).and_then(|pages| pages.parse::<u64>().ok());
        program.memory_bytes = pages.map(|pages| pages * PAGE);
        let used = clock_gettime(ClockId::ProcessCPUTime);
        program.processor_s = Some(used.tv_sec as f64 + used.tv_nsec as f64 * 1e-9);
    }
}

/// A short hash of a configuration's text.
pub(in crate::run) fn hash(text: &str) -> String {
    format!("{:08x}", Crc::<u32>::new(&CRC_32_ISO_HDLC).checksum(text.as_bytes()))
}

/// How UTC is known, and its 1-sigma, s.
pub(super) fn time_quality(status: &TimeStatus) -> (String, Option<f64>) {
    let quality = match status.quality {
        TimeQuality::Unknown => "unknown",
        TimeQuality::Messages => "messages",
        TimeQuality::Pulses => "pulses",
    };
    (quality.to_owned(), status.sigma)
}

pub(super) fn recording(config: &Config, slow: &Slow) -> Option<ShownRecording> {
    let (section, state) = config.recording.as_ref().zip(slow.recorder.as_ref())?;
    Some(ShownRecording {
        state: if state.fault.is_some() {
            RecordingState::Failing
        } else {
            RecordingState::Recording
        },
        folder: section.folder.display().to_string(),
        bytes: state.written.bytes,
        files: u64::from(state.written.files),
        quota_bytes: section.quota_mb.map(|quota| quota.saturating_mul(1 << 20)),
        lost: state.written.dropped,
        last_error: state.fault.as_ref().map(ToString::to_string),
    })
}

pub(super) fn saving(state: &SaverState) -> Saving {
    Saving { saved: state.saved, failed: state.failed, last_error: state.fault.clone() }
}

pub(super) fn fleet((name, status): &(String, FleetStatus)) -> ShownFleet {
    let SpoolLosses { quota, expired, unwritten, damaged_bytes } = status.losses;
    ShownFleet {
        name: name.clone(),
        connected: status.is_connected,
        sent_messages: status.messages,
        sent_bytes: status.bytes,
        waiting: status.waiting,
        lost_quota: quota,
        lost_expired: expired,
        lost_unwritten: unwritten,
        damaged_bytes,
        disk_fault: status.disk_fault.clone(),
        link_fault: status.link_fault.clone(),
    }
}
