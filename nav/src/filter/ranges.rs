//! Ranges of satellites: each counts for itself, down to the last one.

use insd_base::satellites::{SatelliteRange, SatelliteRanges, SatelliteUse};
use insd_base::{Rejection, SatelliteId, SatelliteInnovation, Source, Time};
use insd_estimation::Innovation;
use nalgebra::Matrix3;

use super::Filter;
use super::bent::bent_distance;
use super::entry::{CODE_AID, Judged, NO_INNOVATION, PHASE_AID, RATE_AID, enter};
use super::gnss::SLACK;
use super::satellites::{Slot, are_most};
use crate::aids::satellite_range::{self, Antenna, Sighted};
use crate::declaration::Carried;
use crate::error_state::{
    ATTITUDE, PHASE_CONSTANTS, PHASE_DRIFT, PHASE_DRIFTS, RANGE_ERRORS, REFLECTIONS, Weighed,
};
use crate::judge::Aid;
use crate::receiver_clock;
use crate::report::{Outcome, Report};

/// A row is at fault beyond so many sigmas of what all others let expect of it: by chance once in 150 000.
const FAULT: f64 = 4.5;
/// So long nearly all satellites may contradict the filter, s, before it begins anew from what fixes make of the ship.
const STRIFE: f64 = 5.0;
/// One that was at fault agrees within so many sigmas.
const AGREES: f64 = 3.0;
/// No slip is smaller, m.
const SLIP: f64 = 0.03;
/// A clock that is off by more than this has jumped, m: codes err by less.
const JUMP: f64 = 300.0;
/// How stiff masts are taken to be where phases tell, 1-sigma, m.
const SLACK_PHASE: f64 = 0.01;
/// A place of which the ranges of enough satellites tell all, 1-sigma, m.
pub(super) const UNKNOWN_PLACE: f64 = 30.0;
/// Codes of epochs that are closer than this, s, are no news: a receiver's loop smooths them, and what reflects is the same.
const CODE_TIME: f64 = 1.0;
/// The codes of an arc that lasts count with a variance that grows by itself in each time of this, s. The errors of codes have all periods, from the
/// receiver's noise to what the quay reflects for an hour: of such noise (flicker) a mean gets better with the logarithm of the time only.
const NEWS_TIME: f64 = 2.0;
/// A constant of which nothing is known, m.
const UNKNOWN_CONSTANT: f64 = 100.0;

/// Rows of one kind, and whose they are: among those seated, and by name.
struct Rows {
    all: Innovation,
    of: Vec<usize>,
    names: Vec<SatelliteId>,
}

impl Filter {
    /// What becomes of a satellite that has a range.
    #[must_use]
    pub fn fate_of(&self, range: &SatelliteRange) -> SatelliteUse {
        self.satellites.fate_of(range, self.state.time)
    }

    pub(super) fn apply_ranges(
        &mut self,
        told: &SatelliteRanges,
        source: Source,
        report: &mut Report,
    ) {
        if told.ranges.is_empty() || !self.navigating {
            return;
        }
        if let Some(reason) = self.why_no_ranges() {
            let outcome = Outcome::Rejected(reason);
            let judged = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
            enter(report, told.time, source, CODE_AID, &judged);
            return;
        }
        self.be_accompanied();
        self.begin_with_ranges(told, source);
        self.carry_clock();
        let seated = self.seat(told);
        self.look_for_clock_jump(&seated);
        let seated = self.use_codes(seated, (told, source), report);
        if let Some(lasts) = self.satellites.strife(self.state.time) {
            if lasts > STRIFE {
                self.go_on_without_ranges(report);
            }
            return;
        }
        self.begin_arcs(&seated);
        self.use_phases(&seated, (told, source), report);
        self.use_rates(&seated, (told, source), report);
        // what has moved this one has not moved the companion, and the next fix is a second away
        self.claim_both();
        self.protect_at_epochs();
    }

