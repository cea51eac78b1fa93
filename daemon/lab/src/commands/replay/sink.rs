//! Where the outputs of the engine go.

use std::path::PathBuf;

use insd_base::{AlignmentStatus, Counts, Event, Finding, Mode, SatelliteId, Stands, Time};
use insd_config::OutputFile;
use insd_drivers::raw::RawRead;
use insd_drivers::recording::FileReport;
use insd_engine::{Engine, Output};

use super::args::ReplayOptions;
use super::destination::{Destination, Replayed};
use super::sky_log::SkyLog;
use super::states_log::StatesLog;
use crate::commands::smooth::Afterwards;
use crate::commands::summary::Summary;
use crate::evaluation::{AlignmentRow, InnovationRow, RowWriter};

/// Where the outputs of the engine go.
pub(super) struct Sink {
    nav: Destination,
    /// Where they are smoothed before they are written.
    afterwards: Option<Afterwards>,
    innovations: Option<RowWriter<InnovationRow, OutputFile>>,
    alignment_log: Option<RowWriter<AlignmentRow, OutputFile>>,
    sky: Option<SkyLog>,
    states: Option<StatesLog>,
    alignment: Vec<AlignmentStatus>,
    modes: Vec<(Time, Mode)>,
    departures: Vec<Time>,
    resets: Vec<Time>,
    findings: Vec<(Time, Finding)>,
    standings: Vec<Stands>,
    satellites: Vec<(Time, SatelliteId, bool)>,
    stored: Option<Event>,
    solutions: u64,
    /// Time of the newest solution.
    solved: Option<Time>,
}

impl Sink {
    pub(super) fn create(
        args: &ReplayOptions,
        afterwards: Option<Afterwards>,
        nav: Destination,
    ) -> anyhow::Result<Self> {
        let innovations = |path: &PathBuf| OutputFile::create(path).map(RowWriter::new);
        let log = |path: &PathBuf| OutputFile::create(path).map(RowWriter::new);
        Ok(Sink {
            nav,
            afterwards,
            innovations: args.innovations.as_ref().map(innovations).transpose()?,
            alignment_log: args.alignment_log.as_ref().map(log).transpose()?,
            sky: args.sky.as_deref().map(SkyLog::create).transpose()?,
            states: args.states.as_deref().map(StatesLog::create).transpose()?,
            alignment: Vec::new(),
            modes: Vec::new(),
            departures: Vec::new(),
            resets: Vec::new(),
            findings: Vec::new(),
            standings: Vec::new(),
            satellites: Vec::new(),
            stored: None,
            solutions: 0,
            solved: None,
        })
    }

    pub(super) fn take(&mut self, output: &Output) -> std::io::Result<()> {
        match output {
            Output::Solution(solution) => {
                self.solutions += 1;
                self.solved = Some(solution.time);
                match &mut self.afterwards {
                    Some(afterwards) => afterwards.take(solution),
                    None => self.nav.write(solution)?,
                }
                Ok(())
            }
            Output::Innovation(innovation) => self.write(|| innovation.into()),
            Output::Satellite(told) => {
                self.nav.hear_satellite(told);
                self.write(|| told.into())
            }
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

    fn write(&mut self, row: impl FnOnce() -> InnovationRow) -> std::io::Result<()> {
        match &mut self.innovations {
            Some(file) => file.write(&row()),
            None => Ok(()),
        }
    }

    /// Looks at the sky and at the states, if they are to be written, after each message that the engine has taken.
    pub(super) fn look(&mut self, engine: &Engine) -> std::io::Result<()> {
        let solved = self.solved;
        self.sky.iter_mut().try_for_each(|sky| sky.look(engine, solved))?;
        self.states.iter_mut().try_for_each(|states| states.look(engine, solved))
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

    /// Says all of it in words, with what the engine counted, the messages dropped on request, and what the
    /// files of a voyage lacked.
    pub(super) fn say(&mut self, counts: &Counts, dropped: u64, files: Vec<&FileReport>) {
        self.nav.end(counts, &files);
        let summary = Summary {
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
        };
        let summary = summary.to_string();
        self.nav.say(summary);
    }

    /// A message was received.
    pub(super) fn hear(&mut self, at: Time) {
        self.nav.hear(at);
    }

    /// A raw recording was read, with so many runs, of a program. Gives whether that is summed up.
    pub(super) fn read(&mut self, read: RawRead, runs: u32, program: Option<&String>) -> bool {
        self.nav.read(read, runs, program)
    }

    /// The voyage is over.
    pub(super) fn smooth(&mut self, engine: &Engine) {
        if let Some(afterwards) = &mut self.afterwards {
            afterwards.smooth(engine);
        }
    }

    pub(super) fn finish(mut self) -> anyhow::Result<Replayed> {
        if let Some(afterwards) = &self.afterwards {
            afterwards.write(&mut self.nav)?;
        }
        let replayed = self.nav.finish()?;
        if let Some(file) = self.alignment_log {
            file.finish()?.finish()?;
        }
        self.sky.map_or(Ok(()), SkyLog::finish)?;
        self.states.map_or(Ok(()), StatesLog::finish)?;
        if let Some(file) = self.innovations {
            file.finish()?.finish()?;
        }
        Ok(replayed)
    }
}
