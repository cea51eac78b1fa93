//! Several antennas of one hull: how it stands, by phases whose whole cycles are known.
//!
//! Cycles were told without the filter, so that nothing is counted twice but the phases of the epoch. What reflects goes on for minutes: it is a state.

use insd_base::satellites::{CompassPhases, CompassReading};
use insd_base::{Rejection, Source};
use nalgebra::{Matrix1, Matrix3};

use super::Filter;
use super::antennas_followed::sky_of;
use super::entry::{COMPASS_AID, Judged, NO_INNOVATION, enter};
use crate::aids::{antenna_heading, antenna_phases};
use crate::declaration::Carried;
use crate::error_state::{
    ANTENNA_AXES, ANTENNA_HEADING_ERROR, ANTENNA_LINES, ANTENNA_REFLECTIONS, ANTENNA_ROWS,
    Innovation, LINE_UNKNOWN, LINES,
};
use crate::judge::{Aid, rows};
use crate::report::{Outcome, Report};

/// Variance of what reflects under another sky than before, in that of one epoch.
const OTHER_SKY: f64 = 2.0;
/// A filter that has had no fix for so long drifts, s.
const UNFIXED: f64 = 3.0;
/// A heading that is less sure than this, rad, 1-sigma, tells the judge nothing, and none is surer than that.
const UNSURE: f64 = 0.1;
const SUREST: f64 = 1e-3;
/// After so many epochs in a row that contradict the filter its lines are not those of the antennas.
const CONTRADICTED: u8 = 5;

impl Filter {
    pub(super) fn apply_compass(
        &mut self,
        reading: &CompassReading,
        source: Source,
        report: &mut Report,
    ) {
        let Ok(told) = &reading.told else { return };
        if !self.navigating {
            return;
        }
        if self.companion.is_none() {
            self.judge_antennas(told);
        }
        if self.withholds(Aid::Antennas) {
            let outcome = Outcome::Rejected(Rejection::SourceSuspect);
            let judged = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
            enter(report, reading.time, source, COMPASS_AID, &judged);
            return;
        }
        self.begin_with_antennas();
        self.seat_lines(told, reading.run);
        self.seat_reflections(told);
        let lines = &self.antennas.lines;
        let innovation = antenna_phases::innovation(&self.view(), &told.signals, lines);
        let Some(innovation) = innovation else { return };
        let judged = self.gated(&innovation, None);
        let outcome = enter(report, reading.time, source, COMPASS_AID, &judged);
        self.note_compass(outcome);
    }

    /// Lets the judge hear the heading that antennas tell. Gives it as it is to be used by who does not follow their phases.
    fn judge_antennas(&mut self, told: &CompassPhases) -> Option<Innovation> {
        let stated = told.covariance[(2, 2)] - self.config.antennas.axes_std.z.powi(2);
        let std = stated.max(SUREST * SUREST).sqrt();
        if std > UNSURE || self.court.judge.is_none() {
            return None;
        }
        self.begin_to_carry(Carried::WithAntennaHeading);
        let (sky, is_other) = sky_of(told, &self.antennas.heard_sky);
        self.antennas.heard_sky = sky;
        if is_other {
            self.forget_reflected_heading();
        }
        let heading = told.attitude.heading;
        let mut innovation = antenna_heading::innovation(&self.view(), heading, std);
        innovation.r *= self.noise_of(Aid::Antennas);
        self.consult(Aid::Antennas, &innovation, rows::of_antennas);
        Some(innovation)
    }

    /// What is reflected under another sky is another error of the heading.
    fn forget_reflected_heading(&mut self) {
        let unknown = Matrix1::new(OTHER_SKY);
        self.state.nominal.antenna_heading_error = 0.0;
        ANTENNA_HEADING_ERROR.renew(&mut self.state.covariance, &unknown);
        if let Some(judge) = self.judge_now() {
            judge.renew(ANTENNA_HEADING_ERROR, &unknown);
        }
    }

    /// Lets the judge hear the heading, and takes it, of antennas of which another filter follows the phases. Without fixes this one drifts, and
    /// what it would make of somebody's lie is nothing that happens to the other, whose ranges go on.
    pub(super) fn hear_antennas(&mut self, told: &CompassPhases) {
        let fixed = self.receiver.trust.last_used();
        if fixed.is_none_or(|last| (self.state.time - last).as_seconds() > UNFIXED) {
            return;
        }
        self.settle();
        if let Some(innovation) = self.judge_antennas(told) {
            let refused = self.withholds(Aid::Antennas).then_some(Rejection::SourceSuspect);
            self.gated(&innovation, refused);
        }
        self.heed();
    }

    /// Their states join; how they sit is known better about one axis than about another.
    fn begin_with_antennas(&mut self) {
        if !self.state.covariance.has(ANTENNA_AXES) {
            self.begin_to_carry(Carried::WithAntennas);
            let std = self.config.antennas.axes_std;
            let known = Matrix3::from_diagonal(&std.component_mul(&std));
            ANTENNA_AXES.renew(&mut self.state.covariance, &known);
        }
    }

    /// Lines of integers that were found anew, and those that are new, are not known.
    fn seat_lines(&mut self, told: &CompassPhases, run: u32) {
        if self.antennas.run != Some(run) {
            self.antennas.run = Some(run);
            self.forget_lines();
        }
        let phases = told.signals.iter().flat_map(|signal| &signal.phases);
        for line in phases.filter_map(|phase| phase.line) {
            let lines = &mut self.antennas.lines;
            if lines.len() < LINES && !lines.contains(&line) {
                lines.push(line);
            }
        }
    }

    fn forget_lines(&mut self) {
        self.antennas.lines.clear();
        self.state.nominal.antenna_lines.fill(0.0);
        let covariance = &mut self.state.covariance;
        for line in 0..LINES {
            covariance.renew_state(ANTENNA_LINES.key(), line, LINE_UNKNOWN * LINE_UNKNOWN);
        }
    }

    /// Under another sky reflections are others, and no news altogether: the ship that reflects is the same. They count as twice as large.
    fn seat_reflections(&mut self, told: &CompassPhases) {
        let (sky, is_other) = sky_of(told, &self.antennas.sky);
        if is_other {
            self.state.nominal.antenna_reflections.fill(0.0);
            for row in 0..ANTENNA_ROWS {
                self.state.covariance.renew_state(ANTENNA_REFLECTIONS.key(), row, OTHER_SKY);
            }
        }
        self.antennas.sky = sky;
    }

    fn note_compass(&mut self, outcome: Outcome) {
        if outcome == Outcome::Accepted {
            self.antennas.contradicted = 0;
            return;
        }
        self.antennas.contradicted += 1;
        if self.antennas.contradicted >= CONTRADICTED {
            self.antennas.contradicted = 0;
            self.forget_lines();
        }
    }
}