    /// Ranges are not for a ship whose receiver is left out, nor, good to millimetres as they are, for an antenna of which nobody knows the place.
    fn why_no_ranges(&self) -> Option<Rejection> {
        if self.companion.is_none() && self.withholds(Aid::GnssPosition) {
            Some(Rejection::SourceSuspect)
        } else {
            self.config.is_gnss_lever_unknown().then_some(Rejection::NotUsable)
        }
    }

    /// The states of satellites join; what judges fixes has nothing to judge.
    fn begin_with_ranges(&mut self, told: &SatelliteRanges, source: Source) {
        self.begin_to_carry(Carried::WithRanges);
        let is_first = self.satellites.last.is_none();
        if self.satellites.is_of_other(source) {
            let (offset, drift) = told.clock.unwrap_or_default();
            let state = &mut self.state;
            receiver_clock::renew(&mut state.nominal, &mut state.covariance, offset, Some(drift));
            self.satellites.last = Some(self.state.time);
        }
        if told.clock.is_some() && self.satellites.place() {
            self.forget_fixed_place();
        }
        if is_first {
            self.take_over_claims();
            self.be_judged();
            // of the place they stay what they are
            let companion = self.companion.as_deref();
            self.court.covered = companion.and_then(Filter::cover);
        }
    }

    /// Fixes have the slow errors of the same orbits and the same air: a place that they told would be counted twice.
    fn forget_fixed_place(&mut self) {
        if self.receiver.rtk != Some(true) {
            let unknown = Matrix3::from_diagonal_element(UNKNOWN_PLACE * UNKNOWN_PLACE);
            self.renew_place(&unknown);
        }
    }

    /// What was claimed of the heading because somebody may lie is what the filter itself takes it for from now on.
    fn take_over_claims(&mut self) {
        let Some(covered) = self.court.covered.take() else { return };
        let own = self.own_heading_std();
        let more = covered.heading * covered.heading - own * own;
        let down = self.view().c_ne.row(2).transpose();
        ATTITUDE.add(&mut self.state.covariance, &(down * down.transpose() * more.max(0.0)));
        self.part_with_past();
    }

    fn carry_clock(&mut self) {
        let now = self.state.time;
        let elapsed = self.satellites.last.map_or(0.0, |last| (now - last).as_seconds());
        let state = &mut self.state;
        let model = &self.config.ranges;
        let elapsed = elapsed.max(0.0);
        self.satellites.apart = elapsed;
        receiver_clock::carry(&mut state.nominal, &mut state.covariance, model, elapsed);
        receiver_clock::carry_constants(&mut state.nominal, &mut state.covariance, elapsed);
        self.satellites.last = Some(now);
    }

