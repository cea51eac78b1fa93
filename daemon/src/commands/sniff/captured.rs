//! Files of gateways of NMEA 2000.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use anyhow::Context;
use insd_base::{Arrival, Input, PortId, PortState, Stamp, Time, UtcTime};
use insd_lab::sniff::bus::file::{BusFile, Frames};
use insd_lab::sniff::{PortToHear, SniffReport, Sniffed};
use insd_wire::stream::Protocol;

use super::frames;

/// Bytes of a file that are looked at to find out what it is.
const HEAD: u64 = 16 * 1024;
/// Longest line that is read, bytes.
const LONGEST: u64 = 4096;

/// The port of a file.
const PORT: PortId = PortId(0);

/// Which gateway has written a file, if one has.
pub(super) fn format_of(path: &Path) -> Option<BusFile> {
    let mut head = Vec::new();
    File::open(path).ok()?.take(HEAD).read_to_end(&mut head).ok()?;
    BusFile::recognise(&head)
}

/// What stands in the file, as far as it is read.
pub(super) fn read(
    path: &Path,
    format: BusFile,
    plan: &PortToHear,
    protocols: &[Protocol],
    form: frames::Form,
) -> anyhow::Result<SniffReport> {
    let stamp = Stamp { monotonic: Time::START, system: UtcTime::from_nanos(0) };
    let mut sniffed = Sniffed::new(protocols);
    sniffed.announce(PORT, plan.clone());
    sniffed.note(PORT, format.advice());
    let mut shown = frames::Printer::new(form);
    if let Some(mut frames) = Frames::of(format) {
        let file = File::open(path).with_context(|| path.display().to_string())?;
        let (mut lines, mut line) = (BufReader::new(file), Vec::new());
        while lines.by_ref().take(LONGEST).read_until(b'\n', &mut line)? > 0 {
            for frame in frames.of_line(&line) {
                let arrival = Arrival { stamp, port: PORT, input: Input::Can(frame) };
                sniffed.take_and_show(&arrival, |seen| shown.show(seen));
            }
            line.clear();
            if shown.outcome().context("cannot print")? {
                break;
            }
        }
    }
    sniffed.take(&Arrival { stamp, port: PORT, input: Input::State(PortState::Ended) });
    Ok(sniffed.report(Time::START))
}
