//! Where the outputs of the engine go.

use std::path::{Path, PathBuf};

use anyhow::Context;
use insd_base::{
    AidInnovation, AlignmentStatus, Counts, Event, Finding, Mode, SatelliteId, Stands, Time,
};
use insd_config::OutputFile;
use insd_drivers::recording::{FileReport, NavWriter};
use insd_engine::Output;

use super::args::ReplayArgs;
use crate::commands::summary::Summary;
use crate::evaluation::{AlignmentRow, InnovationRow, RowWriter};

/// Where the outputs of the engine go.
pub(super) struct Sink {
    nav: NavWriter<OutputFile>,
    innovations: Option<RowWriter<InnovationRow, OutputFile>>,
    alignment_log: Option<RowWriter<AlignmentRow, OutputFile>>,
    alignment: Vec<AlignmentStatus>,
    modes: Vec<(Time, Mode)>,
    departures: Vec<Time>,
    resets: Vec<Time>,
    findings: Vec<(Time, Finding)>,
    standings: Vec<Stands>,
    satellites: Vec<(Time, SatelliteId, bool)>,
    stored: Option<Event>,
    solutions: u64,
}

impl Sink {
    pub(super) fn create(args: &ReplayArgs) -> anyhow::Result<Self> {
        let innovations = |path: &PathBuf| OutputFile::create(path).map(RowWriter::new);
        let log = |path: &PathBuf| OutputFile::create(path).map(RowWriter::new);
        Ok(Sink {
            nav: open_nav(&args.out)?,
            innovations: args.innovations.as_ref().map(innovations).transpose()?,
            alignment_log: args.alignment_log.as_ref().map(log).transpose()?,
            alignment: Vec::new(),
            modes: Vec::new(),
            departures: Vec::new(),
            resets: Vec::new(),
            findings: Vec::new(),
            standings: Vec::new(),
            satellites: Vec::new(),
            stored: None,
            solutions: 0,
        })
    }

    pub(super) fn take(&mut self, output: &Output) -> std::io::Result<()> {
        match output {
            Output::Solution(solution) => {
                self.solutions += 1;
                self.nav.write(solution)
            }
            Output::Innovation(innovation) => match &mut self.innovations {
                Some(file) => file.write(&row(innovation)),
                None => Ok(()),
            },
            Output::Alignment(status) => {
                self.alignment.push(*status);
                match &mut self.alignment_log {
                    Some(file) => file.write(&AlignmentRow::from(status)),
                    None => Ok(()),
                }
            }
            Output::Event(event) => {
                self.note(event);
                Ok(())
            }
        }
    }

    fn note(&mut self, event: &Event) {
        tracing::debug!(?event);
        match *event {
            Event::ModeChanged { time, to, .. } => self.modes.push((time, to)),
            Event::LeftBerth { time } => self.departures.push(time),
            Event::PositionReset { time } => self.resets.push(time),
            Event::InstallationFound { time, finding } => self.findings.push((time, finding)),
            Event::Judged { stands, .. } => self.standings.push(stands),
            Event::SatelliteJudged { time, satellite, is_excluded } => {
                self.nav.leave_out(satellite, is_excluded);
                self.satellites.push((time, satellite, is_excluded));
            }
            Event::StoredStateUsed { .. } | Event::StoredStateDropped { .. } => {
                self.stored = Some(*event);
            }
            _ => {}
        }
    }

    /// All of it in words, with what the engine counted, the messages dropped on request, and what the
    /// files of a voyage lacked.
    pub(super) fn summary<'a>(
        &'a self,
        counts: &'a Counts,
        dropped: u64,
        files: Vec<&'a FileReport>,
    ) -> Summary<'a> {
        Summary {
            solutions: self.solutions,
            left_out: self.nav.left_out(),
            alignment: &self.alignment,
            modes: &self.modes,
            departures: &self.departures,
            resets: &self.resets,
            findings: &self.findings,
            standings: &self.standings,
            satellites: &self.satellites,
            stored: self.stored.as_ref(),
            counts,
            dropped,
            files,
        }
    }

    pub(super) fn finish(self) -> anyhow::Result<()> {
        self.nav.finish().context("cannot write the solution")?.finish()?;
        if let Some(file) = self.alignment_log {
            file.finish()?.finish()?;
        }
        match self.innovations {
            Some(file) => file.finish()?.finish(),
            None => Ok(()),
        }
    }
}

fn open_nav(path: &Path) -> anyhow::Result<NavWriter<OutputFile>> {
    NavWriter::new(OutputFile::create(path)?).context("cannot write the solution")
}

fn row(innovation: &AidInnovation) -> InnovationRow {
    InnovationRow {
        t_s: innovation.time.as_seconds(),
        aid: innovation.aid.to_owned(),
        component: innovation.component,
        innovation: innovation.innovation,
        sigma: innovation.sigma,
        accepted: innovation.accepted,
    }
}
