//! Reads what a report is of: a raw recording, or a voyage directory.

use std::path::Path;

use insd_base::{Input, Order, Span, Time};
use insd_config::{BadInput, VoyageCalendar};
use insd_drivers::raw::RawFault;
use insd_drivers::recording::VoyageReader;
use insd_engine::{Engine, EngineConfig};
use insd_vessel::Names;

use super::bounded::Bounded;
use super::gathered::{FAULTS, Faults, VoyageReport};
use crate::raw_run::RawRun;
use crate::raw_table::RawTable;
use crate::raw_voyage::RawVoyage;

/// Solutions per second of a voyage.
const RATE: f64 = 10.0;
/// Spacing of looks at the calendar of a voyage.
const LOOK: Span = Span::from_nanos(1_000_000_000);

impl VoyageReport {
    /// Replays one run of a raw recording, from 1. `config` replaces the recorded configuration.
    ///
    /// # Errors
    /// It cannot be read, its configuration is not known, or it holds no arrivals.
    pub fn of_recording(path: &Path, config: Option<&Path>, run: u32) -> anyhow::Result<Self> {
        let mut raw = RawRun::open(path, config, run)?;
        let (settings, engine) = (raw.config.clone(), raw.config.engine());
        let mut names = Names::of(&settings.intake());
        let mut pipeline = settings.pipeline();
        let mut report: Option<VoyageReport> = None;
        let mut told = Bounded::new(FAULTS);
        let (mut last, mut now_in) = (None, 1);
        let runs = raw.walk(|item| match item {
            Ok(arrival) => {
                let now = arrival.stamp.monotonic;
                last = Some(now);
                let fresh = || VoyageReport::new(name_of(path), &engine, now);
                let report = report.get_or_insert_with(fresh);
                pipeline.handle(&arrival, |product| {
                    report.collected.product(now, &names, &product);
                });
                if matches!(arrival.input, Input::Order(Order::Configuration(_))) {
                    names = Names::of(&pipeline.reader().intake());
                }
                report.collected.arrival(&arrival, &pipeline);
                Ok(())
            }
            Err(RawFault::NewRun { .. }) => {
                now_in += 1;
                Ok(())
            }
            Err(fault) => {
                if now_in == run {
                    told.push((last, in_words(&fault, path)));
                }
                Ok(())
            }
        })?;
        let what = "no arrivals in it: there is nothing to report";
        let nothing = || BadInput(format!("{}: {what}", path.display()));
        let mut report = report.ok_or_else(nothing)?;
        report.collected.finish();
        report.run = Some((run, runs));
        report.program = raw.header().map(|header| header.program.clone());
        report.other_config = config.is_some();
        report.config = match config {
            Some(file) => std::fs::read_to_string(file).ok(),
            None => raw.header().map(|header| header.config.clone()),
        };
        report.counts = pipeline.counts().clone();
        report.intake = Some(pipeline.status());
        report.outputs = settings.outputs.iter().map(|output| output.name.clone()).collect();
        report.skipped = pipeline.outputs().station().skipped();
        report.faults = Faults { told, read: raw.read() };
        Ok(report)
    }

    /// Runs a voyage directory, by ranges where it has raw GNSS, as a replay does. It has no ports, so a report of it has less to say.
    ///
    /// # Errors
    /// It cannot be read, or it is empty.
    pub fn of_voyage(path: &Path) -> anyhow::Result<Self> {
        let mut reader = VoyageReader::open(path)?;
        let mut config = EngineConfig::for_voyage(reader.header(), RATE);
        let table = RawTable::read(path)?;
        config.models.ranges = table.model();
        let mut raw = RawVoyage::open(path, None, &[], &table, &reader.header().start_utc)?;
        let calendar = VoyageCalendar::new(&reader.header().start_utc);
        let mut engine = Engine::new(config.clone());
        let mut report: Option<VoyageReport> = None;
        let mut looked: Option<Time> = None;
        for received in &mut reader {
            let received = received?;
            let now = received.receipt;
            let fresh = || VoyageReport::new(name_of(path), &config, now);
            let own = report.get_or_insert_with(fresh);
            raw.until(now).for_each(|ranges| engine.handle(&ranges));
            raw.hear(&received);
            engine.handle(&received);
            while let Some(output) = engine.poll_output() {
                own.collected.engine(now, &output);
            }
            let due = looked.is_none_or(|last| now - last >= LOOK);
            let utc = calendar.filter(|_| due).map(|calendar| calendar.utc(now));
            looked = looked.filter(|_| !due).or(Some(now));
            own.collected.times.note(now, utc);
        }
        let nothing = || BadInput(format!("{}: no messages in it", path.display()));
        let mut report = report.ok_or_else(nothing)?;
        report.collected.finish();
        report.counts = engine.counts().clone();
        report.config = std::fs::read_to_string(path.join("voyage.toml")).ok();
        for file in reader.skipped().iter().filter(|file| file.faulty() > 0) {
            let (skipped, rows) = (file.skipped_total(), file.rows);
            let words = format!("{}: {skipped} of {rows} rows skipped", file.file);
            report.faults.told.push((None, words));
        }
        Ok(report)
    }
}

/// A fault without the folder of the recording, so that a copy of it gives the same page.
fn in_words(fault: &RawFault, path: &Path) -> String {
    let folder = if path.is_dir() { Some(path) } else { path.parent() };
    let prefix = folder.map(|folder| folder.join("").display().to_string());
    let words = fault.to_string();
    match prefix.filter(|prefix| !prefix.is_empty()) {
        Some(prefix) => words.replace(&prefix, ""),
        None => words,
    }
}

/// Name of a file or folder.
fn name_of(path: &Path) -> String {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let name = whole.file_name().unwrap_or(whole.as_os_str());
    name.to_string_lossy().into_owned()
}