    fn seat<'a>(&mut self, told: &'a SatelliteRanges) -> Vec<Sighted<'a>> {
        let now = self.state.time;
        let mut highest: Vec<_> = told.ranges.iter().collect();
        highest.sort_by(|a, b| b.elevation.total_cmp(&a.elevation));
        let mut seated = Vec::with_capacity(highest.len());
        for range in highest {
            let Some((slot, is_new)) = self.satellites.seat(range, now) else { continue };
            if is_new {
                self.forget_code_errors(slot);
                self.state.nominal.phase_drifts[slot] = 0.0;
                let covariance = &mut self.state.covariance;
                covariance.renew_state(PHASE_DRIFTS.key(), slot, PHASE_DRIFT * PHASE_DRIFT);
            }
            seated.push(Sighted { range, slot });
        }
        seated
    }

    /// Nothing is known any more of what a satellite's code is off by.
    pub(super) fn forget_code_errors(&mut self, slot: usize) {
        self.state.nominal.range_errors[slot] = 0.0;
        self.state.nominal.reflections[slot] = 0.0;
        let covariance = &mut self.state.covariance;
        covariance.renew_state(RANGE_ERRORS.key(), slot, 1.0);
        covariance.renew_state(REFLECTIONS.key(), slot, 1.0);
    }

    fn antenna(&self) -> Antenna {
        Antenna::of(&self.view(), &self.antenna_lever(), &self.antenna_velocity())
    }

    /// A clock that is set moves all ranges alike.
    fn look_for_clock_jump(&mut self, seated: &[Sighted<'_>]) {
        let (view, antenna) = (self.view(), self.antenna());
        let off = |seated: &Sighted<'_>| {
            let code = seated.range.code?.value;
            Some(code - satellite_range::predicted(&view, &antenna, seated.range))
        };
        let mut off: Vec<f64> = seated.iter().filter_map(off).collect();
        off.sort_by(f64::total_cmp);
        let Some(middle) = off.get(off.len() / 2).copied() else { return };
        if middle.abs() > JUMP {
            let offset = self.state.nominal.receiver_clock.x + middle;
            let state = &mut self.state;
            receiver_clock::renew(&mut state.nominal, &mut state.covariance, offset, None);
        }
    }

    /// Constants of arcs that have begun are what makes the phase fit, and unknown.
    fn begin_arcs(&mut self, seated: &[Sighted<'_>]) {
        let now = self.state.time;
        let (mut new, mut all) = (0, 0);
        for one in seated {
            let Some(phase) = one.range.phase else { continue };
            let known = self.satellites.slot_mut(one.slot);
            let is_new = known.is_some_and(|slot| slot.goes_over_to(phase.arc, now));
            all += 1;
            if is_new {
                new += 1;
                self.begin_arc(one);
            }
        }
        self.satellites.note_breaks(new, all, self.state.time);
    }

    fn begin_arc(&mut self, one: &Sighted<'_>) {
        let (view, antenna) = (self.view(), self.antenna());
        let Some(phase) = one.range.phase else { return };
        let constant = phase.phase.value - satellite_range::predicted(&view, &antenna, one.range);
        self.state.nominal.phase_constants[one.slot] = constant;
        let variance = UNKNOWN_CONSTANT * UNKNOWN_CONSTANT;
        self.state.covariance.renew_state(PHASE_CONSTANTS.key(), one.slot, variance);
    }

    fn use_phases(
        &mut self,
        seated: &[Sighted<'_>],
        from: (&SatelliteRanges, Source),
        report: &mut Report,
    ) {
        let (view, antenna) = (self.view(), self.antenna());
        let attitude = ATTITUDE.covariance(&self.state.covariance);
        let row = |one: &Sighted<'_>| {
            let mut row = satellite_range::phase(&view, &antenna, *one)?;
            let antenna = antenna.of_range(&view, one.range);
            let line = one.range.transmitter.line(&antenna.position);
            row.r[(0, 0)] += bent_distance(&attitude, &line, &antenna.arm);
            Some(row)
        };
        let Some(mut rows) = Rows::of(seated, row) else { return };
        self.satellites.unrest.spread(&mut rows.all, self.state.time);
        let (_, slipped) = self.absorb_rows(rows, seated, SLIP, (PHASE_AID, from), report);
        for one in slipped.iter().filter_map(|index| seated.get(*index)) {
            self.begin_arc(one);
        }
    }

    /// Of satellites without a phase, which tells it better; one whose phase has just slipped may be a reflection.
    fn use_rates(
        &mut self,
        seated: &[Sighted<'_>],
        from: (&SatelliteRanges, Source),
        report: &mut Report,
    ) {
        let (view, antenna) = (self.view(), self.antenna());
        let lever = self.antenna_lever();
        let row = |one: &Sighted<'_>| {
            one.range
                .phase
                .is_none()
                .then(|| satellite_range::rate(&view, &antenna, one.range, &lever))
                .flatten()
        };
        if let Some(rows) = Rows::of(seated, row) {
            self.absorb_rows(rows, seated, 0.0, (RATE_AID, from), report);
        }
    }

    /// Returns the satellites that nothing speaks against: one whose code is a reflection's has that phase, too.
    fn use_codes<'a>(
        &mut self,
        seated: Vec<Sighted<'a>>,
        from: (&SatelliteRanges, Source),
        report: &mut Report,
    ) -> Vec<Sighted<'a>> {
        let is_out =
            |one: &Sighted<'_>| self.satellites.slot(one.slot).is_some_and(Slot::is_excluded);
        let (out, used): (Vec<_>, Vec<_>) = seated.into_iter().partition(is_out);
        self.hear_excluded(&out, from.0.time, report);
        let now = self.state.time;
        let Some(rows) = self.code_rows(&used) else { return used };
        let (accepted, faulty) = self.absorb_rows(rows, &used, 0.0, (CODE_AID, from), report);
        if !accepted.is_empty() {
            self.receiver.trust.used(self.state.time);
        }
        for one in faulty.iter().filter_map(|index| used.get(*index)) {
            let slot = self.satellites.slot_mut(one.slot);
            let excluded = slot.and_then(|slot| slot.exclude(now));
            report.satellites.extend(excluded.map(|satellite| (now, satellite, true)));
        }
        let good = used.into_iter().enumerate().filter(|(index, _)| !faulty.contains(index));
        good.map(|(_, one)| one).collect()
    }

    fn code_rows(&self, seated: &[Sighted<'_>]) -> Option<Rows> {
        let (view, antenna) = (self.view(), self.antenna());
        let apart = self.satellites.apart;
        let alike = if apart > 0.0 { (CODE_TIME / apart).max(1.0) } else { 1.0 };
        Rows::of(seated, |one| {
            let mut row = satellite_range::code(&view, &antenna, *one)?;
            row.r *= alike;
            Some(row)
        })
    }

    /// Weighs codes that nothing speaks against for what is news in them: of a satellite whose phase goes on the next code says little that those before
    /// have not said.
    fn weigh_news(&self, rows: &mut Rows, seated: &[Sighted<'_>]) -> Option<Weighed> {
        for (row, index) in rows.of.iter().enumerate() {
            let slot = self.satellites.slot(seated[*index].slot);
            let lasts = slot.map_or(0.0, |slot| slot.arc_lasts(self.state.time));
            rows.all.r[(row, row)] *= 1.0 + lasts / NEWS_TIME;
        }
        rows.all.weigh(&self.state.covariance)
    }

    /// Those that are left out are listened to and not used.
    fn hear_excluded(&mut self, out: &[Sighted<'_>], sampled: Time, report: &mut Report) {
        let now = self.state.time;
        for one in out {
            let rows = self.code_rows(std::slice::from_ref(one));
            let told = rows.and_then(|rows| Some((rows.all.weigh(&self.state.covariance)?, rows)));
            let agrees = told.as_ref().is_some_and(|(own, _)| own.nis() < AGREES * AGREES);
            report
                .ranges
                .extend(told.iter().flat_map(|(own, rows)| rows.told(own, CODE_AID, sampled)));
            let Some(slot) = self.satellites.slot_mut(one.slot) else { continue };
            let readmitted = if agrees { slot.agree() } else { slot.exclude(now) };
            let is_excluded = !agrees;
            report.satellites.extend(readmitted.map(|satellite| (now, satellite, is_excluded)));
        }
    }

    /// Absorbs rows but for those that contradict all others by more than `least`; returns whose were used, and whose were not.
    fn absorb_rows(
        &mut self,
        mut rows: Rows,
        seated: &[Sighted<'_>],
        least: f64,
        (aid, (told, source)): (&'static str, (&SatelliteRanges, Source)),
        report: &mut Report,
    ) -> (Vec<usize>, Vec<usize>) {
        let mut left_out = Vec::new();
        let mut innovations = Vec::new();
        let all = rows.of.len();
        let weighed = loop {
            if are_most(left_out.len(), all) {
                break None;
            }
            let Some(weighed) = rows.all.weigh(&self.state.covariance) else { break None };
            if left_out.is_empty() {
                innovations.extend(rows.told(&weighed, aid, told.time));
            }
            match worst(&weighed, least) {
                Some(row) if rows.of.len() > 1 => left_out.push(rows.remove(row)),
                Some(_) => {
                    left_out.append(&mut rows.of);
                    break None;
                }
                None if aid == PHASE_AID => {
                    let unrest = &mut self.satellites.unrest;
                    break Some(unrest.hear((&rows.all, weighed), &self.state.covariance));
                }
                None if aid == CODE_AID => break self.weigh_news(&mut rows, seated),
                None => break Some(weighed),
            }
        };
        let outcome = match &weighed {
            Some(weighed) => {
                let slack = if aid == CODE_AID { SLACK } else { SLACK_PHASE };
                self.installation.bias.iter_mut().for_each(|bias| bias.hear(weighed, slack));
                self.absorb(weighed);
                Outcome::Accepted
            }
            None => Outcome::Rejected(Rejection::ChiSquare),
        };
        let judged = Judged { outcome, log_likelihood: 0.0, innovation: NO_INNOVATION };
        enter(report, told.time, source, aid, &judged);
        let (used, names) =
            if weighed.is_some() { (rows.of, rows.names) } else { Default::default() };
        innovations.iter_mut().for_each(|own| own.accepted = names.contains(&own.satellite));
        report.ranges.append(&mut innovations);
        (used, left_out)
    }
}

impl Rows {
    /// Of all that have one; `None` where nobody has.
    fn of(
        seated: &[Sighted<'_>],
        row: impl Fn(&Sighted<'_>) -> Option<Innovation>,
    ) -> Option<Self> {
        let own = |(index, one)| Some((index, row(one)?));
        let (of, own): (Vec<_>, Vec<_>) = seated.iter().enumerate().filter_map(own).unzip();
        let names = of.iter().map(|index| seated[*index].range.satellite).collect();
        (!of.is_empty()).then(|| Rows { all: Innovation::stacked(own.iter()), of, names })
    }

    /// Takes a row out; returns whose it was.
    fn remove(&mut self, row: usize) -> usize {
        let kept: Vec<usize> = (0..self.of.len()).filter(|index| *index != row).collect();
        self.all = self.all.select(&kept);
        self.names.remove(row);
        self.of.remove(row)
    }

    /// What each tells beside what was expected, for those who look on; none of them is used so far.
    fn told(&self, weighed: &Weighed, aid: &'static str, time: Time) -> Vec<SatelliteInnovation> {
        let (z, sigmas) = (weighed.z(), weighed.sigma());
        let rows = self.names.iter().zip(z.iter().zip(&sigmas));
        rows.map(|(satellite, (innovation, sigma))| SatelliteInnovation {
            time,
            aid,
            satellite: *satellite,
            innovation: *innovation,
            sigma: *sigma,
            accepted: false,
        })
        .collect()
    }
}

/// The row that lies farthest from what all others let expect of it, if that is a fault: `(S^-1 z)_i / sqrt((S^-1)_ii)`, which is what is left of a row
/// after an update with all others, in its sigmas (Teunissen, Testing Theory, section 4.3), and by more than `least`.
fn worst(weighed: &Weighed, least: f64) -> Option<usize> {
    let inverse = weighed.covariance().try_inverse()?;
    let drawn = &inverse * weighed.z();
    let left = |row: usize| {
        let precision = inverse[(row, row)];
        let beyond = drawn[row].abs() / precision;
        let sigmas = drawn[row].abs() / precision.sqrt();
        (sigmas > FAULT && beyond > least).then_some((row, sigmas))
    };
    let far = (0..weighed.rows()).filter_map(left);
    far.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(row, _)| row)
}
