//! What is told of the voyage once it is over.

use std::path::PathBuf;

use anyhow::Context;
use insd_base::{Protection, Solution};
use insd_config::{BadInput, OutputFile};
use insd_engine::Engine;
use insd_nav::smoothing::{Smoothed, SmoothedVoyage};

use super::sbet::SbetRow;
use crate::commands::replay::Destination;
use crate::evaluation::RowWriter;

/// The solutions of the filter, which are told when they have been smoothed.
pub(in crate::commands) struct Afterwards {
    /// Interval between epochs that are smoothed by themselves, s.
    pub(in crate::commands) interval: f64,
    sbet: Option<PathBuf>,
    solutions: Vec<Solution>,
    voyage: SmoothedVoyage,
}

impl Afterwards {
    pub(super) fn new(interval: f64, sbet: Option<PathBuf>) -> Self {
        Afterwards { interval, sbet, solutions: Vec::new(), voyage: SmoothedVoyage::default() }
    }

    pub(in crate::commands) fn take(&mut self, solution: &Solution) {
        self.solutions.push(*solution);
    }

    /// The voyage is over: smooths it.
    pub(in crate::commands) fn smooth(&mut self, engine: &Engine) {
        self.voyage = engine.smoothed();
        let mut rows = self.voyage.rows.iter().peekable();
        for solution in &mut self.solutions {
            while rows.next_if(|row| row.time < solution.time).is_some() {}
            if let Some(row) = rows.next_if(|row| row.time == solution.time) {
                *solution = as_smoothed(solution, row);
            }
        }
        let SmoothedVoyage { rows, cuts, epochs } = &self.voyage;
        eprintln!("{} rows smoothed over {epochs} epochs", rows.len());
        for cut in cuts {
            eprintln!(
                "  {:>10.1} s  not smoothed across: the filter gave its estimate up for another",
                cut.as_seconds()
            );
        }
    }

    /// Writes what was smoothed, and what the filter told where nothing was.
    ///
    /// # Errors
    /// There is no solution at all, or the output cannot be written.
    pub(in crate::commands) fn write(&self, nav: &mut Destination) -> anyhow::Result<()> {
        if self.solutions.is_empty() {
            return Err(BadInput("the recording has no solution to smooth".to_owned()).into());
        }
        let told = self.solutions.iter().try_for_each(|solution| nav.write(solution));
        told.context("cannot write the solution")?;
        let Some(path) = &self.sbet else { return Ok(()) };
        let mut file = RowWriter::new(OutputFile::create(path)?);
        for row in SbetRow::all(&self.solutions) {
            file.write(&row).context("cannot write the trajectory")?;
        }
        file.finish()?.finish()
    }
}

/// A solution of the filter as it is known afterwards. Its protection levels are a promise that was made at the time, and stay.
fn as_smoothed(solution: &Solution, row: &Smoothed) -> Solution {
    // a claim that is lost to rounding is that of the filter
    let sound = |own: f64, told: f64| if own.is_finite() && own > 0.0 { own } else { told };
    let none = Protection { horizontal: 0.0, vertical: 0.0 };
    let smoothed = Solution {
        position: row.position,
        velocity: row.velocity,
        attitude: row.attitude,
        sigma: row.sigma.zip(&solution.sigma, sound),
        hidden: none,
        ..*solution
    };
    let (told, own) = (solution.protection(), smoothed.protection());
    let hidden = Protection {
        horizontal: told.horizontal - own.horizontal,
        vertical: told.vertical - own.vertical,
    };
    Solution { hidden, ..smoothed }
}
